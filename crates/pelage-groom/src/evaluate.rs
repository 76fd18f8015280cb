//! From a capture and a pose to strands.
//!
//! Total: nothing here can fail. Runs stage by stage over the chunk, so that each
//! stage's arrays stay in cache; the only memory is the chunk and a reused scratch.

use crate::capture::Capture;
use crate::clock::{Clock, Stage};
use crate::plan::Plan;
use crate::shape::Shapes;
use crate::stages::roots::Root;
use crate::stages::{frames, look, world};
use fearless_simd::{Level, dispatch};
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
        self.shape(capture, pose.time as f32, shapes, clock);
        let started = clock.start();
        self.lay_out(capture, shapes, out);
        self.color(capture, shapes, out);
        let started = clock.stop(Stage::Look, started);
        let frames = if pose.surface.is_none() && !self.roots.is_displaced() {
            &capture.frames
        } else {
            let surface = pose.surface.unwrap_or(&self.roots.rest);
            let frame = |root: &Root| self.roots.frame(surface, &root.place, root.uv);
            posed.clear();
            posed.extend(capture.roots.iter().map(frame));
            posed
        };
        to_world(frames, shapes, out);
        let started = clock.stop(Stage::World, started);
        if self.normals {
            let points = bytemuck::cast_slice(&out.points);
            let normals = bytemuck::cast_slice_mut(&mut out.normals);
            frames::normals(frames, points, &out.offsets, side_by_side, normals);
        }
        clock.stop(Stage::Frames, started);
    }

    /// Every array of `out` gets its length here.
    fn lay_out(&self, capture: &Capture, shapes: &Shapes, out: &mut StrandBuffer) {
        out.clear();
        let offsets = shapes.offsets();
        for (root, &vertices) in capture.roots.iter().zip(&offsets[1..]) {
            out.push_meta(&StrandMeta {
                hair_id: root.hair,
                root_uv: root.uv.to_array(),
                group: root.group,
                triangle: root.place.triangle,
                barycentric: root.place.barycentric,
                root_rest: root.rest.to_array(),
                ..StrandMeta::default()
            });
            // `push_meta` closes a strand at the points present; they come below.
            if let Some(end) = out.offsets.last_mut() {
                *end = vertices;
            }
        }
        let vertices = offsets.last().map_or(0, |&end| end as usize);
        out.points.resize(vertices, [0.0; 3]);
        out.widths.resize(vertices, 0.0);
        out.colors.resize(vertices, [0.0; 3]);
        out.opacities.resize(vertices, 0.0);
        if self.normals {
            out.normals.resize(vertices, [0.0; 3]);
        }
    }

    fn color(&self, capture: &Capture, shapes: &Shapes, out: &mut StrandBuffer) {
        dispatch!(Level::new(), simd => {
            let _ = simd;
            self.color_all(capture, shapes, out)
        });
    }

    #[inline(always)]
    fn color_all(&self, capture: &Capture, shapes: &Shapes, out: &mut StrandBuffer) {
        for (i, one) in capture.looks.iter().enumerate() {
            let range = out.vertices(i);
            let segments = self.guides[capture.roots[i].group as usize].segments;
            look::along(
                one,
                shapes.numbers(i),
                segments,
                capture.cut(i),
                &mut out.colors[range.clone()],
                &mut out.opacities[range.clone()],
                &mut out.widths[range],
            );
        }
    }
}

fn to_world(frames: &[RootFrame], shapes: &Shapes, out: &mut StrandBuffer) {
    for (i, frame) in frames.iter().enumerate() {
        let range = out.vertices(i);
        let points = bytemuck::cast_slice_mut(&mut out.points[range]);
        world::to_world(frame, shapes.vertices(i), points);
    }
}
