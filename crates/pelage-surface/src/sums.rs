//! Weights as what lies before each: what a distribution is made of.

use crate::pages::Pages;
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
}

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
