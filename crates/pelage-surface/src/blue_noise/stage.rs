//! One stage: clusters of candidates become roots, level by level.
//!
//! A level has a reach, and takes candidates until each is nearer than the reach to a
//! root. Tiles of clusters are coloured so that neighbours differ; those of one colour
//! then know nothing of each other and are visited at once, each by one thread that
//! goes along the curve, where what it needs is near in memory too. A visit to a cluster
//! first learns what the neighbours took when they were visited last, then takes what it
//! can, the farthest first. So what comes out is the same for any number of threads.

use super::cluster::{Cluster, Distances, Near};
use super::ground::{Ground, Site};
use super::hierarchy::Hierarchy;
use super::leaf::Leaf;
use super::pool::Found;
use fearless_simd::{Level, Simd, dispatch};
use rayon::prelude::*;
use std::ops::Range;

/// Clusters of a tile: with all that belongs to them they fit a core's own cache.
const TILE: usize = 64;

pub(crate) struct Stage<'a> {
    ground: &'a Ground<'a>,
    clusters: Vec<&'a Cluster>,
    neighbours: Neighbours,
    /// Tiles, colour by colour.
    order: Vec<u32>,
    /// Where in `order` each colour is.
    colours: Vec<Range<usize>>,
    /// Of the clusters of each tile in `order`.
    near: Vec<Vec<Near>>,
    roots: Vec<Root>,
    /// Which of the roots each cluster took when it was visited last.
    fresh: Vec<Range<u32>>,
}

/// A candidate taken.
#[derive(Clone, Copy)]
struct Root {
    site: Site,
    number: u64,
}

impl<'a> Stage<'a> {
    /// Candidates that may come within `reach` (squared) of each other.
    pub(crate) fn new(ground: &'a Ground<'a>, found: &'a [Found], reach: f32) -> Self {
        let clusters: Vec<&Cluster> = found.iter().flat_map(|f| &f.clusters).collect();
        let near: Vec<&Near> = found.iter().flat_map(|f| &f.near).collect();
        let neighbours = Neighbours::new(&clusters, reach);
        let (order, colours) = coloured(&neighbours.of_tiles());
        let tile = |&tile: &u32| {
            near[clusters_of(tile, near.len())]
                .iter()
                .map(|n| **n)
                .collect()
        };
        Self {
            ground,
            neighbours,
            near: order.par_iter().map(tile).collect(),
            order,
            colours,
            roots: Vec::new(),
            fresh: vec![0..0; clusters.len()],
            clusters,
        }
    }

    /// Takes candidates until each is within `reach`; returns their numbers, ascending.
    pub(crate) fn level(&mut self, reach: f32) -> Vec<u64> {
        for colour in self.colours.clone() {
            let order = &self.order[colour.clone()];
            let mut near = std::mem::take(&mut self.near);
            let tasks = near[colour].par_iter_mut().zip(order);
            let taken: Vec<_> = tasks
                .map(|(near, tile)| self.tile(near, *tile, reach))
                .collect();
            self.near = near;
            for (tile, &number) in taken.into_iter().zip(order) {
                let shift = self.roots.len() as u32 - tile.base;
                self.roots.extend(tile.roots);
                let fresh = &mut self.fresh[clusters_of(number, self.clusters.len())];
                for (fresh, found) in fresh.iter_mut().zip(tile.fresh) {
                    *fresh = found.start + shift..found.end + shift;
                }
            }
        }
        self.fresh_numbers()
    }

    /// Numbers of what was taken last, ascending.
    fn fresh_numbers(&self) -> Vec<u64> {
        let mut numbers = Vec::new();
        for fresh in &self.fresh {
            let before = numbers.len();
            numbers.extend(self.roots_of(fresh).iter().map(|root| root.number));
            numbers[before..].sort_unstable();
        }
        numbers
    }

    /// Visits the clusters of tile `number`.
    fn tile(&self, near: &mut [Near], number: u32, reach: f32) -> Tile {
        let clusters = clusters_of(number, self.clusters.len());
        let mut tile = Tile {
            start: clusters.start,
            fresh: self.fresh[clusters.clone()].to_vec(),
            base: self.roots.len() as u32,
            roots: Vec::new(),
        };
        dispatch!(Level::new(), simd => {
            for (near, cluster) in near.iter_mut().zip(clusters) {
                self.visit(simd, cluster, near, reach, &mut tile);
            }
        });
        tile
    }

    #[inline(always)]
    fn visit<S: Simd>(&self, simd: S, index: usize, near: &mut Near, reach: f32, tile: &mut Tile) {
        let before = tile.end();
        let mut distances = Distances::load(simd, near);
        self.learn(index, &mut distances, reach, tile);
        self.take(self.clusters[index], &mut distances, reach, tile);
        distances.store(near);
        tile.fresh[index - tile.start] = before..tile.end();
    }

    /// Learns what the neighbours took.
    #[inline(always)]
    fn learn<S: Simd>(&self, index: usize, near: &mut Distances<S>, reach: f32, tile: &Tile) {
        let (cluster, normals) = (self.clusters[index], self.ground.normals());
        let mut leaf = Leaf::EMPTY;
        for &neighbour in self.neighbours.of(index) {
            let inside = (neighbour as usize).wrapping_sub(tile.start);
            let roots = match tile.fresh.get(inside) {
                Some(fresh) if fresh.start >= tile.base => tile.roots_of(fresh),
                Some(fresh) => self.roots_of(fresh),
                None => self.roots_of(&self.fresh[neighbour as usize]),
            };
            for root in roots {
                leaf.add(&root.site);
                if leaf.is_full() {
                    cluster.learn(near, &leaf, reach, normals);
                    leaf.clear();
                }
            }
        }
        cluster.learn(near, &leaf, reach, normals);
    }

    /// Takes what is farther than `reach`, the farthest first.
    #[inline(always)]
    fn take<S: Simd>(
        &self,
        cluster: &Cluster,
        near: &mut Distances<S>,
        reach: f32,
        tile: &mut Tile,
    ) {
        let normals = self.ground.normals();
        loop {
            let most = near.most();
            if most < reach {
                return;
            }
            let lane = near.lane_of(most);
            let site = cluster.site(lane, normals);
            let number = cluster.number(lane);
            tile.roots.push(Root { site, number });
            cluster.push(near, &site, normals);
            near.take(lane);
        }
    }

    #[inline(always)]
    fn roots_of(&self, range: &Range<u32>) -> &[Root] {
        &self.roots[range.start as usize..range.end as usize]
    }

    /// Numbers of all candidates taken, ascending.
    pub(crate) fn taken(&self) -> Vec<u64> {
        let mut numbers: Vec<u64> = self.roots.iter().map(|root| root.number).collect();
        numbers.par_sort_unstable();
        numbers
    }
}

/// What a tile takes while it is visited.
struct Tile {
    /// The first cluster.
    start: usize,
    /// As of the stage; what was taken in this visit begins at `base`.
    fresh: Vec<Range<u32>>,
    base: u32,
    roots: Vec<Root>,
}

impl Tile {
    #[inline(always)]
    fn end(&self) -> u32 {
        self.base + self.roots.len() as u32
    }

    #[inline(always)]
    fn roots_of(&self, range: &Range<u32>) -> &[Root] {
        &self.roots[(range.start - self.base) as usize..(range.end - self.base) as usize]
    }
}

/// Clusters of tile `number`, of `count` in all.
fn clusters_of(number: u32, count: usize) -> Range<usize> {
    let start = number as usize * TILE;
    start..(start + TILE).min(count)
}

/// Which clusters are near each.
struct Neighbours {
    ends: Vec<usize>,
    list: Vec<u32>,
}

impl Neighbours {
    fn new(clusters: &[&Cluster], reach: f32) -> Self {
        let tree = Hierarchy::new(clusters.iter().map(|c| c.bounds));
        let tasks: Vec<(Vec<u32>, Vec<usize>)> = clusters
            .par_chunks(TILE)
            .enumerate()
            .map(|(task, clusters)| {
                let (mut list, mut counts) = (Vec::new(), Vec::new());
                for (k, cluster) in clusters.iter().enumerate() {
                    let before = list.len();
                    tree.near(&cluster.bounds, reach, |other| {
                        if other != task * TILE + k {
                            list.push(other as u32);
                        }
                    });
                    counts.push(list.len() - before);
                }
                (list, counts)
            })
            .collect();
        let mut end = 0;
        let counts = tasks.iter().flat_map(|(_, counts)| counts);
        Self {
            ends: counts
                .map(|count| {
                    end += count;
                    end
                })
                .collect(),
            list: tasks.iter().flat_map(|(list, _)| list).copied().collect(),
        }
    }

    #[inline(always)]
    fn of(&self, cluster: usize) -> &[u32] {
        let start = if cluster == 0 {
            0
        } else {
            self.ends[cluster - 1]
        };
        &self.list[start..self.ends[cluster]]
    }

    /// Which tiles are near each.
    fn of_tiles(&self) -> Self {
        let tiles = self.ends.len().div_ceil(TILE);
        let mut seen = vec![usize::MAX; tiles];
        let (mut ends, mut list) = (Vec::with_capacity(tiles), Vec::new());
        for tile in 0..tiles {
            seen[tile] = tile;
            for cluster in clusters_of(tile as u32, self.ends.len()) {
                for &other in self.of(cluster) {
                    let other = other as usize / TILE;
                    if seen[other] != tile {
                        seen[other] = tile;
                        list.push(other as u32);
                    }
                }
            }
            ends.push(list.len());
        }
        Self { ends, list }
    }

    fn len(&self) -> usize {
        self.ends.len()
    }
}

/// Gives each tile the first colour that no neighbour before it has; returns the tiles
/// colour by colour, and where in that order each colour is.
fn coloured(neighbours: &Neighbours) -> (Vec<u32>, Vec<Range<usize>>) {
    let mut colour_of: Vec<u32> = Vec::with_capacity(neighbours.len());
    let mut seen: Vec<usize> = Vec::new();
    let mut counts: Vec<usize> = Vec::new();
    for tile in 0..neighbours.len() {
        for &other in neighbours.of(tile) {
            if let Some(&colour) = colour_of.get(other as usize) {
                seen[colour as usize] = tile;
            }
        }
        let colour = seen.iter().position(|&by| by != tile);
        let colour = colour.unwrap_or_else(|| {
            seen.push(usize::MAX);
            counts.push(0);
            counts.len() - 1
        });
        counts[colour] += 1;
        colour_of.push(colour as u32);
    }
    let mut end = 0;
    let colours: Vec<Range<usize>> = counts
        .iter()
        .map(|count| {
            end += count;
            end - count..end
        })
        .collect();
    let mut next: Vec<usize> = colours.iter().map(|c| c.start).collect();
    let mut order = vec![0; neighbours.len()];
    for (tile, &colour) in colour_of.iter().enumerate() {
        order[next[colour as usize]] = tile as u32;
        next[colour as usize] += 1;
    }
    (order, colours)
}
