//! Kink: noise along each hair.
//!
//! Source: document 004, section 2.2.5: `p += K · ((1 - t) · root + t · tip)` with
//! t = i / segments, or by a ramp in the place of that amount; K is three noises of the
//! vertex where it stands on the surface at rest. Unlike there, the root stays where it is:
//! a hair keeps growing out of the skin whatever `kink.root`. Local space, unit of the mesh;
//! frequencies per unit of the mesh.

use crate::blocks::Blocks;
use crate::lanes::{Frames, LANES, Rows};
use crate::noise::noise_row;
use crate::noise_fields::{HairNoise, NoiseFields};
use crate::profile::line;
use fearless_simd::{Level, dispatch};
use pelage_surface::RootFrame;

/// Moves the vertices of `local`: of hairs with such noise, whose roots have `frames` at
/// rest. `rest` are the hairs at rest where those of `local` are others.
pub(crate) fn kink(
    fields: &NoiseFields,
    hairs: &[HairNoise],
    frames: &[RootFrame],
    rest: Option<&Blocks>,
    local: &mut Blocks,
) {
    dispatch!(Level::new(), simd => {
        let _ = simd;
        for block in 0..local.blocks() {
            let range = local.hairs(block);
            let hairs = (&hairs[range.clone()], Frames::of(&frames[range]));
            let steps = local.steps(block);
            let rest = rest.map(|rest| rest.block(block));
            let vertices = local.block_mut(block).iter_mut().enumerate().skip(1);
            for (number, vertex) in vertices {
                let ts = steps.map(|step| number as f32 * step);
                let rest = rest.map_or(*vertex, |rest| rest[number]);
                move_row(fields, hairs, ts, rest, vertex);
            }
        }
    });
}

/// Moves a vertex of each hair of a block.
#[inline(always)]
fn move_row(
    fields: &NoiseFields,
    (hairs, frames): (&[HairNoise], Frames),
    ts: [f32; LANES],
    rest: Rows,
    vertex: &mut Rows,
) {
    let frequency = Rows::of(hairs, |hair| hair.frequency);
    let place = |lane| frequency.get(lane) * frames.place(lane, rest.get(lane));
    let noise = noise_row(fields.seed, &Rows::from_fn(place));
    let amounts = fields.amounts(hairs, &ts, line);
    *vertex = Rows::from_fn(|lane| vertex.get(lane) + noise.get(lane) * amounts[lane]);
}
