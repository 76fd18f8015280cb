//! Which guides of a group shape a hair, and how much each: the search, and the method
//! that a recipe asks for.
//!
//! Reads the rest pose alone. Total: every root of a group that has guides gets some,
//! and their weights sum to 1.

use crate::guide_set::GuideSet;
use crate::locator::Near;
use crate::recipe::{Facing, Interpolation, Method};
use crate::stages::facing::{self, Faced};
use crate::stages::natural::{self, Cell, Site};
use crate::stages::weights::inverse_distance;
use fearless_simd::Simd;
use pelage_surface::RootFrame;

/// How guides share a hair among them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sharing {
    method: Method,
    /// Guides that shape a hair.
    wanted: usize,
    /// Exponent of the distance where guides must face the root.
    facing: Option<f32>,
}

/// The guides of a hair with their weights. Reused between hairs.
#[derive(Clone, Debug, Default)]
pub(crate) struct Neighbors {
    near: Vec<Near>,
    faced: Vec<Faced>,
    sites: Vec<Site>,
    cell: Cell,
    guides: Vec<u32>,
    weights: Vec<f32>,
}

impl Neighbors {
    /// Guides with their weights, in the order in which they are to be summed.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (u32, f32)> {
        let guides = self.guides.iter().copied();
        guides.zip(self.weights.iter().copied())
    }

    /// One guide alone.
    fn one(&mut self, guide: Option<u32>) {
        self.guides.extend(guide);
        self.weights.clear();
        self.weights.push(1.0);
    }
}

impl Sharing {
    pub(crate) fn new(recipe: &Interpolation) -> Self {
        Self {
            method: recipe.method,
            wanted: recipe.guides as usize,
            facing: match recipe.facing {
                Facing::Off => None,
                Facing::On { exponent } => Some(exponent),
            },
        }
    }

    /// How many guides a locator has to find for this: mostly enough, so that all need
    /// not be looked at.
    pub(crate) fn nearest(&self) -> usize {
        match (self.method, self.facing) {
            (Method::NaturalNeighbor, None) => natural::ORDER,
            (Method::NaturalNeighbor, Some(_)) => 2 * natural::ORDER,
            (_, None) => self.enough(),
            // Some point away and most lean, so that the nearest are not the first.
            (_, Some(_)) => self.enough().saturating_mul(4),
        }
    }

    /// Whether distances alone say what guides weigh.
    pub(crate) fn is_by_distance(&self) -> bool {
        self.method == Method::InverseDistance && self.facing.is_none()
    }

    /// How many guides shape a hair.
    pub(crate) fn wanted(&self) -> usize {
        self.wanted
    }

    /// How many guides have to be known to tell weights by distance.
    fn enough(&self) -> usize {
        match self.method {
            Method::Nearest => 1,
            _ => self.wanted.saturating_add(1),
        }
    }

    /// Finds the guides of a hair at `root` and their weights. `guides` has at least one
    /// guide.
    #[inline(always)]
    pub(crate) fn find<S: Simd>(
        &self,
        simd: S,
        guides: &GuideSet,
        root: &RootFrame,
        found: &mut Neighbors,
    ) {
        guides.locator.query(root.position, &mut found.near);
        found.guides.clear();
        match (self.method, self.facing) {
            (Method::NaturalNeighbor, _) => self.natural(guides, root, found),
            (_, Some(exponent)) => self.faced(guides, root, exponent, found),
            (Method::Nearest, None) => found.one(found.near.first().map(|n| n.guide)),
            (Method::InverseDistance, None) => {
                found.guides.extend(found.near.iter().map(|n| n.guide));
                inverse_distance(simd, &found.near, self.wanted, &mut found.weights);
            }
        }
    }

    /// S · T_k of a guide, or 1 where guides need not face the root.
    fn facing(&self, guides: &GuideSet, root: &RootFrame, guide: u32) -> f32 {
        match self.facing {
            Some(_) => guides.directions[guide as usize].dot(root.normal),
            None => 1.0,
        }
    }

    /// The guide that stands where the root does, if one does: one that faces it before
    /// one that does not.
    fn at_the_root(&self, guides: &GuideSet, root: &RootFrame, near: &[Near]) -> Option<u32> {
        let here = || near.iter().take_while(|n| n.square == 0.0);
        let faces = |n: &&Near| self.facing(guides, root, n.guide) > 0.0;
        let found = here().find(faces).or_else(|| here().next());
        found.map(|n| n.guide)
    }

    /// The guides of the smallest D (see [`facing`](crate::stages::facing)).
    fn faced(&self, guides: &GuideSet, root: &RootFrame, exponent: f32, found: &mut Neighbors) {
        let alone = self.at_the_root(guides, root, &found.near);
        if alone.is_some() {
            return found.one(alone);
        }
        let (near, faced, enough) = (&found.near, &mut found.faced, self.enough());
        let seen = |near: Near| Faced::new(near, self.facing(guides, root, near.guide));
        faced.clear();
        faced.extend(near.iter().filter_map(|&n| seen(n)));
        faced.sort_unstable_by(Faced::order);
        // D is at least d, so no guide beyond the last one found comes before these.
        let last = near.last().map_or(0.0, |n| n.square);
        let before_last = faced.get(enough - 1).is_some_and(|f| f.apart < last);
        if near.len() < guides.len() && !before_last {
            faced.clear();
            faced.extend(guides.all(root.position).filter_map(seen));
            if faced.len() > enough {
                faced.select_nth_unstable_by(enough, Faced::order);
                faced.truncate(enough);
            }
            faced.sort_unstable_by(Faced::order);
        }
        if faced.is_empty() {
            faced.extend(near.iter().filter_map(|&n| Faced::new(n, 1.0)));
        }
        faced.truncate(enough);
        match self.method {
            Method::Nearest => found.one(found.faced.first().map(|f| f.guide)),
            _ => {
                found.guides.extend(faced.iter().map(|f| f.guide));
                facing::weigh(faced, self.wanted, exponent, &mut found.weights);
            }
        }
    }

    /// Sibson's weights (see [`natural`](crate::stages::natural)).
    fn natural(&self, guides: &GuideSet, root: &RootFrame, found: &mut Neighbors) {
        let alone = self.at_the_root(guides, root, &found.near);
        if alone.is_some() {
            return found.one(alone);
        }
        let Neighbors {
            near, sites, cell, ..
        } = found;
        let place = |near: &Near, recede| {
            let position = guides.frames[near.guide as usize].position;
            Site::new(near.guide, position, root, recede)
        };
        let seen = |near: &Near| {
            let facing = self.facing(guides, root, near.guide);
            place(near, facing::recede(facing))
        };
        let far = near.iter().take(natural::ORDER).next_back();
        let domain = natural::DOMAIN * far.map_or(0.0, |n| n.square as f64).sqrt();
        sites.clear();
        sites.extend(near.iter().filter_map(seen));
        let mut reach = cell.make(sites, domain);
        // A little less than the last, whose distance is rounded otherwise than a site's.
        let last = near.last().map_or(0.0, |n| n.square.sqrt()) as f64 * 0.9999;
        if near.len() < guides.len() && reach >= last {
            near.clear();
            let within = (reach * reach) as f32 * 1.001;
            near.extend(guides.all(root.position).filter(|n| n.square <= within));
            near.sort_unstable_by_key(Near::order);
            sites.clear();
            sites.extend(near.iter().filter_map(seen));
            reach = cell.make(sites, domain);
        }
        if sites.is_empty() {
            sites.extend(near.iter().filter_map(|n| place(n, 1.0)));
            reach = cell.make(sites, domain);
        }
        sites.truncate(sites.partition_point(|s| s.distance <= reach));
        cell.share(sites, &mut found.weights);
        found.guides.extend(sites.iter().map(|s| s.guide));
    }
}

#[cfg(test)]
#[path = "neighbors_tests.rs"]
mod tests;
