//! The shapes of the hairs of a chunk: from their guides to curves on the pose.

use crate::bundles::BundleScratch;
use crate::capture::Capture;
use crate::clock::{Clock, Stage};
use crate::curves::Curves;
use crate::plan::Plan;
use crate::stages::{cut, frizz, interpolate, kink, scale, thin, world};
use pelage_curves::Vec3;
use pelage_surface::RootFrame;

/// The curves of a chunk. Reused between chunks.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shapes {
    /// The hairs, in local space first, then on the pose; where hairs are multi-strands,
    /// at last their fibres. A curve that is cut ends before its last vertex.
    curves: Curves,
    /// For each curve, the numbers of its vertices that stay.
    kept: Vec<u32>,
    /// Where each curve's begin there; one more entry than curves.
    kept_starts: Vec<u32>,
    noise: [Vec<Vec3>; 3],
    bundles: BundleScratch,
    tangents: Vec<Vec3>,
}

impl Shapes {
    /// Where the vertices that stay start, curve by curve.
    pub(crate) fn offsets(&self) -> &[u32] {
        &self.kept_starts
    }

    /// Numbers of the vertices that stay of curve `i`.
    pub(crate) fn numbers(&self, i: usize) -> &[u32] {
        &self.kept[self.kept_starts[i] as usize..self.kept_starts[i + 1] as usize]
    }

    /// Appends the vertices that stay to `points`.
    pub(crate) fn write(&self, points: &mut Vec<[f32; 3]>) {
        for i in 0..self.curves.len() {
            let (all, numbers) = (self.curves.get(i), self.numbers(i));
            if numbers.len() == all.len() {
                points.extend_from_slice(bytemuck::cast_slice(all));
            } else {
                points.extend(numbers.iter().map(|&n| all[n as usize].to_array()));
            }
        }
    }
}

/// Where and when hairs are shaped.
#[derive(Clone, Copy)]
pub(crate) struct Moment<'a> {
    /// Frames of the roots where they differ from those at rest.
    pub posed: Option<&'a [RootFrame]>,
    /// In frames.
    pub time: f32,
}

impl Plan {
    /// Shapes the hairs of `capture`.
    ///
    /// Which vertices stay is decided by the shapes at rest, so that it is the same on all
    /// poses and at all times (architecture.md, law 4).
    pub(crate) fn shape(
        &self,
        capture: &Capture,
        moment: Moment,
        shapes: &mut Shapes,
        clock: &mut Clock,
    ) {
        let moves = self.fields.frizz.as_ref().is_some_and(|f| f.is_moving());
        let differs = moment.posed.is_some() || (moves && moment.time != 0.0);
        if self.thinning.is_some() && differs {
            let rest = Moment {
                posed: None,
                time: 0.0,
            };
            self.make(capture, rest, shapes, clock);
            self.choose(capture, shapes, clock);
            self.make(capture, moment, shapes, clock);
        } else {
            self.make(capture, moment, shapes, clock);
            self.choose(capture, shapes, clock);
        }
    }

    fn make(&self, capture: &Capture, moment: Moment, shapes: &mut Shapes, clock: &mut Clock) {
        let frames = moment.posed.unwrap_or(&capture.frames);
        self.bend(capture, moment.time, shapes, clock);
        let curves = &mut shapes.curves;
        let started = clock.start();
        for (i, frame) in frames.iter().enumerate() {
            world::to_world(frame, curves.get_mut(i));
        }
        let started = clock.stop(Stage::World, started);
        self.bundle(capture, frames, &mut shapes.bundles, curves);
        let started = clock.stop(Stage::Strand, started);
        let fibers = self.fibers();
        for i in 0..capture.cuts.len() * fibers {
            cut::cut(capture.cut(i / fibers), curves.get_mut(i));
        }
        clock.stop(Stage::Thin, started);
    }

    /// The stages of local space.
    fn bend(&self, capture: &Capture, time: f32, shapes: &mut Shapes, clock: &mut Clock) {
        let started = clock.start();
        self.interpolate(capture, &mut shapes.curves);
        let started = clock.stop(Stage::Interpolate, started);
        let (noise, Curves { vertices, starts }) = (&mut shapes.noise, &mut shapes.curves);
        let range = |i: usize| starts[i] as usize..starts[i + 1] as usize;
        if let Some(fields) = &self.fields.frizz {
            frizz::frizz(fields, &capture.frizz, time, range, vertices, noise);
        }
        let started = clock.stop(Stage::Frizz, started);
        if let Some(fields) = &self.fields.kink {
            let (hairs, frames) = (&capture.kinks, &capture.frames);
            kink::kink(fields, hairs, frames, range, vertices, noise);
        }
        clock.stop(Stage::Kink, started);
    }

    fn interpolate(&self, capture: &Capture, hairs: &mut Curves) {
        let segments = |group: u32| self.guides[group as usize].segments;
        hairs.lay_out(capture.roots.iter().map(|root| segments(root.group) + 1));
        for (i, root) in capture.roots.iter().enumerate() {
            let shares = capture.share_starts[i] as usize..capture.share_starts[i + 1] as usize;
            let hair = hairs.get_mut(i);
            let guides = &self.guides[root.group as usize].vertices;
            interpolate::interpolate(guides, &capture.shares[shares], hair);
            scale::scale(capture.scale[i], hair);
        }
    }

    fn choose(&self, capture: &Capture, shapes: &mut Shapes, clock: &mut Clock) {
        let started = clock.start();
        let fibers = self.fibers();
        shapes.kept.clear();
        shapes.kept_starts.clear();
        shapes.kept_starts.push(0);
        for i in 0..shapes.curves.len() {
            let curve = shapes.curves.get(i);
            let uncut = cut::kept(curve.len(), capture.cut(i / fibers));
            match self.thinning {
                None => shapes.kept.extend(0..uncut as u32),
                Some(threshold) => thin::thin(
                    threshold,
                    &curve[..uncut],
                    &mut shapes.tangents,
                    &mut shapes.kept,
                ),
            }
            shapes.kept_starts.push(shapes.kept.len() as u32);
        }
        clock.stop(Stage::Thin, started);
    }
}
