//! The hairs of an interval of the surface: those whose first numbers lie between two bounds.
//!
//! The scramble can be undone bit by bit (architecture.md, law 3): all hairs whose
//! first number starts with k given bits are r, r + 2^k, r + 2·2^k, …

use crate::{RootSequence, Spread};
use std::ops::Range;

impl RootSequence {
    /// Calls `visit` with every one of `indices` whose first number lies in `low..high`
    /// (`high` up to 2^64), in time proportional to how many they are plus the logarithm of
    /// `indices.end` (random numbers: to the length of `indices`). The order is not that of
    /// the indices.
    pub fn indices_in(
        &self,
        low: u64,
        high: u128,
        indices: Range<u64>,
        visit: &mut impl FnMut(u64),
    ) {
        self.runs_in([low as u128, high], indices, u64::MAX, &mut |run| {
            (0..run.count).for_each(|k| visit(run.index(k)));
        });
    }

    /// The same indices in runs of at most `most`, ordered by their first numbers from
    /// run to run: the finer the runs, the nearer their hairs.
    pub(crate) fn runs_in(
        &self,
        [low, high]: [u128; 2],
        indices: Range<u64>,
        most: u64,
        visit: &mut impl FnMut(Run),
    ) {
        if self.spread() == Spread::Random {
            return indices
                .filter(|&index| {
                    let x = self.random(index).0 as u128;
                    low <= x && x < high
                })
                .for_each(|index| visit(Run::one(index, self.random(index).0)));
        }
        let interval = Interval {
            low,
            high,
            indices,
            most,
        };
        let all = Node {
            prefix: 0,
            bits: 0,
            residue: 0,
        };
        self.descend(all, &interval, visit);
    }

    fn descend(&self, node: Node, wanted: &Interval, visit: &mut impl FnMut(Run)) {
        let (start, end) = node.interval();
        if end <= wanted.low || start >= wanted.high {
            return;
        }
        let Some(run) = node.run(&wanted.indices) else {
            return;
        };
        let inside = wanted.low <= start && end <= wanted.high;
        if inside && run.count <= wanted.most {
            visit(run);
        } else if inside && node.bits < WORD - LEVELS {
            // Above the last of so many levels, none is short enough to be visited.
            let levels = (run.count / (wanted.most + 1)).ilog2() + 1;
            self.list_below(node, levels.min(LEVELS), wanted, visit);
        } else if run.count == 1 {
            let x = self.sample(run.first).0 as u128;
            if inside || wanted.low <= x && x < wanted.high {
                visit(run);
            }
        } else {
            let own = self.bit(node.residue, node.bits);
            for bit in [0, 1] {
                let residue = if bit == own {
                    node.residue
                } else {
                    node.residue | 1 << node.bits
                };
                let child = Node {
                    prefix: node.prefix << 1 | bit as u128,
                    bits: node.bits + 1,
                    residue,
                };
                self.descend(child, wanted, visit);
            }
        }
    }

    /// The same of a node whose numbers are all wanted, `levels` levels at once: the branches
    /// of a level do not wait for each other, as those along one path do.
    fn list_below(&self, node: Node, levels: u32, wanted: &Interval, visit: &mut impl FnMut(Run)) {
        let mut residues = [node.residue; 1 << LEVELS];
        for level in 0..levels {
            let bits = node.bits + level;
            // From the last on, since two take the place of one.
            for k in (0..1 << level).rev() {
                let residue = residues[k];
                let own = self.bit(residue, bits) as usize;
                residues[2 * k + own] = residue;
                residues[2 * k + 1 - own] = residue | 1 << bits;
            }
        }
        for (k, &residue) in residues[..1 << levels].iter().enumerate() {
            let child = Node {
                prefix: node.prefix << levels | k as u128,
                bits: node.bits + levels,
                residue,
            };
            self.descend(child, wanted, visit);
        }
    }
}

/// Most levels of the tree of prefixes that are listed at once.
const LEVELS: u32 = 6;

/// Bits of the upper word of the first number.
const WORD: u32 = 32;

/// Indices that are a step apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Run {
    pub first: u64,
    pub step: u64,
    pub count: u64,
    /// The first number of one of them; the others share as many of its upper bits as `step`
    /// has lower zeros.
    pub number: u64,
}

impl Run {
    fn one(index: u64, number: u64) -> Self {
        Self {
            first: index,
            step: 0,
            count: 1,
            number,
        }
    }

    /// Index number `k` of the run.
    #[inline(always)]
    pub fn index(&self, k: u64) -> u64 {
        self.first + k * self.step
    }
}

/// Which are wanted: those of `indices` with a first number in `low..high`, at most `most`
/// a run.
struct Interval {
    low: u128,
    high: u128,
    indices: Range<u64>,
    most: u64,
}

/// The numbers that start with `bits` given bits, and the smallest index of one.
#[derive(Clone, Copy)]
struct Node {
    prefix: u128,
    bits: u32,
    residue: u64,
}

impl Node {
    fn interval(&self) -> (u128, u128) {
        let shift = 64 - self.bits;
        (self.prefix << shift, (self.prefix + 1) << shift)
    }

    /// Those of `wanted`, if there are any.
    fn run(&self, wanted: &Range<u64>) -> Option<Run> {
        let Some(step) = 1u64.checked_shl(self.bits) else {
            return wanted
                .contains(&self.residue)
                .then(|| Run::one(self.residue, self.prefix as u64));
        };
        let skipped = wanted.start.saturating_sub(self.residue).div_ceil(step);
        let first = self.residue.checked_add(skipped.checked_mul(step)?)?;
        (first < wanted.end).then(|| Run {
            first,
            step,
            number: (self.prefix << (64 - self.bits)) as u64,
            count: ((wanted.end - first - 1) >> self.bits) + 1,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn fine_runs_follow_each_other_along_the_first_number() {
        let sequence = RootSequence::new(3, Spread::Stratified);
        let mut highest = 0;
        let mut found = 0;
        sequence.runs_in([0, 1 << 64], 0..5000, 8, &mut |run| {
            assert!(run.count <= 8);
            let numbers = (0..run.count).map(|k| sequence.sample(run.index(k)).0);
            let numbers: Vec<u64> = numbers.collect();
            assert!(numbers.iter().all(|&x| x >= highest));
            highest = numbers.into_iter().fold(highest, u64::max);
            found += run.count;
        });
        assert_eq!(found, 5000);
    }

    proptest! {
        #[test]
        fn listing_an_interval_finds_exactly_its_hairs(
            seed: u64, from in 0u64..300, count in 0u64..600, a: u64, b: u64, dice: bool,
        ) {
            let spread = if dice { Spread::Random } else { Spread::Stratified };
            let sequence = RootSequence::new(seed, spread);
            let (low, high) = (a.min(b), a.max(b) as u128 + 1);
            let mut found = Vec::new();
            sequence.indices_in(low, high, from..count, &mut |i| found.push(i));
            found.sort_unstable();
            let expected: Vec<u64> = (from..count)
                .filter(|&i| {
                    let x = sequence.sample(i).0;
                    x >= low && (x as u128) < high
                })
                .collect();
            prop_assert_eq!(found, expected);
        }

        #[test]
        fn a_narrow_interval_costs_little_even_among_a_trillion_hairs(seed: u64, low: u64) {
            let sequence = RootSequence::new(seed, Spread::Stratified);
            let mut found = 0;
            let width = 1u128 << 28; // expects 2^40 · 2^28 / 2^64 = 16 hairs
            sequence.indices_in(low, low as u128 + width, 0..1 << 40, &mut |_| found += 1);
            prop_assert!(found <= 40, "{}", found);
        }
    }
}
