//! Weights that heed where guides point.
//!
//! Source: document 000, eq. 49, with its errata: |x - x_k|^-a (S · T_k) Θ(S · T_k), with
//! S the surface normal at the hair's root, T_k the direction in which guide k leaves
//! its root, both at rest. A guide that points away from S counts nothing, so the two
//! sides of an ear do not mix.
//!
//! The equation weighs all guides there are; a hair takes few. A guide at distance d is
//! taken to be as far as D = d / min(1, 10 S · T_k): one that lies within 6° of the
//! surface recedes, to infinity when it begins to point away (see [`recede`]).
//! The n + 1 of the smallest D are taken, and eq. 49 is multiplied by (1 - D / R)², R
//! being the largest of them: the window that document 004 (2.2.4) puts on distances. D
//! is continuous in the root, so is R, and a guide comes and goes with weight 0. Where n
//! guides or fewer face the root, R is infinite and eq. 49 stands as it is. On a plane
//! under upright guides a = 2 gives the weights of document 004.
//!
//! Distances in the unit of the mesh. Limits: where the last guide that faces the root
//! turns away, weights jump to those by distance alone, as the errata ask.

use super::weights::{first_alone, normalise};
use crate::locator::Near;

/// S · T_k below which a guide recedes: small, so that a coat that leans is shaped by the
/// guides that are nearest; not so small that a guide comes and goes all at once.
const GRAZING: f32 = 0.1;

/// The factor of a guide's squared distance that its S · T_k, `facing`, makes: 1 for most,
/// rising to infinity where it begins to point away.
#[inline]
pub fn recede(facing: f32) -> f32 {
    let seen = (facing / GRAZING).clamp(0.0, 1.0);
    1.0 / (seen * seen)
}

/// A guide as a root sees it that has a normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Faced {
    /// Index of the guide in its group.
    pub guide: u32,
    /// Squared distance d² to its root, at rest.
    pub square: f32,
    /// S · T_k, above 0.
    pub facing: f32,
    /// D², finite.
    pub apart: f32,
}

impl Faced {
    /// The guide `near` with its S · T_k, or 1 for distance alone; `None` where it points
    /// away.
    #[inline]
    pub fn new(near: Near, facing: f32) -> Option<Self> {
        let apart = near.square * recede(facing);
        (facing > 0.0 && apart < f32::INFINITY).then_some(Self {
            guide: near.guide,
            square: near.square,
            facing,
            apart,
        })
    }

    /// Orders by D, then by index.
    #[inline]
    pub fn order(&self, other: &Self) -> std::cmp::Ordering {
        let index = self.guide.cmp(&other.guide);
        self.apart.total_cmp(&other.apart).then(index)
    }
}

/// Normalised weights of the guides `near` (smallest D first), written to `weights`;
/// `wanted` is n, and more than n + 1 guides are not heeded. `exponent` is a.
pub fn weigh(near: &[Faced], wanted: usize, exponent: f32, weights: &mut Vec<f32>) {
    weights.clear();
    let least = near.iter().map(|g| g.square).fold(f32::INFINITY, f32::min);
    // At a guide's root the guide is taken alone; the first is one, its D being 0 too.
    if least == 0.0 {
        weights.push(1.0);
        weights.resize(near.len(), 0.0);
        return;
    }
    // Relative to the nearest guide no power of a distance overflows.
    let bare = |g: &Faced| power(least / g.square, exponent / 2.0) * g.facing;
    let radius = near.get(wanted).map(|g| g.apart);
    weights.extend(near.iter().map(|g| {
        let inside = radius.map_or(1.0, |r| (1.0 - (g.apart / r).sqrt()).max(0.0));
        bare(g) * inside * inside
    }));
    if !normalise(weights) {
        // All at one D: the window says nothing.
        weights.clear();
        weights.extend(near.iter().map(bare));
        if !normalise(weights) {
            first_alone(weights);
        }
    }
}

/// `base` to the power of `exponent`; the usual exponent is 1, a being 2.
#[inline]
fn power(base: f32, exponent: f32) -> f32 {
    if exponent == 1.0 {
        base
    } else {
        libm::powf(base, exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stages::weights::inverse_distance;
    use fearless_simd::{Level, dispatch};
    use proptest::prelude::*;

    fn upright(distances: &[f32]) -> Vec<Near> {
        let guides = distances.iter().enumerate();
        guides
            .map(|(i, d)| Near {
                guide: i as u32,
                square: d * d,
            })
            .collect()
    }

    #[test]
    fn a_guide_that_points_away_is_not_seen() {
        let near = upright(&[1.0])[0];
        assert_eq!(Faced::new(near, -1.0), None);
        assert_eq!(Faced::new(near, 0.0), None);
        assert!(Faced::new(near, 0.5).is_some_and(|f| f.apart == 1.0));
        assert!(Faced::new(near, GRAZING / 2.0).is_some_and(|f| f.apart == 4.0));
    }

    #[test]
    fn few_guides_weigh_as_the_equation_says() {
        let at = |guide, square: f32, facing: f32| Faced {
            guide,
            square,
            facing,
            apart: square * recede(facing),
        };
        let mut weights = Vec::new();
        for exponent in [0.0, 1.0, 2.0, 3.5] {
            weigh(
                &[at(0, 1.0, 0.8), at(1, 4.0, 0.5)],
                2,
                exponent,
                &mut weights,
            );
            let [p, q] = [0.8, libm::powf(2.0, -exponent) * 0.5];
            assert!((weights[0] - p / (p + q)).abs() < 1e-6, "a = {exponent}");
            assert!((weights[1] - q / (p + q)).abs() < 1e-6, "a = {exponent}");
        }
    }

    proptest! {
        #[test]
        fn upright_guides_weigh_by_distance_alone(
            mut distances in prop::collection::vec(0.01f32..100.0, 4),
        ) {
            distances.sort_by(f32::total_cmp);
            let near = upright(&distances);
            let faced: Vec<_> = near.iter().filter_map(|&n| Faced::new(n, 1.0)).collect();
            let (mut found, mut expected) = (Vec::new(), Vec::new());
            weigh(&faced, 3, 2.0, &mut found);
            dispatch!(Level::new(), simd => inverse_distance(simd, &near, 3, &mut expected));
            for (a, b) in found.iter().zip(&expected) {
                prop_assert!((a - b).abs() < 1e-4, "{found:?} {expected:?}");
            }
        }

        #[test]
        fn weights_sum_to_one_whatever_comes(
            guides in prop::collection::vec((0.0f32..1e30, 1e-30f32..1.0), 1..9),
            wanted in 1usize..9, exponent in prop_oneof![Just(0.0f32), 0.0f32..1e9],
        ) {
            let mut faced: Vec<Faced> = guides
                .iter()
                .enumerate()
                .filter_map(|(i, &(square, facing))| {
                    let near = Near { guide: i as u32, square };
                    Faced::new(near, facing)
                })
                .collect();
            prop_assume!(!faced.is_empty());
            faced.sort_by(Faced::order);
            let mut weights = Vec::new();
            weigh(&faced, wanted, exponent, &mut weights);
            prop_assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-5);
            prop_assert!(weights.iter().all(|w| (0.0..=1.0).contains(w)));
        }
    }
}
