//! The shares of a distribution, and the grid that tells which of them a fraction falls in.
//!
//! Both are made of the same numbers, run by run, while those are at hand: a run of weights
//! has cells of its own, as what lies before it is known from the sums.

use crate::pages::Pages;
use crate::sums::{PADDING, Run, Sums, divide};
use fearless_simd::{Level, Simd, SimdBase, dispatch, u32x16};
use rayon::prelude::*;

/// Where shares begin, and the grid over them.
pub(crate) struct Shares {
    /// In fractions of 2^64; then [`PADDING`] times the end of the range.
    pub starts: Pages<u64>,
    /// For each cell, the element its lower end falls in; then the last element.
    pub grid: Pages<u32>,
    /// Sum of the weights.
    pub total: f64,
}

/// 2^64.
pub(crate) const TWO_64: f64 = 18_446_744_073_709_551_616.0;

/// The shares of weights, and a grid whose cells are fractions without their lower `shift`
/// bits; `None` where there is nothing to share, or for 2^32 elements or more.
pub(crate) fn shares(sums: Sums, shift: u32) -> Option<Shares> {
    let Sums { before, runs } = sums;
    let mut starts = before;
    let len = starts.len() - PADDING;
    u32::try_from(len).ok()?;
    let (lower, total) = sums_before(&runs);
    if total <= 0.0 || !total.is_finite() {
        return None;
    }
    let scale = TWO_64 / total;
    starts[len..].fill(u64::MAX);
    let cells = 1usize << (64 - shift);
    let mut grid = Pages::zeroed(cells + 1);
    grid[cells] = (len - 1) as u32;
    let first_cells = lower
        .iter()
        .map(|lower| first_cell((lower * scale) as u64, shift));
    let first_cells: Vec<usize> = first_cells.chain([cells]).collect();
    let first_elements = runs.iter().scan(0, |next, run| {
        let first = *next;
        *next += run.len;
        Some(first)
    });
    let first_elements: Vec<usize> = first_elements.collect();
    let of_runs = (
        divide(&mut starts, runs.iter().map(|run| run.len)),
        divide(
            &mut grid,
            first_cells.windows(2).map(|pair| pair[1] - pair[0]),
        ),
        first_elements,
        &first_cells[..runs.len()],
        lower,
    );
    let level = Level::new();
    of_runs
        .into_par_iter()
        .for_each(|(starts, cells, first_element, first, lower)| {
            dispatch!(level, simd => {
                for start in starts.iter_mut() {
                    // Scaling is monotonic, and a product past the end saturates.
                    *start = ((lower + f64::from_bits(*start)) * scale) as u64;
                }
                note(starts, first_element as u32, cells, *first, shift);
                raise(simd, cells);
            });
        });
    Some(Shares {
        starts,
        grid,
        total,
    })
}

/// What lies before each run, and the sum of all.
fn sums_before(runs: &[Run]) -> (Vec<f64>, f64) {
    let mut total = 0.0;
    let before = runs.iter().map(|run| {
        let before = total;
        total += run.sum;
        before
    });
    (before.collect(), total)
}

/// The first cell whose lower end is not below `start`.
#[inline(always)]
fn first_cell(start: u64, shift: u32) -> usize {
    match start {
        0 => 0,
        start => ((start - 1) >> shift) as usize + 1,
    }
}

/// Notes each element from `element` on, whose shares begin at `starts`, in the first of
/// `cells` whose lower end it holds, if it holds any. What is noted last before a cell is its
/// element: so nothing depends on a comparison that processors would have to guess.
#[inline(always)]
fn note(starts: &[u64], element: u32, cells: &mut [u32], first: usize, shift: u32) {
    for (&start, element) in starts.iter().zip(element..) {
        if let Some(cell) = cells.get_mut(first_cell(start, shift) - first) {
            *cell = element;
        }
    }
}

/// Gives each cell the largest of all up to it. One by one, every second cell would be a
/// decision to guess.
#[inline(always)]
fn raise<S: Simd>(simd: S, cells: &mut [u32]) {
    let none = u32x16::splat(simd, 0);
    let mut before = none;
    let (rows, rest) = cells.as_chunks_mut();
    for row in rows {
        let mut cells = u32x16::load_array_ref(simd, row);
        cells = cells.max(none.slide::<15>(cells));
        cells = cells.max(none.slide::<14>(cells));
        cells = cells.max(none.slide::<12>(cells));
        cells = cells.max(none.slide::<8>(cells));
        cells = cells.max(before);
        cells.store_array(row);
        before = u32x16::splat(simd, cells[15]);
    }
    let mut before = before[0];
    for cell in rest {
        before = before.max(*cell);
        *cell = before;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_grid_knows_the_element_at_the_lower_end_of_each_cell(
            runs in prop::collection::vec(
                prop::collection::vec(prop_oneof![1e-9f64..1e-3, 1.0f64..1e9], 0..50), 1..20),
            bits in 1u32..18,
        ) {
            let weights: usize = runs.iter().map(Vec::len).sum();
            prop_assume!(weights > 0);
            let mut before = Vec::new();
            let sum = |weights: &Vec<f64>| {
                let mut sum = 0.0;
                for weight in weights {
                    before.push(f64::to_bits(sum));
                    sum += weight;
                }
                Run { len: weights.len(), sum }
            };
            let runs = runs.iter().map(sum).collect();
            before.extend([0; PADDING]);
            let before = Pages::from(before);
            let Shares { starts, grid, .. } = shares(Sums { before, runs }, 64 - bits).unwrap();
            let starts = &starts[..weights];
            prop_assert!(starts.is_sorted());
            for (cell, &element) in grid[..1 << bits].iter().enumerate() {
                let low = (cell as u64) << (64 - bits);
                let expected = starts.partition_point(|&start| start <= low) - 1;
                prop_assert_eq!(element as usize, expected);
            }
            prop_assert_eq!(grid[1 << bits] as usize, weights - 1);
        }
    }
}
