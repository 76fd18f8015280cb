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
use pelage_curves::FrameScratch;
use pelage_strands::{StrandBuffer, StrandMeta};
use pelage_surface::RootFrame;

/// Arrays that are only used while a chunk is evaluated.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    shapes: Shapes,
    posed: Vec<RootFrame>,
    frames: FrameScratch,
}

impl Plan {
    /// Writes the strands of `capture` on a pose into `out`, which is emptied first.
    pub fn evaluate(
        &self,
        capture: &Capture,
        posed: &Posed,
        scratch: &mut Scratch,
        out: &mut StrandBuffer,
        clock: &mut Clock,
    ) {
        let moment = posed.moment();
        let Scratch {
            shapes,
            posed,
            frames: side_by_side,
        } = scratch;
        let started = clock.start();
        let frames = self.frames(capture, &moment, posed);
        clock.stop(Stage::World, started);
        self.shape(capture, frames, &moment, shapes, clock);
        let started = clock.start();
        self.lay_out(capture, shapes, out);
        self.color(capture, shapes, out);
        let started = clock.stop(Stage::Look, started);
        if self.normals {
            let (points, fibers) = (bytemuck::cast_slice(&out.points), self.fibers());
            let normals = bytemuck::cast_slice_mut(&mut out.normals);
            let first = |i: usize| frames[i / fibers].tangent;
            frames::normals(first, points, &out.offsets, side_by_side, normals);
        }
        clock.stop(Stage::Frames, started);
    }

    /// Every array of `out` gets its length here, and those of single strands their values.
    fn lay_out(&self, capture: &Capture, shapes: &Shapes, out: &mut StrandBuffer) {
        out.clear();
        shapes.write(&mut out.points);
        let mut ends = shapes.offsets()[1..].iter().enumerate();
        for root in &capture.roots {
            let meta = StrandMeta {
                hair_id: root.hair,
                root_uv: root.uv.to_array(),
                group: root.group,
                triangle: root.place.triangle,
                barycentric: root.place.barycentric,
                root_rest: root.rest.to_array(),
                ..StrandMeta::default()
            };
            for (fiber, (i, &end)) in ends.by_ref().take(self.fibers()).enumerate() {
                let place = capture.fibers.get(i).map(|fiber| fiber.place.to_array());
                out.push_meta(&StrandMeta {
                    strand_id: fiber as u32,
                    strand_uv: place.unwrap_or_default(),
                    ..meta
                });
                // `push_meta` closes a strand at the points present, which are all.
                if let Some(last) = out.offsets.last_mut() {
                    *last = end;
                }
            }
        }
        let vertices = out.points.len();
        out.widths.resize(vertices, 0.0);
        out.colors.resize(vertices, [0.0; 3]);
        out.opacities.resize(vertices, 0.0);
        if self.normals {
            out.normals.resize(vertices, [0.0; 3]);
        }
    }

    fn color(&self, capture: &Capture, shapes: &Shapes, out: &mut StrandBuffer) {
        let fibers = self.fibers();
        for i in 0..out.len() {
            let (hair, range) = (i / fibers, out.vertices(i));
            look::along(
                &capture.looks[hair],
                shapes.numbers(i),
                self.guides[capture.roots[hair].group as usize].segments,
                capture.cut(hair),
                &mut out.colors[range.clone()],
                &mut out.opacities[range.clone()],
                &mut out.widths[range],
            );
        }
    }
}
