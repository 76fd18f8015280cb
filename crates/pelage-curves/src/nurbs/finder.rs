//! Which piece a parameter is in.

/// For even cells of the domain, as many as pieces, / search then begins among the one or two pieces of its cell.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Finder {
    low: f64,
    /// Cells per unit of the parameter.
    scale: f64,
    /// The last piece that starts before the cell, or 0; one more than cells, ascending.
    first: Vec<u32>,
}

impl Finder {
    /// For `breaks`, at least two, which ascend. (More than 2^32 pieces fit no memory.)
    pub(super) fn new(breaks: &[f64]) -> Self {
        let starts = &breaks[..breaks.len() - 1];
        let (low, cells) = (breaks[0], starts.len());
        let mut finder = Self {
            low,
            scale: cells as f64 / (breaks[cells] - low),
            first: vec![0; cells + 1],
        };
        // By the very rounding of a search, which ascends with the parameter: a piece that
        // starts in an earlier cell starts before.
        for &start in starts {
            let cell = finder.cell(start);
            finder.first[cell + 1] += 1;
        }
        let mut earlier = 0u32;
        for count in &mut finder.first {
            earlier += *count;
            *count = earlier.saturating_sub(1);
        }
        finder
    }

    /// Cell of `u`, clamped; the first for a NaN.
    #[inline(always)]
    fn cell(&self, u: f64) -> usize {
        (((u - self.low) * self.scale) as usize).min(self.first.len() - 2)
    }

    /// The last piece that starts at `u` or before, or the first.
    #[inline(always)]
    pub(super) fn piece(&self, breaks: &[f64], u: f64) -> usize {
        let cell = self.cell(u);
        let (mut low, high) = (self.first[cell] as usize, self.first[cell + 1] as usize);
        // Few: step by step. Many: halve.
        if high - low > 8 {
            let started = breaks[low..=high].partition_point(|&b| b <= u);
            return low + started.max(1) - 1;
        }
        while low < high && breaks[low + 1] <= u {
            low += 1;
        }
        low
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_piece_found_is_that_of_a_search_of_all(
            steps in prop::collection::vec(-30i32..3, 1..60), at in -0.1f64..1.1,
        ) {
            let mut breaks = vec![-1.0];
            for step in steps {
                breaks.push(breaks[breaks.len() - 1] + libm::pow(3.0, step as f64));
            }
            let finder = Finder::new(&breaks);
            let last = breaks.len() - 2;
            let along = -1.0 + (breaks[last + 1] + 1.0) * at;
            for u in breaks.iter().copied().chain([along]) {
                let all = breaks.partition_point(|&b| b <= u).clamp(1, last + 1) - 1;
                prop_assert_eq!(finder.piece(&breaks, u), all);
            }
        }
    }
}
