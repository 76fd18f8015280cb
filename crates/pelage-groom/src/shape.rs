//! The shapes of the hairs of a chunk: from their guides to curves on the pose.

use crate::blocks::Blocks;
use crate::bundles::BundleScratch;
use crate::capture::Capture;
use crate::clock::{Clock, Stage};
use crate::curves::Curves;
use crate::lanes::Frames;
use crate::mix::MixScratch;
use crate::plan::Plan;
use crate::pose::Moment;
use crate::stages::{cut, flyaway, frizz, kink, length, world};
use crate::stay::Stay;
use fearless_simd::{Level, dispatch};
use pelage_curves::Vec3;
use pelage_surface::RootFrame;

/// The curves of a chunk. Reused between chunks.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shapes {
    /// The hairs on the pose; where hairs are multi-strands, at last their fibres. A curve that is cut ends before its last vertex.
    pub curves: Curves,
    /// Which vertices of each curve stay.
    pub stay: Stay,
    /// Frames of the roots at rest, where they are displaced.
    rest_frames: Vec<RootFrame>,
    /// The hairs in local space.
    local: Blocks,
    /// Those as the guides at rest have them, where guides are posed.
    at_rest: Blocks,
    /// Hairs as they were before a stage.
    before: Blocks,
    hair: [Vec<Vec3>; 2],
    mixing: MixScratch,
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
        let Shapes {
            local,
            hair: [before, _],
            curves,
            ..
        } = shapes;
        let started = clock.start();
        dispatch!(Level::new(), simd => {
            for block in 0..local.blocks() {
                let frames = Frames::of(&frames[local.hairs(block)]);
                world::to_world(simd, &frames, local.block_mut(block));
            }
            local.unroll(simd, curves);
        });
        let started = clock.stop(Stage::World, started);
        self.draw_together(capture, moment.middles, before, curves);
        clock.stop(Stage::Clump, started);
    }

    /// The stages of local space.
    fn bend(&self, capture: &Capture, moment: &Moment, shapes: &mut Shapes, clock: &mut Clock) {
        let Shapes {
            local,
            at_rest,
            before,
            hair,
            stay,
            mixing,
            ..
        } = shapes;
        let started = clock.start();
        self.mix(capture, moment.guides, mixing, local);
        if moment.guides.is_some() {
            self.mix(capture, None, mixing, at_rest);
        }
        let rest = moment.guides.map_or(&*local, |_| &*at_rest);
        self.find_degenerate(capture, rest, stay);
        let started = clock.stop(Stage::Interpolate, started);
        self.frizz(capture, moment.time, before, hair, local);
        let started = clock.stop(Stage::Frizz, started);
        if let Some(fields) = &self.fields.kink {
            // Guides that move must not move hairs through the noise.
            let domain = moment.guides.map(|_| {
                self.frizz(capture, 0.0, before, hair, at_rest);
                &*at_rest
            });
            keep(self.fields.preserve.kink, before, hair, local, |hairs| {
                kink::kink(fields, &capture.kinks, &capture.frames, domain, hairs);
            });
        }
        let started = clock.stop(Stage::Kink, started);
        let strays = capture.strays.iter().zip(&capture.lengths).enumerate();
        for (i, (stray, length)) in strays.filter(|(_, (stray, _))| stray.strays()) {
            let [hair, before] = hair;
            local.read(i, hair);
            flyaway::stray(stray, *length, hair, before);
            local.write(i, hair);
        }
        clock.stop(Stage::Flyaway, started);
    }

    fn frizz(
        &self,
        capture: &Capture,
        time: f32,
        before: &mut Blocks,
        hair: &mut [Vec<Vec3>; 2],
        hairs: &mut Blocks,
    ) {
        let Some(fields) = &self.fields.frizz else {
            return;
        };
        keep(self.fields.preserve.frizz, before, hair, hairs, |hairs| {
            frizz::frizz(fields, &capture.frizz, time, hairs);
        });
    }
}

/// Bends hairs; where their length is preserved, their segments get theirs back.
fn keep(
    preserved: bool,
    before: &mut Blocks,
    [was, is]: &mut [Vec<Vec3>; 2],
    hairs: &mut Blocks,
    bend: impl FnOnce(&mut Blocks),
) {
    if preserved {
        before.clone_from(hairs);
    }
    bend(hairs);
    if preserved {
        for i in 0..hairs.len() {
            before.read(i, was);
            hairs.read(i, is);
            length::preserve(was, 1.0, is);
            hairs.write(i, is);
        }
    }
}
