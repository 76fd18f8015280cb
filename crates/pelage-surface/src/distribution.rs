//! Picking an element of a discrete distribution by a 64-bit fraction.
//!
//! Source: document 004, section 2.1.6: a uniform grid over the codomain of the
//! cumulative distribution says between which elements to bisect, so that a pick
//! costs constant time whatever the weights. The sum runs in f64 and is stored as
//! fractions of 2^64 (errata: floats would leave 4 bits inside an element).

use crate::grid::{Shares, TWO_64, shares};
use crate::pages::Pages;
use crate::sums::{PADDING, Sums};

/// A discrete distribution over `0..len`.
///
/// ```
/// use pelage_surface::Distribution;
/// let dice = Distribution::new(&[1.0, 1.0, 2.0]).unwrap();
/// assert_eq!(dice.pick(u64::MAX / 2 + 1).index, 2);
/// assert_eq!(dice.probability(2), 0.5);
/// ```
#[derive(Clone, Debug)]
pub struct Distribution {
    /// Where each element's share of 0..2^64 begins; ascending, first 0; then
    /// [`PADDING`] times the end of the range.
    starts: Pages<u64>,
    /// For each cell of the grid, the element its lower end falls in; one more entry
    /// than cells.
    grid: Pages<u32>,
    /// Right shift that turns a fraction into its cell.
    shift: u32,
    total: f64,
}

/// An element picked, and how far into its share the fraction fell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pick {
    /// The element.
    pub index: usize,
    /// Position inside its share, 0..=1: a random number in its own right.
    pub rest: f32,
}

impl Distribution {
    /// A distribution in proportion to `weights`, which must be positive and finite;
    /// `None` where there is none, where one is not, or for 2^32 or more of them.
    ///
    /// Its grid has as many cells as elements, rounded to a power of two: more of them pick
    /// hardly faster from memory that is near, and slower from memory that is far
    /// (docs/results/sampling.md).
    pub fn new(weights: &[f64]) -> Option<Self> {
        Self::with_cells(weights, cell_bits(weights.len()))
    }

    /// The same with a grid of 2^`bits` cells (1 to 32 bits), for those who know better.
    pub fn with_cells(weights: &[f64], bits: u32) -> Option<Self> {
        Self::of_sums_with_cells(Sums::new(weights)?, bits)
    }

    /// As [`new`](Self::new), of weights that were summed before.
    pub(crate) fn of_sums(sums: Sums) -> Option<Self> {
        let bits = cell_bits(sums.before.len() - PADDING);
        Self::of_sums_with_cells(sums, bits)
    }

    fn of_sums_with_cells(sums: Sums, bits: u32) -> Option<Self> {
        let shift = 64 - bits.clamp(1, 32);
        let Shares {
            starts,
            grid,
            total,
        } = shares(sums, shift)?;
        Some(Self {
            starts,
            grid,
            shift,
            total,
        })
    }

    /// The element in whose share `fraction` (of 2^64) falls.
    #[inline]
    pub fn pick(&self, fraction: u64) -> Pick {
        let (index, [inside, width]) = self.tables().locate(fraction);
        Pick {
            index,
            rest: inside as f32 / width as f32,
        }
    }

    /// What picking reads.
    #[inline(always)]
    pub(crate) fn tables(&self) -> Tables<'_> {
        Tables {
            starts: &self.starts,
            grid: &self.grid,
            shift: self.shift,
        }
    }

    /// The share of element `index`, in fractions of 2^64; the end may be 2^64.
    pub fn share(&self, index: usize) -> (u64, u128) {
        (self.starts[index], self.end(index))
    }

    fn end(&self, index: usize) -> u128 {
        if index + 1 < self.len() {
            self.starts[index + 1] as u128
        } else {
            1 << 64
        }
    }

    /// The probability that `index` is picked.
    pub fn probability(&self, index: usize) -> f64 {
        let (start, end) = self.share(index);
        (end - start as u128) as f64 / TWO_64
    }

    /// Number of elements.
    pub fn len(&self) -> usize {
        self.starts.len() - PADDING
    }

    /// Whether there is no element; never true for a distribution that was made.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Sum of the weights.
    pub fn total(&self) -> f64 {
        self.total
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.starts.len() * 8 + self.grid.len() * 4
    }
}

/// The arrays of a distribution, for loops over many picks: a copy stays in registers,
/// where the fields of a reference would be read again at every pick.
#[derive(Clone, Copy)]
pub(crate) struct Tables<'a> {
    starts: &'a [u64],
    grid: &'a [u32],
    shift: u32,
}

impl<'a> Tables<'a> {
    /// The element, how far into its share the fraction fell, and the width of the share.
    /// Those two are cut to 31 bits, so that processors turn many into floats at once;
    /// the width is at least 1.
    #[inline(always)]
    pub(crate) fn locate(self, fraction: u64) -> (usize, [i32; 2]) {
        let (index, share) = self.share_around(fraction);
        (index, inside(fraction, share))
    }

    /// [`locate`](Self::locate) for many. All tables are read before anything is decided, and
    /// what is decided needs no branch: a decision guessed wrong throws away what was begun
    /// to be read after it.
    #[inline(always)]
    pub(crate) fn locate_all<const N: usize>(self, fractions: &[u64], picks: &mut Picks<N>) {
        let picks = picks.first(fractions.len());
        for (cell, &fraction) in picks.indices.iter_mut().zip(fractions) {
            *cell = self.grid[(fraction >> self.shift) as usize];
        }
        for (near, &first) in picks.near.iter_mut().zip(&*picks.indices) {
            *near = self.four(first as usize);
        }
        let mut far = false;
        for (k, &fraction) in fractions.iter().enumerate() {
            let [first, second, third, fourth] = picks.near[k];
            let (one, two) = (second <= fraction, third <= fraction);
            let start = if one { second } else { first };
            let end = if one { third } else { second };
            let start = if two { third } else { start };
            let end = if two { fourth } else { end };
            [picks.insides[k], picks.widths[k]] = inside(fraction, (start, end - start));
            picks.indices[k] += one as u32 + two as u32;
            far |= fourth <= fraction;
        }
        if far {
            self.bisect_all(fractions, picks);
        }
    }

    /// Looks further for those that are not in the first three shares.
    #[inline(never)]
    fn bisect_all(self, fractions: &[u64], picks: FirstPicks) {
        for (k, &fraction) in fractions.iter().enumerate() {
            if picks.near[k][3] <= fraction {
                let (found, share) = self.share_around(fraction);
                picks.indices[k] = found as u32;
                [picks.insides[k], picks.widths[k]] = inside(fraction, share);
            }
        }
    }

    /// The element in whose share `fraction` falls; where its share begins, and its width,
    /// both of 2^64. The last fraction of all, 2^64 - 1, may be in no share.
    #[inline(always)]
    pub(crate) fn share_around(self, fraction: u64) -> (usize, (u64, u64)) {
        let first = self.grid[(fraction >> self.shift) as usize] as usize;
        self.share_among(fraction, first, self.four(first))
    }

    /// How many elements lie, more or less, between those of the fractions `least` and `most`.
    #[inline(always)]
    pub(crate) fn between(self, least: u64, most: u64) -> u32 {
        let element = |fraction: u64| self.grid[(fraction >> self.shift) as usize];
        element(most) - element(least)
    }

    /// Where element `first` and those after it begin; at the very end, where the last ends.
    #[inline(always)]
    pub(crate) fn starts(self, first: usize) -> &'a [u64] {
        &self.starts[first..self.starts.len() + 1 - PADDING]
    }

    /// The starts from element `first` on.
    #[inline(always)]
    fn four(self, first: usize) -> [u64; 4] {
        let mut four = [0; 4];
        four.copy_from_slice(&self.starts[first..first + 4]);
        four
    }

    /// The same where the cell of `fraction` begins in element `first`, and the starts from
    /// there on are `near`.
    ///
    /// A cell of the grid holds one start on the mean, so the next two are looked at
    /// without a branch that could be guessed wrong; what is left to bisect is rare for
    /// any weights.
    #[inline(always)]
    fn share_among(self, fraction: u64, first: usize, near: [u64; 4]) -> (usize, (u64, u64)) {
        let further = (near[1] <= fraction) as usize + (near[2] <= fraction) as usize;
        let (mut index, mut start, mut end) = (first + further, near[further], near[further + 1]);
        if near[2] <= fraction {
            let next = self.grid[(fraction >> self.shift) as usize + 1] as usize;
            index = bisect(self.starts, first, next, fraction);
            (start, end) = (self.starts[index], self.starts[index + 1]);
        }
        (index, (start, end - start))
    }
}

/// What is found of up to `N` fractions.
pub(crate) struct Picks<const N: usize> {
    pub indices: [u32; N],
    /// How far into their shares they fell, and the widths of those, as
    /// [`locate`](Tables::locate) gives them.
    pub insides: [i32; N],
    pub widths: [i32; N],
    /// Where the elements begin that each may lie in.
    near: [[u64; 4]; N],
}

/// The first of many [`Picks`].
struct FirstPicks<'a> {
    indices: &'a mut [u32],
    insides: &'a mut [i32],
    widths: &'a mut [i32],
    near: &'a mut [[u64; 4]],
}

impl<const N: usize> Picks<N> {
    pub(crate) fn new() -> Self {
        Self {
            indices: [0; N],
            insides: [0; N],
            widths: [1; N],
            near: [[0; 4]; N],
        }
    }

    #[inline(always)]
    fn first(&mut self, count: usize) -> FirstPicks<'_> {
        FirstPicks {
            indices: &mut self.indices[..count],
            insides: &mut self.insides[..count],
            widths: &mut self.widths[..count],
            near: &mut self.near[..count],
        }
    }
}

/// How far into its share a fraction fell, and the width of the share, as
/// [`locate`](Tables::locate) gives them.
#[inline(always)]
pub(crate) fn inside(fraction: u64, (start, width): (u64, u64)) -> [i32; 2] {
    let (width, cut) = (width.max(1), cut(width));
    [((fraction - start) >> cut) as i32, (width >> cut) as i32]
}

/// Lower bits that a share of `width` is cut by, so that 31 are left.
#[inline(always)]
pub(crate) fn cut(width: u64) -> u32 {
    33u32.saturating_sub(width.leading_zeros())
}

/// The element among `first..=last` in whose share `fraction` falls. Takes no more than
/// fits registers: a caller's loop would keep the rest in memory for it all the time.
#[cold]
#[inline(never)]
fn bisect(starts: &[u64], first: usize, last: usize, fraction: u64) -> usize {
    first + starts[first + 1..last + 1].partition_point(|&start| start <= fraction)
}

/// Bits of the power of two that is nearest to the number of elements.
fn cell_bits(elements: usize) -> u32 {
    let square = (elements as u128).pow(2);
    square.checked_ilog2().map_or(0, |bits| bits.div_ceil(2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_pick_lies_in_its_share_and_shares_match_the_weights(
            weights in prop::collection::vec(1e-6f64..1e6, 1..200),
            fraction: u64,
        ) {
            let d = Distribution::new(&weights).unwrap();
            let pick = d.pick(fraction);
            let (start, end) = d.share(pick.index);
            prop_assert!(start <= fraction && (fraction as u128) < end);
            prop_assert!((0.0..=1.0).contains(&pick.rest));
            for (i, w) in weights.iter().enumerate() {
                prop_assert!((d.probability(i) - w / d.total()).abs() < 1e-14);
            }
        }
    }

    proptest! {
        #[test]
        fn many_at_once_are_located_as_one_by_one(
            weights in prop::collection::vec(prop_oneof![1e-9f64..1e-3, 1.0f64..1e9], 1..200),
            fractions: [u64; 16],
            bits in 1u32..8,
        ) {
            let d = Distribution::with_cells(&weights, bits).unwrap();
            let mut picks = Picks::<16>::new();
            d.tables().locate_all(&fractions, &mut picks);
            for (k, &fraction) in fractions.iter().enumerate() {
                let (index, share) = d.tables().share_around(fraction);
                prop_assert_eq!(picks.indices[k] as usize, index);
                let rest = [picks.insides[k], picks.widths[k]];
                prop_assert_eq!(rest, inside(fraction, share));
            }
        }
    }

    #[test]
    fn extremes_of_the_range_pick_the_first_and_the_last() {
        let d = Distribution::new(&[1.0, 2.0, 1.0]).unwrap();
        assert_eq!(d.pick(0).index, 0);
        assert_eq!(d.pick(u64::MAX).index, 2);
    }

    #[test]
    fn unsound_weights_are_refused() {
        for weights in [
            &[][..],
            &[0.0],
            &[1.0, f64::NAN],
            &[-1.0],
            &[f64::MAX, f64::MAX],
        ] {
            assert!(Distribution::new(weights).is_none(), "{weights:?}");
        }
    }
}
