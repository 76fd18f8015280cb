//! The eight laws of the design (ARCHITECTURE.md), each as a test.

// Clippy's exception for tests does not reach the helpers of an integration test.
#![allow(clippy::unwrap_used)]

mod clump;
mod fixture;
mod interpolation;
mod look;
mod order;
mod pose;
mod ramp;
mod strand;

use fixture::{Fixture, collect, fibers, kinds, moved, request, strands};
use pelage_curves::{Vec3, catmull_rom};
use pelage_groom::{Capture, Clock, Plan, Pose, Scratch, generate, write_roots};
use pelage_strands::{
    Amount, BoundsSink, Collect, Sink, SinkError, StrandBuffer, StreamInfo, validate,
};

fn plan() -> Plan {
    Fixture::default().plan()
}

#[test]
fn law_1_any_split_thread_count_and_chunk_gives_the_same_bits() {
    for fixture in kinds() {
        let (plan, more) = (fixture.plan(), fixture.more);
        let whole = collect(&plan, 0..5000, 1);
        assert_eq!(whole.len(), 5000 * fibers(&whole));
        for threads in [2, 3, 7] {
            let same = collect(&plan, 0..5000, threads) == whole;
            assert!(same, "{threads} threads, {more}");
        }
        for cuts in [&[0, 5000][..], &[0, 1, 5000], &[0, 1023, 1025, 4096, 5000]] {
            let mut joined = StrandBuffer::new();
            for pair in cuts.windows(2) {
                joined.append(&collect(&plan, pair[0]..pair[1], 2));
            }
            assert!(joined == whole, "cuts at {cuts:?}, {more}");
        }
    }
}

#[test]
fn law_1_the_same_bytes_on_every_machine() {
    // A change here changes every groom of every user: say so in CHANGELOG.md.
    const EXPECTED: u64 = 0xf70c_2759_580a_64ec;
    let strands = collect(&plan(), 0..2000, 2);
    let mut hash = 0xcbf2_9ce4_8422_2325u64;
    let mut add = |bytes: &[u8]| {
        for b in bytes {
            hash = (hash ^ *b as u64).wrapping_mul(0x0100_0000_01b3);
        }
    };
    add(bytemuck::cast_slice(&strands.points));
    add(bytemuck::cast_slice(&strands.normals));
    add(bytemuck::cast_slice(&strands.colors));
    add(bytemuck::cast_slice(&strands.barycentric));
    assert_eq!(hash, EXPECTED, "hash {hash:#018x}");
}

#[test]
fn law_2_more_hair_keeps_the_old_hair() {
    for fixture in kinds() {
        let more = fixture.more;
        let few = Fixture {
            count: 1000,
            ..fixture
        };
        let many = Fixture {
            count: 2000,
            ..fixture
        };
        let few = collect(&few.plan(), 0..1000, 1);
        let first = collect(&many.plan(), 0..1000, 1);
        assert!(few == first, "{more}");
    }
}

#[test]
fn law_3_hairs_of_the_voxels_are_exactly_the_whole_and_bit_for_bit_the_same() {
    for fixture in kinds() {
        let plan = fixture.plan();
        let whole = collect(&plan, 0..3000, 1);
        for resolution in [[1, 1, 1], [2, 3, 1], [4, 4, 4]] {
            let voxels = plan.roots().voxels(resolution).unwrap();
            let mut seen = vec![false; 3000];
            for cell in 0..voxels.cells() {
                let hairs = voxels.hairs(cell, 3000);
                let part = strands(&plan, &hairs, None);
                let fibers = fibers(&whole);
                assert_eq!(part.len(), hairs.len() * fibers);
                for (i, &hair) in hairs.iter().enumerate() {
                    let hair = hair as usize;
                    let twice = std::mem::replace(&mut seen[hair], true);
                    assert!(!twice, "hair {hair} twice, {}", fixture.more);
                    for k in 0..fibers {
                        let (one, same) = (i * fibers + k, hair * fibers + k);
                        assert_eq!(part.strand_points(one), whole.strand_points(same));
                        assert_eq!(part.strand_id[one] as usize, k);
                    }
                }
            }
            assert!(seen.iter().all(|s| *s), "{resolution:?}, {}", fixture.more);
        }
    }
}

#[test]
fn law_4_a_rigid_motion_moves_every_hair_rigidly() {
    for fixture in kinds() {
        let plan = fixture.plan();
        let rest = collect(&plan, 0..1000, 1);
        let (turn, shift) = fixture::motion();
        let pose = plan
            .rest()
            .posed(&moved(&fixture.mesh(), turn, shift), true)
            .unwrap();
        let hairs: Vec<u64> = (0..1000).collect();
        let posed = strands(&plan, &hairs, Some(&pose));
        assert!(rest.offsets == posed.offsets, "{}", fixture.more);
        for (p, q) in rest.points.iter().zip(&posed.points) {
            let expected = turn * Vec3::from(*p) + shift;
            assert!(expected.distance(Vec3::from(*q)) < 4e-5, "{expected} {q:?}");
        }
        for (n, m) in rest.normals.iter().zip(&posed.normals) {
            assert!((turn * Vec3::from(*n)).distance(Vec3::from(*m)) < 1e-3);
        }
        assert_eq!(rest.root_rest, posed.root_rest);
    }
}

#[test]
fn law_5_a_plan_that_was_made_gives_sound_strands() {
    for fixture in kinds() {
        let strands = collect(&fixture.plan(), 0..5000, 2);
        let faults = validate(&strands);
        assert!(faults.is_empty(), "{}, {}", faults[0], fixture.more);
    }
}

#[test]
fn law_6_bounds_are_a_sink_and_hold_the_curves() {
    for fixture in kinds() {
        let (plan, more) = (fixture.plan(), fixture.more);
        let mut bounds = BoundsSink::default();
        let mut still = |_| Ok(Pose::default());
        let request = request(0..1000, 2);
        generate(&plan, &request, &mut still, &mut bounds, &mut |_| true).unwrap();
        let all = bounds.all();
        let strands = collect(&plan, 0..1000, 1);
        for strand in 0..strands.len() {
            let points = strands.strand_points(strand);
            let pieces = points.len() - 1;
            for k in 0..1024 {
                let along = k as f32 / 1023.0 * pieces as f32;
                let piece = (along as usize).min(pieces - 1);
                let window = catmull_rom::window(points, piece);
                let p = catmull_rom::position(window, along - piece as f32);
                for axis in 0..3 {
                    let inside = all.min[axis] - 1e-6..=all.max[axis] + 1e-6;
                    assert!(inside.contains(&p[axis]), "{more}");
                }
            }
        }
    }
}

#[test]
fn law_7_a_strand_holds_its_real_vertices_only() {
    let strands = collect(&plan(), 0..500, 1);
    for strand in 0..strands.len() {
        let points = strands.strand_points(strand);
        assert_eq!(points.len(), 7, "six segments");
        assert!(points.windows(2).all(|w| w[0] != w[1]));
        let root = Vec3::from(strands.root_rest[strand]);
        assert!(points[0].distance(root) < 1e-6);
    }
}

#[test]
fn law_8_roots_inside_one_small_triangle_do_not_fall_on_lines() {
    // Document 004 in floats leaves about 4 bits inside one of a million triangles;
    // here the hairs of one triangle of a fine mesh all differ in both weights.
    let fixture = Fixture {
        rings: 256,
        ..Fixture::default()
    };
    let plan = fixture.plan();
    let sampler = plan.roots().sampler().unwrap();
    let place = sampler.place(1 << 63, 1 << 31);
    let mut weights: Vec<u32> = (0..4096u64)
        .map(|k| sampler.place((1 << 63) + (k << 31), 1 << 31))
        .filter(|p| p.triangle == place.triangle)
        .map(|p| p.barycentric[1].to_bits())
        .collect();
    let drawn = weights.len();
    weights.sort_unstable();
    weights.dedup();
    assert!(drawn > 500, "{drawn}");
    assert!(
        weights.len() * 10 > drawn * 9,
        "{} of {drawn} differ",
        weights.len()
    );
}

#[test]
fn roots_by_themselves_are_those_of_the_hairs() {
    for fixture in kinds() {
        let plan = fixture.plan();
        let hairs = collect(&plan, 0..5000, 1);
        let mut roots = Collect::default();
        let request = request(0..5000, 2);
        write_roots(plan.roots(), &request, None, &mut roots, &mut |_| true).unwrap();
        let (roots, fibers) = (roots.strands, fibers(&hairs));
        for (i, root) in roots.points.iter().enumerate() {
            let hair = i * fibers;
            assert_eq!(roots.hair_id[i], hairs.hair_id[hair]);
            assert_eq!(roots.barycentric[i], hairs.barycentric[hair]);
            assert_eq!(roots.root_rest[i], hairs.root_rest[hair]);
            if fibers > 1 {
                continue;
            }
            let first = hairs.strand_points(i)[0];
            assert!(Vec3::from(*root).distance(first) < 1e-6, "{}", fixture.more);
        }
    }
}

#[test]
fn displaced_roots_stand_off_the_surface_by_the_map_and_the_rest_stays() {
    let plain = plan();
    let fixture = Fixture {
        more: fixture::DISPLACED,
        ..Fixture::default()
    };
    let (flat, bumpy) = (
        collect(&plain, 0..2000, 1),
        collect(&fixture.plan(), 0..2000, 1),
    );
    assert_eq!(flat.root_rest, bumpy.root_rest);
    assert_eq!(flat.barycentric, bumpy.barycentric);
    let mut turned = 0;
    for i in 0..flat.len() {
        let [from, to] = [&flat, &bumpy].map(|hair| hair.strand_points(i)[0]);
        let u = flat.root_uv[i][0];
        // The map rises with u by steps of 1/128, each 1/64 wide, from 0.5.
        let inside = (0.02..0.98).contains(&u);
        let expected = 0.1 * (0.5 + (u * 64.0 - 0.5) / 128.0);
        assert!(!inside || (from.distance(to) - expected).abs() < 1e-5);
        let [before, after] = [&flat, &bumpy].map(|hair| {
            let points = hair.strand_points(i);
            (points[1] - points[0]).normalize()
        });
        turned += usize::from(before.distance(after) > 1e-3);
    }
    assert!(turned > 1000, "{turned}");
}

#[test]
fn frizz_and_kink_leave_the_root_and_turn_hairs_that_stand_side_by_side_alike() {
    let fixture = Fixture {
        flat: true,
        more: "frizz = { root = 0.2, tip = 0.4 }",
        ..Fixture::default()
    };
    let plain = collect(
        &Fixture {
            more: "",
            ..fixture
        }
        .plan(),
        0..3000,
        2,
    );
    let frizzed = collect(&fixture.plan(), 0..3000, 2);
    let kinked = "kink = { root = 0.05, tip = 0.1, frequency = [9, 9, 9] }";
    let kinked = collect(
        &Fixture {
            more: kinked,
            ..fixture
        }
        .plan(),
        0..3000,
        2,
    );
    let moved = |bent: &StrandBuffer, i: usize, k: usize| {
        bent.strand_points(i)[k] - plain.strand_points(i)[k]
    };
    let last = plain.strand_points(0).len() - 1;
    let (mut most, mut apart) = (0.0f32, 0.0f32);
    for i in 0..plain.len() {
        for bent in [&frizzed, &kinked] {
            assert_eq!(moved(bent, i, 0), Vec3::ZERO);
        }
        // Three noises of at most 1.3, by 0.4 and 0.1.
        most = most.max(moved(&frizzed, i, last).length());
        assert!(moved(&kinked, i, last).length() < 0.1 * 1.3 * 3f32.sqrt());
        for j in i + 1..(i + 40).min(plain.len()) {
            let (p, q) = (plain.root_rest[i], plain.root_rest[j]);
            let distance = Vec3::from(p).distance(Vec3::from(q));
            if distance < 0.05 {
                let difference = moved(&frizzed, i, last).distance(moved(&frizzed, j, last));
                apart = apart.max(difference / distance);
            }
        }
    }
    assert!(most > 0.2 && most < 0.4 * 1.3 * 3f32.sqrt(), "{most}");
    // The noise has a frequency of 1; local frames turn over one radius.
    assert!(apart < 4.0, "{apart}");
}

#[test]
fn a_hair_cut_at_c_ends_at_its_point_c_and_keeps_what_is_before() {
    let whole = collect(&plan(), 0..2000, 2);
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
fn animated_frizz_moves_with_time_and_what_does_not_move_stays() {
    let at = |more, time| {
        let plan = Fixture {
            flat: true,
            more,
            ..Fixture::default()
        }
        .plan();
        let (mut capture, mut clock) = (Capture::default(), Clock::default());
        let (mut scratch, mut out) = (Scratch::default(), StrandBuffer::new());
        plan.capture(0..500, &mut capture, &mut clock);
        let pose = Pose {
            time,
            ..Pose::default()
        };
        plan.evaluate(
            &capture,
            &plan.posed(&pose).unwrap(),
            &mut scratch,
            &mut out,
            &mut clock,
        );
        out
    };
    let (still, moving) = (
        "frizz = { tip = 0.3 }",
        "frizz = { tip = 0.3, animation = { amount = 0.5, speed = 0.1, direction = [0, 1, 0] } }",
    );
    assert!(at(still, 0.0) == at(still, 9.0));
    assert!(at(still, 0.0).points != at(moving, 9.0).points);
    let tips = |time| {
        let hair = at(moving, time);
        (0..hair.len())
            .map(|i| hair.strand_points(i)[6])
            .collect::<Vec<_>>()
    };
    let (before, after, later) = (tips(4.0), tips(4.01), tips(8.0));
    let distance = |a: &[Vec3], b: &[Vec3]| {
        let apart = a.iter().zip(b).map(|(p, q)| p.distance(*q));
        apart.fold(0.0, f32::max)
    };
    assert!(distance(&before, &after) < 1e-3);
    assert!(distance(&before, &later) > 0.02);
}

#[test]
fn the_way_the_texture_lies_on_the_surface_does_not_matter() {
    for (more, exceptions) in [
        ("", 0),
        ("interpolation.space = 'frenet'", 0),
        // Fits stop where a step gains little, so they answer to the last bits of guides; few
        // hairs, where guides hardly agree about the roll, make much of that.
        ("interpolation.space = 'helix'", 105),
    ] {
        let [straight, turned] = [false, true].map(|turned_uvs| {
            let fixture = Fixture {
                flat: true,
                turned_uvs,
                more,
                ..Fixture::default()
            };
            collect(&fixture.plan(), 0..500, 1)
        });
        let mut beyond = 0;
        for (p, q) in straight.points.iter().zip(&turned.points) {
            let apart = Vec3::from(*p).distance(Vec3::from(*q));
            beyond += usize::from(apart >= 1e-4);
        }
        assert!(
            beyond <= exceptions,
            "{more}: {beyond} of {}",
            straight.points.len()
        );
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

#[test]
fn every_property_at_its_neutral_value_changes_no_bit() {
    let plain = collect(&plan(), 0..2000, 2);
    for neutral in [
        "roots.displacement = 0",
        "interpolation = { guides = 3, method = 'inverse-distance', facing = false }",
        "interpolation.space = 'vertices'",
        "cut.length = { value = 1.0, map = 'one.png' }",
        "frizz = { root = 0, tip = 0, frequency = [5, 5, 5], preserve_length = true }",
        "frizz.animation = { amount = 1, speed = 2 }",
        "kink = { root = 0, tip = 0, frequency = [50, 50, 50], preserve_length = true }",
        "clump.levels = []",
        "clump.levels = [{ size = 0.2, root = 0, tip = 0, random = 1 }]",
        "flyaway = { percent = 0, strength = 2 }",
        "flyaway = { percent = 50, strength = 0 }",
        "color.mutant = { percent = 0, color = [1, 0, 0] }",
        "color.variation = { hue = 0, saturation = 0, value = 0 }",
        "opacity = { root = 1, tip = { value = 1.0, map = 'one.png' } }",
        "strand = { count = 0, twist = 90, aspect = 3, offset = 2, randomize = 1 }",
        "strand.splay = { root = 1, center = 1, tip = 1 }",
        "output.skip_threshold = 1.0",
        "voxels.resolution = [3, 4, 5]",
    ] {
        let fixture = Fixture {
            more: neutral,
            ..Fixture::default()
        };
        assert!(plain == collect(&fixture.plan(), 0..2000, 2), "{neutral}");
    }
    let bare = Fixture {
        flat: true,
        ..Fixture::default()
    };
    let scaled = Fixture {
        more: "scale = { amount = { value = 1.0, map = 'one.png' }, random = 0 }",
        ..bare
    };
    assert!(collect(&bare.plan(), 0..2000, 2) == collect(&scaled.plan(), 0..2000, 2));
}

#[test]
fn a_failing_sink_ends_the_run_with_its_words() {
    struct Full(u64);
    impl Sink for Full {
        fn write(&mut self, strands: &StrandBuffer) -> Result<(), SinkError> {
            self.0 += strands.len() as u64;
            if self.0 > 3000 {
                Err(SinkError::new("the disk", "it is full"))
            } else {
                Ok(())
            }
        }
    }
    for threads in [1, 4] {
        let request = request(0..50_000, threads);
        let plan = Fixture {
            count: 50_000,
            ..Fixture::default()
        }
        .plan();
        let run = generate(
            &plan,
            &request,
            &mut |_| Ok(Pose::default()),
            &mut Full(0),
            &mut |_| true,
        );
        assert_eq!(
            run.unwrap_err().to_string(),
            "cannot write the disk: it is full"
        );
    }
}

#[test]
fn what_a_run_announces_is_what_comes_where_no_hair_is_left_out() {
    #[derive(Default)]
    struct Announced(Option<Amount>);
    impl Sink for Announced {
        fn begin(&mut self, info: &StreamInfo) -> Result<(), SinkError> {
            self.0 = info.at_most;
            Ok(())
        }
        fn write(&mut self, _: &StrandBuffer) -> Result<(), SinkError> {
            Ok(())
        }
    }
    let mut sink = Announced::default();
    let request = request(100..1500, 1);
    let report = generate(
        &plan(),
        &request,
        &mut |_| Ok(Pose::default()),
        &mut sink,
        &mut |_| true,
    )
    .unwrap();
    assert_eq!(report.dropped.total(), 0);
    let came = Amount {
        strands: report.strands,
        vertices: report.vertices,
    };
    assert_eq!(sink.0, Some(came));
}

#[test]
fn a_reused_capture_gives_what_a_fresh_one_gives() {
    let plan = plan();
    let (mut capture, mut scratch, mut clock) =
        (Capture::default(), Scratch::default(), Clock::default());
    let mut out = StrandBuffer::new();
    for range in [0..700u64, 100..120, 0..700] {
        plan.capture(range.clone(), &mut capture, &mut clock);
        plan.evaluate(
            &capture,
            &plan.posed(&Pose::default()).unwrap(),
            &mut scratch,
            &mut out,
            &mut clock,
        );
        assert!(out == collect(&plan, range, 1));
    }
}
