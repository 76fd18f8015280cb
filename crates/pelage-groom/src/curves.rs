//! The vertices of many curves, one curve after the other.

use pelage_curves::Vec3;
use std::ops::Range;

/// The curves of a chunk.
#[derive(Clone, Debug, Default)]
pub(crate) struct Curves {
    /// All vertices of all curves.
    pub vertices: Vec<Vec3>,
    /// Where each curve's vertices start; one more entry than curves.
    pub starts: Vec<u32>,
}

impl Curves {
    /// Number of curves.
    pub(crate) fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Where the vertices of curve `i` lie.
    pub(crate) fn range(&self, i: usize) -> Range<usize> {
        self.starts[i] as usize..self.starts[i + 1] as usize
    }

    /// The vertices of curve `i`.
    pub(crate) fn get(&self, i: usize) -> &[Vec3] {
        &self.vertices[self.range(i)]
    }

    /// The vertices of curve `i`, to be changed.
    pub(crate) fn get_mut(&mut self, i: usize) -> &mut [Vec3] {
        let range = self.range(i);
        &mut self.vertices[range]
    }

    /// Makes room for curves of so many vertices each; what they hold is left open.
    pub(crate) fn lay_out(&mut self, lengths: impl Iterator<Item = u32>) {
        self.starts.clear();
        self.starts.push(0);
        let mut end = 0;
        self.starts.extend(lengths.map(|length| {
            end += length;
            end
        }));
        self.vertices.resize(end as usize, Vec3::ZERO);
    }
}
