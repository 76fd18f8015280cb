//! What frizz and kink have in common: the frequencies of a noise along the axes, and
//! amounts at root and tip.

use crate::PlanError;
use crate::maps::{FieldMaker, ScalarField};
use crate::random::{Channel, noise_seed};
use crate::recipe::ScalarProperty;
use pelage_curves::Vec3;

/// A noise over the surface.
#[derive(Clone, Debug)]
pub struct NoiseFields {
    frequency: [ScalarField; 3],
    root: ScalarField,
    tip: ScalarField,
    /// Which noise it is.
    pub(crate) seed: u32,
}

/// The noise of one hair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HairNoise {
    /// Along the axes, per unit of the mesh; at least 0.
    pub frequency: Vec3,
    /// Amount at the root, at least 0.
    pub root: f32,
    /// Amount at the tip, at least 0.
    pub tip: f32,
}

impl NoiseFields {
    /// Reads the section `key` of a recipe; `None` where both amounts are 0.
    pub(crate) fn new(
        key: &str,
        frequency: &[ScalarProperty; 3],
        [root, tip]: [&ScalarProperty; 2],
        maker: &mut FieldMaker,
        (seed, channel): (u64, Channel),
    ) -> Result<Option<Self>, PlanError> {
        let fields = Self {
            frequency: maker.frequencies(&format!("{key}.frequency"), frequency)?,
            root: maker.scalar(&format!("{key}.root"), root)?,
            tip: maker.scalar(&format!("{key}.tip"), tip)?,
            seed: noise_seed(seed, channel),
        };
        let acts = !(fields.root.is_zero() && fields.tip.is_zero());
        Ok(acts.then_some(fields))
    }

    /// Its properties, in the order in which [`HairNoise::new`] takes their values.
    pub(crate) fn fields(&self) -> [&ScalarField; 5] {
        let [x, y, z] = &self.frequency;
        [x, y, z, &self.root, &self.tip]
    }
}

impl HairNoise {
    /// The noise of a hair from what its properties are at its root.
    pub(crate) fn new(values: [f32; 5]) -> Self {
        let [x, y, z, root, tip] = values.map(|value| value.max(0.0));
        Self {
            frequency: Vec3::new(x, y, z),
            root,
            tip,
        }
    }
}
