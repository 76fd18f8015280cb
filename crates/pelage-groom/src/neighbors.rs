//! Which guides of a group shape a hair, and how much each: the search, and the method
//! that a recipe asks for.
//!
//! Reads the rest pose alone. Total: every root of a group that has guides gets some,
//! and their weights sum to 1.

use crate::guide_set::GuideSet;
use crate::locator::Near;
use crate::recipe::{Facing, Interpolation, Method};
use crate::stages::facing::{self, Faced};
use crate::stages::weights::inverse_distance;
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
    guides: Vec<u32>,
    weights: Vec<f32>,
}

impl Neighbors {
    /// Guides with their weights, in the order in which they are to be summed.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (u32, f32)> {
        self.guides
            .iter()
            .copied()
            .zip(self.weights.iter().copied())
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

    /// How many guides a locator has to find for this.
    pub(crate) fn nearest(&self) -> usize {
        let enough = self.enough();
        match self.facing {
            None => enough,
            // Some point away and most lean, so that the nearest are not the first.
            Some(_) => enough.saturating_mul(4),
        }
    }

    /// How many guides have to be known to tell the weights.
    fn enough(&self) -> usize {
        match self.method {
            Method::Nearest => 1,
            _ => self.wanted.saturating_add(1),
        }
    }

    /// Finds the guides of a hair at `root` and their weights. `guides` has at least one
    /// guide.
    pub(crate) fn find(&self, guides: &GuideSet, root: &RootFrame, found: &mut Neighbors) {
        guides.locator.query(root.position, &mut found.near);
        if self.facing.is_some() {
            self.face(guides, root, found);
        }
        let Neighbors {
            near,
            faced,
            guides,
            weights,
        } = found;
        guides.clear();
        match self.facing {
            None => guides.extend(near.iter().map(|n| n.guide)),
            Some(_) => guides.extend(faced.iter().map(|f| f.guide)),
        }
        match (self.method, self.facing) {
            (Method::Nearest, _) => {
                weights.clear();
                weights.push(1.0);
            }
            (_, None) => inverse_distance(near, self.wanted, weights),
            (_, Some(exponent)) => facing::weigh(faced, self.wanted, exponent, weights),
        }
    }

    /// Fills `found.faced` with the guides of the smallest D (see
    /// [`facing`](crate::stages::facing)), from `found.near`, those nearest to the root.
    fn face(&self, guides: &GuideSet, root: &RootFrame, found: &mut Neighbors) {
        let Neighbors { near, faced, .. } = found;
        faced.clear();
        if let Some(alone) = at_the_root(guides, root, near) {
            faced.push(alone);
            return;
        }
        let enough = self.enough();
        let seen =
            |near: Near| Faced::new(near, guides.directions[near.guide as usize], root.normal);
        faced.extend(near.iter().filter_map(|&n| seen(n)));
        faced.sort_unstable_by(Faced::order);
        // D is at least d, so no guide beyond the last one found comes before these.
        let last = near.last().map_or(0.0, |n| n.square);
        let sure =
            near.len() == guides.len() || faced.get(enough - 1).is_some_and(|f| f.apart < last);
        if !sure {
            faced.clear();
            faced.extend(guides.all(root.position).filter_map(seen));
            if faced.len() > enough {
                faced.select_nth_unstable_by(enough, Faced::order);
                faced.truncate(enough);
            }
            faced.sort_unstable_by(Faced::order);
        }
        if faced.is_empty() {
            faced.extend(near.iter().map(|&n| Faced::by_distance(n)));
        }
        faced.truncate(enough);
    }
}

/// The guide that stands where the root does, if one does: one that faces it before one
/// that does not.
fn at_the_root(guides: &GuideSet, root: &RootFrame, near: &[Near]) -> Option<Faced> {
    let here = || near.iter().take_while(|n| n.square == 0.0);
    let faces = |n: &&Near| guides.directions[n.guide as usize].dot(root.normal) > 0.0;
    let found = here().find(faces).or_else(|| here().next())?;
    Some(Faced::by_distance(*found))
}

#[cfg(test)]
#[path = "neighbors_tests.rs"]
mod tests;
