//! Values along hairs: at the root and the tip (and the centre), or by a ramp.

use crate::PlanError;
use crate::maps::{FieldMaker, ScalarField};
use crate::recipe::{Ramp, ScalarProperty};
use fearless_simd::{Simd, SimdFloat};
use std::ops::{Add, Mul, Neg};

/// A number along hairs, over the surface: at `N` places of a hair, or by a ramp that all
/// hairs share and a map multiplies.
#[derive(Clone, Debug)]
pub struct Profile<const N: usize> {
    /// With a ramp, the first is what multiplies it and the others are 0.
    ends: [ScalarField; N],
    ramp: Option<Ramp<f32>>,
}

impl<const N: usize> Profile<N> {
    /// Reads the properties of the section `key` with these names, root first.
    pub(crate) fn new(
        key: &str,
        properties: [(&str, &ScalarProperty); N],
        maker: &mut FieldMaker,
    ) -> Result<Self, PlanError> {
        let ramp = properties[0].1.ramp.clone();
        let mut ends = [const { ScalarField::ZERO }; N];
        // A ramp at the root takes the place of all others.
        let told = if ramp.is_some() { 1 } else { N };
        for (end, (name, property)) in ends.iter_mut().zip(properties).take(told) {
            let mut property = property.clone();
            if ramp.is_some() {
                property.value = 1.0;
            }
            *end = maker.scalar(&format!("{key}.{name}"), &property)?;
        }
        Ok(Self { ends, ramp })
    }

    /// What is to be read at the root of a hair.
    pub(crate) fn fields(&self) -> [&ScalarField; N] {
        self.ends.each_ref()
    }

    /// Whether the recipe says 0 all along.
    pub(crate) fn is_zero(&self) -> bool {
        match &self.ramp {
            Some(ramp) => ramp.points.iter().all(|(_, value)| *value == 0.0),
            None => self.ends.iter().all(ScalarField::is_zero),
        }
    }

    /// The value at `t` (0 at the root, 1 at the tip) of a hair whose fields are `values`;
    /// `between` says what these mean without a ramp.
    #[inline(always)]
    pub(crate) fn at(
        &self,
        values: [f32; N],
        t: f32,
        between: impl Fn([f32; N], f32) -> f32,
    ) -> f32 {
        match &self.ramp {
            None => between(values, t),
            Some(ramp) => values[0] * on(ramp, t),
        }
    }
}

impl Profile<2> {
    /// The values at each of `ts`, of hairs whose fields are `values`; `between` says what
    /// these mean without a ramp.
    #[inline(always)]
    pub(crate) fn row<S: Simd, V: SimdFloat<S, Element = f32>>(
        &self,
        values: [V; 2],
        mut ts: V,
        between: impl Fn([V; 2], V) -> V,
    ) -> V {
        match &self.ramp {
            None => between(values, ts),
            Some(ramp) => {
                ts.as_mut_slice().iter_mut().for_each(|t| *t = on(ramp, *t));
                values[0] * ts
            }
        }
    }
}

/// The value of `ramp` at `t`: straight lines between its points, and the first and the
/// last point's value beyond them.
fn on(ramp: &Ramp<f32>, t: f32) -> f32 {
    let next = ramp.points.partition_point(|(place, _)| *place <= t);
    match (ramp.points[..next].last(), ramp.points.get(next)) {
        (Some((from, a)), Some((to, b))) => a + (b - a) * ((t - from) / (to - from)),
        (Some((_, value)), None) | (None, Some((_, value))) => *value,
        (None, None) => 0.0,
    }
}

/// A straight line from root to tip, of one number or of many side by side.
#[inline(always)]
pub(crate) fn line<V>([root, tip]: [V; 2], t: V) -> V
where
    V: Copy + Neg<Output = V> + Mul<Output = V> + Add<Output = V> + Add<f32, Output = V>,
{
    root * (-t + 1.0) + tip * t
}

#[cfg(test)]
impl<const N: usize> Profile<N> {
    /// Without a ramp.
    pub(crate) fn plain() -> Self {
        Self {
            ends: [const { ScalarField::ZERO }; N],
            ramp: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_meets_its_points_and_is_straight_in_between() {
        let ramp = Ramp {
            points: vec![(0.25, 1.0), (0.5, 3.0), (1.0, 2.0)],
        };
        let expected = [
            (0.0, 1.0),
            (0.25, 1.0),
            (0.375, 2.0),
            (0.5, 3.0),
            (0.75, 2.5),
            (1.0, 2.0),
        ];
        for (t, value) in expected {
            assert_eq!(on(&ramp, t), value, "at {t}");
        }
    }
}
