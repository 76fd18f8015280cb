//! From samples to pixels.
//!
//! A pixel is the weighted mean of all samples within 1.5 pixels, weighted by a
//! Blackman-Harris window in each direction: as smooth as a Gaussian, but it ends.

use crate::color::Rgb;
use std::f32::consts::TAU;

/// Entries of the table of the window.
const ENTRIES: usize = 128;

/// A ray's colour and its place in its pixel.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sample {
    /// Radiance.
    pub rgb: [f32; 3],
    /// Place in the pixel: 16 bits to the right, 16 bits down.
    pub at: u32,
}

impl Sample {
    /// Place in the pixel, each 0..1.
    pub fn place(at: u32) -> [f32; 2] {
        [at >> 16, at & 0xffff].map(|bits| (bits as f32 + 0.5) / 65536.0)
    }
}

/// The window, tabulated.
pub(crate) struct Filter {
    table: Vec<f32>,
}

impl Filter {
    /// Pixels on each side that a pixel takes samples from.
    pub const REACH: usize = 1;

    /// The Blackman-Harris window over ±1.5 pixels.
    pub fn new() -> Self {
        let window = |k: usize| {
            let x = 0.5 + 0.5 * (k as f32 + 0.5) / ENTRIES as f32;
            let c = |n: f32| libm::cosf(n * TAU * x);
            0.35875 - 0.48829 * c(1.0) + 0.14128 * c(2.0) - 0.01168 * c(3.0)
        };
        Self {
            table: (0..ENTRIES).map(window).collect(),
        }
    }

    fn weight(&self, distance: f32) -> f32 {
        let k = (distance.abs() * (ENTRIES as f32 / 1.5)) as usize;
        self.table[k.min(ENTRIES - 1)]
    }

    /// The pixel of `column` in the middle of `rows`, each row with `per_pixel`
    /// samples a pixel; `None` rows are outside the picture.
    pub fn pixel(&self, rows: [Option<&[Sample]>; 3], column: usize, per_pixel: usize) -> Rgb {
        let (mut sum, mut total) = (Rgb::ZERO, 0.0);
        for (dy, row) in rows.into_iter().enumerate() {
            let Some(row) = row else { continue };
            let width = row.len() / per_pixel;
            for x in column.saturating_sub(1)..(column + 2).min(width) {
                let shift = [x as f32 - column as f32 - 0.5, dy as f32 - 1.5];
                for sample in &row[x * per_pixel..(x + 1) * per_pixel] {
                    let [u, v] = Sample::place(sample.at);
                    let weight = self.weight(u + shift[0]) * self.weight(v + shift[1]);
                    sum += Rgb::from(sample.rgb) * weight;
                    total += weight;
                }
            }
        }
        if total > 0.0 { sum / total } else { Rgb::ZERO }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_even_field_stays_even_up_to_the_edges() {
        let row: Vec<Sample> = (0..12)
            .map(|i| Sample {
                rgb: [0.25, 0.5, 1.0],
                at: crate::sampling::hash(i),
            })
            .collect();
        let filter = Filter::new();
        for column in 0..3 {
            let pixel = filter.pixel([None, Some(&row), Some(&row)], column, 4);
            assert!((pixel - Rgb::new(0.25, 0.5, 1.0)).length() < 1e-5);
        }
    }
}
