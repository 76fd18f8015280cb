//! From a curve to its curvature and torsion.
//!
//! Source: document 000, section 4.2, with its errata. Bases come from the first and the
//! second derivative (equations 39, 40, 43–45; the second is projected with the tangent
//! at its own point), and curvature and torsion are means over each interval, from the
//! turn between its two bases (equations 46–48; where that is small, b / ds and e / ds,
//! and what is small is an angle).
//!
//! Signs: a basis whose binormal would point away from the one before it is turned round,
//! so curvature changes sign at an inflection instead of the basis. Where the curve is
//! straight its normal stays what it was, carried to the new tangent; before the first
//! bend it is the first normal there is. Which of the two bases the curve starts with is
//! chosen such that it bends to its normal on the whole. A step must not turn the binormal by more than
//! a quarter, which would be taken for an inflection.

use super::frame::{perpendicular, unit};
use super::{Apparatus, Frame, FrenetError, Measure, Segment, SpaceCurve};
use glam::DVec3;

/// What is known of a curve at one of its points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Arc length up to here.
    pub s: f64,
    /// Position.
    pub position: DVec3,
    /// Derivative of the position with respect to any parameter that grows along the
    /// curve.
    pub first: DVec3,
    /// Second derivative with respect to the same parameter.
    pub second: DVec3,
}

/// Below this angle over the whole curve a curvature is rounding noise: the curve is
/// straight there.
const STRAIGHT: f64 = 1e-9;

/// Below this angle of a step, equations 47 and 48 are the same as b and e to rounding.
const SMALL: f64 = 1e-5;

impl Sample {
    /// `segments + 1` samples (two at least) at equal steps of arc length.
    ///
    /// # Errors
    ///
    /// [`FrenetError::NotFinite`] where the curve's length is not finite.
    pub fn along(curve: &impl SpaceCurve, segments: usize) -> Result<Vec<Self>, FrenetError> {
        let measure = Measure::new(curve)?;
        let segments = segments.max(1);
        let mut span = 0;
        let sample = |i: usize| {
            let s = measure.total() * i as f64 / segments as f64;
            let (piece, t) = measure.locate_next(curve, s, &mut span);
            let [position, first, second] = curve.at(piece, t);
            Self {
                s,
                position,
                first,
                second,
            }
        };
        Ok((0..=segments).map(sample).collect())
    }

    /// Unit normal, if the curve bends here; `length` is that of the whole curve.
    pub(crate) fn normal(&self, tangent: DVec3, length: f64) -> Option<DVec3> {
        let across = self.second - tangent * self.second.dot(tangent);
        let turn = across.length() / self.first.length_squared() * length;
        // A NaN is no bend either.
        if turn > STRAIGHT {
            perpendicular(across, tangent)
        } else {
            None
        }
    }

    pub(crate) fn is_finite(&self) -> bool {
        let vectors = [self.position, self.first, self.second];
        self.s.is_finite() && vectors.iter().all(|v| v.is_finite())
    }
}

impl Apparatus {
    /// Takes a curve apart that is known at some of its points, in order along it.
    ///
    /// # Errors
    ///
    /// [`FrenetError::Empty`] for no samples, [`FrenetError::NotFinite`] for one that is
    /// not.
    pub fn of_samples(samples: &[Sample]) -> Result<Self, FrenetError> {
        let start = samples.first().ok_or(FrenetError::Empty)?.position;
        if let Some(index) = samples.iter().position(|sample| !sample.is_finite()) {
            return Err(FrenetError::NotFinite { index });
        }
        let frames = frames(samples);
        let pairs = samples.windows(2).zip(frames.windows(2));
        let segments = pairs.map(|(s, f)| between(s[1].s - s[0].s, &f[0], &f[1]));
        let mut apparatus = Self {
            start,
            frame: frames[0],
            segments: segments.collect(),
        };
        let segments = apparatus.segments.iter();
        if bends_back(segments.map(|segment| segment.curvature * segment.length)) {
            apparatus.frame = apparatus.frame.turned_round();
            apparatus
                .segments
                .iter_mut()
                .for_each(|segment| segment.curvature = -segment.curvature);
        }
        Ok(apparatus)
    }
}

/// Whether angles of bends are clearly negative on the whole. An S, of which that cannot be
/// said, begins with a positive bend.
pub(super) fn bends_back(bends: impl Iterator<Item = f64>) -> bool {
    let [sum, size] = bends.fold([0.0, 0.0], |[sum, size], b| [sum + b, size + b.abs()]);
    sum < -0.05 * size
}

/// The basis at every sample.
fn frames(samples: &[Sample]) -> Vec<Frame> {
    let length = samples.last().map_or(0.0, |last| last.s) - samples[0].s;
    let tangents = tangents(samples);
    let normals: Vec<Option<DVec3>> = samples
        .iter()
        .zip(&tangents)
        .map(|(sample, &tangent)| sample.normal(tangent, length))
        .collect();
    let bends = normals.iter().position(|n| n.is_some());
    let mut normal = bends.and_then(|i| normals[i]).unwrap_or(DVec3::ZERO);
    // Back to the start along what is straight before the first bend.
    for &tangent in tangents[..bends.unwrap_or(0)].iter().rev() {
        normal = Frame::new(tangent, normal).normal;
    }
    let mut before = Frame::new(tangents[0], normal);
    tangents
        .iter()
        .zip(normals)
        .map(|(&tangent, normal)| {
            let frame = match normal {
                Some(normal) => Frame {
                    tangent,
                    normal,
                    binormal: tangent.cross(normal),
                },
                None => Frame::new(tangent, before.normal),
            };
            before = match frame.binormal.dot(before.binormal) < 0.0 {
                true => frame.turned_round(),
                false => frame,
            };
            before
        })
        .collect()
}

/// Unit tangents; where the curve stands still that before it, else the first one.
pub(crate) fn tangents(samples: &[Sample]) -> Vec<DVec3> {
    let own = samples.iter().map(|sample| unit(sample.first));
    let mut before = own.clone().flatten().next().unwrap_or(DVec3::Z);
    own.map(|tangent| {
        before = tangent.unwrap_or(before);
        before
    })
    .collect()
}

/// Mean curvature and torsion from the turn between two bases (equations 46–48).
fn between(length: f64, from: &Frame, to: &Frame) -> Segment {
    // Where the curve makes no way there is nothing to bend.
    if length <= 0.0 {
        return Segment::default();
    }
    let (a, b) = (to.tangent.dot(from.tangent), to.tangent.dot(from.normal));
    let (d, e) = (to.normal.dot(from.normal), to.normal.dot(from.binormal));
    let (c, f) = (
        to.tangent.dot(from.binormal),
        to.binormal.dot(from.binormal),
    );
    let across = (b * b + e * e).sqrt();
    let angle = libm::atan2(across, d);
    let (k, t) = if angle < SMALL {
        (b, e)
    } else if d >= 0.0 {
        (angle * b / across, angle * e / across)
    } else {
        axis_beyond_a_quarter([a, b, c], [d, e, f])
            .map(|part| angle * part)
            .into()
    };
    Segment {
        length,
        curvature: k / length,
        torsion: t / length,
    }
}

/// κ / w and τ / w where the angle is above a quarter turn. The larger comes from a or f
/// (equations 47 and 48), the other from c = (1 - d) κ τ / w²: a difference from 1, near
/// it, would leave half the digits.
fn axis_beyond_a_quarter([a, b, c]: [f64; 3], [d, e, f]: [f64; 3]) -> [f64; 2] {
    let versine = 1.0 - d;
    if a <= f {
        let k = ((1.0 - a).max(0.0) / versine).sqrt().copysign(b);
        [k, c / (versine * k)]
    } else {
        let t = ((1.0 - f).max(0.0) / versine).sqrt().copysign(e);
        [c / (versine * t), t]
    }
}

#[cfg(test)]
#[path = "analysis_tests.rs"]
mod tests;
