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

/// Arrays that are only used while a chunk is evaluated.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    shapes: Shapes,
    posed: Vec<RootFrame>,
    /// The hair of each curve, by its number in the chunk.
    hairs: Vec<u32>,
    frames: FrameScratch,
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
            hairs,
            frames: side_by_side,
        } = scratch;
        let started = clock.start();
        let frames = self.frames(capture, &moment, posed);
        clock.stop(Stage::World, started);
        self.shape(capture, frames, &moment, shapes, clock);
        let started = clock.start();
        dispatch!(Level::new(), simd => {
            let _ = simd;
            self.lay_out(capture, shapes, hairs, out)
        });
        let started = clock.stop(Stage::Look, started);
        if self.normals {
            let points = bytemuck::cast_slice(&out.points);
            let normals = bytemuck::cast_slice_mut(&mut out.normals);
            let first = |i: usize| frames[hairs[i] as usize].tangent;
            frames::normals(first, points, &out.offsets, side_by_side, normals);
        }
        clock.stop(Stage::Frames, started);
        (capture.len() - out.len() / self.fibers()) as u64
    }

    /// Writes everything but normals, which get their length; and the number of each
    /// curve's hair in the chunk to `hairs`.
    #[inline(always)]
    fn lay_out(
        &self,
        capture: &Capture,
        shapes: &Shapes,
        hairs: &mut Vec<u32>,
        out: &mut StrandBuffer,
    ) {
        out.clear();
        hairs.clear();
        shapes.write(&mut out.points);
        let vertices = out.points.len();
        out.widths.resize(vertices, 0.0);
        out.colors.resize(vertices, [0.0; 3]);
        out.opacities.resize(vertices, 0.0);
        if self.normals {
            out.normals.resize(vertices, [0.0; 3]);
        }
        let fibers = self.fibers();
        for (hair, root) in capture.roots.iter().enumerate() {
            let meta = StrandMeta {
                hair_id: root.hair,
                root_uv: root.uv.to_array(),
                group: root.group,
                triangle: root.place.triangle,
                barycentric: root.place.barycentric,
                root_rest: root.rest.to_array(),
                ..StrandMeta::default()
            };
            for fiber in 0..fibers {
                let curve = hair * fibers + fiber;
                if shapes.stay.numbers(curve).is_empty() {
                    continue;
                }
                let place = capture.fibers.get(curve);
                out.push_meta(&StrandMeta {
                    strand_id: fiber as u32,
                    strand_uv: place.map_or([0.0; 2], |fiber| fiber.place.to_array()),
                    ..meta
                });
                // `push_meta` closes a strand at the points present, which are all.
                if let Some(last) = out.offsets.last_mut() {
                    *last = shapes.stay.offsets()[curve + 1];
                }
                hairs.push(hair as u32);
                self.color(capture, hair, shapes.stay.numbers(curve), out);
            }
        }
    }

    /// Writes the looks of the last curve of `out`, whose vertices had `numbers` in hair
    /// number `hair` of the chunk.
    #[inline(always)]
    fn color(&self, capture: &Capture, hair: usize, numbers: &[u32], out: &mut StrandBuffer) {
        let range = out.vertices(out.len() - 1);
        let fields = &self.fields.look;
        let pieces = fields.color.pieces();
        look::along(
            fields,
            &capture.looks[hair],
            &capture.mixes[hair * pieces..][..pieces],
            look::Vertices {
                numbers,
                segments: self.guides[capture.roots[hair].group as usize].segments,
                cut: capture.cut(hair),
            },
            &mut out.colors[range.clone()],
            &mut out.opacities[range.clone()],
            &mut out.widths[range],
        );
    }
}
