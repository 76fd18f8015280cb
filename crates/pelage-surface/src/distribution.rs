//! Picking an element of a discrete distribution by a 64-bit fraction.
//!
//! Source: document 004, section 2.1.6: a uniform grid over the codomain of the
//! cumulative distribution says between which elements to bisect, so that a pick
//! costs constant time whatever the weights. The sum runs in f64 and is stored as
//! fractions of 2^64 (errata: floats would leave 4 bits inside an element).

use rayon::prelude::*;

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
    starts: Vec<u64>,
    /// For each cell of the grid, the element its lower end falls in; one more entry
    /// than cells.
    grid: Vec<u32>,
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

/// Entries after the last start, so that a pick may read ahead.
const PADDING: usize = 3;

impl Distribution {
    /// A distribution in proportion to `weights`, which must be positive and finite;
    /// `None` where there is none, where one is not, or for 2^32 or more of them.
    ///
    /// Its grid has as many cells as elements, rounded up to a power of two: up to four
    /// times as many pick a few percent faster from memory that is near, and slower from
    /// memory that is far (docs/results/sampling.md).
    pub fn new(weights: &[f64]) -> Option<Self> {
        let bits = usize::BITS - weights.len().saturating_sub(1).leading_zeros();
        Self::with_cells(weights, bits)
    }

    /// The same with a grid of 2^`bits` cells (1 to 32 bits), for those who know better.
    pub fn with_cells(weights: &[f64], bits: u32) -> Option<Self> {
        let sound = weights.iter().all(|w| *w > 0.0 && w.is_finite());
        let few = u32::try_from(weights.len()).is_ok();
        if weights.is_empty() || !sound || !few {
            return None;
        }
        let (sums, total) = running_sums(weights);
        if !total.is_finite() {
            return None;
        }
        let scale = TWO_64 / total;
        let mut starts = vec![u64::MAX; weights.len() + PADDING];
        starts
            .par_iter_mut()
            .zip(&sums)
            // Scaling is monotonic, and a product past the end saturates.
            .for_each(|(start, sum)| *start = (sum * scale) as u64);
        let shift = 64 - bits.clamp(1, 32);
        Some(Self {
            grid: grid(&starts[..weights.len()], shift),
            starts,
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

impl Tables<'_> {
    /// The element, how far into its share the fraction fell, and the width of the share.
    /// Those two are cut to 31 bits, so that processors turn many into floats at once;
    /// the width is at least 1.
    #[inline(always)]
    pub(crate) fn locate(self, fraction: u64) -> (usize, [i32; 2]) {
        let (index, (start, width)) = self.share_around(fraction);
        let width = width.max(1);
        let cut = 33u32.saturating_sub(width.leading_zeros());
        let inside = (fraction - start) >> cut;
        (index, [inside as i32, (width >> cut) as i32])
    }

    /// The element in whose share `fraction` falls; where its share begins, and its width,
    /// both of 2^64. The last fraction of all, 2^64 - 1, may be in no share.
    ///
    /// A cell of the grid holds one start on the mean, so the next two are looked at
    /// without a branch that could be guessed wrong; what is left to bisect is rare for
    /// any weights.
    #[inline(always)]
    pub(crate) fn share_around(self, fraction: u64) -> (usize, (u64, u64)) {
        let cell = (fraction >> self.shift) as usize;
        let first = self.grid[cell] as usize;
        let near = &self.starts[first..first + 4];
        let further = (near[1] <= fraction) as usize + (near[2] <= fraction) as usize;
        let (mut index, mut start, mut end) = (first + further, near[further], near[further + 1]);
        if near[2] <= fraction {
            index = self.bisect(first, self.grid[cell + 1] as usize, fraction);
            (start, end) = (self.starts[index], self.starts[index + 1]);
        }
        (index, (start, end - start))
    }

    #[cold]
    fn bisect(self, first: usize, last: usize, fraction: u64) -> usize {
        let inside = &self.starts[first + 1..last + 1];
        first + inside.partition_point(|&start| start <= fraction)
    }
}

const TWO_64: f64 = 18_446_744_073_709_551_616.0;

/// Weights summed at a time. Fixed, so that the sums do not depend on the threads.
const RUN: usize = 1 << 14;

/// The sum of the weights before each, and of all.
fn running_sums(weights: &[f64]) -> (Vec<f64>, f64) {
    let mut total = 0.0;
    let before: Vec<f64> = weights
        .par_chunks(RUN)
        .map(|run| run.iter().sum::<f64>())
        .collect::<Vec<_>>()
        .into_iter()
        .map(|sum| {
            let before = total;
            total += sum;
            before
        })
        .collect();
    let mut sums = vec![0.0; weights.len()];
    let runs = weights.par_chunks(RUN).zip(sums.par_chunks_mut(RUN));
    runs.zip(before).for_each(|((weights, sums), before)| {
        let mut inside = 0.0;
        for (weight, sum) in weights.iter().zip(sums) {
            *sum = before + inside;
            inside += weight;
        }
    });
    (sums, total)
}

/// The element that the lower end of each cell falls in, and the last element.
fn grid(starts: &[u64], shift: u32) -> Vec<u32> {
    let cells = 1usize << (64 - shift);
    let mut grid = vec![0; cells + 1];
    grid[cells] = (starts.len() - 1) as u32;
    grid[..cells]
        .par_chunks_mut(RUN)
        .enumerate()
        .for_each(|(run, cells)| {
            let low = ((run * RUN) as u64) << shift;
            let mut element = starts.partition_point(|&start| start <= low) - 1;
            for (k, cell) in cells.iter_mut().enumerate() {
                let low = ((run * RUN + k) as u64) << shift;
                while element + 1 < starts.len() && starts[element + 1] <= low {
                    element += 1;
                }
                *cell = element as u32;
            }
        });
    grid
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
