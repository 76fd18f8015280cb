//! Kink: noise along each hair.
//!
//! Source: document 004, section 2.2.5: `p += K · ((1 - t) · root + t · tip)` with
//! t = i / segments, where K is three noises of the vertex where it stands on the surface
//! at rest. Unlike there, the root stays where it is: a hair keeps growing out of the skin
//! whatever `kink.root`. Local space, unit of the mesh; frequencies per unit of the mesh.

use super::frizz::frequency;
use crate::maps::{FieldMaker, ScalarField};
use crate::noise::noise_vectors;
use crate::random::{Channel, noise_seed};
use crate::recipe;
use crate::{PlanError, stages::roots::Root};
use pelage_curves::Vec3;
use pelage_surface::RootFrame;
use std::ops::Range;

/// The properties of kink over the surface.
#[derive(Clone, Debug)]
pub struct KinkFields {
    frequency: [ScalarField; 3],
    root: ScalarField,
    tip: ScalarField,
    seed: u32,
}

/// The kink of one hair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kink {
    frequency: Vec3,
    root: f32,
    tip: f32,
}

impl KinkFields {
    /// Reads `[kink]`; `None` where it moves nothing.
    pub(crate) fn new(
        kink: &recipe::Kink,
        maker: &mut FieldMaker,
        seed: u64,
    ) -> Result<Option<Self>, PlanError> {
        let fields = Self {
            frequency: maker.frequencies("kink.frequency", &kink.frequency)?,
            root: maker.scalar("kink.root", &kink.root)?,
            tip: maker.scalar("kink.tip", &kink.tip)?,
            seed: noise_seed(seed, Channel::Kink),
        };
        let moves = !(fields.root.is_zero() && fields.tip.is_zero());
        Ok(moves.then_some(fields))
    }

    /// The kink of the hair that grows at `root`.
    pub(crate) fn at(&self, root: &Root) -> Kink {
        Kink {
            frequency: frequency(&self.frequency, root.uv),
            root: self.root.at(root.uv).max(0.0),
            tip: self.tip.at(root.uv).max(0.0),
        }
    }
}

/// Moves the vertices of hairs; hair `i` has the vertices `range(i)` of `local` and the
/// frame `frames[i]` at rest. `places` and `values` are scratch.
pub fn kink(
    fields: &KinkFields,
    hairs: &[Kink],
    frames: &[RootFrame],
    range: impl Fn(usize) -> Range<usize>,
    local: &mut [Vec3],
    [places, values, _]: &mut [Vec<Vec3>; 3],
) {
    places.resize(local.len(), Vec3::ZERO);
    values.resize(local.len(), Vec3::ZERO);
    for (i, (hair, frame)) in hairs.iter().zip(frames).enumerate() {
        let range = range(i);
        for (place, vertex) in places[range.clone()].iter_mut().zip(&local[range]) {
            *place = hair.frequency * (frame.position + frame.vector(*vertex));
        }
    }
    noise_vectors(fields.seed, places, values);
    for (i, hair) in hairs.iter().enumerate() {
        let range = range(i);
        let step = 1.0 / (range.len().max(2) - 1) as f32;
        let vertices = local[range.clone()].iter_mut().zip(&values[range]);
        for (k, (vertex, value)) in vertices.enumerate().skip(1) {
            let t = k as f32 * step;
            *vertex += *value * (hair.root * (1.0 - t) + hair.tip * t);
        }
    }
}
