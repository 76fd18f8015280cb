//! A moment in which hairs are made, and what all hairs of it share.

use crate::PlanError;
use crate::capture::Capture;
use crate::curves::Curves;
use crate::guide::refuse_far;
use crate::guide_shapes::GuideShapes;
use crate::plan::Plan;
use pelage_curves::Vec3;
use pelage_surface::{Mesh, RootFrame};
use std::sync::Arc;

/// A moment in which hairs are made: where the surface and the guides are, and the time.
/// The default is the rest pose at time 0.
#[derive(Clone, Debug, Default)]
pub struct Pose {
    /// The posed surface, with the topology of the rest mesh (see [`Mesh::posed`]); `None`
    /// is the rest pose itself.
    pub surface: Option<Arc<Mesh>>,
    /// The posed guides in the order of [`Groom::guides`](crate::Groom::guides), root
    /// first, in the space of `surface`; `None` lets them move with the skin. Each may have
    /// another number of vertices than at rest.
    pub guides: Option<Arc<Vec<Vec<Vec3>>>>,
    /// In frames; moves the animated part of frizz.
    pub time: f64,
}

/// A pose ready for the hairs of all chunks.
#[derive(Clone, Debug)]
pub struct Posed {
    surface: Option<Arc<Mesh>>,
    /// Shapes of the guides of each group.
    guides: Option<Vec<GuideShapes>>,
    time: f32,
    /// The hairs in the middles of clumps, level by level.
    middles: Vec<Curves>,
}

/// A [`Posed`] as the pipeline looks at it.
#[derive(Clone, Copy)]
pub(crate) struct Moment<'a> {
    pub surface: Option<&'a Mesh>,
    pub guides: Option<&'a [GuideShapes]>,
    pub time: f32,
    pub middles: &'a [Curves],
}

impl Posed {
    pub(crate) fn moment(&self) -> Moment<'_> {
        Moment {
            surface: self.surface.as_deref(),
            guides: self.guides.as_deref(),
            time: self.time,
            middles: &self.middles,
        }
    }
}

impl Moment<'_> {
    /// Time 0 of the rest pose, where there are no clumps.
    pub(crate) const REST: Self = Moment {
        surface: None,
        guides: None,
        time: 0.0,
        middles: &[],
    };
}

impl Plan {
    /// Makes `pose` ready: what is the same for all its hairs is done here, once.
    pub fn posed(&self, pose: &Pose) -> Result<Posed, PlanError> {
        let guides = pose.guides.as_ref();
        let mut posed = Posed {
            guides: guides
                .map(|guides| self.posed_guides(pose.surface.as_deref(), guides))
                .transpose()?,
            surface: pose.surface.clone(),
            time: pose.time as f32,
            middles: Vec::new(),
        };
        posed.middles = self.middle_hairs(&posed.moment());
        Ok(posed)
    }

    /// Shapes of the guides, group by group.
    fn posed_guides(
        &self,
        surface: Option<&Mesh>,
        curves: &[Vec<Vec3>],
    ) -> Result<Vec<GuideShapes>, PlanError> {
        if curves.len() != self.guide_count() {
            return Err(PlanError::PosedGuides {
                found: curves.len(),
                expected: self.guide_count(),
            });
        }
        for (index, curve) in curves.iter().enumerate() {
            refuse_far(index, curve)?;
        }
        let surface = surface.unwrap_or(self.rest());
        let groups = self.guides.iter();
        Ok(groups.map(|guides| guides.posed(surface, curves)).collect())
    }

    /// Whether hairs of `moment` can have another shape than those at rest.
    pub(crate) fn differs(&self, moment: &Moment) -> bool {
        let moves = self.fields.frizz.as_ref().is_some_and(|f| f.is_moving());
        moment.surface.is_some() || moment.guides.is_some() || (moves && moment.time != 0.0)
    }

    /// Frames of the roots of `capture`; `posed` is where they are put if they are not
    /// those at rest.
    pub(crate) fn frames<'a>(
        &self,
        capture: &'a Capture,
        moment: &Moment,
        posed: &'a mut Vec<RootFrame>,
    ) -> &'a [RootFrame] {
        if moment.surface.is_none() && !self.roots.is_displaced() {
            return &capture.frames;
        }
        let surface = moment.surface.unwrap_or(self.rest());
        posed.clear();
        self.roots.frames(surface, &capture.roots, posed);
        posed
    }
}
