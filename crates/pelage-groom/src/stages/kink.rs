//! Kink: noise along each hair.
//!
//! Source: document 004, section 2.2.5: `p += K · ((1 - t) · root + t · tip)` with
//! t = i / segments, or by a ramp in the place of that amount; K is three noises of the
//! vertex where it stands on the surface at rest. Unlike there, the root stays where it is:
//! a hair keeps growing out of the skin whatever `kink.root`. Local space, unit of the mesh;
//! frequencies per unit of the mesh.

use crate::blocks::Blocks;
use crate::lanes::{Frames, Number, Row, Rows};
use crate::noise::noise_at;
use crate::noise_fields::{NoiseFields, NoiseRows};
use crate::profile::line;
use fearless_simd::{Level, Simd, SimdBase, dispatch};
use pelage_surface::RootFrame;

/// Moves the vertices of `local`: of hairs with the noise `rows`, block by block, whose roots
/// have `frames` at rest. `rest` are the hairs at rest where those of `local` are others.
pub(crate) fn kink(
    fields: &NoiseFields,
    rows: &[NoiseRows],
    frames: &[RootFrame],
    rest: Option<&Blocks>,
    local: &mut Blocks,
) {
    dispatch!(Level::new(), simd => {
        for (block, noise) in rows.iter().enumerate() {
            let kinked = Kinked {
                fields,
                noise,
                frames: Frames::of(&frames[local.hairs(block)]),
                steps: local.steps(block),
            };
            let rest = rest.map(|rest| rest.block(block));
            kinked.bend(simd, rest, local.block_mut(block));
        }
    });
}

/// The hairs of a block, without their vertices.
struct Kinked<'a> {
    fields: &'a NoiseFields,
    noise: &'a NoiseRows,
    frames: Frames,
    /// From vertex to vertex.
    steps: Row,
}

impl Kinked<'_> {
    #[inline(always)]
    fn bend<S: Simd>(&self, simd: S, rest: Option<&[Rows]>, hairs: &mut [Rows]) {
        let amounts = self.noise.amount.map(|row| Number::load_array(simd, row));
        let steps = Number::load_array(simd, self.steps);
        for (number, vertex) in hairs.iter_mut().enumerate().skip(1) {
            let local = vertex.load(simd);
            let rest = rest.map_or(local, |rest| rest[number].load(simd));
            let place = self.noise.frequency.load(simd) * self.frames.place(simd, rest);
            let amounts = self.fields.amounts(amounts, steps * number as f32, line);
            *vertex = (local + noise_at(self.fields.seed, place) * amounts).rows();
        }
    }
}
