//! The candidates of a stage: one at random in each of many equal parts of the mass.

use super::Placed;
use super::cluster::{Cluster, Columns, Distances, Near, bits};
use super::ground::{Fractions, Ground, LANES, Milestone, Places, Site};
use super::hierarchy::{Bounds, Boxes, Hierarchy};
use super::keeper::Keeper;
use super::leaf::{LEAF, Leaf};
use crate::hash;
use crate::scramble::mix;
use fearless_simd::{Level, Simd, dispatch};
use rayon::prelude::*;
use std::ops::Range;

/// Candidates for each root that a stage wants. More of them leave smaller gaps: with 16
/// the smallest distance is 4 percent larger, at half as much time again.
const CANDIDATES: u64 = 8;

/// Candidates over which the density is averaged on rough ground: the share of one
/// root. So the roots follow what a map means where it changes from texel to texel,
/// faster than they can.
const SMOOTHED: u64 = 8;

/// Candidates drawn by one task, as many as a chunk of clusters comes from.
const CHUNK: u64 = 64 * LANES as u64;

/// Clusters drawn together, to look for the roots around them once.
const ROWS: usize = 4;

/// Candidates of so many clusters.
const BLOCK: u64 = (ROWS * LANES) as u64;

/// Clusters found by one task, and what is known of their candidates.
pub(crate) struct Found {
    pub clusters: Vec<Cluster>,
    pub near: Vec<Near>,
}

pub(crate) struct Pool<'a> {
    ground: &'a Ground<'a>,
    /// Mass of a candidate's part, of 2^64.
    step: u64,
    count: u64,
    key: u32,
    /// Of the candidates averaged over; 0 where the ground is not rough.
    closeness: Vec<f32>,
}

impl<'a> Pool<'a> {
    /// Candidates for `roots` roots.
    pub(crate) fn new(ground: &'a Ground<'a>, roots: u64, seed: u64) -> Self {
        let count = (roots * CANDIDATES).next_multiple_of(BLOCK);
        let step = ((1u128 << 64) / count as u128) as u64;
        let parts = count / SMOOTHED;
        let milestones: Vec<Milestone> = (0..=parts)
            .into_par_iter()
            .map(|k| ground.milestone((k * SMOOTHED).saturating_mul(step).min(u64::MAX - 1)))
            .collect();
        let mass = 1.0 / parts as f64;
        let average = |pair: &[Milestone]| pair[0].rough(&pair[1], mass).unwrap_or(0.0);
        let closeness = milestones.par_windows(2).map(average).collect();
        Self {
            ground,
            step,
            count,
            key: hash(seed ^ hash(count)) as u32,
            closeness,
        }
    }

    /// The fraction of the mass that candidate `number` is at.
    #[inline(always)]
    pub(crate) fn fraction(&self, number: u64) -> u64 {
        let at_random = mix(number as u32 ^ mix((number >> 32) as u32 ^ self.key)) as u64;
        let (high, low) = (self.step >> 32, self.step & 0xffff_ffff);
        number * self.step + high * at_random + ((low * at_random) >> 32)
    }

    /// The closeness in a part of the mass where the piece has its `own`.
    #[inline(always)]
    fn smoothed(&self, part: usize, own: f32) -> f32 {
        let average = self.closeness[part];
        if average > 0.0 { average } else { own }
    }

    #[inline(always)]
    fn draw<S: Simd>(&self, simd: S, first: u64, chunk: u64, places: &mut Places) -> Cluster {
        let number = |lane: usize| first + lane as u64;
        let fractions = Fractions::new(|lane| self.fraction(number(lane)));
        self.ground.places(&fractions, places);
        for lane in 0..LANES {
            let part = (number(lane) / SMOOTHED) as usize;
            places.closeness[lane] = self.smoothed(part, places.closeness[lane]);
        }
        let mut columns = Columns {
            x: *front(&places.x),
            y: *front(&places.y),
            z: *front(&places.z),
            closeness: *front(&places.closeness),
            triangle: *front(&places.triangle),
            offset: [0; LANES],
        };
        for (lane, offset) in columns.offset.iter_mut().enumerate() {
            *offset = (number(lane) - chunk) as u16;
        }
        Cluster::new(simd, columns, chunk, self.ground)
    }

    /// What candidates see of a root.
    fn site(&self, root: &Placed) -> Site {
        let part = (root.fraction / (self.step * SMOOTHED)) as usize;
        let own = self.ground.closeness(root.root.piece);
        Site {
            position: root.position,
            closeness: self.smoothed(part.min(self.closeness.len() - 1), own),
            normal: self.ground.normals()[root.root.triangle as usize],
        }
    }

    /// Clusters, along the curve, of the candidates that are `floor` (squared) away from
    /// all `roots`, which follow the curve, with their distances from the nearest of those within `reach`.
    pub(crate) fn clusters(&self, roots: &[Placed], reach: f32, floor: f32) -> Vec<Found> {
        let taken = Taken::new(self, roots);
        (0..self.count.div_ceil(CHUNK))
            .into_par_iter()
            .map(|chunk| {
                let numbers = chunk * CHUNK..((chunk + 1) * CHUNK).min(self.count);
                // About a quarter is kept.
                let mut found = Found {
                    clusters: Vec::with_capacity(LANES / 2),
                    near: Vec::with_capacity(LANES / 2),
                };
                dispatch!(Level::new(), simd => {
                    self.chunk(simd, numbers, &taken, reach, floor, &mut found)
                });
                found
            })
            .collect()
    }

    #[inline(always)]
    fn chunk<S: Simd>(
        &self,
        simd: S,
        numbers: Range<u64>,
        taken: &Taken,
        reach: f32,
        floor: f32,
        found: &mut Found,
    ) {
        let chunk = numbers.start;
        let mut kept = Keeper::new(chunk);
        let mut groups = Vec::new();
        let mut places = Places::new();
        let mut drawn = Vec::with_capacity(ROWS);
        for first in numbers.step_by(BLOCK as usize) {
            drawn.clear();
            for row in 0..ROWS {
                drawn.push(self.draw(simd, first + (row * LANES) as u64, chunk, &mut places));
            }
            let bounds = Bounds::around(drawn.iter().map(|cluster: &Cluster| cluster.bounds));
            taken.groups(&bounds, reach, &mut groups);
            for drawn in &drawn {
                let mut near = Distances::all(simd, f32::INFINITY);
                for &group in &groups {
                    for leaf in taken.near(simd, group, &drawn.bounds, reach) {
                        drawn.learn(&mut near, leaf, reach, self.ground.normals());
                    }
                }
                kept.keep(drawn, &near, floor, self.ground, found);
            }
        }
        kept.flush(simd, self.ground, found);
    }
}

/// As many lanes as a cluster has.
#[inline(always)]
fn front<T>(lanes: &[T]) -> &[T; LANES] {
    // Rows are written whole, so there are more.
    lanes.first_chunk().expect("more lanes than a cluster has")
}

/// The roots of earlier stages.
struct Taken {
    leaves: Vec<Leaf>,
    /// Of the leaves, in the same order.
    boxes: Vec<Boxes>,
    /// Of the boxes.
    tree: Hierarchy,
}

impl Taken {
    /// Of roots along the curve.
    fn new(pool: &Pool, roots: &[Placed]) -> Self {
        let leaf = |roots: &[Placed]| {
            let mut leaf = Leaf::EMPTY;
            roots.iter().for_each(|root| leaf.add(&pool.site(root)));
            leaf
        };
        let leaves: Vec<Leaf> = roots.par_chunks(LEAF).map(leaf).collect();
        let bounds: Vec<Bounds> = leaves.iter().map(Leaf::bounds).collect();
        let groups = bounds.chunks(Boxes::MOST);
        Self {
            tree: Hierarchy::new(groups.clone().map(|g| Bounds::around(g.iter().copied()))),
            boxes: groups.map(|g| Boxes::new(g.iter().copied())).collect(),
            leaves,
        }
    }

    /// Finds the groups of leaves that may be within `reach` of `bounds`.
    #[inline(always)]
    fn groups(&self, bounds: &Bounds, reach: f32, groups: &mut Vec<usize>) {
        groups.clear();
        self.tree.near(bounds, reach, |group| groups.push(group));
    }

    /// Those leaves of `group` that may be within `reach` of `bounds`.
    #[inline(always)]
    fn near<S: Simd>(
        &self,
        simd: S,
        group: usize,
        bounds: &Bounds,
        reach: f32,
    ) -> impl Iterator<Item = &Leaf> {
        let [near] = self.boxes[group].near(simd, bounds, [reach]);
        bits(near).map(move |leaf| &self.leaves[group * Boxes::MOST + leaf])
    }
}
