//! Picking an element of a discrete distribution by a 64-bit fraction.
//!
//! Source: document 004, section 2.1.6: a uniform grid over the codomain of the
//! cumulative distribution says between which elements to bisect, so that a pick
//! costs constant time whatever the weights. The sum runs in f64 and is stored as
//! fractions of 2^64 (errata: floats would leave 4 bits inside an element).

/// A discrete distribution over `0..len`.
#[derive(Clone, Debug)]
pub struct Distribution {
    /// Where each element's share of 0..2^64 begins; ascending, first 0.
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
    /// Position inside its share, 0..1: a random number in its own right.
    pub rest: f64,
}

impl Distribution {
    /// A distribution in proportion to `weights`, which must be positive and finite;
    /// `None` where there is none, where one is not, or for 2^32 or more of them.
    pub fn new(weights: &[f64]) -> Option<Self> {
        let sound = weights.iter().all(|w| *w > 0.0 && w.is_finite());
        let total: f64 = weights.iter().sum();
        let few = u32::try_from(weights.len()).is_ok();
        if weights.is_empty() || !sound || !few || !total.is_finite() {
            return None;
        }
        let mut sum = 0.0;
        let starts: Vec<u64> = weights
            .iter()
            .map(|w| {
                let start = (sum / total * TWO_64) as u64;
                sum += w;
                start
            })
            .collect();
        let bits = usize::BITS - (weights.len() - 1).leading_zeros();
        let bits = bits.max(1);
        let shift = 64 - bits;
        let mut grid = Vec::with_capacity((1 << bits) + 1);
        let mut element = 0;
        for cell in 0..1u64 << bits {
            while element + 1 < starts.len() && starts[element + 1] <= cell << shift {
                element += 1;
            }
            grid.push(element as u32);
        }
        grid.push((starts.len() - 1) as u32);
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
        let cell = (fraction >> self.shift) as usize;
        let (first, last) = (self.grid[cell] as usize, self.grid[cell + 1] as usize);
        let inside = &self.starts[first + 1..last + 1];
        let index = first + inside.partition_point(|&start| start <= fraction);
        let start = self.starts[index];
        let width = self.end(index) - start as u128;
        Pick {
            index,
            rest: (fraction - start) as f64 / width as f64,
        }
    }

    /// The share of element `index`, in fractions of 2^64; the end may be 2^64.
    pub fn share(&self, index: usize) -> (u64, u128) {
        (self.starts[index], self.end(index))
    }

    #[inline]
    fn end(&self, index: usize) -> u128 {
        self.starts.get(index + 1).map_or(1 << 64, |&s| s as u128)
    }

    /// Number of elements.
    pub fn len(&self) -> usize {
        self.starts.len()
    }

    /// Whether there is no element; never true for a distribution that was made.
    pub fn is_empty(&self) -> bool {
        self.starts.is_empty()
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

const TWO_64: f64 = 18_446_744_073_709_551_616.0;

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
                let (start, end) = d.share(i);
                let share = (end - start as u128) as f64 / TWO_64;
                prop_assert!((share - w / d.total()).abs() < 1e-14);
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
