//! Frames along a curve by four rules, each with where it fails.
//!
//! Source: document 003 (Frenet, a fixed up-axis, and after J. Bloomenthal, "Calculation of
//! Reference Frames along a Space Curve", 1990, the propagated frame), with its errata;
//! document 004, section 2.2.8 (double reflection, after Wang et al. 2008).
//!
//! | | inflection | straight part | tangent along the up-axis | cusp, opposite tangents | coincident points | helix |
//! |---|---|---|---|---|---|---|
//! | [`Frenet`](Framing::Frenet) | jumps by half a turn | carried, then jumps | – | may jump by half a turn | carried | turns by the torsion |
//! | [`UpAxis`](Framing::UpAxis) | – | – | whirls near it, carried at it | jumps by half a turn | – | turns back and forth |
//! | [`Propagated`](Framing::Propagated) | – | – | – | normal kept | – | error of the second order in the step |
//! | [`DoubleReflection`](Framing::DoubleReflection) | – | – | – | normal kept | as propagated | of the fourth |
//!
//! What a rule does not define is *carried*: the frame before, turned with the tangent by
//! the smallest rotation. So every rule gives an orthonormal, right-handed frame for every
//! finite sample. [`twists`] measures how far frames turn about the tangent, and [`close_frames`]
//! makes the ends of a closed curve meet.

mod carry;
mod closing;

use crate::frenet::{Frame, FrenetError, Sample, perpendicular, tangents};
use glam::DVec3;

pub(crate) use carry::turned;
pub use closing::{close_frames, twists};

/// How the frames of a curve are chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Framing {
    /// The normal points where the curve bends to.
    Frenet,
    /// The normal is this axis times the tangent (a cross product), so the binormal points
    /// along the axis as far as it can. The axis has any length but 0.
    UpAxis(DVec3),
    /// The frame before, turned by the smallest rotation of the tangent.
    Propagated,
    /// The frame before, reflected twice: the least twist, to the fourth order.
    #[default]
    DoubleReflection,
}

impl Framing {
    /// A right-handed, orthonormal frame at each sample; none for none.
    ///
    /// `first` is where the first normal should point (made perpendicular to the tangent;
    /// some other direction where it cannot be). Frenet frames and those of an up-axis take
    /// it only where they have no normal of their own. Where the curve stands still it
    /// keeps the tangent that it had.
    ///
    /// # Errors
    ///
    /// [`FrenetError::NotFinite`] naming the first sample that is not.
    ///
    /// ```
    /// use pelage_curves::frenet::Sample;
    /// use pelage_curves::{Chain, DVec3, Framing};
    /// let s = [[0.0, 0.0], [1.0, 1.0], [2.0, 0.0], [3.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 0.0));
    /// let samples = Sample::along(&Chain::catmull_rom(&s, 0.5)?, 20)?;
    /// // In a plane, a frame that does not twist keeps the plane's normal …
    /// let calm = Framing::DoubleReflection.frames(&samples, DVec3::Z)?;
    /// assert!(calm.iter().all(|frame| frame.normal.distance(DVec3::Z) < 1e-12));
    /// // … while the Frenet frame turns round where the curve bends the other way.
    /// let frenet = Framing::Frenet.frames(&samples, DVec3::Z)?;
    /// assert!(frenet[4].binormal.dot(frenet[16].binormal) < -0.99);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn frames(self, samples: &[Sample], first: DVec3) -> Result<Vec<Frame>, FrenetError> {
        if let Some(index) = samples.iter().position(|sample| !sample.is_finite()) {
            return Err(FrenetError::NotFinite { index });
        }
        let tangents = tangents(samples);
        let Some(&start) = tangents.first() else {
            return Ok(Vec::new());
        };
        let own = self.own_normals(samples, &tangents);
        let mut frame = Frame::new(start, self.start(&own, &tangents).unwrap_or(first));
        let mut frames = vec![frame];
        for i in 1..samples.len() {
            let step = samples[i].position - samples[i - 1].position;
            let normal = match own.get(i).copied().flatten() {
                Some(normal) => normal,
                None if self == Self::DoubleReflection => {
                    carry::reflected_twice(&frame, step, tangents[i])
                }
                None => carry::turned(&frame, tangents[i]),
            };
            frame = Frame::new(tangents[i], normal);
            frames.push(frame);
        }
        Ok(frames)
    }

    /// The normals that do not depend on the frame before, where there are such.
    fn own_normals(self, samples: &[Sample], tangents: &[DVec3]) -> Vec<Option<DVec3>> {
        let pairs = samples.iter().zip(tangents);
        match self {
            Self::Frenet => {
                let length = samples.last().map_or(0.0, |last| last.s) - samples[0].s;
                pairs.map(|(sample, &t)| sample.normal(t, length)).collect()
            }
            Self::UpAxis(axis) => {
                let across = |(_, &t): (_, &DVec3)| perpendicular(axis, t).map(|up| up.cross(t));
                pairs.map(across).collect()
            }
            Self::Propagated | Self::DoubleReflection => Vec::new(),
        }
    }

    /// The first normal of one's own, carried back to the start.
    fn start(self, own: &[Option<DVec3>], tangents: &[DVec3]) -> Option<DVec3> {
        let at = own.iter().position(Option::is_some)?;
        let frame = Frame::new(tangents[at], own[at]?);
        let back = tangents[..at].iter().rev();
        let start = back.fold(frame, |f, &t| Frame::new(t, carry::turned(&f, t)));
        Some(start.normal)
    }
}

#[cfg(test)]
mod tests;
