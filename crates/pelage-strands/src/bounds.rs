//! The smallest box around strands, widths included.

use crate::{Sink, SinkError, StrandBuffer};
use pelage_curves::{Vec3, catmull_rom};

/// An axis-aligned box; empty until something is added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Smallest coordinates.
    pub min: [f32; 3],
    /// Largest coordinates.
    pub max: [f32; 3],
}

impl Default for Bounds {
    fn default() -> Self {
        Self {
            min: [f32::INFINITY; 3],
            max: [f32::NEG_INFINITY; 3],
        }
    }
}

impl Bounds {
    /// Whether nothing was added.
    pub fn is_empty(&self) -> bool {
        (0..3).any(|k| self.min[k] > self.max[k])
    }

    /// Widens the box to hold the ball of `radius` around `point`. A point with a
    /// NaN coordinate adds nothing on that axis.
    pub fn add(&mut self, point: [f32; 3], radius: f32) {
        for (k, x) in point.into_iter().enumerate() {
            self.min[k] = self.min[k].min(x - radius);
            self.max[k] = self.max[k].max(x + radius);
        }
    }

    /// Widens the box to hold `other`.
    pub fn join(&mut self, other: &Bounds) {
        for k in 0..3 {
            self.min[k] = self.min[k].min(other.min[k]);
            self.max[k] = self.max[k].max(other.max[k]);
        }
    }

    /// Length of the diagonal; 0 for an empty box.
    pub fn diagonal(&self) -> f32 {
        if self.is_empty() {
            return 0.0;
        }
        (0..3)
            .map(|k| self.max[k] - self.min[k])
            .map(|side| side * side)
            .sum::<f32>()
            .sqrt()
    }

    /// Box of all curves in `strands`, widened by half the largest width of each.
    pub fn of(strands: &StrandBuffer) -> Self {
        let mut bounds = Self::default();
        for strand in 0..strands.len() {
            let points = strands.strand_points(strand);
            let width = strands.widths.get(strands.vertices(strand)).unwrap_or(&[]);
            let radius = width.iter().copied().fold(0.0, f32::max) / 2.0;
            // The tight box of a curve costs much more than this one, and most curves
            // lie far inside the box of those before them.
            if bounds.holds(&Self::around(points), radius) {
                continue;
            }
            let Some((low, high)) = catmull_rom::bounds(points) else {
                continue;
            };
            bounds.add(low.to_array(), radius);
            bounds.add(high.to_array(), radius);
        }
        bounds
    }

    /// A box that the Catmull-Rom curve through `points` does not leave: its Bézier
    /// points are at most a sixth of the points' extent away from them.
    fn around(points: &[Vec3]) -> Self {
        let least = |a: Vec3, b: &Vec3| a.min(*b);
        let low = points.iter().fold(Vec3::INFINITY, least);
        let high = points.iter().fold(Vec3::NEG_INFINITY, |a, b| a.max(*b));
        // A little more than a sixth, for the rounding of either side.
        let margin = (high - low) * 0.167;
        Self {
            min: (low - margin).to_array(),
            max: (high + margin).to_array(),
        }
    }

    fn holds(&self, other: &Self, radius: f32) -> bool {
        (0..3).all(|k| self.min[k] <= other.min[k] - radius && other.max[k] + radius <= self.max[k])
    }
}

/// Gathers the bounds of each frame and of all of them.
#[derive(Clone, Debug, Default)]
pub struct BoundsSink {
    /// One box a frame.
    pub frames: Vec<Bounds>,
}

impl BoundsSink {
    /// The box of all frames together.
    pub fn all(&self) -> Bounds {
        let mut all = Bounds::default();
        self.frames.iter().for_each(|b| all.join(b));
        all
    }
}

impl Sink for BoundsSink {
    fn begin_frame(&mut self, _index: usize) -> Result<(), SinkError> {
        self.frames.push(Bounds::default());
        Ok(())
    }

    fn write(&mut self, strands: &StrandBuffer) -> Result<(), SinkError> {
        if self.frames.is_empty() {
            self.frames.push(Bounds::default());
        }
        if let Some(frame) = self.frames.last_mut() {
            frame.join(&Bounds::of(strands));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn half_the_width_is_added_on_every_side() {
        let mut strands = StrandBuffer::new();
        strands.points = vec![[0.0; 3], [0.0, 0.0, 1.0]];
        strands.widths = vec![0.2, 0.1];
        strands.offsets = vec![0, 2];
        let bounds = Bounds::of(&strands);
        assert_eq!(bounds.min, [-0.1, -0.1, -0.1]);
        assert_eq!(bounds.max, [0.1, 0.1, 1.1]);
    }

    proptest! {
        #[test]
        fn the_box_of_many_is_the_box_of_the_boxes_of_each(
            curves in prop::collection::vec(
                (prop::collection::vec(prop::array::uniform3(-4i8..5), 1..6), 0.0f32..0.5), 0..30
            ),
        ) {
            let (mut all, mut joined) = (StrandBuffer::new(), Bounds::default());
            for (points, width) in curves {
                let mut one = StrandBuffer::new();
                one.points = points.iter().map(|p| p.map(f32::from)).collect();
                one.widths = vec![width; points.len()];
                one.offsets = vec![0, points.len() as u32];
                joined.join(&Bounds::of(&one));
                all.points.extend(&one.points);
                all.widths.extend(&one.widths);
                all.offsets.push(all.points.len() as u32);
            }
            prop_assert_eq!(Bounds::of(&all), joined);
        }
    }

    #[test]
    fn nothing_has_no_bounds() {
        assert!(Bounds::of(&StrandBuffer::new()).is_empty());
    }
}
