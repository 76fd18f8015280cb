//! Boxes of things along a curve, to find those near a box.
//!
//! The things come in an order that keeps neighbours near, so a complete binary tree
//! over the order is as good as one that was built, and needs no links.

use super::ground::ROW;
use fearless_simd::{Simd, SimdBase, SimdMask, f32x16};
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

/// The [gaps](Bounds::gap) between `bounds` and a row of boxes from `low` to `high` that
/// have `least`.
#[inline(always)]
pub(crate) fn gaps<S: Simd>(
    simd: S,
    [low, high]: [&[[f32; ROW]; 3]; 2],
    least: &[f32; ROW],
    bounds: &Bounds,
) -> f32x16<S> {
    let nothing = f32x16::splat(simd, 0.0);
    let mut squares = nothing;
    for axis in 0..3 {
        let below = f32x16::load_array_ref(simd, &low[axis]) - bounds.high[axis];
        let above = bounds.low[axis] - f32x16::load_array_ref(simd, &high[axis]);
        let apart = below.max(above).max(nothing);
        squares += apart * apart;
    }
    squares * (f32x16::load_array_ref(simd, least) * bounds.least)
}

/// Up to [`Boxes::MOST`] boxes, in a form in which many are compared with one at once.
pub(crate) struct Boxes([Row; Boxes::MOST / ROW]);

/// A row of boxes; where there is none, [`Bounds::EMPTY`].
#[repr(align(64))]
struct Row {
    low: [[f32; ROW]; 3],
    high: [[f32; ROW]; 3],
    least: [f32; ROW],
}

impl Boxes {
    /// As many as a word has bits.
    pub(crate) const MOST: usize = 64;

    pub(crate) fn new(boxes: impl Iterator<Item = Bounds>) -> Self {
        let empty = || Row {
            low: [[f32::INFINITY; ROW]; 3],
            high: [[f32::NEG_INFINITY; ROW]; 3],
            least: [f32::INFINITY; ROW],
        };
        let mut rows: [Row; Self::MOST / ROW] = std::array::from_fn(|_| empty());
        for (i, bounds) in boxes.enumerate() {
            let (row, k) = (&mut rows[i / ROW], i % ROW);
            for axis in 0..3 {
                row.low[axis][k] = bounds.low[axis];
                row.high[axis][k] = bounds.high[axis];
            }
            row.least[k] = bounds.least;
        }
        Self(rows)
    }

    /// Which have a [gap](Bounds::gap) to `bounds` less than each of `reaches`: a bit each.
    #[inline(always)]
    pub(crate) fn near<S: Simd, const N: usize>(
        &self,
        simd: S,
        bounds: &Bounds,
        reaches: [f32; N],
    ) -> [u64; N] {
        let mut near = [0; N];
        for (k, row) in self.0.iter().enumerate() {
            let gaps = gaps(simd, [&row.low, &row.high], &row.least, bounds);
            for (near, reach) in near.iter_mut().zip(reaches) {
                *near |= gaps.simd_lt(reach).to_bitmask() << (ROW * k);
            }
        }
        near
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
    use fearless_simd::{Level, dispatch};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn boxes_compared_at_once_are_near_as_those_compared_one_by_one(
            places in prop::collection::vec((prop::array::uniform3(0f32..1.0), 0.5f32..2.0), 0..=64),
            at in prop::array::uniform3(0f32..1.0), reaches in prop::array::uniform2(0f32..0.5),
        ) {
            let bounds = |&(p, least): &([f32; 3], f32)| {
                Bounds { low: p.into(), high: Vec3::from(p) + 0.1, least }
            };
            let query = bounds(&(at, 1.0));
            let boxes = Boxes::new(places.iter().map(bounds));
            let near = dispatch!(Level::new(), simd => boxes.near(simd, &query, reaches));
            for (near, reach) in near.into_iter().zip(reaches) {
                let is_near = |i: usize| places.get(i).is_some_and(|p| bounds(p).gap(&query) < reach);
                prop_assert_eq!(near, (0..64).fold(0, |bits, i| bits | (is_near(i) as u64) << i));
            }
        }

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
