//! Weights as what lies before each: what a distribution is made of.

use crate::pages::Pages;
use fearless_simd::{Level, dispatch};
use rayon::prelude::*;

/// Entries after the last start of a distribution, so that a pick may read ahead.
pub(crate) const PADDING: usize = 3;

/// The sums of weights that come in runs. How they are cut into runs shows in the last
/// bits of the sums, so that must not depend on the threads.
#[derive(Default)]
pub(crate) struct Sums {
    /// For each element, the bits of the sum (f64) of the weights before it in its run:
    /// the starts of the shares will take the same place. Then [`PADDING`].
    pub before: Pages<u64>,
    pub runs: Vec<Run>,
}

/// A run of weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Run {
    /// How many there are.
    pub len: usize,
    /// Their sum.
    pub sum: f64,
}

impl Sums {
    /// The sums of `weights`; `None` where one is not positive and finite.
    pub(crate) fn new(weights: &[f64]) -> Option<Self> {
        let mut before = Pages::zeroed(weights.len() + PADDING);
        let runs: Option<Vec<Run>> = before[..weights.len()]
            .par_chunks_mut(RUN)
            .zip(weights.par_chunks(RUN))
            .map(|(before, weights)| {
                let mut sum = 0.0;
                for (before, weight) in before.iter_mut().zip(weights) {
                    *before = f64::to_bits(sum);
                    sum += weight;
                }
                let sound = weights.iter().all(|w| *w > 0.0 && w.is_finite());
                sound.then_some(Run {
                    len: weights.len(),
                    sum,
                })
            })
            .collect();
        Some(Self {
            before,
            runs: runs?,
        })
    }

    /// Where the share of each element begins, in fractions of 2^64, then [`PADDING`] times
    /// the end of the range; and the sum of all. `None` where there is none to share.
    pub(crate) fn into_starts(self) -> Option<(Pages<u64>, f64)> {
        let Self { mut before, runs } = self;
        let mut total = 0.0;
        let lower: Vec<f64> = runs
            .iter()
            .map(|run| {
                let before = total;
                total += run.sum;
                before
            })
            .collect();
        if total <= 0.0 || !total.is_finite() {
            return None;
        }
        let scale = TWO_64 / total;
        let len = before.len() - PADDING;
        before[len..].fill(u64::MAX);
        let level = Level::new();
        let places = divide(&mut before, runs.iter().map(|run| run.len));
        places
            .into_par_iter()
            .zip(lower)
            .for_each(|(starts, lower)| {
                dispatch!(level, simd => {
                    let _ = simd;
                    for start in starts {
                        // Scaling is monotonic, and a product past the end saturates.
                        *start = ((lower + f64::from_bits(*start)) * scale) as u64;
                    }
                });
            });
        Some((before, total))
    }
}

/// 2^64.
pub(crate) const TWO_64: f64 = 18_446_744_073_709_551_616.0;

/// Weights summed at a time.
const RUN: usize = 1 << 14;

/// The consecutive parts of `whole` that have the lengths `lengths`.
pub(crate) fn divide<T>(whole: &mut [T], lengths: impl Iterator<Item = usize>) -> Vec<&mut [T]> {
    let mut left = whole;
    lengths
        .map(|length| {
            let (part, later) = std::mem::take(&mut left).split_at_mut(length);
            left = later;
            part
        })
        .collect()
}
