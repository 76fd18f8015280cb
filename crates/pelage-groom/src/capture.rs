//! What a chunk of hairs takes from the rest pose, once for all frames.
//!
//! Depends on the plan and the hairs' indices alone (architecture.md, laws 1 and 4).

use crate::clock::{Clock, Stage};
use crate::color::ColorMix;
use crate::locator::Near;
use crate::neighbors::Neighbors;
use crate::noise_fields::HairNoise;
use crate::plan::{Fields, Plan};
use crate::stages::clump::Member;
use crate::stages::flyaway::Stray;
use crate::stages::frizz::Frizz;
use crate::stages::look::Look;
use crate::stages::roots::{Root, root};
use crate::stages::scale;
use crate::stages::strand::{Bundle, Fiber};
use crate::stages::weights::{Share, turn};
use pelage_surface::{RootFrame, SurfacePoint};
use std::ops::Range;

/// Hairs that were left out, and why.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dropped {
    /// Their group has no guide.
    pub without_guides: u64,
    /// They have no length: the scale, or every guide they follow, is 0.
    pub without_length: u64,
    /// They are cut at the root.
    pub cut: u64,
}

impl Dropped {
    /// Adds the counts of another chunk.
    pub fn add(&mut self, other: &Dropped) {
        self.without_guides += other.without_guides;
        self.without_length += other.without_length;
        self.cut += other.cut;
    }

    /// All of them.
    pub fn total(&self) -> u64 {
        self.without_guides + self.without_length + self.cut
    }
}

/// The rest-pose part of a chunk of hairs, as arrays. Reused between chunks.
#[derive(Clone, Debug, Default)]
pub struct Capture {
    pub(crate) roots: Vec<Root>,
    /// Frame of each root at rest.
    pub(crate) frames: Vec<RootFrame>,
    pub(crate) scale: Vec<f32>,
    /// Lengths of the guides as they are mixed and scaled.
    pub(crate) lengths: Vec<f32>,
    /// The part of each hair that stays; empty where the recipe cuts none.
    pub(crate) cuts: Vec<f32>,
    /// Where each hair's shares start; one more entry than hairs.
    pub(crate) share_starts: Vec<u32>,
    pub(crate) shares: Vec<Share>,
    pub(crate) looks: Vec<Look>,
    /// Empty where the recipe has none.
    pub(crate) frizz: Vec<Frizz>,
    /// Empty where the recipe has none.
    pub(crate) kinks: Vec<HairNoise>,
    /// Empty where hairs are single.
    pub(crate) bundles: Vec<Bundle>,
    /// Those of a hair follow one another. Empty where hairs are single.
    pub(crate) fibers: Vec<Fiber>,
    /// Empty where no hair strays.
    pub(crate) strays: Vec<Stray>,
    /// One for each level of clumps, hair by hair.
    pub(crate) members: Vec<Member>,
    pub(crate) near: Vec<Near>,
    dropped: Dropped,
    hairs: Vec<u64>,
    places: Vec<SurfacePoint>,
    neighbors: Neighbors,
}

impl Capture {
    /// Number of hairs kept.
    pub fn len(&self) -> usize {
        self.roots.len()
    }

    /// Whether no hair was kept.
    pub fn is_empty(&self) -> bool {
        self.roots.is_empty()
    }

    /// The guides of hair number `i`.
    pub(crate) fn shares(&self, i: usize) -> &[Share] {
        &self.shares[self.share_starts[i] as usize..self.share_starts[i + 1] as usize]
    }

    /// The part of hair number `i` that stays.
    pub(crate) fn cut(&self, i: usize) -> f32 {
        self.cuts.get(i).copied().unwrap_or(1.0)
    }

    /// How much of hair number `i` stays with its clump.
    pub(crate) fn clumped(&self, i: usize) -> f32 {
        self.strays.get(i).map_or(1.0, |stray| stray.clumped)
    }

    /// Hairs left out, and why.
    pub fn dropped(&self) -> Dropped {
        self.dropped
    }
}

/// What is captured.
#[derive(Clone, Copy)]
enum Kind {
    Hairs,
    /// Those in the middles of clumps, which are whole and have nothing to do with chance.
    Middles,
}

impl Plan {
    /// Captures `hairs` into `capture`, which is emptied first. Hairs that have no root
    /// (see [`RootPlan::rooted`](crate::RootPlan::rooted)) are left out.
    pub fn capture(&self, hairs: Range<u64>, capture: &mut Capture, clock: &mut Clock) {
        let hairs = self.roots.rooted(hairs);
        self.capture_placed(Kind::Hairs, capture, clock, |all, places| {
            self.roots.places(hairs.clone(), places);
            all.extend(hairs);
        });
        self.capture_hairs(capture, clock);
    }

    /// Captures the hairs in the middles of clumps at `places`, numbered in their order.
    pub(crate) fn capture_middles(&self, places: &[SurfacePoint], capture: &mut Capture) {
        let clock = &mut Clock::default();
        self.capture_placed(Kind::Middles, capture, clock, |all, found| {
            all.extend(0..places.len() as u64);
            found.extend(places);
        });
        self.clump(capture);
    }

    /// Captures the hairs listed, in that order: those of a voxel, say. Otherwise as
    /// [`capture`](Self::capture).
    pub fn capture_listed(&self, hairs: &[u64], capture: &mut Capture, clock: &mut Clock) {
        self.capture_placed(Kind::Hairs, capture, clock, |all, places| {
            let rooted = hairs
                .iter()
                .filter_map(|&hair| Some((hair, self.roots.place(hair)?)));
            for (hair, place) in rooted {
                all.push(hair);
                places.push(place);
            }
        });
        self.capture_hairs(capture, clock);
    }

    /// Captures the hairs that `place` appends, with their places.
    fn capture_placed(
        &self,
        kind: Kind,
        capture: &mut Capture,
        clock: &mut Clock,
        place: impl FnOnce(&mut Vec<u64>, &mut Vec<SurfacePoint>),
    ) {
        let started = clock.start();
        let (rest, groups) = (&self.roots.rest, &self.roots.groups);
        capture.hairs.clear();
        capture.places.clear();
        place(&mut capture.hairs, &mut capture.places);
        let hairs = capture.hairs.iter().zip(&capture.places);
        capture.roots.clear();
        capture
            .roots
            .extend(hairs.map(|(&hair, &place)| root(hair, place, rest, groups)));
        // By itself, so that the loads of many triangles overlap.
        let frames = capture.places.iter().map(|place| rest.frame(place));
        capture.frames.clear();
        capture.frames.extend(frames);
        capture.dropped = Dropped::default();
        let started = clock.stop(Stage::Roots, started);
        self.weigh(kind, capture);
        let started = clock.stop(Stage::Weights, started);
        let Fields { frizz, kink, .. } = &self.fields;
        capture.frizz.clear();
        if let Some(fields) = frizz {
            let hairs = capture.roots.iter().map(|root| fields.at(root));
            capture.frizz.extend(hairs);
        }
        capture.kinks.clear();
        if let Some(fields) = kink {
            let hairs = capture.roots.iter().map(|root| fields.at(root.uv));
            capture.kinks.extend(hairs);
        }
        clock.stop(Stage::Maps, started);
    }

    /// What the hairs in the middles of clumps lack: straying, fibres, looks and clumps of
    /// all levels.
    fn capture_hairs(&self, capture: &mut Capture, clock: &mut Clock) {
        let started = clock.start();
        let Fields {
            flyaway, strand, ..
        } = &self.fields;
        capture.strays.clear();
        if let Some(fields) = flyaway {
            let stray = |root: &Root| fields.at(root.uv, self.seed, root.hair);
            capture.strays.extend(capture.roots.iter().map(stray));
        }
        capture.bundles.clear();
        capture.fibers.clear();
        if let Some(fields) = strand {
            let hairs = capture.roots.iter().map(|root| fields.at(root.uv));
            capture.bundles.extend(hairs);
            let bundles = capture.roots.iter().zip(&capture.bundles);
            let fibers = bundles.flat_map(|(root, bundle)| {
                (0..fields.fibers).map(|fiber| bundle.fiber(self.seed, root.hair, fiber))
            });
            capture.fibers.extend(fibers);
        }
        capture.looks.clear();
        capture
            .looks
            .extend(capture.roots.iter().map(|root| self.look(root)));
        let started = clock.stop(Stage::Maps, started);
        self.clump(capture);
        clock.stop(Stage::Clump, started);
    }

    /// Finds guides, weights and scale, and drops hairs that have no length.
    fn weigh(&self, kind: Kind, capture: &mut Capture) {
        capture.scale.clear();
        capture.lengths.clear();
        capture.cuts.clear();
        capture.shares.clear();
        capture.share_starts.clear();
        capture.share_starts.push(0);
        let mut kept = 0;
        for i in 0..capture.roots.len() {
            let root = capture.roots[i];
            let f = &self.fields;
            let amount = scale::amount(&f.scale, root.uv);
            let (factor, cut) = match kind {
                Kind::Middles => (amount, None),
                Kind::Hairs => (
                    amount * scale::random(&f.scale_random, root.uv, self.seed, root.hair),
                    f.cut.as_ref().map(|cut| cut.at(root.uv).clamp(0.0, 1.0)),
                ),
            };
            if cut == Some(0.0) {
                capture.dropped.cut += 1;
                continue;
            }
            let Some(guides) = self
                .guides
                .get(root.group as usize)
                .filter(|g| !g.is_empty())
            else {
                capture.dropped.without_guides += 1;
                continue;
            };
            let frame = capture.frames[i];
            self.sharing.find(guides, &frame, &mut capture.neighbors);
            let first = capture.shares.len();
            let mut length = 0.0;
            for (guide, weight) in capture.neighbors.iter() {
                if weight > 0.0 {
                    let (c, s) = turn(&guides.frames[guide as usize], &frame);
                    let (cosine, sine) = (weight * c, weight * s);
                    capture.shares.push(Share {
                        guide,
                        weight,
                        cosine,
                        sine,
                    });
                    length += weight * guides.lengths[guide as usize];
                }
            }
            // A NaN has no length either.
            let has_length = length * factor > 0.0;
            if !has_length {
                capture.shares.truncate(first);
                capture.dropped.without_length += 1;
                continue;
            }
            capture.roots[kept] = root;
            capture.frames[kept] = frame;
            kept += 1;
            capture.scale.push(factor);
            capture.lengths.push(length * factor);
            capture.cuts.extend(cut);
            capture.share_starts.push(capture.shares.len() as u32);
        }
        capture.roots.truncate(kept);
        capture.frames.truncate(kept);
    }

    fn look(&self, root: &Root) -> Look {
        let f = &self.fields;
        let common = [0, 1].map(|k| f.color[k].at(root.uv));
        let [from, to] = f.tint.apply(common, root.uv, self.seed, root.hair);
        Look {
            color: ColorMix::new(f.color_space, from, to),
            opacity: [0, 1].map(|k| f.opacity[k].at(root.uv).clamp(0.0, 1.0)),
            width: [0, 1].map(|k| f.width[k].at(root.uv).max(0.0)),
        }
    }
}
