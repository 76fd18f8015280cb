//! What a chunk of hairs takes from the rest pose, once for all frames.
//!
//! Depends on the plan and the hairs' indices alone (architecture.md, laws 1 and 4).

use crate::clock::{Clock, Stage};
use crate::columns::Columns;
use crate::looks::LookScratch;
use crate::neighbors::Neighbors;
use crate::noise_fields::HairNoise;
use crate::plan::Plan;
use crate::stages::frizz::Frizz;
use crate::stages::look::Look;
use crate::stages::roots::{Root, root};
use crate::stages::scale;
use crate::stages::weights::{Share, turn};
use pelage_curves::Vec2;
use pelage_surface::{RootFrame, SurfacePoint};
use std::ops::Range;

/// Hairs whose guides are fetched together: their lists (200 bytes each) stay in the
/// first-level cache.
const FETCHED: usize = 64;

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
    dropped: Dropped,
    hairs: Vec<u64>,
    places: Vec<SurfacePoint>,
    uvs: Vec<Vec2>,
    columns: Columns,
    look_scratch: LookScratch,
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

    /// The part of hair number `i` that stays.
    pub(crate) fn cut(&self, i: usize) -> f32 {
        self.cuts.get(i).copied().unwrap_or(1.0)
    }

    /// Hairs left out, and why.
    pub fn dropped(&self) -> Dropped {
        self.dropped
    }
}

impl Plan {
    /// Captures `hairs` into `capture`, which is emptied first. Hairs that have no root
    /// (see [`RootPlan::rooted`](crate::RootPlan::rooted)) are left out.
    pub fn capture(&self, hairs: Range<u64>, capture: &mut Capture, clock: &mut Clock) {
        let hairs = self.roots.rooted(hairs);
        self.capture_placed(capture, clock, |all, places| {
            self.roots.places(hairs.clone(), places);
            all.extend(hairs);
        });
    }

    /// Captures the hairs listed, in that order: those of a voxel, say. Otherwise as
    /// [`capture`](Self::capture).
    pub fn capture_listed(&self, hairs: &[u64], capture: &mut Capture, clock: &mut Clock) {
        self.capture_placed(capture, clock, |all, places| {
            let rooted = hairs
                .iter()
                .filter_map(|&hair| Some((hair, self.roots.place(hair)?)));
            for (hair, place) in rooted {
                all.push(hair);
                places.push(place);
            }
        });
    }

    /// Captures the hairs that `place` appends, with their places.
    fn capture_placed(
        &self,
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
        self.weigh(capture);
        let started = clock.stop(Stage::Weights, started);
        self.read_maps(capture);
        clock.stop(Stage::Maps, started);
    }

    /// Reads the properties that bend and colour hairs.
    fn read_maps(&self, capture: &mut Capture) {
        let Capture {
            roots,
            uvs,
            columns,
            frizz,
            kinks,
            looks,
            look_scratch,
            ..
        } = capture;
        list_uvs(roots, uvs);
        frizz.clear();
        if let Some(fields) = &self.fields.frizz {
            let hairs = roots.iter().zip(columns.read(fields.fields(), uvs));
            frizz.extend(hairs.map(|(root, values)| fields.hair(root, values)));
        }
        kinks.clear();
        if let Some(fields) = &self.fields.kink {
            kinks.extend(columns.read(fields.fields(), uvs).map(HairNoise::new));
        }
        looks.clear();
        let fields = &self.fields;
        fields.read_looks(roots, uvs, self.seed, look_scratch, looks);
    }

    /// Reads how long hairs are compared with their guides, and what part of them stays.
    fn read_lengths(&self, capture: &mut Capture) {
        let Capture {
            roots,
            uvs,
            columns,
            scale,
            cuts,
            ..
        } = capture;
        list_uvs(roots, uvs);
        let f = &self.fields;
        let factors = columns.read([&f.scale, &f.scale_random], uvs).zip(&*roots);
        scale.clear();
        scale.extend(
            factors.map(|([amount, random], root)| {
                scale::factor(amount, random, self.seed, root.hair)
            }),
        );
        cuts.clear();
        if let Some(field) = &f.cut {
            field.read(uvs, cuts);
            cuts.iter_mut().for_each(|cut| *cut = cut.clamp(0.0, 1.0));
        }
    }

    /// Brings the guides near the hairs from `first` on into the cache.
    fn fetch_guides(&self, capture: &Capture, first: usize) {
        let hairs = first..capture.roots.len().min(first + FETCHED);
        for (group, guides) in self.guides.iter().enumerate() {
            let mine = hairs
                .clone()
                .filter(|&i| capture.roots[i].group as usize == group);
            guides
                .locator
                .fetch(mine.map(|i| capture.frames[i].position));
        }
    }

    /// Finds guides, weights and scale, and drops hairs that have no length.
    fn weigh(&self, capture: &mut Capture) {
        self.read_lengths(capture);
        capture.shares.clear();
        capture.share_starts.clear();
        capture.share_starts.push(0);
        let mut kept = 0;
        for i in 0..capture.roots.len() {
            if i % FETCHED == 0 {
                self.fetch_guides(capture, i);
            }
            let root = capture.roots[i];
            let factor = capture.scale[i];
            let cut = capture.cuts.get(i).copied();
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
            capture.scale[kept] = factor;
            if let Some(cut) = cut {
                capture.cuts[kept] = cut;
            }
            kept += 1;
            capture.share_starts.push(capture.shares.len() as u32);
        }
        capture.roots.truncate(kept);
        capture.frames.truncate(kept);
        capture.scale.truncate(kept);
        capture.cuts.truncate(kept);
    }
}

/// Writes the texture coordinates of `roots` to `uvs`, which is emptied first.
fn list_uvs(roots: &[Root], uvs: &mut Vec<Vec2>) {
    uvs.clear();
    uvs.extend(roots.iter().map(|root| root.uv));
}
