//! From a capture and a pose to strands.
//!
//! Total: nothing here can fail. Runs stage by stage over the chunk, so that each
//! stage's arrays stay in cache; the only memory is the chunk and a reused scratch.

use crate::capture::Capture;
use crate::clock::{Clock, Stage};
use crate::plan::Plan;
use crate::shape::{Moment, Shapes};
use crate::stages::roots::Root;
use crate::stages::{frames, look};
use pelage_curves::FrameScratch;
use pelage_strands::{StrandBuffer, StrandMeta};
use pelage_surface::{Mesh, RootFrame};

/// Arrays that are only used while a chunk is evaluated.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    shapes: Shapes,
    posed: Vec<RootFrame>,
    frames: FrameScratch,
}

/// A moment in which hairs are made: where the surface is, and the time.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pose<'a> {
    /// The posed surface, with the topology of the rest mesh (see [`Mesh::posed`]); `None`
    /// is the rest pose itself.
    pub surface: Option<&'a Mesh>,
    /// In frames; moves the animated part of frizz.
    pub time: f64,
}

impl Plan {
    /// Writes the strands of `capture` on `pose` into `out`, which is emptied first.
    pub fn evaluate(
        &self,
        capture: &Capture,
        pose: Pose,
        scratch: &mut Scratch,
        out: &mut StrandBuffer,
        clock: &mut Clock,
    ) {
        let Scratch {
            shapes,
            posed,
            frames: side_by_side,
        } = scratch;
        let started = clock.start();
        posed.clear();
        let at_rest = pose.surface.is_none() && !self.roots.is_displaced();
        if !at_rest {
            let surface = pose.surface.unwrap_or(&self.roots.rest);
            let frame = |root: &Root| self.roots.frame(surface, &root.place, root.uv);
            posed.extend(capture.roots.iter().map(frame));
        }
        clock.stop(Stage::World, started);
        let moment = Moment {
            posed: (!at_rest).then_some(&posed[..]),
            time: pose.time as f32,
        };
        self.shape(capture, moment, shapes, clock);
        let started = clock.start();
        self.lay_out(capture, shapes, out);
        self.color(capture, shapes, out);
        let started = clock.stop(Stage::Look, started);
        if self.normals {
            let frames = moment.posed.unwrap_or(&capture.frames);
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
