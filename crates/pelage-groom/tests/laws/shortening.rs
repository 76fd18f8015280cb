//! What makes hairs shorter, or fewer their vertices: cut, thinning, lengths of nothing.

use crate::fixture::{Fixture, collect, request};
use pelage_curves::catmull_rom;
use pelage_groom::{Capture, Clock, Pose, Scratch, generate};
use pelage_strands::{Collect, StrandBuffer, validate};

#[test]
fn a_hair_cut_at_c_ends_at_its_point_c_and_keeps_what_is_before() {
    let whole = collect(&Fixture::default().plan(), 0..2000, 2);
    for (more, part) in [
        ("cut.length = 0.7", 0.7f32),
        ("cut.length = 0.5", 0.5),
        ("cut.length = 0.01", 0.01),
        ("cut.length = { map = 'length.png' }", f32::NAN),
        ("cut.length = { value = 1.0, map = 'one.png' }", 1.0),
    ] {
        let fixture = Fixture {
            more,
            ..Fixture::default()
        };
        let hairs = collect(&fixture.plan(), 0..2000, 2);
        assert_eq!(hairs.len(), whole.len());
        for i in 0..hairs.len() {
            let (cut, all) = (hairs.strand_points(i), whole.strand_points(i));
            let vertices = hairs.vertices(i);
            // Widths go from 0.02 to 0 along a whole hair: they tell where it ends.
            let end = 1.0 - hairs.widths[vertices.end - 1] / 0.02;
            assert!(part.is_nan() || (end - part).abs() < 1e-5, "{more}: {end}");
            let pieces = all.len() - 1;
            let piece = ((end * pieces as f32) as usize).min(pieces - 1);
            let inside = end * pieces as f32 - piece as f32;
            let expected = catmull_rom::position(catmull_rom::window(all, piece), inside);
            let last = cut[cut.len() - 1];
            assert!(last.distance(expected) < 1e-4, "{more}: {last} {expected}");
            assert_eq!(cut[..cut.len() - 1], all[..cut.len() - 1]);
            assert!(cut.len() <= piece + 2 && cut.len() >= 2);
        }
    }
    let none = Fixture {
        more: "cut.length = 0",
        ..Fixture::default()
    };
    assert!(collect(&none.plan(), 0..100, 1).is_empty());
}

#[test]
fn thinning_drops_vertices_where_hairs_are_straight_the_same_ones_in_all_frames() {
    let more = "output.skip_threshold = 0.9
        frizz = { tip = 0.3, animation = { amount = 1.0, speed = 0.3 } }";
    let thin = Fixture {
        more,
        ..Fixture::default()
    }
    .plan();
    let all = Fixture {
        more: "frizz.tip = 0.3",
        ..Fixture::default()
    };
    let (thinned, whole) = (collect(&thin, 0..2000, 2), collect(&all.plan(), 0..2000, 2));
    assert!(thinned.points.len() * 10 < whole.points.len() * 9);
    for i in 0..whole.len() {
        let mut left = thinned.strand_points(i).iter();
        let widths = &thinned.widths[thinned.vertices(i)];
        let points = whole.strand_points(i);
        // What is left are vertices of the whole hair, in order, with their widths.
        let mut next = left.next();
        let mut found = 0;
        for (point, width) in points.iter().zip(&whole.widths[whole.vertices(i)]) {
            if next == Some(point) {
                assert_eq!(*width, widths[found]);
                found += 1;
                next = left.next();
            }
        }
        assert_eq!(next, None, "hair {i}");
        assert_eq!(thinned.strand_points(i)[0], points[0]);
        assert_eq!(widths[found - 1], 0.0);
    }
    let (mut capture, mut clock) = (Capture::default(), Clock::default());
    let (mut scratch, mut out) = (Scratch::default(), StrandBuffer::new());
    thin.capture(0..2000, &mut capture, &mut clock);
    for time in [1.0, 5.0, 40.0] {
        let pose = Pose {
            time,
            ..Pose::default()
        };
        let posed = thin.posed(&pose).unwrap();
        thin.evaluate(&capture, &posed, &mut scratch, &mut out, &mut clock);
        assert_eq!(out.offsets, thinned.offsets);
        assert!(out.points != thinned.points);
    }
}

#[test]
fn hairs_too_short_for_their_coordinates_are_left_out_and_counted() {
    for (amount, left) in [("1e-9", 0), ("1.0", 5000)] {
        let more = format!("[scale]\namount = {amount}");
        let fixture = Fixture {
            flat: true,
            more: &more,
            ..Fixture::default()
        };
        let mut sink = Collect::default();
        let mut still = |_| Ok(Pose::default());
        let request = request(0..5000, 2);
        let report = generate(
            &fixture.plan(),
            &request,
            &mut still,
            &mut sink,
            &mut |_| true,
        );
        let report = report.unwrap();
        assert_eq!(report.strands, left);
        assert_eq!(report.dropped.without_length, 5000 - left);
        assert!(validate(&sink.strands).is_empty());
    }
}
