//! From a capture and a pose to strands.
//!
//! Total: nothing here can fail. Runs stage by stage over the chunk, so that each
//! stage's arrays stay in cache; the only memory is the chunk and a reused scratch.

use crate::capture::Capture;
use crate::clock::{Clock, Stage};
use crate::plan::Plan;
use crate::stages::roots::Root;
use crate::stages::{cut, frames, frizz, interpolate, kink, look, scale, world};
use pelage_curves::{FrameScratch, Vec3};
use pelage_strands::{StrandBuffer, StrandMeta};
use pelage_surface::{Mesh, RootFrame};

/// Arrays that are only used while a chunk is evaluated.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    /// Vertices before hairs are cut, and where each hair's start.
    local: Vec<Vec3>,
    starts: Vec<u32>,
    posed: Vec<RootFrame>,
    noise: [Vec<Vec3>; 2],
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
        let started = clock.start();
        self.lay_out(capture, &mut scratch.starts, out);
        self.interpolate(capture, scratch);
        let started = clock.stop(Stage::Interpolate, started);
        let Scratch {
            local,
            starts,
            noise,
            ..
        } = scratch;
        let range = |i: usize| starts[i] as usize..starts[i + 1] as usize;
        if let Some(fields) = &self.fields.frizz {
            let (hairs, time) = (&capture.frizz, pose.time as f32);
            frizz::frizz(fields, hairs, time, range, local, noise);
        }
        let started = clock.stop(Stage::Frizz, started);
        if let Some(fields) = &self.fields.kink {
            let (hairs, frames) = (&capture.kinks, &capture.frames);
            kink::kink(fields, hairs, frames, range, local, noise);
        }
        for (i, &length) in capture.cuts.iter().enumerate() {
            cut::cut(length, &mut local[range(i)]);
        }
        let started = clock.stop(Stage::Kink, started);
        self.color(capture, out);
        let started = clock.stop(Stage::Look, started);
        let Scratch {
            local,
            starts,
            posed,
            frames: side_by_side,
            ..
        } = scratch;
        let frames = if pose.surface.is_none() && !self.roots.is_displaced() {
            &capture.frames
        } else {
            let surface = pose.surface.unwrap_or(&self.roots.rest);
            let frame = |root: &Root| self.roots.frame(surface, &root.place, root.uv);
            posed.clear();
            posed.extend(capture.roots.iter().map(frame));
            posed
        };
        to_world(frames, local, starts, out);
        let started = clock.stop(Stage::World, started);
        if self.normals {
            let points = bytemuck::cast_slice(&out.points);
            let normals = bytemuck::cast_slice_mut(&mut out.normals);
            frames::normals(frames, points, &out.offsets, side_by_side, normals);
        }
        clock.stop(Stage::Frames, started);
    }

    /// Counts, then prefix sums: every array of `out` gets its length here.
    fn lay_out(&self, capture: &Capture, starts: &mut Vec<u32>, out: &mut StrandBuffer) {
        out.clear();
        starts.clear();
        starts.push(0);
        let (mut vertices, mut uncut) = (0, 0);
        for (i, root) in capture.roots.iter().enumerate() {
            let all = self.guides[root.group as usize].segments as usize + 1;
            vertices += cut::kept(all, capture.cut(i));
            uncut += all;
            starts.push(uncut as u32);
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
                *end = vertices as u32;
            }
        }
        out.points.resize(vertices, [0.0; 3]);
        out.widths.resize(vertices, 0.0);
        out.colors.resize(vertices, [0.0; 3]);
        out.opacities.resize(vertices, 0.0);
        if self.normals {
            out.normals.resize(vertices, [0.0; 3]);
        }
    }

    fn interpolate(&self, capture: &Capture, scratch: &mut Scratch) {
        let Scratch { local, starts, .. } = scratch;
        let vertices = starts.last().map_or(0, |&end| end as usize);
        local.resize(vertices, Vec3::ZERO);
        for (i, root) in capture.roots.iter().enumerate() {
            let range = capture.share_starts[i] as usize..capture.share_starts[i + 1] as usize;
            let hair = &mut local[starts[i] as usize..starts[i + 1] as usize];
            let guides = &self.guides[root.group as usize].vertices;
            interpolate::interpolate(guides, &capture.shares[range], hair);
            scale::scale(capture.scale[i], hair);
        }
    }

    fn color(&self, capture: &Capture, out: &mut StrandBuffer) {
        for (i, one) in capture.looks.iter().enumerate() {
            let range = out.vertices(i);
            let segments = self.guides[capture.roots[i].group as usize].segments;
            look::along(
                one,
                segments,
                capture.cut(i),
                &mut out.colors[range.clone()],
                &mut out.opacities[range.clone()],
                &mut out.widths[range],
            );
        }
    }
}

fn to_world(frames: &[RootFrame], local: &[Vec3], starts: &[u32], out: &mut StrandBuffer) {
    for (i, frame) in frames.iter().enumerate() {
        let range = out.vertices(i);
        let hair = &local[starts[i] as usize..][..range.len()];
        let points = bytemuck::cast_slice_mut(&mut out.points[range.clone()]);
        world::to_world(frame, hair, points);
    }
}
