//! The shapes of the guides of one group, ready to be mixed: at rest, or as a pose has them.

use crate::recipe::InterpolationSpace;
use crate::stages::frenet::{self, Corner};
use crate::stages::interpolate::{Row, rows};
use pelage_curves::Vec3;
use rayon::prelude::*;

/// Guides of one number of segments as arrays.
#[derive(Clone, Debug)]
pub(crate) struct GuideShapes {
    /// `segments + 1` local vertices a guide, in rows, one guide after the other.
    pub vertices: Vec<Row>,
    /// `segments` corners a guide, one guide after the other; `None` where hairs are mixed
    /// by their vertices.
    pub corners: Option<Vec<Corner>>,
}

impl GuideShapes {
    /// The shapes of guides with these local vertices, to be mixed in `space`.
    pub(crate) fn new(guides: &[Vec<Vec3>], space: InterpolationSpace) -> Self {
        let corners = || {
            let guides = guides.par_iter().map(|guide| frenet::corners(guide));
            guides.collect::<Vec<Vec<Corner>>>().concat()
        };
        Self {
            vertices: guides.iter().flat_map(|guide| rows(guide)).collect(),
            corners: match space {
                InterpolationSpace::Vertices => None,
                InterpolationSpace::Frenet => Some(corners()),
            },
        }
    }
}
