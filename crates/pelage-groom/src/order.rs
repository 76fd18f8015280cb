//! The order in which hairs are made, and the chunks they are cut into.

use crate::RootPlan;
use crate::in_order::Chunks;
use pelage_surface::{AlongSurface, SurfacePoint};
use std::ops::Range;

/// The order in which hairs come.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// By their indices: the first n are a thinner coat, and ranges of hairs one after the
    /// other make the same as all at once.
    #[default]
    Index,
    /// Neighbours after each other, which is faster, since they are made of the same triangles,
    /// guides and texels. They are the same hairs, in one order in all frames; but the first n
    /// are a patch, and other ranges of hairs have another order. Random roots and blue noise
    /// take 8 bytes a hair.
    Surface,
}

/// The hairs of a run, chunk by chunk.
pub(crate) enum Parts<'a> {
    Ranges(Chunks),
    Along(AlongSurface<'a>),
}

impl<'a> Parts<'a> {
    /// Those of `hairs` that have a root, about `each` at a time.
    pub(crate) fn new(plan: &'a RootPlan, hairs: Range<u64>, order: Order, each: u64) -> Self {
        let hairs = plan.rooted(hairs);
        let along = match order {
            Order::Index => None,
            Order::Surface => plan.along_surface(hairs.clone(), each),
        };
        along.map_or_else(|| Self::Ranges(Chunks::new(hairs, each)), Self::Along)
    }

    pub(crate) fn count(&self) -> u64 {
        match self {
            Self::Ranges(chunks) => chunks.count(),
            Self::Along(along) => along.parts(),
        }
    }

    /// Appends the hairs of chunk `number` and their places.
    pub(crate) fn list(
        &self,
        plan: &RootPlan,
        number: u64,
        hairs: &mut Vec<u64>,
        places: &mut Vec<SurfacePoint>,
    ) {
        match self {
            Self::Ranges(chunks) => {
                let range = chunks.get(number);
                plan.places(range.clone(), places);
                hairs.extend(range);
            }
            Self::Along(along) => along.part(number, hairs, places),
        }
    }
}
