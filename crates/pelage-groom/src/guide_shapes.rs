//! The shapes of the guides of one group, ready to be mixed: at rest, or as a pose has them.

use crate::recipe::{Interpolation, InterpolationSpace};
use crate::stages::frenet::{self, Corner};
use crate::stages::helix::Helices;
use crate::stages::interpolate::{Row, rows};
use pelage_curves::Vec3;
use rayon::prelude::*;

/// Guides of one number of segments as arrays.
#[derive(Clone, Debug)]
pub(crate) struct GuideShapes {
    /// `segments + 1` local vertices a guide, in rows, one guide after the other.
    pub vertices: Vec<Row>,
    /// What else hairs are mixed of.
    pub mixed: Mixed,
}

/// What of guides is mixed beside their vertices.
#[derive(Clone, Debug)]
pub(crate) enum Mixed {
    /// Nothing.
    Vertices,
    /// `segments` corners a guide, one guide after the other.
    Frenet(Vec<Corner>),
    /// Their Super-Helices.
    Helix(Helices),
}

impl GuideShapes {
    /// The shapes of guides with these local vertices, to be mixed as `interpolation` says.
    pub(crate) fn new(guides: &[Vec<Vec3>], interpolation: &Interpolation) -> Self {
        let corners = || {
            let guides = guides.par_iter().map(|guide| frenet::corners(guide));
            guides.collect::<Vec<Vec<Corner>>>().concat()
        };
        Self {
            vertices: guides.iter().flat_map(|guide| rows(guide)).collect(),
            mixed: match interpolation.space {
                InterpolationSpace::Vertices => Mixed::Vertices,
                InterpolationSpace::Frenet => Mixed::Frenet(corners()),
                InterpolationSpace::Helix => {
                    Mixed::Helix(Helices::fit(guides, interpolation.elements as usize))
                }
            },
        }
    }
}
