//! The guides of one interpolation group, ready to be mixed.

use crate::guide::Guide;
use crate::locator::{Locator, Near};
use crate::stages::interpolate::{self, Row};
use pelage_curves::Vec3;
use pelage_surface::{Mesh, RootFrame};

/// The guides of one group as arrays.
#[derive(Clone, Debug)]
pub(crate) struct GuideSet {
    /// Segments of the group's hairs.
    pub segments: u32,
    /// `segments + 1` local vertices a guide, in rows, one guide after the other.
    pub vertices: Vec<Row>,
    /// Frame of each guide's root at rest.
    pub frames: Vec<RootFrame>,
    /// Direction at rest in which each guide leaves its root; unit vectors.
    pub directions: Vec<Vec3>,
    /// Length of each guide.
    pub lengths: Vec<f32>,
    /// Finds the guides nearest to a root.
    pub locator: Locator,
}

impl GuideSet {
    /// Resamples `guides` to `segments` each and prepares finding the `nearest`.
    pub(crate) fn new(mesh: &Mesh, guides: &[&Guide], segments: u32, nearest: usize) -> Self {
        let resampled: Vec<Guide> = guides
            .iter()
            .map(|g| g.resampled(segments as usize))
            .collect();
        Self {
            segments,
            vertices: resampled
                .iter()
                .flat_map(|g| interpolate::rows(&g.local))
                .collect(),
            frames: resampled.iter().map(|g| g.frame).collect(),
            directions: guides.iter().map(|g| g.direction()).collect(),
            lengths: resampled.iter().map(Guide::length).collect(),
            locator: Locator::new(
                mesh,
                resampled.iter().map(|g| g.frame.position).collect(),
                nearest,
            ),
        }
    }

    /// Number of guides.
    pub(crate) fn len(&self) -> usize {
        self.frames.len()
    }

    /// Every guide with its distance from `point`, as the locator measures it.
    pub(crate) fn all(&self, point: Vec3) -> impl Iterator<Item = Near> {
        self.frames
            .iter()
            .enumerate()
            .map(move |(guide, frame)| Near {
                guide: guide as u32,
                square: frame.position.distance_squared(point),
            })
    }

    /// Whether the group has no guide.
    pub(crate) fn is_empty(&self) -> bool {
        self.frames.is_empty()
    }
}
