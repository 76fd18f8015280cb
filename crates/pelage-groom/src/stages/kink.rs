//! Kink: noise along each hair.
//!
//! Source: document 004, section 2.2.5: `p += K · ((1 - t) · root + t · tip)` with
//! t = i / segments, or by a ramp in the place of that amount; K is three noises of the
//! vertex where it stands on the surface at rest. Unlike there, the root stays where it is:
//! a hair keeps growing out of the skin whatever `kink.root`. Local space, unit of the mesh;
//! frequencies per unit of the mesh.

use crate::noise::noise_vectors;
use crate::noise_fields::{HairNoise, NoiseFields};
use crate::profile::line;
use pelage_curves::Vec3;
use pelage_surface::RootFrame;
use std::ops::Range;

/// Moves the vertices of hairs; hair `i` has the vertices `range(i)` of `local` and the
/// frame `frames[i]` at rest. `rest` are the vertices at rest where those of `local` are
/// others. `places` and `values` are scratch.
pub fn kink(
    fields: &NoiseFields,
    hairs: &[HairNoise],
    frames: &[RootFrame],
    range: impl Fn(usize) -> Range<usize>,
    rest: Option<&[Vec3]>,
    local: &mut [Vec3],
    [places, values, _]: &mut [Vec<Vec3>; 3],
) {
    places.resize(local.len(), Vec3::ZERO);
    values.resize(local.len(), Vec3::ZERO);
    let rest = rest.unwrap_or(local);
    for (i, (hair, frame)) in hairs.iter().zip(frames).enumerate() {
        let range = range(i);
        for (place, vertex) in places[range.clone()].iter_mut().zip(&rest[range]) {
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
            *vertex += *value * fields.amount(hair.amount, t, line);
        }
    }
}
