//! Times of picking from a discrete distribution alone: the grid's size, and maps of the
//! sky with and without it (document 004, figures 4.2 and 4.3).

use super::maps::Map;
use super::measure::Effort;
use super::methods::starts;
use pelage::surface::{Distribution, hash};
use std::hint::black_box;
use std::time::Instant;

/// Grid cells an element that are tried.
pub const CELLS: [f64; 6] = [0.25, 0.5, 1.0, 2.0, 4.0, 8.0];

/// Millions of picks a second for each of [`CELLS`], of elements with `weights`.
pub fn by_cells(weights: &[f64], effort: Effort) -> Vec<f64> {
    CELLS
        .iter()
        .map(|cells| {
            // The nearest power of two, as `Distribution::new` has it for one cell an element.
            let bits = libm::log2(weights.len() as f64 * cells).round() as u32;
            // The weights are those of a distribution that was made.
            let distribution = Distribution::with_cells(weights, bits).expect("weights");
            rate(effort, |fraction| distribution.pick(fraction).index)
        })
        .collect()
}

/// Millions of picks a second from a map of the sky, with the grid and by bisection.
pub fn sky(map: &Map, effort: Effort) -> [f64; 2] {
    let weights = sky_weights(map);
    let distribution = Distribution::new(&weights).expect("weights");
    let starts = starts(&distribution);
    [
        rate(effort, |fraction| distribution.pick(fraction).index),
        rate(effort, |fraction| {
            starts.partition_point(|&start| start <= fraction) - 1
        }),
    ]
}

/// The share of each texel in the light of a sky map in latitude and longitude.
fn sky_weights(map: &Map) -> Vec<f64> {
    let (width, height) = (map.image.width() as usize, map.image.height() as f64);
    let texels = map.image.texels().iter().enumerate();
    texels
        .map(|(i, light)| {
            let angle = ((i / width) as f64 + 0.5) / height * std::f64::consts::PI;
            light.max(1e-6) as f64 * libm::sin(angle)
        })
        .collect()
}

fn rate(effort: Effort, pick: impl Fn(u64) -> usize) -> f64 {
    let (count, seconds) = effort.best(|count| {
        let started = Instant::now();
        let sum = (0..count).fold(0, |sum: usize, i| sum.wrapping_add(pick(hash(i))));
        black_box(sum);
        started.elapsed().as_secs_f64()
    });
    count as f64 / seconds / 1e6
}
