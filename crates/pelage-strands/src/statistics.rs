//! Counts, lengths and widths of a stream, gathered as it passes.

use crate::{Bounds, Sink, SinkError, StrandBuffer};

/// Smallest, largest and mean of a quantity; NaN values are left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Smallest value seen; infinity where nothing was seen.
    pub min: f64,
    /// Largest value seen; minus infinity where nothing was seen.
    pub max: f64,
    sum: f64,
    count: u64,
}

impl Default for Range {
    fn default() -> Self {
        Self {
            min: f64::INFINITY,
            max: f64::NEG_INFINITY,
            sum: 0.0,
            count: 0,
        }
    }
}

impl Range {
    /// Adds a value.
    pub fn add(&mut self, value: f64) {
        if !value.is_nan() {
            self.min = self.min.min(value);
            self.max = self.max.max(value);
            self.sum += value;
            self.count += 1;
        }
    }

    /// Mean of the values, 0 where nothing was seen.
    pub fn mean(&self) -> f64 {
        if self.count == 0 {
            0.0
        } else {
            self.sum / self.count as f64
        }
    }

    /// How many values were added.
    pub fn count(&self) -> u64 {
        self.count
    }
}

/// What a stream of strands amounts to.
#[derive(Clone, Debug, Default)]
pub struct Statistics {
    /// Strands.
    pub strands: u64,
    /// Vertices of all strands.
    pub vertices: u64,
    /// Vertices a strand.
    pub vertices_per_strand: Range,
    /// Length of the polygon through a strand's vertices.
    pub length: Range,
    /// Width at vertices.
    pub width: Range,
    /// Box around the curves, widths included.
    pub bounds: Bounds,
}

impl Statistics {
    /// Statistics of one buffer.
    pub fn of(strands: &StrandBuffer) -> Self {
        let mut statistics = Self::default();
        statistics.add(strands);
        statistics
    }

    /// Adds all strands of a buffer.
    pub fn add(&mut self, strands: &StrandBuffer) {
        self.strands += strands.len() as u64;
        self.vertices += strands.points.len() as u64;
        for strand in 0..strands.len() {
            let points = strands.strand_points(strand);
            self.vertices_per_strand.add(points.len() as f64);
            let length: f64 = points.windows(2).map(|w| w[0].distance(w[1]) as f64).sum();
            self.length.add(length);
        }
        strands
            .widths
            .iter()
            .for_each(|&w| self.width.add(w as f64));
        self.bounds.join(&Bounds::of(strands));
    }
}

impl Sink for Statistics {
    fn begin_frame(&mut self, _index: usize) -> Result<(), SinkError> {
        let bounds = self.bounds;
        *self = Self {
            bounds,
            ..Self::default()
        };
        Ok(())
    }

    fn write(&mut self, strands: &StrandBuffer) -> Result<(), SinkError> {
        self.add(strands);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_lengths_and_widths_add_up() {
        let mut strands = StrandBuffer::new();
        strands.points = vec![[0.0; 3], [3.0, 4.0, 0.0], [0.0; 3], [0.0, 0.0, 1.0]];
        strands.widths = vec![1.0, 2.0, 3.0, f32::NAN];
        strands.offsets = vec![0, 2, 4];
        let s = Statistics::of(&strands);
        assert_eq!((s.strands, s.vertices), (2, 4));
        assert_eq!(
            (s.length.min, s.length.max, s.length.mean()),
            (1.0, 5.0, 3.0)
        );
        assert_eq!((s.width.max, s.width.count()), (3.0, 3));
    }
}
