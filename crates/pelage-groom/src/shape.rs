//! The shapes of the hairs of a chunk: from their guides to curves on the pose.

use crate::bundles::BundleScratch;
use crate::capture::Capture;
use crate::clock::{Clock, Stage};
use crate::curves::Curves;
use crate::plan::Plan;
use crate::pose::Moment;
use crate::stages::{cut, flyaway, frenet, frizz, kink, length, world};
use crate::stay::Stay;
use pelage_curves::Vec3;
use pelage_surface::RootFrame;

/// The curves of a chunk. Reused between chunks.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shapes {
    /// The hairs, in local space first, then on the pose; where hairs are multi-strands,
    /// at last their fibres. A curve that is cut ends before its last vertex.
    pub curves: Curves,
    /// Which vertices of each curve stay.
    pub stay: Stay,
    /// Frames of the roots at rest, where they are displaced.
    rest_frames: Vec<RootFrame>,
    /// The hairs as the guides at rest have them, where guides are posed.
    at_rest: Curves,
    /// Vertices as they were before a stage.
    before: Vec<Vec3>,
    noise: [Vec<Vec3>; 3],
    frenet: frenet::Scratch,
    bundles: BundleScratch,
}

impl Shapes {
    /// Appends the vertices that stay to `points`.
    pub(crate) fn write(&self, points: &mut Vec<[f32; 3]>) {
        let vertices = &self.curves.vertices;
        if self.stay.len() == vertices.len() {
            return points.extend_from_slice(bytemuck::cast_slice(vertices));
        }
        for i in 0..self.curves.len() {
            let (all, numbers) = (self.curves.get(i), self.stay.numbers(i));
            points.extend(numbers.iter().map(|&n| all[n as usize].to_array()));
        }
    }
}

impl Plan {
    /// Shapes the hairs of `capture`, whose roots have `frames` on the pose.
    ///
    /// Which vertices stay is decided by the shapes at rest, so that it is the same on all
    /// poses and at all times (architecture.md, law 4).
    pub(crate) fn shape(
        &self,
        capture: &Capture,
        frames: &[RootFrame],
        moment: &Moment,
        shapes: &mut Shapes,
        clock: &mut Clock,
    ) {
        let decided = self.thinning.is_some() && self.differs(moment);
        if decided {
            let rest = Moment {
                middles: &self.rest_middles,
                ..Moment::REST
            };
            let mut posed = std::mem::take(&mut shapes.rest_frames);
            let frames = self.frames(capture, &rest, &mut posed);
            self.make(capture, frames, &rest, shapes, clock);
            shapes.rest_frames = posed;
            self.choose(capture, &shapes.curves, &mut shapes.stay, clock);
        }
        self.make(capture, frames, moment, shapes, clock);
        if !decided {
            self.choose(capture, &shapes.curves, &mut shapes.stay, clock);
        }
    }

    /// All curves, as they are cut.
    fn make(
        &self,
        capture: &Capture,
        frames: &[RootFrame],
        moment: &Moment,
        shapes: &mut Shapes,
        clock: &mut Clock,
    ) {
        self.hairs(capture, frames, moment, shapes, clock);
        let started = clock.start();
        self.bundle(capture, frames, &mut shapes.bundles, &mut shapes.curves);
        let started = clock.stop(Stage::Strand, started);
        let fibers = self.fibers();
        for i in 0..capture.cuts.len() * fibers {
            cut::cut(capture.cut(i / fibers), shapes.curves.get_mut(i));
        }
        clock.stop(Stage::Thin, started);
    }

    /// The hairs on the pose, without fibres and uncut.
    pub(crate) fn hairs(
        &self,
        capture: &Capture,
        frames: &[RootFrame],
        moment: &Moment,
        shapes: &mut Shapes,
        clock: &mut Clock,
    ) {
        self.bend(capture, moment, shapes, clock);
        let (before, curves) = (&mut shapes.before, &mut shapes.curves);
        let started = clock.start();
        for (i, frame) in frames.iter().enumerate() {
            world::to_world(frame, curves.get_mut(i));
        }
        let started = clock.stop(Stage::World, started);
        self.draw_together(capture, moment.middles, before, curves);
        clock.stop(Stage::Clump, started);
    }

    /// The stages of local space.
    fn bend(&self, capture: &Capture, moment: &Moment, shapes: &mut Shapes, clock: &mut Clock) {
        let Shapes {
            curves,
            at_rest,
            before,
            noise,
            stay,
            frenet,
            ..
        } = shapes;
        let started = clock.start();
        self.mix(capture, moment.guides, frenet, curves);
        if moment.guides.is_some() {
            self.mix(capture, None, frenet, at_rest);
        }
        let rest = moment.guides.map_or(&*curves, |_| &*at_rest);
        self.find_degenerate(capture, rest, stay);
        let started = clock.stop(Stage::Interpolate, started);
        self.frizz(capture, moment.time, noise, before, curves);
        let started = clock.stop(Stage::Frizz, started);
        if let Some(fields) = &self.fields.kink {
            // Guides that move must not move hairs through the noise.
            let domain = moment.guides.map(|_| {
                self.frizz(capture, 0.0, noise, before, at_rest);
                &at_rest.vertices[..]
            });
            keep(self.fields.preserve.kink, before, curves, |curves| {
                let (hairs, frames) = (&capture.kinks, &capture.frames);
                let Curves { vertices, starts } = curves;
                let range = |i: usize| starts[i] as usize..starts[i + 1] as usize;
                kink::kink(fields, hairs, frames, range, domain, vertices, noise);
            });
        }
        let started = clock.stop(Stage::Kink, started);
        for (i, stray) in capture.strays.iter().enumerate() {
            flyaway::stray(stray, capture.lengths[i], curves.get_mut(i), before);
        }
        clock.stop(Stage::Flyaway, started);
    }

    fn frizz(
        &self,
        capture: &Capture,
        time: f32,
        noise: &mut [Vec<Vec3>; 3],
        before: &mut Vec<Vec3>,
        curves: &mut Curves,
    ) {
        let Some(fields) = &self.fields.frizz else {
            return;
        };
        keep(self.fields.preserve.frizz, before, curves, |curves| {
            let Curves { vertices, starts } = curves;
            let range = |i: usize| starts[i] as usize..starts[i + 1] as usize;
            frizz::frizz(fields, &capture.frizz, time, range, vertices, noise);
        });
    }
}

/// Bends curves; where their length is preserved, their segments get theirs back.
fn keep(
    preserved: bool,
    before: &mut Vec<Vec3>,
    curves: &mut Curves,
    bend: impl FnOnce(&mut Curves),
) {
    if preserved {
        before.clone_from(&curves.vertices);
    }
    bend(curves);
    if preserved {
        for i in 0..curves.len() {
            let range = curves.range(i);
            length::preserve(&before[range], 1.0, curves.get_mut(i));
        }
    }
}
