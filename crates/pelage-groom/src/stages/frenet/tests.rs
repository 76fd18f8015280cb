use super::*;
use crate::stages::laying::samples::*;
use pelage_curves::DVec3;
use pelage_curves::frenet::Frame;
use proptest::prelude::*;
use std::f32::consts::TAU;

/// The hairs that guides share by each of `weights`.
fn frenet_each<const N: usize>(guides: &[Vec<Vec3>], weights: &[[f32; N]]) -> Vec<Vec<Vec3>> {
    let (all, count) = (in_rows(guides), guides[0].len());
    let profiles: Vec<Corner> = guides.iter().flat_map(|g| corners(g)).collect();
    let shares: Vec<Vec<Share>> = weights.iter().map(|w| shares(w)).collect();
    let mut hairs = vec![Vec3::ZERO; count * weights.len()];
    for (hair, shares) in hairs.chunks_mut(count).zip(&shares) {
        interpolate(&all, shares, hair);
    }
    let starts: Vec<u32> = (0..=weights.len()).map(|i| (i * count) as u32).collect();
    let parts = |i: usize| Parts {
        corners: &profiles,
        shares: &shares[i],
    };
    wind(
        |i| Some(parts(i)),
        &starts,
        &mut Scratch::default(),
        &mut hairs,
    );
    hairs.chunks(count).map(<[Vec3]>::to_vec).collect()
}

/// The hair that guides share by `weights`, by vertices and by Frenet.
fn both<const N: usize>(guides: &[Vec<Vec3>], weights: &[f32; N]) -> [Vec<Vec3>; 2] {
    let mut mean = vec![Vec3::ZERO; guides[0].len()];
    interpolate(&in_rows(guides), &shares(weights), &mut mean);
    [mean, frenet(guides, weights)]
}

fn frenet<const N: usize>(guides: &[Vec<Vec3>], weights: &[f32; N]) -> Vec<Vec3> {
    frenet_each(guides, &[*weights]).remove(0)
}

#[test]
fn hairs_side_by_side_are_those_of_each_alone_also_of_different_segments() {
    let long = [
        helix(0.1, 4.0, 0.0),
        helix(0.2, -2.0, 0.4),
        s_shape(0.2, 1.0),
    ];
    let short = long.clone().map(|guide| guide[..6].to_vec());
    let profiles = [&long, &short].map(|g| g.iter().flat_map(|g| corners(g)).collect::<Vec<_>>());
    let (mut every, mut vertices, mut starts) = (Vec::new(), Vec::new(), vec![0]);
    for i in 0..50usize {
        let guides = if i.is_multiple_of(3) { &long } else { &short };
        let w = i as f32 / 60.0;
        // Every seventh follows one guide and is left as it is.
        let mine = match i % 7 {
            0 => shares(&[1.0]),
            _ => shares(&[w, 0.9 - w, 0.1]),
        };
        let first = vertices.len();
        vertices.resize(first + guides[0].len(), Vec3::ZERO);
        interpolate(&in_rows(guides), &mine, &mut vertices[first..]);
        starts.push(vertices.len() as u32);
        every.push(mine);
    }
    let parts = |i: usize| Parts {
        corners: &profiles[usize::from(!i.is_multiple_of(3))],
        shares: &every[i],
    };
    let mut scratch = Scratch::default();
    let mut together = vertices.clone();
    wind(|i| Some(parts(i)), &starts, &mut scratch, &mut together);
    for i in 0..50 {
        let range = starts[i] as usize..starts[i + 1] as usize;
        let mut alone = vertices[range.clone()].to_vec();
        let end = alone.len() as u32;
        wind(|_| Some(parts(i)), &[0, end], &mut scratch, &mut alone);
        assert_eq!(alone, together[range.clone()], "hair {i}");
        assert_eq!(alone == vertices[range], i % 7 == 0);
    }
}

#[test]
fn equal_guides_reproduce_the_guide_whatever_it_is() {
    let guides = [
        helix(0.2, 3.0, 0.3),
        helix(0.02, 9.0, 0.0),
        straight(Vec3::new(0.3, -0.2, 1.0)),
        s_shape(0.2, 1.0),
        straight(Vec3::ZERO),
        // A zigzag, and a loop that comes back to the root.
        (0..=SEGMENTS)
            .map(|i| Vec3::new((i % 2) as f32, 0.0, 0.1 * i as f32))
            .collect(),
        (0..=SEGMENTS)
            .map(|i| i as f32 / SEGMENTS as f32 * TAU)
            .map(|a| Vec3::new(libm::sinf(a), 0.0, 1.0 - libm::cosf(a)))
            .collect(),
    ];
    for guide in guides {
        let hair = frenet(
            &[guide.clone(), guide.clone(), guide.clone()],
            &[0.5, 0.3, 0.2],
        );
        let miss = farthest(&hair, &guide);
        assert!(miss < 2e-5, "{miss}");
    }
}

#[test]
fn curls_of_any_phase_keep_their_radius_that_vertices_lose() {
    // Three curls of random phases, mixed by random weights.
    let (mut kept, cases) = ([0.0f32; 2], 500);
    let mut full = 0;
    for case in 0..cases {
        let random = |k: u64| crate::random::uniform(case, k, crate::random::Channel::GuideCurl);
        let guides = [0, 1, 2].map(|k| helix(0.1, 4.0, random(k)));
        let weights = [3, 4, 5].map(|k| random(k) + 0.01);
        let sum: f32 = weights.iter().sum();
        let found = both(&guides, &weights.map(|w| w / sum)).map(|hair| radius(&hair) / 0.1);
        kept = [
            kept[0] + found[0] / cases as f32,
            kept[1] + found[1] / cases as f32,
        ];
        full += usize::from(found[1] > 0.98);
    }
    assert!(kept[0] < 0.65 && kept[1] > 0.95, "{kept:?}");
    assert!(full * 100 > cases as usize * 90, "{full}");
}

#[test]
fn opposite_curls_keep_their_radius_and_length_beside_the_middle() {
    let guides = [helix(0.1, 4.0, 0.0), helix(0.1, 4.0, 0.5)];
    let whole = length(&guides[0]);
    for weight in [0.1, 0.3, 0.38, 0.62, 0.9] {
        let [mean, hair] = both(&guides, &[weight, 1.0 - weight]);
        assert!((radius(&mean) - 0.1 * (1.0 - 2.0 * weight).abs()) < 1e-3);
        assert!((radius(&hair) - 0.1).abs() < 1e-3, "{weight}");
        assert!((length(&hair) / whole - 1.0).abs() < 1e-3);
    }
    // In the middle nothing says how to roll: a line of full length.
    let hair = frenet(&guides, &[0.5, 0.5]);
    assert!(radius(&hair) < 1e-3 && length(&hair) > 0.95 * whole);
}

#[test]
fn coats_of_curls_stand_as_their_guides_do() {
    let guides = [0.0, 0.4, 0.75].map(|phase| helix(0.1, 4.0, phase));
    let weights = [0.4, 0.35, 0.25];
    let lean = |tip: Vec3| tip.normalize().dot(Vec3::Z).clamp(-1.0, 1.0);
    let fitted = frenet(&guides, &weights)[SEGMENTS];
    assert!(lean(fitted) > 0.9998, "{fitted}");
    // On the mean of the first bases it leans by 51 degrees.
    let shapes = guides.each_ref().map(|guide| {
        let exact: Vec<_> = guide.iter().map(|v| v.as_dvec3()).collect();
        Polygon::of(&exact, STRAIGHT).unwrap()
    });
    let mean = |axis: fn(&Frame) -> DVec3| -> DVec3 {
        let parts = shapes.iter().zip(weights);
        parts.map(|(shape, w)| axis(&shape.frame) * w as f64).sum()
    };
    let on_bases = Polygon {
        frame: Frame::new(mean(|f| f.tangent), mean(|f| f.normal)),
        ..shapes[0].clone()
    };
    let tip = on_bases.points()[SEGMENTS].as_vec3();
    assert!((lean(tip) - 0.629).abs() < 0.01, "{tip}");
}

#[test]
fn from_straight_to_curly_the_curl_grows_and_the_length_goes_along() {
    let guides = [straight(Vec3::Z), helix(0.1, 4.0, 0.0)];
    let lengths = [1.0, length(&guides[1])];
    let mut before = 0.0;
    for i in 0..=50 {
        let w = i as f32 / 50.0;
        let hair = frenet(&guides, &[1.0 - w, w]);
        let found = radius(&hair);
        // Half curled it winds more slowly, and wider: the radius is κ / (κ² + τ²).
        assert!(
            (found - before).abs() < 0.03 && found < 0.15,
            "{w}: {found}"
        );
        before = found;
        let expected = lengths[0] * (1.0 - w) + lengths[1] * w;
        assert!((length(&hair) / expected - 1.0).abs() < 0.03, "{w}");
    }
    assert!((before - 0.1).abs() < 1e-3);
}

#[test]
fn plane_guides_make_plane_hairs_and_s_shapes_stay_s_shapes() {
    for direction in [0.0, 1.0, 2.5] {
        // Larger, smaller, and one that bends the other way first.
        for sizes in [[0.2, 0.1], [0.2, 0.19], [0.2, -0.05]] {
            let guides = sizes.map(|size| s_shape(size, direction));
            let hair = frenet(&guides, &[0.6, 0.4]);
            let across = Vec3::new(-libm::sinf(direction), libm::cosf(direction), 0.0);
            let off = hair.iter().map(|v| v.dot(across).abs()).fold(0.0, f32::max);
            assert!(off < 1e-4, "{sizes:?}: {off}");
            let along = Vec3::new(libm::cosf(direction), libm::sinf(direction), 0.0);
            let most = hair.iter().map(|v| v.dot(along)).fold(0.0, f32::max);
            let mean = 2.0 * (sizes[0] * 0.6 + sizes[1] * 0.4f32);
            let near = if sizes[1] > 0.0 { 0.02 } else { 0.5 };
            assert!((most / mean - 1.0).abs() < near, "{sizes:?}: {most} {mean}");
        }
    }
}

#[test]
fn a_guide_without_length_shortens_the_hair_and_leaves_its_shape() {
    let guides = [helix(0.1, 4.0, 0.2), straight(Vec3::ZERO)];
    let hair = frenet(&guides, &[0.25, 0.75]);
    for (h, g) in hair.iter().zip(&guides[0]) {
        assert!(h.distance(*g * 0.25) < 1e-5);
    }
}

#[test]
fn hairs_change_without_a_jump_where_weights_do() {
    let guides = motley();
    let steps = 4000;
    for i in 0..guides.len() {
        for j in 0..i {
            // From one guide to another, past a third that does not say much.
            let third = (i + j) % guides.len();
            let some = [&guides[i], &guides[j], &guides[third]].map(Vec::clone);
            let weights: Vec<[f32; 3]> = (0..=steps)
                .map(|k| k as f32 / steps as f32)
                .map(|w| [0.9 * w, 0.9 * (1.0 - w), 0.1])
                .collect();
            let hairs = frenet_each(&some, &weights);
            for (k, pair) in hairs.windows(2).enumerate() {
                let slope = farthest(&pair[0], &pair[1]) * steps as f32;
                // A jump would be thousands. The steepest is 399, at any number of steps,
                // where curls of both hands and an S mix to what is almost a ring.
                assert!(slope < 450.0, "{i} {j} {k}: {slope}");
            }
        }
    }
}

/// Sums of squares of the guides' squares would not fit in a float.
#[test]
fn guides_of_huge_size_give_finite_hairs() {
    for exponent in [9, 12, 16] {
        let unit = libm::powf(10.0, exponent as f32);
        let steps = [(1., -1., -1.), (-1., 0., 1.), (1., -1., -1.), (0., 0., 0.)];
        let vertices = steps.map(|(x, y, z)| Vec3::new(x - 1.0, y + 1.0, z + 1.0) * unit);
        let guide: Vec<Vec3> = [Vec3::ZERO].into_iter().chain(vertices).collect();
        let nothing = vec![Vec3::ZERO; 5];
        let hair = frenet(&[nothing.clone(), guide, nothing], &[0.0, 0.7, 0.0]);
        assert!(hair.iter().all(|v| v.is_finite()), "{hair:?}");
    }
}

proptest! {
    #[test]
    fn whatever_the_guides_hairs_are_finite_and_no_longer_than_they_say(
        points in prop::collection::vec(prop::array::uniform3(-1i8..2), 15),
        weights in prop::array::uniform3(0.0f32..1.0), exponent in -30i32..17,
    ) {
        let unit = libm::powf(10.0, exponent as f32);
        let vector = |p: &[i8; 3]| Vec3::from(p.map(f32::from)) * unit;
        let guides: Vec<Vec<Vec3>> =
            points.chunks(5).map(|g| g.iter().map(|p| vector(p) - vector(&g[0])).collect()).collect();
        let sum: f32 = weights.iter().sum();
        prop_assume!(sum > 0.1);
        let weights = weights.map(|w| w / sum);
        let hair = frenet(&guides, &weights);
        let expected: f32 = guides.iter().zip(weights).map(|(g, w)| length(g) * w).sum();
        prop_assert!(hair.iter().all(|v| v.is_finite()));
        prop_assert!(length(&hair) <= expected * 1.006 + unit * 1e-5, "{}", length(&hair));
    }
}
