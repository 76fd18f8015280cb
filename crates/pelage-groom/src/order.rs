//! The order in which hairs are made, and the chunks they are cut into.

use crate::RootPlan;
use crate::generate::{GenerateError, Request};
use crate::in_order::Chunks;
use pelage_strands::Sink;
use pelage_surface::{AlongSurface, SurfacePoint};

/// Most hairs that are sorted along the surface: 2 GB.
const MOST_SORTED: u64 = 250_000_000;

/// The order in which hairs come.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// By their indices; along the surface where the sink does not mind (see
    /// [`Sink::takes_any_order`]).
    #[default]
    Auto,
    /// By their indices: the first n are a thinner coat, and ranges of hairs one after the
    /// other make the same as all at once.
    Index,
    /// Neighbours after each other, which is faster, since they are made of the same triangles,
    /// guides and texels. They are the same hairs, in one order in all frames; but the first n
    /// are a patch, and other ranges of hairs have another order. Random roots and blue noise
    /// take 8 bytes a hair, and no more than 250 million of them go at once.
    Surface,
}

impl Order {
    /// What it comes to where `sink` gets the hairs; those that would have to be `sorted` first
    /// are no faster along the surface.
    fn toward(self, sink: &dyn Sink, sorted: bool) -> Self {
        match self {
            Self::Auto if sink.takes_any_order() && !sorted => Self::Surface,
            Self::Auto => Self::Index,
            order => order,
        }
    }
}

/// The hairs of a run, chunk by chunk.
pub(crate) enum Parts<'a> {
    Ranges(Chunks),
    Along(AlongSurface<'a>),
}

impl<'a> Parts<'a> {
    /// Those of the hairs of `request` that have a root, about `each` at a time, as they are to
    /// come to `sink`.
    pub(crate) fn new(
        plan: &'a RootPlan,
        request: &Request,
        sink: &dyn Sink,
        each: u64,
    ) -> Result<Self, GenerateError> {
        let (hairs, sorted) = (plan.rooted(request.hairs.clone()), plan.is_sorted_along());
        if request.order.toward(sink, sorted) == Order::Index {
            return Ok(Self::Ranges(Chunks::new(hairs, each)));
        }
        let found = hairs.end.saturating_sub(hairs.start);
        if sorted && found > MOST_SORTED {
            let limit = MOST_SORTED;
            return Err(GenerateError::TooManyToSort { found, limit });
        }
        let along = plan.along_surface(hairs.clone(), each);
        Ok(along.map_or_else(|| Self::Ranges(Chunks::new(hairs, each)), Self::Along))
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
