//! What frizz and kink have in common: the frequencies of a noise along the axes, and
//! amounts along hairs.

use crate::PlanError;
use crate::lanes::Number;
use crate::maps::{FieldMaker, ScalarField};
use crate::profile::Profile;
use crate::random::{Channel, noise_seed};
use crate::recipe::ScalarProperty;
use fearless_simd::Simd;
use pelage_curves::Vec3;

/// A noise over the surface.
#[derive(Clone, Debug)]
pub struct NoiseFields {
    frequency: [ScalarField; 3],
    amount: Profile<2>,
    /// Which noise it is.
    pub(crate) seed: u32,
}

/// The noise of one hair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HairNoise {
    /// Along the axes, per unit of the mesh; at least 0.
    pub frequency: Vec3,
    /// Amounts at root and tip, at least 0; with a ramp, the first multiplies it.
    pub amount: [f32; 2],
}

impl NoiseFields {
    /// Reads the section `key` of a recipe; `None` where the amounts are 0.
    pub(crate) fn new(
        key: &str,
        frequency: &[ScalarProperty; 3],
        [root, tip]: [&ScalarProperty; 2],
        maker: &mut FieldMaker,
        (seed, channel): (u64, Channel),
    ) -> Result<Option<Self>, PlanError> {
        let fields = Self {
            frequency: maker.frequencies(&format!("{key}.frequency"), frequency)?,
            amount: Profile::new(key, [("root", root), ("tip", tip)], maker)?,
            seed: noise_seed(seed, channel),
        };
        Ok(Some(fields).filter(|fields| !fields.amount.is_zero()))
    }

    /// Its properties, in the order in which [`HairNoise::new`] takes their values.
    pub(crate) fn fields(&self) -> [&ScalarField; 5] {
        let ([x, y, z], [root, tip]) = (&self.frequency, self.amount.fields());
        [x, y, z, root, tip]
    }

    /// How much of the noise hairs side by side have at `ts`, of their amounts at root and
    /// tip; `between` says it without a ramp.
    #[inline(always)]
    pub(crate) fn amounts<S: Simd>(
        &self,
        ends: [Number<S>; 2],
        ts: Number<S>,
        between: impl Fn([Number<S>; 2], Number<S>) -> Number<S>,
    ) -> Number<S> {
        self.amount.row(ends, ts, between)
    }
}

impl HairNoise {
    /// The noise of a hair from what its properties are at its root.
    pub(crate) fn new(values: [f32; 5]) -> Self {
        let [x, y, z, root, tip] = values.map(|value| value.max(0.0));
        Self {
            frequency: Vec3::new(x, y, z),
            amount: [root, tip],
        }
    }
}
