//! Which guides shape a hair, and how much each.
//!
//! Source: document 004, section 2.2.4, with its errata. With the n + 1 nearest guides
//! of the group at distances d, r the farthest, a guide weighs ((r - d) / (r d))²,
//! normalised: the field is continuous where the set of neighbours changes. A guide at
//! the root itself is taken alone. With n guides or fewer in the group all are taken and
//! r is enlarged; guides all at one distance weigh the same.
//!
//! Guides are kept in the frame of *their* root. To be mixed they are carried to the
//! hair's root by the smallest rotation that brings the one normal onto the other, all
//! at rest; what remains is a turn in the tangent plane, kept as cosine and sine. So the
//! result does not depend on how the texture lies on the surface (DESIGN.md, "Why are
//! guides carried?").

use crate::locator::Near;
use pelage_surface::RootFrame;

/// How much r grows where there is no (n + 1)-th guide.
const ENLARGED: f32 = 1.1;

/// A guide's part in a hair: the guide, and its weight times cosine and sine of the
/// turn from the guide's frame into the hair's.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Share {
    /// Index of the guide in its group.
    pub guide: u32,
    /// Weight; the weights of a hair sum to 1.
    pub weight: f32,
    /// Weight times the cosine of the turn.
    pub cosine: f32,
    /// Weight times the sine of the turn.
    pub sine: f32,
}

/// Normalised weights of the guides `near` (nearest first), written to `weights`;
/// `wanted` is n. At most n of them are above zero.
#[inline]
pub fn inverse_distance(near: &[Near], wanted: usize, weights: &mut Vec<f32>) {
    weights.clear();
    let (Some(first), Some(last)) = (near.first(), near.last()) else {
        return;
    };
    // Nearer than a millionth of the radius: the weight is beyond what f32 can mix.
    if first.square <= last.square * 1e-12 {
        weights.push(1.0);
        weights.resize(near.len(), 0.0);
        return;
    }
    let enlarge = if near.len() <= wanted { ENLARGED } else { 1.0 };
    let radius = last.square.sqrt() * enlarge;
    for guide in near {
        let distance = guide.square.sqrt();
        let weight = ((radius - distance) / (radius * distance)).max(0.0);
        weights.push(weight * weight);
    }
    if !normalise(weights) {
        weights.fill(1.0 / near.len() as f32);
    }
}

/// Divides `weights` by their sum, if there is one to divide by; tells whether there is.
#[inline]
pub(super) fn normalise(weights: &mut [f32]) -> bool {
    let sum: f32 = weights.iter().sum();
    let has_sum = sum > 0.0 && sum.is_finite();
    if has_sum {
        weights.iter_mut().for_each(|w| *w /= sum);
    }
    has_sum
}

/// Leaves all weight to the first guide, the nearest.
pub(super) fn first_alone(weights: &mut [f32]) {
    weights.fill(0.0);
    weights.iter_mut().take(1).for_each(|w| *w = 1.0);
}

/// Cosine and sine of the turn that carries local coordinates at `guide` to `hair`.
#[inline]
pub fn turn(guide: &RootFrame, hair: &RootFrame) -> (f32, f32) {
    let cosine = guide.normal.dot(hair.normal);
    // Beyond 175° the smallest rotation has no stable axis; keep the coordinates.
    if cosine < -0.996 {
        return (1.0, 0.0);
    }
    let carried = guide.tangent
        - (guide.normal + hair.normal) * (guide.tangent.dot(hair.normal) / (1.0 + cosine));
    let (c, s) = (carried.dot(hair.tangent), carried.dot(hair.binormal));
    let length = (c * c + s * s).sqrt();
    if length > 0.0 {
        (c / length, s / length)
    } else {
        (1.0, 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pelage_curves::Vec3;
    use proptest::prelude::*;

    fn near(distances: &[f32]) -> Vec<Near> {
        let guides = distances.iter().enumerate();
        guides
            .map(|(i, d)| Near {
                guide: i as u32,
                square: d * d,
            })
            .collect()
    }

    #[test]
    fn equal_distances_weigh_the_same_and_the_root_itself_is_taken_alone() {
        let mut weights = Vec::new();
        inverse_distance(&near(&[2.0; 4]), 3, &mut weights);
        assert_eq!(weights, [0.25; 4]);
        inverse_distance(&near(&[0.0, 1.0, 1.0]), 2, &mut weights);
        assert_eq!(weights, [1.0, 0.0, 0.0]);
        inverse_distance(&near(&[0.0, 0.0]), 2, &mut weights);
        assert_eq!(weights, [1.0, 0.0]);
    }

    #[test]
    fn the_last_of_more_than_n_guides_weighs_nothing() {
        let mut weights = Vec::new();
        inverse_distance(&near(&[1.0, 2.0, 3.0]), 2, &mut weights);
        assert_eq!(weights[2], 0.0);
        inverse_distance(&near(&[1.0, 2.0, 3.0]), 3, &mut weights);
        assert!(weights[2] > 0.0);
    }

    proptest! {
        #[test]
        fn weights_sum_to_one(
            mut distances in prop::collection::vec(0.0f32..1e6, 1..9), wanted in 1usize..9
        ) {
            distances.sort_by(f32::total_cmp);
            let mut weights = Vec::new();
            inverse_distance(&near(&distances), wanted, &mut weights);
            prop_assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-5);
            prop_assert!(weights.iter().all(|w| (0.0..=1.0).contains(w)));
        }

        #[test]
        fn carrying_does_not_depend_on_the_tangents_chosen(
            a in prop::array::uniform3(-1.0f32..1.0), b in prop::array::uniform3(-1.0f32..1.0),
            t in prop::array::uniform3(-1.0f32..1.0), u in prop::array::uniform3(-1.0f32..1.0),
        ) {
            let (n, m) = (Vec3::from(a), Vec3::from(b));
            prop_assume!(n.length() > 0.1 && m.length() > 0.1);
            let frame = |t: Vec3, n: Vec3| RootFrame::new(Vec3::ZERO, t, n);
            let vector = Vec3::new(0.3, -0.5, 0.8);
            let guide = frame(t.into(), n);
            prop_assume!(guide.normal.dot(m.normalize()) > -0.9);
            let world = guide.vector(vector);
            let carry = |guide: RootFrame, hair: RootFrame| {
                let local = guide.local(world);
                let (c, s) = turn(&guide, &hair);
                let v = Vec3::new(
                    c * local.x - s * local.y, s * local.x + c * local.y, local.z,
                );
                hair.vector(v)
            };
            let one = carry(guide, frame(u.into(), m));
            let other = carry(frame(Vec3::from(u), n), frame(t.into(), m));
            prop_assert!(one.distance(other) < 1e-3, "{} {}", one, other);
        }
    }
}
