//! Ramps: values at points along a hair.

use crate::fixture::{Fixture, collect};
use pelage_curves::Vec3;
use pelage_strands::StrandBuffer;

/// 500 hairs on the ball without maps, with more lines.
fn hairs(more: &str) -> StrandBuffer {
    let fixture = Fixture {
        flat: true,
        more,
        ..Fixture::default()
    };
    collect(&fixture.plan(), 0..500, 2)
}

#[test]
fn a_ramp_of_two_points_is_root_and_tip() {
    for (ends, ramp) in [
        (
            "width = { root = 0.04, tip = 0.01 }",
            "width.root = { ramp = [[0, 0.04], [1, 0.01]] }",
        ),
        (
            "opacity = { root = 0.25, tip = 0.75 }",
            "opacity.root = { ramp = [[0, 0.25], [1, 0.75]] }",
        ),
        (
            "color = { root = [0.1, 0.4, 0.2], tip = [0.7, 0.2, 0.6] }",
            "color.root = { ramp = [[0, [0.1, 0.4, 0.2]], [1, [0.7, 0.2, 0.6]]] }",
        ),
        (
            "kink = { root = 0.01, tip = 0.05, frequency = [9, 9, 9] }",
            "kink = { root = { ramp = [[0, 0.01], [1, 0.05]] }, frequency = [9, 9, 9] }",
        ),
        (
            "clump.levels = [{ size = 0.3, root = 0.25, tip = 0.75 }]",
            "clump.levels = [{ size = 0.3, root = { ramp = [[0, 0.25], [1, 0.75]] } }]",
        ),
    ] {
        let (ends, ramp) = (hairs(ends), hairs(ramp));
        for (p, q) in ends.points.iter().zip(&ramp.points) {
            assert!(Vec3::from(*p).distance(Vec3::from(*q)) < 1e-6);
        }
        for (a, b) in ends.widths.iter().zip(&ramp.widths) {
            assert!((a - b).abs() < 1e-7);
        }
        for (a, b) in ends.opacities.iter().zip(&ramp.opacities) {
            assert!((a - b).abs() < 1e-6);
        }
        for (a, b) in ends.colors.iter().zip(&ramp.colors) {
            assert!(Vec3::from(*a).distance(Vec3::from(*b)) < 1e-5);
        }
    }
}

#[test]
fn vertices_at_the_points_of_a_ramp_have_their_values_times_the_map() {
    // Six segments: vertex k is at k / 6. The map rises from 0.5 to 1 with u.
    let more = "width.root = { ramp = [[0.5, 0.02], [0.75, 0.06]], map = 'length.png' }
        [color]
        root = { ramp = [[0.0, [1, 0, 0]], [0.5, [0, 1, 0]], [1.0, [0, 0, 1]]] }
        [strand]
        count = 2
        splay.root = { ramp = [[0.0, 0.0], [0.5, 0.1], [1.0, 0.0]] }
        [cut]
        length = 0.75";
    let strands = hairs(more);
    let single = hairs("cut.length = 0.75");
    for i in 0..strands.len() {
        let range = strands.vertices(i);
        let (widths, colors) = (&strands.widths[range.clone()], &strands.colors[range]);
        let factor = widths[0] / 0.02;
        assert!((0.49..1.0).contains(&factor), "{factor}");
        assert_eq!(
            widths[..4],
            [widths[0]; 4],
            "the same up to the first point"
        );
        // 0.75 is where the hair is cut.
        let last = widths[widths.len() - 1];
        assert!((last - 0.06 * factor).abs() < 1e-6, "{last}");
        assert_eq!(colors[0], [1.0, 0.0, 0.0]);
        assert!(Vec3::from(colors[3]).distance(Vec3::Y) < 1e-6);
        let apart = |k: usize| {
            let fiber = strands.strand_points(i)[k];
            fiber.distance(single.strand_points(i / 2)[k])
        };
        let place = Vec3::new(strands.strand_uv[i][0], strands.strand_uv[i][1], 0.0);
        assert!(apart(0) < 1e-6);
        assert!((apart(3) - 0.1 * place.length()).abs() < 1e-5);
    }
}

#[test]
fn a_ramp_of_zero_changes_no_bit() {
    let plain = hairs("");
    for zero in [
        "frizz.root = { ramp = [[0, 0.0], [1, 0.0]] }",
        "kink.root = { ramp = [[0.5, 0]] }",
        "clump.levels = [{ size = 0.3, root = { ramp = [[0, 0]] } }]",
    ] {
        assert!(plain == hairs(zero), "{zero}");
    }
}

#[test]
fn hairs_stay_on_the_skin_whatever_a_ramp_says_of_the_root() {
    let plain = hairs("");
    for more in [
        "frizz.root = { ramp = [[0, 0.5], [1, 0.1]] }",
        "kink = { root = { ramp = [[0, 0.5], [1, 0.1]] }, frequency = [9, 9, 9] }",
    ] {
        let bent = hairs(more);
        for i in 0..bent.len() {
            assert_eq!(bent.strand_points(i)[0], plain.strand_points(i)[0]);
            assert_ne!(bent.strand_points(i)[1], plain.strand_points(i)[1]);
        }
    }
}
