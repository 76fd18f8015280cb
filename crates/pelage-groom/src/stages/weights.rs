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
use bytemuck::{Pod, Zeroable};
use fearless_simd::{Select, Simd, SimdBase, SimdFloat, f32x4};
use pelage_curves::Vec3;
use pelage_surface::RootFrame;

/// How much r grows where there is no (n + 1)-th guide.
const ENLARGED: f32 = 1.1;

/// A guide's part in a hair: the guide, and its weight times cosine and sine of the
/// turn from the guide's frame into the hair's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
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
#[inline(always)]
pub(crate) fn inverse_distance<S: Simd>(
    simd: S,
    near: &[Near],
    wanted: usize,
    weights: &mut Vec<f32>,
) {
    weights.clear();
    let (Some(first), Some(last)) = (near.first(), near.last()) else {
        return;
    };
    let ends = [splat_one(simd, first.square), splat_one(simd, last.square)];
    let falloff = Falloff::new(ends, near.len(), wanted);
    let mut sum = 0.0;
    for guide in near {
        let part = falloff.part(splat_one(simd, guide.square))[0];
        weights.push(part);
        sum += part;
    }
    let sum = splat_one(simd, sum);
    for (k, weight) in weights.iter_mut().enumerate() {
        *weight = falloff.weight(k, splat_one(simd, *weight), sum)[0];
    }
}

/// One number, where formulas are written for many.
#[inline(always)]
fn splat_one<S: Simd>(simd: S, number: f32) -> f32x4<S> {
    f32x4::splat(simd, number)
}

/// How the weights of guides fall off with their distance from a hair; or from many hairs, one
/// a lane, each with as many guides.
#[derive(Clone, Copy)]
pub(crate) struct Falloff<S: Simd, V: SimdFloat<S, Element = f32>> {
    radius: V,
    /// Whether the nearest guide is taken alone.
    alone: V::Mask,
    guides: usize,
}

impl<S: Simd, V: SimdFloat<S, Element = f32>> Falloff<S, V> {
    /// For so many `guides`, of which the squared distances of the nearest and the farthest are
    /// given; `wanted` is n.
    #[inline(always)]
    pub(crate) fn new([first, last]: [V; 2], guides: usize, wanted: usize) -> Self {
        let enlarge = if guides <= wanted { ENLARGED } else { 1.0 };
        Self {
            radius: last.sqrt() * enlarge,
            // Nearer than a millionth of the radius: the weight is beyond what f32 can mix.
            alone: first.simd_le(last * 1e-12),
            guides,
        }
    }

    /// What a guide at a squared distance weighs, before weights are divided by their sum.
    #[inline(always)]
    pub(crate) fn part(&self, square: V) -> V {
        let distance = square.sqrt();
        let weight = (self.radius - distance) / (self.radius * distance);
        let zero = V::splat(weight.token(), 0.0);
        // Not a number where all are at infinity.
        let weight = weight.simd_gt(zero).select(weight, zero);
        weight * weight
    }

    /// The weight of guide number `k`, nearest first, from its part and the sum of all.
    #[inline(always)]
    pub(crate) fn weight(&self, k: usize, part: V, sum: V) -> V {
        let simd = sum.token();
        let (zero, all) = (V::splat(simd, 0.0), V::splat(simd, f32::INFINITY));
        let has_sum = sum.simd_gt(zero) & sum.simd_lt(all);
        let even = V::splat(simd, 1.0 / self.guides as f32);
        let weight = has_sum.select(part / sum, even);
        let alone = if k == 0 { V::splat(simd, 1.0) } else { zero };
        self.alone.select(alone, weight)
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
#[inline(always)]
pub(crate) fn turn<S: Simd>(simd: S, guide: &RootFrame, hair: &RootFrame) -> [f32; 2] {
    let (guide, hair) = (
        Axes::<f32x4<S>>::splat(simd, guide),
        Axes::splat(simd, hair),
    );
    let [cosine, sine] = guide.turn(&hair);
    [cosine[0], sine[0]]
}

/// The axes of a frame; or of many, one a lane.
#[derive(Clone, Copy)]
pub(crate) struct Axes<V> {
    pub tangent: [V; 3],
    pub binormal: [V; 3],
    pub normal: [V; 3],
}

impl<V> Axes<V> {
    /// Those of `frame` in every lane.
    #[inline(always)]
    pub(crate) fn splat<S: Simd>(simd: S, frame: &RootFrame) -> Self
    where
        V: SimdFloat<S, Element = f32>,
    {
        Self {
            tangent: splat(simd, frame.tangent),
            binormal: splat(simd, frame.binormal),
            normal: splat(simd, frame.normal),
        }
    }

    /// Cosine and sine of the turn that carries local coordinates here to `hair`.
    #[inline(always)]
    pub(crate) fn turn<S: Simd>(&self, hair: &Self) -> [V; 2]
    where
        V: SimdFloat<S, Element = f32>,
    {
        let simd = self.normal[0].token();
        let (zero, one) = (V::splat(simd, 0.0), V::splat(simd, 1.0));
        let cosine = dot(self.normal, hair.normal);
        let along = dot(self.tangent, hair.normal) / (one + cosine);
        let mut carried = self.tangent;
        for (k, carried) in carried.iter_mut().enumerate() {
            *carried -= (self.normal[k] + hair.normal[k]) * along;
        }
        let (c, s) = (dot(carried, hair.tangent), dot(carried, hair.binormal));
        let length = (c * c + s * s).sqrt();
        // Beyond 175° the smallest rotation has no stable axis; keep the coordinates.
        let stable = cosine.simd_ge(V::splat(simd, -0.996)) & length.simd_gt(zero);
        [
            stable.select(c / length, one),
            stable.select(s / length, zero),
        ]
    }
}

#[inline(always)]
fn splat<S: Simd, V: SimdFloat<S, Element = f32>>(simd: S, vector: Vec3) -> [V; 3] {
    [
        V::splat(simd, vector.x),
        V::splat(simd, vector.y),
        V::splat(simd, vector.z),
    ]
}

#[inline(always)]
fn dot<S: Simd, V: SimdFloat<S>>([a, b, c]: [V; 3], [x, y, z]: [V; 3]) -> V {
    a * x + b * y + c * z
}

#[cfg(test)]
mod tests {
    use super::*;
    use fearless_simd::{Level, dispatch};
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

    fn inverse_distance(near: &[Near], wanted: usize, weights: &mut Vec<f32>) {
        dispatch!(Level::new(), simd => super::inverse_distance(simd, near, wanted, weights));
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
                let [c, s] = dispatch!(Level::new(), simd => turn(simd, &guide, &hair));
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
