//! One stage: clusters of candidates become roots, level by level.
//!
//! A level has a reach, and takes candidates until each is nearer than the reach to a
//! root. Tiles of clusters are coloured so that neighbours differ; those of one colour
//! then know nothing of each other and are visited at once. A visit to a tile first
//! learns what its neighbours took when they were visited last. Then its clusters take
//! what they can, one after the other, each the farthest first, and tell the others of
//! the tile. So what comes out is the same for any number of threads.

use super::cluster::{Cluster, Distances, Near, bits};
use super::ground::{Ground, Site};
use super::hierarchy::{Bounds, Boxes, Hierarchy};
use super::leaf::{LEAF, Leaf};
use super::pool::Found;
use fearless_simd::{Level, Simd, dispatch};
use pelage_curves::Vec3;
use rayon::prelude::*;
use std::ops::Range;

/// Clusters of a tile: a root is compared with all of them at once, and with all that
/// belongs to them they fit a core's own cache.
const TILE: usize = Boxes::MOST;

pub(crate) struct Stage<'a> {
    ground: &'a Ground<'a>,
    /// Colour by colour, and along the curve in each.
    tiles: Vec<Tile<'a>>,
    /// Where in `tiles` each colour is.
    colours: Vec<Range<usize>>,
    /// Which tiles are near each; both by their places along the curve.
    neighbours: Vec<Vec<usize>>,
    /// What each tile took when it was visited last; along the curve.
    fresh: Vec<Vec<Leaf>>,
    /// Levels so far.
    levels: usize,
}

/// A candidate taken: its number, and the level that took it.
pub(crate) type Taken = (u64, usize);

impl<'a> Stage<'a> {
    /// Candidates that may come within `reach` (squared) of each other.
    pub(crate) fn new(ground: &'a Ground<'a>, found: &'a [Found], reach: f32) -> Self {
        let clusters: Vec<&Cluster> = found.iter().flat_map(|f| &f.clusters).collect();
        let near: Vec<&Near> = found.iter().flat_map(|f| &f.near).collect();
        let tiles: Vec<Tile> = clusters
            .par_chunks(TILE)
            .zip(near.par_chunks(TILE))
            .enumerate()
            .map(|(place, (clusters, near))| Tile::new(place, clusters, near))
            .collect();
        let neighbours = neighbours(&tiles, reach);
        let (tiles, colours) = by_colour(tiles, &neighbours);
        Self {
            ground,
            fresh: vec![Vec::new(); tiles.len()],
            tiles,
            colours,
            neighbours,
            levels: 0,
        }
    }

    /// Takes candidates until each is within `reach` of a root, the next level's being
    /// `next`; returns how many.
    pub(crate) fn level(&mut self, reach: f32, next: f32) -> usize {
        let mut count = 0;
        let visit = Visit {
            normals: self.ground.normals(),
            level: self.levels,
            reach,
            next,
        };
        for colour in self.colours.clone() {
            let tiles = &mut self.tiles[colour];
            let (neighbours, fresh) = (&self.neighbours, &self.fresh);
            let visit = |tile: &mut Tile| {
                let around = neighbours[tile.place].iter().flat_map(|&n| &fresh[n]);
                dispatch!(Level::new(), simd => tile.visit(simd, around, &visit))
            };
            let taken: Vec<Vec<Leaf>> = tiles.par_iter_mut().map(visit).collect();
            for (tile, taken) in tiles.iter().zip(taken) {
                count += taken.iter().map(Leaf::len).sum::<usize>();
                self.fresh[tile.place] = taken;
            }
        }
        self.levels += 1;
        count
    }

    /// All candidates taken, by their numbers.
    pub(crate) fn taken(mut self) -> Vec<Taken> {
        self.tiles
            .par_iter_mut()
            .for_each(|tile| tile.taken.sort_unstable());
        self.tiles.sort_unstable_by_key(|tile| tile.place);
        let taken = |tile: Tile| tile.taken;
        self.tiles.into_iter().flat_map(taken).collect()
    }
}

/// What all visits of a level have in common.
struct Visit<'a> {
    normals: &'a [Vec3],
    level: usize,
    reach: f32,
    /// Of the next level.
    next: f32,
}

/// Clusters that follow each other.
struct Tile<'a> {
    /// Along the curve.
    place: usize,
    clusters: Vec<&'a Cluster>,
    near: Vec<Near>,
    /// No candidate of each cluster is farther.
    most: Vec<f32>,
    boxes: Boxes,
    bounds: Bounds,
    taken: Vec<Taken>,
}

impl<'a> Tile<'a> {
    fn new(place: usize, clusters: &[&'a Cluster], near: &[&Near]) -> Self {
        let bounds = || clusters.iter().map(|cluster| cluster.bounds);
        Self {
            place,
            clusters: clusters.to_vec(),
            near: near.iter().map(|near| **near).collect(),
            most: vec![f32::INFINITY; clusters.len()],
            boxes: Boxes::new(bounds()),
            bounds: Bounds::around(bounds()),
            taken: Vec::new(),
        }
    }

    /// Whether clusters of both may come within `reach` of each other.
    #[inline(always)]
    fn touches<S: Simd>(&self, simd: S, other: &Tile, reach: f32) -> bool {
        let near = |c: &&Cluster| other.boxes.near(simd, &c.bounds, [reach]) != [0];
        self.clusters.iter().any(near)
    }

    /// Learns of the roots around, takes what it can, and returns that.
    #[inline(always)]
    fn visit<'b, S: Simd>(
        &mut self,
        simd: S,
        around: impl Iterator<Item = &'b Leaf>,
        visit: &Visit,
    ) -> Vec<Leaf> {
        for leaf in around {
            for root in bits(leaf.near(simd, &self.bounds, visit.reach)) {
                let site = leaf.site(root % LEAF);
                let [near] = self.boxes.near(simd, &site.bounds(), [visit.reach]);
                self.tell(simd, near, &site, visit.normals);
            }
        }
        let mut taken = Vec::new();
        for cluster in 0..self.clusters.len() {
            if self.most[cluster] >= visit.reach {
                self.take(simd, cluster, visit, &mut taken);
            }
        }
        taken
    }

    /// Takes what is farther than the reach from a cluster, the farthest first.
    #[inline(always)]
    fn take<S: Simd>(&mut self, simd: S, index: usize, visit: &Visit, taken: &mut Vec<Leaf>) {
        let cluster = self.clusters[index];
        let mut near = Distances::load(simd, &self.near[index]);
        // Clusters before this one take nothing before the next level.
        let (own, before) = (1 << index, (1 << index) - 1);
        self.most[index] = loop {
            let most = near.most();
            if most < visit.reach {
                break most;
            }
            let lane = near.lane_of(most);
            let site = cluster.site(lane, visit.normals);
            cluster.push(&mut near, &site, visit.normals);
            near.take(lane);
            let reaches = [visit.reach, visit.next];
            let [now, next] = self.boxes.near(simd, &site.bounds(), reaches);
            let others = (now & !before | next & before) & !own;
            self.tell(simd, others, &site, visit.normals);
            self.taken.push((cluster.number(lane), visit.level));
            match taken.last_mut() {
                Some(leaf) if !leaf.is_full() => leaf.add(&site),
                _ => taken.push(Leaf::of(&site)),
            }
        };
        near.store(&mut self.near[index]);
    }

    /// Some clusters, a bit each, learn of a root at `site`.
    #[inline(always)]
    fn tell<S: Simd>(&mut self, simd: S, clusters: u64, site: &Site, normals: &[Vec3]) {
        for cluster in bits(clusters) {
            let mut near = Distances::load(simd, &self.near[cluster]);
            self.clusters[cluster].push(&mut near, site, normals);
            near.store(&mut self.near[cluster]);
        }
    }
}

/// Which tiles have clusters within `reach` of clusters of each.
fn neighbours(tiles: &[Tile], reach: f32) -> Vec<Vec<usize>> {
    let tree = Hierarchy::new(tiles.iter().map(|tile| tile.bounds));
    let around = |tile: &Tile| {
        let mut found = Vec::new();
        dispatch!(Level::new(), simd => tree.near(&tile.bounds, reach, |other| {
            if other != tile.place && tile.touches(simd, &tiles[other], reach) {
                found.push(other);
            }
        }));
        found
    };
    tiles.par_iter().map(around).collect()
}

/// Gives each tile the first colour that no neighbour before it has; returns the tiles
/// colour by colour, and where in that order each colour is.
fn by_colour<'a>(
    mut tiles: Vec<Tile<'a>>,
    neighbours: &[Vec<usize>],
) -> (Vec<Tile<'a>>, Vec<Range<usize>>) {
    let mut colour_of: Vec<usize> = Vec::with_capacity(tiles.len());
    let mut counts: Vec<usize> = Vec::new();
    for around in neighbours {
        let is_free = |colour: &usize| {
            let has = |n: &usize| colour_of.get(*n) == Some(colour);
            !around.iter().any(has)
        };
        let colour = (0..counts.len()).find(is_free).unwrap_or(counts.len());
        counts.resize(counts.len().max(colour + 1), 0);
        counts[colour] += 1;
        colour_of.push(colour);
    }
    // Keeps the order along the curve.
    tiles.sort_by_key(|tile| colour_of[tile.place]);
    let mut end = 0;
    let ends = counts.iter().map(|count| {
        end += count;
        end - count..end
    });
    (tiles, ends.collect())
}
