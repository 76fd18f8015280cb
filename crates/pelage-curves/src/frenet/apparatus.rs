//! A curve as where it starts, how it is turned there, and how it bends.
//!
//! Source: document 000, section 4.1: nodes joined by helix segments.

use super::{Frame, FrenetError, Sample, SpaceCurve, Step};
use glam::DVec3;

/// A part of a curve whose curvature and torsion are constant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Segment {
    /// Arc length; not negative.
    pub length: f64,
    /// Radians per unit of length; negative where the curve bends away from its normal.
    pub curvature: f64,
    /// Radians per unit of length; positive for a right-handed screw.
    pub torsion: f64,
}

impl Segment {
    /// κ ds and τ ds.
    #[inline(always)]
    pub(super) fn angles(self) -> (f64, f64) {
        (self.curvature * self.length, self.torsion * self.length)
    }
}

/// A whole curve by the Fundamental Theorem of Curves.
#[derive(Clone, Debug, PartialEq)]
pub struct Apparatus {
    /// First point.
    pub start: DVec3,
    /// Basis there.
    pub frame: Frame,
    /// How it goes on; none for a single point.
    pub segments: Vec<Segment>,
}

impl Apparatus {
    /// Takes `curve` apart into `segments` (at least one) of equal arc length.
    ///
    /// The parts are means over each segment, from its two bases, so a curve whose
    /// curvature varies comes back with an error of the second order in the step. A
    /// curve without length, or that is straight, has no curvature and some basis.
    ///
    /// # Errors
    ///
    /// [`FrenetError::NotFinite`] where the curve is not a number.
    pub fn of(curve: &impl SpaceCurve, segments: usize) -> Result<Self, FrenetError> {
        Self::of_samples(&Sample::along(curve, segments)?)
    }

    /// `segments + 1` points, the ends of the segments, by exact helix steps.
    ///
    /// ```
    /// use pelage_curves::{DVec3, frenet::{Apparatus, Frame, Segment}};
    /// let half = Segment { length: std::f64::consts::PI, curvature: 1.0, torsion: 0.0 };
    /// let circle = Apparatus { start: DVec3::ZERO, frame: Frame::IDENTITY, segments: vec![half; 2] };
    /// assert!(circle.points()[1].distance(DVec3::Y * 2.0) < 1e-15);
    /// assert!(circle.points()[2].length() < 1e-15);
    /// ```
    pub fn points(&self) -> Vec<DVec3> {
        let (mut point, mut frame) = (self.start, self.frame);
        let mut points = vec![point];
        points.extend(self.segments.iter().map(|&segment| {
            let step = Step::new(segment);
            point += step.shift(&frame);
            frame = step.frame(&frame);
            point
        }));
        points
    }

    /// The bases at [`points`](Self::points).
    pub fn frames(&self) -> Vec<Frame> {
        let mut frame = self.frame;
        let mut frames = vec![frame];
        frames.extend(self.segments.iter().map(|&segment| {
            frame = Step::new(segment).frame(&frame);
            frame
        }));
        frames
    }

    /// Length of the curve.
    pub fn length(&self) -> f64 {
        self.segments.iter().map(|segment| segment.length).sum()
    }
}
