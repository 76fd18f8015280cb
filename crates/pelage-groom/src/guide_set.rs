//! The guides of one interpolation group, ready to be mixed.

use crate::guide::Guide;
use crate::guide_shapes::GuideShapes;
use crate::locator::{Locator, Near};
use crate::recipe::Interpolation;
use pelage_curves::Vec3;
use pelage_surface::{Mesh, RootFrame, SurfacePoint};

/// The guides of one group as arrays.
#[derive(Clone, Debug)]
pub(crate) struct GuideSet {
    /// Segments of the group's hairs.
    pub segments: u32,
    /// How hairs are mixed of them.
    interpolation: Interpolation,
    /// Their shapes at rest.
    pub shapes: GuideShapes,
    /// Number of each guide among all of the groom.
    pub numbers: Vec<usize>,
    /// Where each guide grows.
    pub roots: Vec<SurfacePoint>,
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
    /// Resamples `guides`, each with its number among all of the groom, to `segments` each,
    /// and prepares mixing them by `interpolation` and finding the `nearest`.
    pub(crate) fn new(
        mesh: &Mesh,
        guides: &[(usize, &Guide)],
        segments: u32,
        interpolation: &Interpolation,
        nearest: usize,
    ) -> Self {
        let resampled: Vec<Guide> = guides
            .iter()
            .map(|(_, guide)| guide.resampled(segments as usize))
            .collect();
        Self {
            segments,
            interpolation: interpolation.clone(),
            shapes: GuideShapes::new(&locals(&resampled), interpolation),
            numbers: guides.iter().map(|(number, _)| *number).collect(),
            roots: guides.iter().map(|(_, guide)| guide.root).collect(),
            frames: resampled.iter().map(|g| g.frame).collect(),
            directions: guides.iter().map(|(_, guide)| guide.direction()).collect(),
            lengths: resampled.iter().map(Guide::length).collect(),
            locator: Locator::new(
                mesh,
                resampled.iter().map(|g| g.frame.position).collect(),
                nearest,
            ),
        }
    }

    /// Shapes of the guides as `curves` has them, one curve for each guide of the groom, in
    /// the space of `surface`.
    pub(crate) fn posed(&self, surface: &Mesh, curves: &[Vec<Vec3>]) -> GuideShapes {
        let guides = self.numbers.iter().zip(&self.roots);
        let posed = guides.map(|(&number, &root)| {
            let guide = Guide::of_curve(surface, root, &curves[number]);
            guide.resampled(self.segments as usize).local
        });
        GuideShapes::new(&posed.collect::<Vec<_>>(), &self.interpolation)
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

fn locals(guides: &[Guide]) -> Vec<Vec<Vec3>> {
    guides.iter().map(|guide| guide.local.clone()).collect()
}
