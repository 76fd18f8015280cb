//! Which guides shape each hair of a capture, and how much each; how long hairs are; and which
//! are left out.

use crate::capture::{Capture, Kind, list_uvs};
use crate::guide_set::GuideSet;
use crate::lanes::{Frames, LANES};
use crate::plan::Plan;
use crate::shared_lists::{Choice, MOST, ShareRows};
use crate::stages::scale;
use crate::stages::weights::{Share, turn};
use fearless_simd::{Level, Simd, dispatch};

/// Hairs whose candidates are fetched together: their lists (200 bytes each) stay in the
/// first-level cache.
const FETCHED: usize = 64;

/// Most lists among which hairs side by side choose; with more, one by one is faster.
const FEW: usize = 4;

/// Where a hair's guides are looked for; `None` where it has none, or is cut off.
type List<'a> = Option<(&'a GuideSet, [u32; 2])>;

impl Plan {
    /// Finds guides, weights and scale, and drops hairs that have no length.
    pub(crate) fn weigh(&self, kind: Kind, capture: &mut Capture) {
        self.read_lengths(kind, capture);
        capture.lengths.clear();
        capture.shares.clear();
        capture.share_starts.clear();
        capture.share_starts.push(0);
        dispatch!(Level::new(), simd => self.weigh_with(simd, capture));
        let kept = capture.lengths.len();
        capture.roots.truncate(kept);
        capture.frames.truncate(kept);
        capture.scale.truncate(kept);
        capture.cuts.truncate(kept);
    }

    #[inline(always)]
    fn weigh_with<S: Simd>(&self, simd: S, capture: &mut Capture) {
        let (mut choices, mut rows) = (Vec::with_capacity(FEW), ShareRows::default());
        let (mut frames, mut lists) = (Vec::new(), Vec::new());
        for first in (0..capture.roots.len()).step_by(FETCHED) {
            let end = capture.roots.len().min(first + FETCHED);
            frames.clear();
            frames.extend(capture.frames[first..end].chunks(LANES).map(Frames::of));
            lists.clear();
            for (row, frames) in frames.iter().enumerate() {
                lists.push(self.lists(simd, capture, first + row * LANES, frames));
            }
            fetch(&lists);
            for (row, (lists, frames)) in lists.iter().zip(&frames).enumerate() {
                let together = self.side_by_side(lists, &mut choices);
                if let Some(nearest) = together {
                    rows.find(simd, &choices, frames, [nearest, self.sharing.wanted()]);
                }
                let hairs = first + row * LANES..end;
                for (lane, (hair, list)) in hairs.zip(lists).enumerate() {
                    let Some((guides, _)) = list else {
                        capture.leave_out(hair);
                        continue;
                    };
                    let length = match together {
                        Some(nearest) => rows.append(lane, nearest, &mut capture.shares),
                        None => self.weigh_one(simd, capture, hair, guides),
                    };
                    capture.keep(hair, length);
                }
            }
        }
    }

    /// The lists of hairs side by side at `frames`, from number `first` on.
    #[inline(always)]
    fn lists<S: Simd>(
        &self,
        simd: S,
        capture: &Capture,
        first: usize,
        frames: &Frames,
    ) -> [List<'_>; LANES] {
        let mut all = [None; LANES];
        for (group, guides) in self.guides.iter().enumerate() {
            let lists = guides.locator.lists(simd, frames.position.load(simd));
            let roots = capture.roots[first..].iter().take(LANES);
            for (lane, (root, list)) in roots.zip(lists).enumerate() {
                let has = root.group as usize == group && !guides.is_empty();
                if has && capture.cut(first + lane) > 0.0 {
                    all[lane] = Some((guides, list));
                }
            }
        }
        all
    }

    /// Lists the `choices` of hairs side by side; gives the number of guides that each chooses
    /// from, or `None` where it is better to go one by one.
    #[inline(always)]
    fn side_by_side<'a>(&self, lists: &[List<'a>], choices: &mut Vec<Choice<'a>>) -> Option<usize> {
        choices.clear();
        for (lane, list) in lists.iter().enumerate() {
            let Some((guides, list)) = *list else {
                continue;
            };
            let same = |other: &Choice| list == other.list && std::ptr::eq(guides, other.guides);
            match choices.iter().position(same) {
                Some(known) => choices[known].lanes |= 1 << lane,
                None if choices.len() == FEW => return None,
                None => choices.push(Choice {
                    guides,
                    list,
                    lanes: 1 << lane,
                }),
            }
        }
        let mut nearest = choices.iter().map(|choice| choice.guides.locator.nearest());
        let first = nearest.next()?;
        let can = self.sharing.is_by_distance() && (2..=MOST).contains(&first);
        (can && nearest.all(|other| other == first)).then_some(first)
    }

    /// Finds the shares of one hair; gives the mean of the guides' lengths.
    #[inline(always)]
    fn weigh_one<S: Simd>(
        &self,
        simd: S,
        capture: &mut Capture,
        hair: usize,
        guides: &GuideSet,
    ) -> f32 {
        let frame = &capture.frames[hair];
        self.sharing
            .find(simd, guides, frame, &mut capture.neighbors);
        let mut length = 0.0;
        for (guide, weight) in capture.neighbors.iter() {
            if weight > 0.0 {
                let [c, s] = turn(simd, &guides.frames[guide as usize], frame);
                capture.shares.push(Share {
                    guide,
                    weight,
                    cosine: weight * c,
                    sine: weight * s,
                });
                length += weight * guides.lengths[guide as usize];
            }
        }
        length
    }

    /// Reads how long hairs are compared with their guides, and what part of them stays.
    fn read_lengths(&self, kind: Kind, capture: &mut Capture) {
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
        scale.extend(factors.map(|([amount, random], root)| match kind {
            Kind::Hairs => scale::factor(amount, random, self.seed, root.hair),
            Kind::Middles => amount.max(0.0),
        }));
        cuts.clear();
        if let (Kind::Hairs, Some(field)) = (kind, &f.cut) {
            field.read(uvs, cuts);
            cuts.iter_mut().for_each(|cut| *cut = cut.clamp(0.0, 1.0));
        }
    }
}

impl Capture {
    /// Keeps `hair` behind those that were kept before, if it has any length; `length` is that
    /// of its guides.
    #[inline(always)]
    fn keep(&mut self, hair: usize, length: f32) {
        let factor = self.scale[hair];
        // A NaN has no length either.
        let has_length = length * factor > 0.0;
        if !has_length {
            let start = self.share_starts.last().map_or(0, |&start| start as usize);
            self.shares.truncate(start);
            self.dropped.without_length += 1;
            return;
        }
        let kept = self.lengths.len();
        if kept < hair {
            self.roots[kept] = self.roots[hair];
            self.frames[kept] = self.frames[hair];
            self.scale[kept] = factor;
            if let Some(&cut) = self.cuts.get(hair) {
                self.cuts[kept] = cut;
            }
        }
        self.lengths.push(length * factor);
        self.share_starts.push(self.shares.len() as u32);
    }

    /// Leaves out `hair`, which is cut off or has no guides.
    fn leave_out(&mut self, hair: usize) {
        match self.cut(hair) == 0.0 {
            true => self.dropped.cut += 1,
            false => self.dropped.without_guides += 1,
        }
    }
}

/// Brings the lists into the cache. They may lie far apart, and a search is full of decisions, so
/// that memory would be waited for list by list; here many are waited for at once.
#[inline(always)]
fn fetch(lists: &[[List; LANES]]) {
    let lists = lists.iter().flatten().flatten();
    let read = lists.fold(0, |read, (guides, list)| read ^ guides.locator.peek(*list));
    std::hint::black_box(read);
}
