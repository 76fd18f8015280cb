//! From a capture and a pose to strands.
//!
//! Total: nothing here can fail. Runs stage by stage over the chunk, so that each
//! stage's arrays stay in cache; the only memory is the chunk and a reused scratch.

use crate::capture::Capture;
use crate::clock::{Clock, Stage};
use crate::plan::Plan;
use crate::pose::Posed;
use crate::shape::Shapes;
use crate::stages::{frames, look};
use fearless_simd::{Level, Simd, dispatch};
use pelage_curves::FrameScratch;
use pelage_strands::{StrandBuffer, StrandMeta};
use pelage_surface::RootFrame;

/// Arrays that are only used while a chunk is evaluated.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    shapes: Shapes,
    posed: Vec<RootFrame>,
    kept: Vec<Kept>,
    frames: FrameScratch,
}

/// A curve that is written, by its number in the chunk, and the number of its hair.
#[derive(Clone, Copy, Debug)]
struct Kept {
    curve: u32,
    hair: u32,
}

impl Plan {
    /// Writes the strands of `capture` on a pose into `out`, which is emptied first, and
    /// gives the number of hairs that are left out because they have degenerated.
    pub fn evaluate(
        &self,
        capture: &Capture,
        posed: &Posed,
        scratch: &mut Scratch,
        out: &mut StrandBuffer,
        clock: &mut Clock,
    ) -> u64 {
        let moment = posed.moment();
        let Scratch {
            shapes,
            posed,
            kept,
            frames: side_by_side,
        } = scratch;
        let started = clock.start();
        let frames = self.frames(capture, &moment, posed);
        clock.stop(Stage::World, started);
        self.shape(capture, frames, &moment, shapes, clock);
        let started = clock.start();
        dispatch!(Level::new(), simd => {
            self.lay_out(simd, capture, shapes, kept, out)
        });
        let started = clock.stop(Stage::Look, started);
        if self.normals {
            let points = bytemuck::cast_slice(&out.points);
            let normals = bytemuck::cast_slice_mut(&mut out.normals);
            let first = |i: usize| frames[kept[i].hair as usize].tangent;
            frames::normals(first, points, &out.offsets, side_by_side, normals);
        }
        clock.stop(Stage::Frames, started);
        (capture.len() - out.len() / self.fibers()) as u64
    }

    /// Writes everything but normals, which get their length; and which curves are written to
    /// `kept`.
    #[inline(always)]
    fn lay_out<S: Simd>(
        &self,
        simd: S,
        capture: &Capture,
        shapes: &Shapes,
        kept: &mut Vec<Kept>,
        out: &mut StrandBuffer,
    ) {
        // Arrays that keep their length need not be filled before they are written.
        out.offsets.truncate(1);
        out.points.clear();
        kept.clear();
        shapes.write(&mut out.points);
        let fibers = self.fibers();
        let curves = 0..capture.len() * fibers;
        let staying = curves.filter(|&curve| !shapes.stay.numbers(curve).is_empty());
        kept.extend(staying.map(|curve| Kept {
            curve: curve as u32,
            hair: (curve / fibers) as u32,
        }));
        out.extend_meta(kept.iter().map(|kept| self.meta(capture, shapes, kept)));
        self.color(simd, capture, shapes, kept, out);
        let normals = if self.normals { out.points.len() } else { 0 };
        out.normals.resize(normals, [0.0; 3]);
    }

    /// Where the vertices of a curve end, and its record.
    #[inline(always)]
    fn meta(&self, capture: &Capture, shapes: &Shapes, kept: &Kept) -> (u32, StrandMeta) {
        let (root, curve) = (&capture.roots[kept.hair as usize], kept.curve as usize);
        let fiber = capture.fibers.get(curve);
        let meta = StrandMeta {
            hair_id: root.hair,
            strand_id: kept.curve - kept.hair * self.fibers() as u32,
            root_uv: root.uv.to_array(),
            strand_uv: fiber.map_or([0.0; 2], |fiber| fiber.place.to_array()),
            group: root.group,
            triangle: root.place.triangle,
            barycentric: root.place.barycentric,
            root_rest: root.rest.to_array(),
        };
        (shapes.stay.offsets()[curve + 1], meta)
    }

    /// Writes the looks of the curves `kept`.
    #[inline(always)]
    fn color<S: Simd>(
        &self,
        simd: S,
        capture: &Capture,
        shapes: &Shapes,
        kept: &[Kept],
        out: &mut StrandBuffer,
    ) {
        let (fields, vertices) = (&self.fields.look, out.points.len());
        let pieces = fields.color.pieces();
        out.colors.resize(vertices + look::ROW, [0.0; 3]);
        out.opacities.resize(vertices + look::ROW, 0.0);
        out.widths.resize(vertices + look::ROW, 0.0);
        let mut written = look::Written {
            colors: &mut out.colors,
            opacities: &mut out.opacities,
            widths: &mut out.widths,
        };
        let mut start = 0;
        for kept in kept {
            let hair = kept.hair as usize;
            let vertices = look::Vertices {
                segments: self.guides[capture.roots[hair].group as usize].segments,
                cut: capture.cut(hair),
                numbers: shapes.stay.numbers_from(kept.curve as usize),
                count: shapes.stay.numbers(kept.curve as usize).len(),
            };
            let mixes = &capture.mixes[hair * pieces..][..pieces];
            look::along(
                simd,
                fields,
                &capture.looks[hair],
                mixes,
                vertices,
                start,
                &mut written,
            );
            start += vertices.count;
        }
        out.colors.truncate(vertices);
        out.opacities.truncate(vertices);
        out.widths.truncate(vertices);
    }
}
