//! What frizz and kink have in common: the frequencies of a noise along the axes, and
//! amounts along hairs.

use crate::PlanError;
use crate::lanes::{Number, Row, Rows};
use crate::maps::{FieldMaker, ScalarField};
use crate::profile::Profile;
use crate::random::{Channel, noise_seed};
use crate::recipe::ScalarProperty;
use fearless_simd::Simd;

/// A noise over the surface.
#[derive(Clone, Debug)]
pub struct NoiseFields {
    frequency: [ScalarField; 3],
    amount: Profile<2>,
    /// Which noise it is.
    pub(crate) seed: u32,
}

/// The noise of hairs side by side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NoiseRows {
    /// Along the axes, per unit of the mesh; at least 0.
    pub frequency: Rows,
    /// Amounts at root and tip, at least 0; with a ramp, the first multiplies it.
    pub amount: [Row; 2],
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

    /// Its properties, in the order in which [`NoiseRows::new`] takes their values.
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

impl NoiseRows {
    /// The noise of hairs from what its properties are at their roots.
    pub(crate) fn new(values: [Row; 5]) -> Self {
        let [x, y, z, root, tip] = values.map(|row| row.map(|value| value.max(0.0)));
        Self {
            frequency: Rows([x, y, z]),
            amount: [root, tip],
        }
    }
}
