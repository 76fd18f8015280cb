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
use fearless_simd::{Level, dispatch};
use pelage_curves::FrameScratch;
use pelage_strands::{StrandBuffer, StrandMeta};
use pelage_surface::RootFrame;
use std::ops::Range;

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
            let _ = simd;
            self.lay_out(capture, shapes, kept, out)
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
    fn lay_out(
        &self,
        capture: &Capture,
        shapes: &Shapes,
        kept: &mut Vec<Kept>,
        out: &mut StrandBuffer,
    ) {
        out.clear();
        kept.clear();
        shapes.write(&mut out.points);
        let vertices = out.points.len();
        out.widths.resize(vertices, 0.0);
        out.colors.resize(vertices, [0.0; 3]);
        out.opacities.resize(vertices, 0.0);
        if self.normals {
            out.normals.resize(vertices, [0.0; 3]);
        }
        let fibers = self.fibers();
        let curves = 0..capture.len() * fibers;
        let staying = curves.filter(|&curve| !shapes.stay.numbers(curve).is_empty());
        kept.extend(staying.map(|curve| Kept {
            curve: curve as u32,
            hair: (curve / fibers) as u32,
        }));
        out.extend_meta(kept.iter().map(|kept| self.meta(capture, shapes, kept)));
        for (i, kept) in kept.iter().enumerate() {
            self.color(capture, shapes, kept, out.vertices(i), out);
        }
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

    /// Writes the looks of a curve, whose vertices lie in `range`.
    #[inline(always)]
    fn color(
        &self,
        capture: &Capture,
        shapes: &Shapes,
        kept: &Kept,
        range: Range<usize>,
        out: &mut StrandBuffer,
    ) {
        let (fields, hair) = (&self.fields.look, kept.hair as usize);
        let pieces = fields.color.pieces();
        look::along(
            fields,
            &capture.looks[hair],
            &capture.mixes[hair * pieces..][..pieces],
            look::Vertices {
                numbers: shapes.stay.numbers(kept.curve as usize),
                segments: self.guides[capture.roots[hair].group as usize].segments,
                cut: capture.cut(hair),
            },
            &mut out.colors[range.clone()],
            &mut out.opacities[range.clone()],
            &mut out.widths[range],
        );
    }
}
