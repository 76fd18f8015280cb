//! The shapes of hairs in the frames of their roots: all that comes before the pose.

use crate::capture::Capture;
use crate::clock::{Clock, Stage};
use crate::plan::Plan;
use crate::stages::{cut, frizz, interpolate, kink, scale, thin};
use fearless_simd::{Level, dispatch};
use pelage_curves::Vec3;
use std::ops::Range;

/// The hairs of a chunk in local space. Reused between chunks.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shapes {
    /// All vertices of all hairs; a hair that is cut ends before its last.
    vertices: Vec<Vec3>,
    /// Where each hair's vertices start; one more entry than hairs.
    starts: Vec<u32>,
    /// For each hair, the numbers of its vertices that stay.
    kept: Vec<u32>,
    /// Where each hair's begin there; one more entry than hairs.
    kept_starts: Vec<u32>,
    noise: [Vec<Vec3>; 3],
    tangents: Vec<Vec3>,
}

impl Shapes {
    /// Where the vertices that stay start, hair by hair.
    pub(crate) fn offsets(&self) -> &[u32] {
        &self.kept_starts
    }

    /// Numbers of the vertices that stay of hair `i`.
    pub(crate) fn numbers(&self, i: usize) -> &[u32] {
        &self.kept[self.kept_starts[i] as usize..self.kept_starts[i + 1] as usize]
    }

    /// The vertices that stay of hair `i`.
    pub(crate) fn vertices(&self, i: usize) -> impl Iterator<Item = Vec3> {
        let all = &self.vertices[self.range(i)];
        self.numbers(i).iter().map(|&number| all[number as usize])
    }

    fn range(&self, i: usize) -> Range<usize> {
        self.starts[i] as usize..self.starts[i + 1] as usize
    }
}

impl Plan {
    /// Shapes the hairs of `capture` at `time`.
    ///
    /// Which vertices stay is decided by the shapes at time 0, so that it is the same at
    /// all times (architecture.md, law 4).
    pub(crate) fn shape(
        &self,
        capture: &Capture,
        time: f32,
        shapes: &mut Shapes,
        clock: &mut Clock,
    ) {
        let moves = self.fields.frizz.as_ref().is_some_and(|f| f.is_moving());
        if self.thinning.is_some() && moves && time != 0.0 {
            self.bend(capture, 0.0, shapes, clock);
            self.choose(capture, shapes, clock);
            self.bend(capture, time, shapes, clock);
        } else {
            self.bend(capture, time, shapes, clock);
            self.choose(capture, shapes, clock);
        }
    }

    fn bend(&self, capture: &Capture, time: f32, shapes: &mut Shapes, clock: &mut Clock) {
        let started = clock.start();
        self.interpolate(capture, shapes);
        let started = clock.stop(Stage::Interpolate, started);
        let Shapes {
            vertices,
            starts,
            noise,
            ..
        } = shapes;
        let range = |i: usize| starts[i] as usize..starts[i + 1] as usize;
        if let Some(fields) = &self.fields.frizz {
            frizz::frizz(fields, &capture.frizz, time, range, vertices, noise);
        }
        let started = clock.stop(Stage::Frizz, started);
        if let Some(fields) = &self.fields.kink {
            let (hairs, frames) = (&capture.kinks, &capture.frames);
            kink::kink(fields, hairs, frames, range, vertices, noise);
        }
        let started = clock.stop(Stage::Kink, started);
        for (i, &length) in capture.cuts.iter().enumerate() {
            cut::cut(length, &mut vertices[range(i)]);
        }
        clock.stop(Stage::Thin, started);
    }

    fn interpolate(&self, capture: &Capture, shapes: &mut Shapes) {
        let Shapes {
            vertices, starts, ..
        } = shapes;
        starts.clear();
        starts.push(0);
        let mut end = 0;
        starts.extend(capture.roots.iter().map(|root| {
            end += self.guides[root.group as usize].segments + 1;
            end
        }));
        vertices.resize(end as usize, Vec3::ZERO);
        dispatch!(Level::new(), simd => {
            let _ = simd;
            self.mix_guides(capture, starts, vertices)
        });
    }

    #[inline(always)]
    fn mix_guides(&self, capture: &Capture, starts: &[u32], vertices: &mut [Vec3]) {
        for (i, root) in capture.roots.iter().enumerate() {
            let range = capture.share_starts[i] as usize..capture.share_starts[i + 1] as usize;
            let hair = &mut vertices[starts[i] as usize..starts[i + 1] as usize];
            let guides = &self.guides[root.group as usize].vertices;
            interpolate::interpolate(guides, &capture.shares[range], hair);
            scale::scale(capture.scale[i], hair);
        }
    }

    fn choose(&self, capture: &Capture, shapes: &mut Shapes, clock: &mut Clock) {
        let started = clock.start();
        shapes.kept.clear();
        shapes.kept_starts.clear();
        shapes.kept_starts.push(0);
        for i in 0..capture.roots.len() {
            let range = shapes.range(i);
            let uncut = cut::kept(range.len(), capture.cut(i));
            match self.thinning {
                None => shapes.kept.extend(0..uncut as u32),
                Some(threshold) => {
                    let hair = &shapes.vertices[range][..uncut];
                    thin::thin(threshold, hair, &mut shapes.tangents, &mut shapes.kept);
                }
            }
            shapes.kept_starts.push(shapes.kept.len() as u32);
        }
        clock.stop(Stage::Thin, started);
    }
}
