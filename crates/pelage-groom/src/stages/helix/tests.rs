use super::*;
use crate::stages::laying::samples::*;
use pelage_curves::{Basis, Curve, Wrap};
use proptest::prelude::*;
use std::f32::consts::TAU;

const ELEMENTS: usize = 8;

/// The hairs that guides, fitted by so many elements, share by each of `weights`.
fn helix_each<const N: usize>(
    guides: &[Vec<Vec3>],
    elements: usize,
    weights: &[[f32; N]],
) -> Vec<Vec<Vec3>> {
    let (all, count) = (in_rows(guides), guides[0].len());
    let helices = Helices::fit(guides, elements);
    let shares: Vec<Vec<Share>> = weights.iter().map(|w| shares(w)).collect();
    let mut hairs = vec![Vec3::ZERO; count * weights.len()];
    for (hair, shares) in hairs.chunks_mut(count).zip(&shares) {
        interpolate(&all, shares, hair);
    }
    let starts: Vec<u32> = (0..=weights.len()).map(|i| (i * count) as u32).collect();
    let parts = |i: usize| {
        Some(Parts {
            helices: &helices,
            shares: &shares[i],
        })
    };
    wind(parts, &starts, &mut Scratch::default(), &mut hairs);
    hairs.chunks(count).map(<[Vec3]>::to_vec).collect()
}

/// The same shape with vertices at equal steps of arc length, as guides have them.
fn evenly(guide: &[Vec3]) -> Vec<Vec3> {
    let curve = Curve::new(guide, Basis::CatmullRom, Wrap::Pinned);
    curve.unwrap().resample(guide.len() - 1)
}

fn blended<const N: usize>(guides: &[Vec<Vec3>], weights: &[f32; N]) -> Vec<Vec3> {
    helix_each(guides, ELEMENTS, &[*weights]).remove(0)
}

#[test]
fn equal_guides_reproduce_the_guide_to_the_error_of_its_fit() {
    let ring = (0..=SEGMENTS)
        .map(|i| i as f32 / SEGMENTS as f32 * TAU)
        .map(|a| Vec3::new(libm::sinf(a), 0.0, 1.0 - libm::cosf(a)));
    let guides = [
        (helix(0.2, 3.0, 0.3), 2e-4),
        (helix(0.02, 9.0, 0.0), 1e-3),
        (straight(Vec3::new(0.3, -0.2, 1.0)), 1e-5),
        (s_shape(0.2, 1.0), 5e-3),
        (straight(Vec3::ZERO), 0.0),
        (ring.collect(), 1e-4),
    ];
    for (guide, bound) in guides {
        let guide = evenly(&guide);
        let hair = blended(&vec![guide.clone(); 3], &[0.5, 0.3, 0.2]);
        let miss = farthest(&hair, &guide) / length(&guide).max(1e-3);
        assert!(miss <= bound, "{miss}");
    }
}

#[test]
fn curls_of_any_phase_keep_their_radius_that_vertices_lose() {
    let (mut kept, cases) = (0.0f32, 100);
    let mut full = 0;
    for case in 0..cases {
        let random = |k: u64| crate::random::uniform(case, k, crate::random::Channel::GuideCurl);
        let guides = [0, 1, 2].map(|k| helix(0.1, 4.0, random(k)));
        let weights = [3, 4, 5].map(|k| random(k) + 0.01);
        let sum: f32 = weights.iter().sum();
        let found = radius(&blended(&guides, &weights.map(|w| w / sum))) / 0.1;
        kept += found / cases as f32;
        full += usize::from(found > 0.98);
    }
    assert!(kept > 0.95, "{kept}");
    assert!(full * 100 > cases as usize * 90, "{full}");
}

#[test]
fn from_straight_to_curly_the_curl_grows_and_the_length_goes_along() {
    let guides = [straight(Vec3::Z), helix(0.1, 4.0, 0.0)];
    let lengths = [1.0, length(&guides[1])];
    let mut before = 0.0;
    for i in 0..=50 {
        let w = i as f32 / 50.0;
        let hair = blended(&guides, &[1.0 - w, w]);
        let found = radius(&hair);
        assert!(
            (found - before).abs() < 0.03 && found < 0.15,
            "{w}: {found}"
        );
        before = found;
        let expected = lengths[0] * (1.0 - w) + lengths[1] * w;
        assert!((length(&hair) / expected - 1.0).abs() < 0.03, "{w}");
    }
    assert!((before - 0.1).abs() < 1e-3, "{before}");
}

#[test]
fn noise_on_straight_guides_does_not_unwind_a_curl() {
    let noisy: Vec<Vec3> = straight(Vec3::new(0.3, 0.5, 0.8))
        .into_iter()
        .enumerate()
        .map(|(i, v)| v * 1.7 + Vec3::splat(1e-8 * (i * 7 % 5) as f32))
        .collect();
    let curl = helix(0.1, 4.0, 0.2);
    let clean = straight(Vec3::new(0.3, 0.5, 0.8) * 1.7);
    let [a, b] = [noisy, clean].map(|guide| blended(&[curl.clone(), guide], &[0.6, 0.4]));
    let apart = farthest(&a, &b);
    assert!(apart < 2e-3, "{apart}");
}

#[test]
fn plane_guides_make_plane_hairs_and_s_shapes_stay_s_shapes() {
    for direction in [0.0, 1.0, 2.5] {
        for sizes in [[0.2, 0.1], [0.2, 0.19]] {
            let guides = sizes.map(|size| s_shape(size, direction));
            let hair = blended(&guides, &[0.6, 0.4]);
            let across = Vec3::new(-libm::sinf(direction), libm::cosf(direction), 0.0);
            let off = hair.iter().map(|v| v.dot(across).abs()).fold(0.0, f32::max);
            assert!(off < 2e-3, "{sizes:?}: {off}");
            let along = Vec3::new(libm::cosf(direction), libm::sinf(direction), 0.0);
            let most = hair.iter().map(|v| v.dot(along)).fold(0.0, f32::max);
            let mean = 2.0 * (sizes[0] * 0.6 + sizes[1] * 0.4f32);
            assert!((most / mean - 1.0).abs() < 0.05, "{sizes:?}: {most} {mean}");
        }
    }
}

#[test]
fn a_guide_without_length_shortens_the_hair_and_leaves_its_shape() {
    let curl = helix(0.1, 4.0, 0.2);
    let whole = blended(std::slice::from_ref(&curl), &[1.0]);
    let hair = blended(&[curl, straight(Vec3::ZERO)], &[0.25, 0.75]);
    for (h, g) in hair.iter().zip(&whole) {
        assert!(h.distance(*g * 0.25) < 1e-5);
    }
}

#[test]
fn more_elements_follow_finer_detail() {
    let wave: Vec<Vec3> = (0..=SEGMENTS)
        .map(|i| i as f32 / SEGMENTS as f32)
        .map(|t| Vec3::new(0.05 * libm::sinf(TAU * 3.0 * t), 0.1 * t * t, t))
        .collect();
    let wave = evenly(&wave);
    let misses = [2, 6, 24].map(|elements| {
        let hair = helix_each(std::slice::from_ref(&wave), elements, &[[1.0]]).remove(0);
        farthest(&hair, &wave)
    });
    assert!(misses.windows(2).all(|m| m[1] < 0.2 * m[0]), "{misses:?}");
    assert!(misses[2] < 1e-3, "{misses:?}");
}

#[test]
fn guides_whose_samples_differ_in_number_are_cut_at_the_joints_of_all() {
    // Tighter curls are sampled more finely, so half a step is something else.
    let guides = [
        straight(Vec3::Z),
        helix(0.1, 4.0, 0.0),
        helix(0.05, 16.0, 0.3),
    ];
    let helices = Helices::fit(&guides, 7);
    assert!(helices.elements() >= 7 && helices.elements() <= 21);
    assert!(helices.joints.windows(2).all(|j| j[0] < j[1]));
    assert_eq!(helices.parts.len(), 3 * helices.elements());
    assert_eq!(
        [helices.joints[0], *helices.joints.last().unwrap()],
        [0.0, 1.0]
    );
}

#[test]
fn hairs_side_by_side_are_those_of_each_alone_also_of_different_segments() {
    let long = [
        helix(0.1, 4.0, 0.0),
        helix(0.2, -2.0, 0.4),
        s_shape(0.2, 1.0),
    ];
    let short = long.clone().map(|guide| guide[..6].to_vec());
    let fits = [&long, &short].map(|guides| Helices::fit(guides, ELEMENTS));
    let (mut every, mut vertices, mut starts) = (Vec::new(), Vec::new(), vec![0]);
    for i in 0..50usize {
        let guides = if i.is_multiple_of(3) { &long } else { &short };
        let w = i as f32 / 60.0;
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
        helices: &fits[usize::from(!i.is_multiple_of(3))],
        shares: &every[i],
    };
    // Every fifth is none of this stage's.
    let some = |i: usize| Some(parts(i)).filter(|_| i % 5 != 4);
    let mut scratch = Scratch::default();
    let mut together = vertices.clone();
    wind(some, &starts, &mut scratch, &mut together);
    for i in 0..50 {
        let range = starts[i] as usize..starts[i + 1] as usize;
        let mut alone = vertices[range.clone()].to_vec();
        let end = alone.len() as u32;
        wind(|_| some(i), &[0, end], &mut scratch, &mut alone);
        assert_eq!(alone, together[range.clone()], "hair {i}");
        assert_eq!(alone == vertices[range], i % 5 == 4);
    }
}

#[test]
fn hairs_change_without_a_jump_where_weights_do() {
    let guides = motley();
    let steps = 1000;
    for i in 0..guides.len() {
        for j in 0..i {
            // From one guide to another, past a third that does not say much; and to the end,
            // where one guide is alone.
            for say in [0.1, 0.0] {
                let third = (i + j) % guides.len();
                let some = [&guides[i], &guides[j], &guides[third]].map(Vec::clone);
                let weights: Vec<[f32; 3]> = (0..=steps)
                    .map(|k| k as f32 / steps as f32)
                    .map(|w| [(1.0 - say) * w, (1.0 - say) * (1.0 - w), say])
                    .collect();
                let hairs = helix_each(&some, ELEMENTS, &weights);
                for (k, pair) in hairs.windows(2).enumerate() {
                    let slope = farthest(&pair[0], &pair[1]) * steps as f32;
                    assert!(slope < 450.0, "{i} {j} {k}: {slope}");
                }
            }
        }
    }
}

proptest! {
    #[test]
    fn whatever_the_guides_hairs_are_finite_and_no_longer_than_they_say(
        points in prop::collection::vec(prop::array::uniform3(-1i8..2), 15),
        weights in prop::array::uniform3(0.0f32..1.0), exponent in -30i32..17, elements in 1usize..9,
    ) {
        let unit = libm::powf(10.0, exponent as f32);
        let vector = |p: &[i8; 3]| Vec3::from(p.map(f32::from)) * unit;
        let guides: Vec<Vec<Vec3>> =
            points.chunks(5).map(|g| g.iter().map(|p| vector(p) - vector(&g[0])).collect()).collect();
        let sum: f32 = weights.iter().sum();
        prop_assume!(sum > 0.1);
        let weights = weights.map(|w| w / sum);
        let hair = helix_each(&guides, elements, &[weights]).remove(0);
        // The curve through the vertices is longer than their polygon.
        let expected: f32 = guides.iter().zip(weights).map(|(g, w)| length(g) * w).sum();
        prop_assert!(hair.iter().all(|v| v.is_finite()));
        prop_assert!(length(&hair) <= expected * 1.25 + unit * 1e-5, "{} {}", length(&hair), expected);
    }
}

#[test]
fn guides_of_one_segment_or_one_vertex_are_straight() {
    for guide in [vec![Vec3::ZERO, Vec3::X], vec![Vec3::ZERO]] {
        let hair = blended(&[guide.clone(), guide.clone()], &[0.5, 0.5]);
        assert!(farthest(&hair, &guide) < 1e-6, "{hair:?}");
    }
}
