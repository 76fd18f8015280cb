//! The curve to be fitted, sampled evenly along itself, its length the unit.

use super::error::FitError;
use crate::frenet::{FrenetError, Measure, SpaceCurve, unit};
use glam::DVec3;

/// A curve whose arc length is known, scaled to length 1 and moved to the origin.
pub(super) struct Target<'a, C> {
    curve: &'a C,
    measure: Measure,
    /// First point, in the curve's own unit.
    pub start: DVec3,
    /// In the curve's own unit; 0 for a curve without length.
    pub length: f64,
}

/// Samples of a target at equal steps of arc length.
#[derive(Clone, Debug)]
pub(super) struct Samples {
    /// One more than steps; the first is the origin.
    pub points: Vec<DVec3>,
    /// Unit tangents there; where the curve stands still, that before.
    pub tangents: Vec<DVec3>,
    /// Sum of the angles between neighbouring tangents, in radians.
    pub turning: f64,
}

/// Fewest and most steps that a target is sampled with before a fit is known to need more.
const STEPS: [usize; 2] = [48, 4096];

/// Steps are halved until the curve turns by this on the mean of one, in radians: a wave
/// has fifteen steps or more.
const TURN: f64 = 0.4;

impl<'a, C: SpaceCurve> Target<'a, C> {
    pub fn new(curve: &'a C) -> Result<Self, FitError> {
        let measure = Measure::new(curve)?;
        let start = curve.at(0, 0.0)[0];
        if !start.is_finite() {
            return Err(FrenetError::NotFinite { index: 0 }.into());
        }
        let length = measure.total();
        Ok(Self {
            curve,
            measure,
            start,
            length,
        })
    }

    /// Position in units of the length, and the velocity, at the part `s` of it.
    pub fn at(&self, s: f64) -> [DVec3; 2] {
        let (piece, t) = self.measure.locate(self.curve, s * self.length);
        let [position, velocity, _] = self.curve.at(piece, t);
        [(position - self.start) / self.length, velocity]
    }

    /// As many steps as the curve's pieces and bends ask for.
    pub fn samples(&self) -> Samples {
        let mut steps = self.curve.pieces().clamp(STEPS[0], STEPS[1]);
        let mut samples = self.sampled(steps);
        while samples.turning > TURN * steps as f64 && steps < STEPS[1] {
            steps = (2 * steps).min(STEPS[1]);
            samples = self.sampled(steps);
        }
        samples
    }

    pub fn sampled(&self, steps: usize) -> Samples {
        let (mut points, mut tangents) = (Vec::new(), Vec::new());
        for i in 0..=steps {
            let [point, velocity] = self.at(i as f64 / steps as f64);
            points.push(point);
            tangents.push(unit(velocity));
        }
        let mut before = tangents.iter().flatten().next().copied();
        let filled = tangents.into_iter().map(|tangent| {
            before = tangent.or(before);
            before.unwrap_or(DVec3::Z)
        });
        let tangents: Vec<DVec3> = filled.collect();
        let angle = |t: &[DVec3]| libm::atan2(t[0].cross(t[1]).length(), t[0].dot(t[1]));
        Samples {
            turning: tangents.windows(2).map(angle).sum(),
            tangents,
            points,
        }
    }
}

impl Samples {
    pub fn steps(&self) -> usize {
        self.points.len() - 1
    }

    /// Arc length of a sample.
    #[inline(always)]
    pub fn s(&self, index: usize) -> f64 {
        index as f64 / self.steps() as f64
    }
}
