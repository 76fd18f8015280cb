//! Boxes of things along a curve, to find those near a box.
//!
//! The things come in an order that keeps neighbours near, so a complete binary tree
//! over the order is as good as one that was built, and needs no links.

use pelage_curves::Vec3;

/// A box, and the least closeness of the places in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    pub low: Vec3,
    pub high: Vec3,
    pub least: f32,
}

impl Bounds {
    /// Holds nothing, and is far from everything.
    pub(crate) const EMPTY: Bounds = Bounds {
        low: Vec3::INFINITY,
        high: Vec3::NEG_INFINITY,
        least: f32::INFINITY,
    };

    /// The bounds of all.
    pub(crate) fn around(all: impl Iterator<Item = Bounds>) -> Self {
        all.fold(Self::EMPTY, |a, b| a.and(&b))
    }

    /// The bounds of both.
    pub(crate) fn and(&self, other: &Bounds) -> Bounds {
        Bounds {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            least: self.least.min(other.least),
        }
    }

    /// A lower bound of the squared distance between places of the two, scaled.
    #[inline(always)]
    pub(crate) fn gap(&self, other: &Bounds) -> f32 {
        let apart = (self.low - other.high).max(other.low - self.high);
        apart.max(Vec3::ZERO).length_squared() * (self.least * other.least)
    }
}

/// A complete binary tree: the children of node `i` are `2i` and `2i + 1`, the leaves
/// the last half.
pub(crate) struct Hierarchy {
    nodes: Vec<Bounds>,
}

impl Hierarchy {
    pub(crate) fn new(leaves: impl ExactSizeIterator<Item = Bounds>) -> Self {
        let first = leaves.len().next_power_of_two();
        let mut nodes = vec![Bounds::EMPTY; 2 * first];
        for (node, leaf) in nodes[first..].iter_mut().zip(leaves) {
            *node = leaf;
        }
        for i in (1..first).rev() {
            nodes[i] = nodes[2 * i].and(&nodes[2 * i + 1]);
        }
        Self { nodes }
    }

    #[inline(always)]
    pub(crate) fn leaf(&self, leaf: usize) -> &Bounds {
        &self.nodes[self.nodes.len() / 2 + leaf]
    }

    /// Calls `visit` with the leaves whose [gap](Bounds::gap) to `bounds` is less than
    /// `reach`, in ascending order.
    #[inline(always)]
    pub(crate) fn near(&self, bounds: &Bounds, reach: f32, mut visit: impl FnMut(usize)) {
        self.near_shrinking(bounds, reach, |leaf| {
            visit(leaf);
            reach
        });
    }

    /// The same where each visit gives the reach for what follows.
    #[inline(always)]
    pub(crate) fn near_shrinking(
        &self,
        bounds: &Bounds,
        mut reach: f32,
        mut visit: impl FnMut(usize) -> f32,
    ) {
        let first = self.nodes.len() / 2;
        let mut node = 1;
        loop {
            if self.nodes[node].gap(bounds) < reach {
                if node < first {
                    node *= 2;
                    continue;
                }
                reach = visit(node - first);
            }
            // Up from every right child, then to the right.
            node >>= node.trailing_ones();
            if node == 0 {
                return;
            }
            node += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn near_boxes_are_those_that_comparing_with_all_finds(
            places in prop::collection::vec((prop::array::uniform3(0f32..1.0), 0.5f32..2.0), 0..70),
            at in prop::array::uniform3(0f32..1.0), reach in 0f32..0.2,
        ) {
            let bounds = |&(p, least): &([f32; 3], f32)| {
                Bounds { low: p.into(), high: Vec3::from(p) + 0.1, least }
            };
            let query = bounds(&(at, 1.0));
            let tree = Hierarchy::new(places.iter().map(bounds));
            let mut found = Vec::new();
            tree.near(&query, reach, |leaf| found.push(leaf));
            let expected: Vec<usize> = (0..places.len())
                .filter(|&i| bounds(&places[i]).gap(&query) < reach)
                .collect();
            prop_assert_eq!(found, expected);
        }
    }
}
