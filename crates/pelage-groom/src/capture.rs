//! What a chunk of hairs takes from the rest pose, once for all frames.
//!
//! Depends on the plan and the hairs' indices alone (architecture.md, laws 1 and 4).

use crate::clock::{Clock, Stage};
use crate::color::ColorMix;
use crate::columns::Columns;
use crate::lanes::LANES;
use crate::locator::Near;
use crate::looks::LookScratch;
use crate::neighbors::Neighbors;
use crate::noise_fields::NoiseRows;
use crate::order::Parts;
use crate::plan::Plan;
use crate::stages::clump::Member;
use crate::stages::flyaway::Stray;
use crate::stages::frizz::FrizzRows;
use crate::stages::look::Look;
use crate::stages::roots::{self, Root};
use crate::stages::strand::{Bundle, Fiber};
use crate::stages::weights::Share;
use pelage_curves::Vec2;
use pelage_surface::{AlongSurface, RootFrame, SurfacePoint};
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
    /// The colours of each hair, hair by hair: see
    /// [`ColorProfile::pieces`](crate::color_profile::ColorProfile::pieces).
    pub(crate) mixes: Vec<ColorMix>,
    /// Block by block; empty where the recipe has none.
    pub(crate) frizz: Vec<FrizzRows>,
    /// Block by block; empty where the recipe has none.
    pub(crate) kinks: Vec<NoiseRows>,
    /// Empty where hairs are single.
    pub(crate) bundles: Vec<Bundle>,
    /// Those of a hair follow one another. Empty where hairs are single.
    pub(crate) fibers: Vec<Fiber>,
    /// Empty where no hair strays.
    pub(crate) strays: Vec<Stray>,
    /// One for each hair, level of clumps by level.
    pub(crate) members: Vec<Member>,
    pub(crate) near: Vec<Near>,
    pub(crate) dropped: Dropped,
    hairs: Vec<u64>,
    places: Vec<SurfacePoint>,
    pub(crate) uvs: Vec<Vec2>,
    pub(crate) columns: Columns,
    look_scratch: LookScratch,
    pub(crate) neighbors: Neighbors,
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

    /// Number of hairs that were to be captured, with those left out.
    pub fn asked(&self) -> u64 {
        self.hairs.len() as u64
    }

    /// Hairs left out, and why.
    pub fn dropped(&self) -> Dropped {
        self.dropped
    }
}

/// What is captured.
#[derive(Clone, Copy)]
pub(crate) enum Kind {
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

    /// Captures part `number` of the hairs `along` the surface, which are roots of this plan's.
    /// Otherwise as [`capture`](Self::capture).
    pub fn capture_along(
        &self,
        along: &AlongSurface,
        number: u64,
        capture: &mut Capture,
        clock: &mut Clock,
    ) {
        self.capture_placed(Kind::Hairs, capture, clock, |all, places| {
            along.part(number, all, places);
        });
        self.capture_hairs(capture, clock);
    }

    /// Captures chunk `number` of `parts`.
    pub(crate) fn capture_part(
        &self,
        parts: &Parts,
        number: u64,
        capture: &mut Capture,
        clock: &mut Clock,
    ) {
        self.capture_placed(Kind::Hairs, capture, clock, |all, places| {
            parts.list(&self.roots, number, all, places);
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
        let Capture {
            hairs,
            places,
            roots,
            frames,
            ..
        } = capture;
        roots::roots((hairs, places), (rest, groups), roots, frames);
        capture.dropped = Dropped::default();
        let started = clock.stop(Stage::Roots, started);
        self.weigh(kind, capture);
        let started = clock.stop(Stage::Weights, started);
        self.read_bends(capture);
        clock.stop(Stage::Maps, started);
    }

    /// Reads the properties that bend hairs.
    fn read_bends(&self, capture: &mut Capture) {
        let Capture {
            roots,
            uvs,
            columns,
            frizz,
            kinks,
            ..
        } = capture;
        list_uvs(roots, uvs);
        frizz.clear();
        if let Some(fields) = &self.fields.frizz {
            let blocks = roots.chunks(LANES).zip(columns.rows(fields.fields(), uvs));
            frizz.extend(blocks.map(|(roots, values)| fields.rows(roots, values)));
        }
        kinks.clear();
        if let Some(fields) = &self.fields.kink {
            kinks.extend(columns.rows(fields.fields(), uvs).map(NoiseRows::new));
        }
    }

    /// What the hairs in the middles of clumps lack: straying, fibres, looks and clumps of
    /// all levels.
    fn capture_hairs(&self, capture: &mut Capture, clock: &mut Clock) {
        let started = clock.start();
        let Capture {
            roots,
            uvs,
            columns,
            strays,
            bundles,
            fibers,
            looks,
            mixes,
            look_scratch,
            ..
        } = capture;
        strays.clear();
        if let Some(fields) = &self.fields.flyaway {
            let hairs = roots.iter().zip(columns.read(fields.fields(), uvs));
            strays.extend(hairs.map(|(root, values)| Stray::new(values, self.seed, root.hair)));
        }
        bundles.clear();
        fibers.clear();
        if let Some(fields) = &self.fields.strand {
            bundles.extend(columns.read(fields.fields(), uvs).map(Bundle::new));
            for (root, bundle) in roots.iter().zip(&*bundles) {
                let all = 0..fields.fibers;
                fibers.extend(all.map(|fiber| bundle.fiber(self.seed, root.hair, fiber)));
            }
        }
        looks.clear();
        let fields = &self.fields;
        fields.read_looks(roots, uvs, self.seed, look_scratch, (looks, mixes));
        let started = clock.stop(Stage::Maps, started);
        self.clump(capture);
        clock.stop(Stage::Clump, started);
    }
}

/// Writes the texture coordinates of `roots` to `uvs`, which is emptied first.
pub(crate) fn list_uvs(roots: &[Root], uvs: &mut Vec<Vec2>) {
    uvs.clear();
    uvs.extend(roots.iter().map(|root| root.uv));
}
