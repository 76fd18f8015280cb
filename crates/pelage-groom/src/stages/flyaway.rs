//! Flyaways: single hairs that stray from the others.
//!
//! Ours; document 004 has none. A hair strays where ξ < percent / 100. Then
//! p += strength · length · t² · d with t = i / segments, where d is a unit vector drawn
//! for the hair, away from the skin; the segments get their lengths back. Local space,
//! unit of the mesh.

use crate::PlanError;
use crate::maps::{FieldMaker, ScalarField};
use crate::random::{Channel, uniform};
use crate::recipe;
use crate::stages::length;
use pelage_curves::Vec3;
use std::f32::consts::TAU;

/// The properties of flyaways over the surface.
#[derive(Clone, Debug)]
pub struct FlyawayFields {
    percent: ScalarField,
    strength: ScalarField,
}

/// How a hair strays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stray {
    /// Unit vector in local space, times the strength; zero for hairs that do not.
    pub toward: Vec3,
    /// How much of it stays with its clump, 0..=1.
    pub clumped: f32,
}

impl FlyawayFields {
    /// Reads `[flyaway]`; `None` where no hair strays.
    pub(crate) fn new(
        flyaway: &recipe::Flyaway,
        maker: &mut FieldMaker,
    ) -> Result<Option<Self>, PlanError> {
        let fields = Self {
            percent: maker.scalar("flyaway.percent", &flyaway.percent)?,
            strength: maker.scalar("flyaway.strength", &flyaway.strength)?,
        };
        let acts = !(fields.percent.is_zero() || fields.strength.is_zero());
        Ok(acts.then_some(fields))
    }

    /// Its properties, in the order in which [`Stray::new`] takes their values.
    pub(crate) fn fields(&self) -> [&ScalarField; 2] {
        [&self.percent, &self.strength]
    }
}

impl Stray {
    /// How hair `hair` strays, from what the properties are at its root.
    pub(crate) fn new([percent, strength]: [f32; 2], seed: u64, hair: u64) -> Self {
        if uniform(seed, hair, Channel::Flyaway) >= percent / 100.0 {
            return Self {
                toward: Vec3::ZERO,
                clumped: 1.0,
            };
        }
        let strength = strength.max(0.0);
        let height = uniform(seed, hair, Channel::FlyawayHeight);
        let (sine, cosine) = libm::sincosf(TAU * uniform(seed, hair, Channel::FlyawayAngle));
        let flat = (1.0 - height * height).max(0.0).sqrt();
        Self {
            toward: Vec3::new(cosine * flat, sine * flat, height) * strength,
            clumped: (1.0 - strength).max(0.0),
        }
    }
}

impl Stray {
    /// Whether the hair strays.
    pub(crate) fn strays(&self) -> bool {
        self.toward != Vec3::ZERO
    }
}

/// Bends a hair of nominal length `length` its own way; `before` is scratch.
pub fn stray(stray: &Stray, length: f32, hair: &mut [Vec3], before: &mut Vec<Vec3>) {
    before.clear();
    before.extend_from_slice(hair);
    let step = 1.0 / (hair.len().max(2) - 1) as f32;
    for (i, vertex) in hair.iter_mut().enumerate() {
        let t = i as f32 * step;
        *vertex += stray.toward * (length * t * t);
    }
    length::preserve(before, 1.0, hair);
}
