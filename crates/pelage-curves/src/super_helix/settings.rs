//! What is asked of a fit, and what it gives.

use super::curve::SuperHelix;
use super::error::FitError;

/// When a fit is good enough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// As good as so many elements allow.
    Elements(usize),
    /// As few elements as keep the error, in the unit of the target.
    Error(f64),
    /// As few elements as keep the error, as a part of the target's length.
    RelativeError(f64),
}

/// How the normal equations of the global fit are solved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Solver {
    /// Exactly, by eliminating element by element from the tip: O(elements + samples).
    #[default]
    Sweep,
    /// By preconditioned conjugate gradients, as document 002 does: O(elements + samples)
    /// an iteration of them.
    ConjugateGradients,
}

/// What is asked of a fit.
///
/// ```
/// use pelage_curves::super_helix::{Goal, Settings};
/// let settings = Settings { turn_root: true, ..Settings::new(Goal::RelativeError(0.01)) };
/// assert!(settings.move_joints);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// When it is good enough.
    pub goal: Goal,
    /// Most elements that a bound of the error may take; 1000 at first.
    pub most_elements: usize,
    /// How many elements the reduction starts from, for [`Goal::Elements`]: more take
    /// longer and tell more of the error against elements. `None`: half as many again.
    pub start: Option<usize>,
    /// What a tangent that is off by a radian counts, as a part of the length: 0, at first,
    /// fits positions alone.
    pub orientation: f64,
    /// Whether the root frame may turn away from the target's tangent; not at first.
    pub turn_root: bool,
    /// Whether the places where elements meet are fitted too; they are at first. Document
    /// 002 moves them only when it removes an element.
    pub move_joints: bool,
    /// How the normal equations are solved.
    pub solver: Solver,
}

impl Settings {
    /// Those said above, for `goal`.
    pub fn new(goal: Goal) -> Self {
        Self {
            goal,
            most_elements: 1000,
            start: None,
            orientation: 0.0,
            turn_root: false,
            move_joints: true,
            solver: Solver::default(),
        }
    }

    pub(super) fn check(&self) -> Result<(), FitError> {
        if !(self.orientation >= 0.0 && self.orientation.is_finite()) {
            let found = self.orientation;
            return Err(FitError::Orientation { found });
        }
        match self.goal {
            Goal::Elements(0) => Err(FitError::NoElements),
            _ if self.most_elements == 0 => Err(FitError::NoElements),
            Goal::Error(found) | Goal::RelativeError(found)
                if !(found > 0.0 && found.is_finite()) =>
            {
                Err(FitError::Bound { found })
            }
            _ => Ok(()),
        }
    }
}

/// What a number of elements came to on the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reached {
    /// Number of elements.
    pub elements: usize,
    /// Largest distance from the target at the samples, at equal arc length, in its unit.
    pub worst: f64,
    /// Mean distance there.
    pub mean: f64,
}

/// A Super-Helix and how well it fits.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The curve; as long as the target, to the bit.
    pub curve: SuperHelix,
    /// No place of it is farther than this from the target's at equal arc length: an upper
    /// bound, in the target's unit. For a number of elements it is at most 2 % (and 1e-6 of
    /// the length) above what is so; where a bound was asked for it is as near as tells that
    /// it is kept. Where one is not kept it is the largest error at the samples, or more.
    pub worst: f64,
    /// Mean distance over samples at equal steps of arc length.
    pub mean: f64,
    /// Error against elements, fewest first. It never rises: more elements that did worse
    /// are told with the error of fewer, which they can take by cutting one in two.
    pub reached: Vec<Reached>,
    /// Whether the bound that was asked for is kept; true where none was.
    pub kept: bool,
    /// Steps of Levenberg–Marquardt in all.
    pub steps: usize,
}
