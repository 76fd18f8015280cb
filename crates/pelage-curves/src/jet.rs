//! A curve with three derivatives, and how it bends and winds there.
//!
//! Source: document 000, section 2 (curvature and torsion of a curve of any parameter).

use crate::frenet::SpaceCurve;
use glam::DVec3;

/// A curve that has three derivatives inside its pieces.
pub trait Jet: SpaceCurve {
    /// Position, first, second and third derivative with respect to `t` at `t` in 0..=1 of
    /// `piece`.
    fn jet(&self, piece: usize, t: f64) -> [DVec3; 4];
}

/// How a curve bends and winds at a point; independent of its parameter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bend {
    /// Radians per unit of length; not negative.
    pub curvature: f64,
    /// Radians per unit of length; positive for a right-handed screw, 0 where the curve is
    /// straight and so has none.
    pub torsion: f64,
}

/// Below this sine between the first and the second derivative they are one line.
const STRAIGHT: f64 = 1e-12;

impl Bend {
    /// Curvature and torsion from position and three derivatives with respect to any
    /// parameter, `None` where the curve stands still (a cusp, coincident vertices).
    ///
    /// ```
    /// use pelage_curves::{Bend, DVec3};
    /// // A helix of radius 3 that rises by 4 a radian, at angle 0.
    /// let jet = [DVec3::X * 3.0, DVec3::new(0.0, 3.0, 4.0), DVec3::X * -3.0, DVec3::Y * -3.0];
    /// let bend = Bend::of(jet).ok_or("stands still")?;
    /// assert!((bend.curvature - 3.0 / 25.0).abs() < 1e-15);
    /// assert!((bend.torsion - 4.0 / 25.0).abs() < 1e-15);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn of([_, first, second, third]: [DVec3; 4]) -> Option<Self> {
        let largest = first.abs().max_element();
        if largest <= 0.0 || !largest.is_finite() {
            return None;
        }
        // The unit of length taken out, nothing here can overflow that did not before.
        let speed = (first / largest).length() * largest;
        let (tangent, second, third) = (first / speed, second / speed, third / speed);
        let across = tangent.cross(second);
        let sine = across.length();
        let curvature = sine / speed;
        let straight = sine <= STRAIGHT * second.length();
        let torsion = match straight {
            true => 0.0,
            false => across.dot(third) / (sine * sine) / speed,
        };
        let bend = Self { curvature, torsion };
        (curvature.is_finite() && torsion.is_finite()).then_some(bend)
    }
}

/// `segments + 1` points at equal steps of arc length (to 1e-10 of the whole), ends
/// included, f64. A curve without length gives copies of its start; `segments` of 0 gives
/// one point.
///
/// # Errors
///
/// [`FrenetError::NotFinite`](crate::frenet::FrenetError::NotFinite) where the curve's
/// length is not finite.
///
/// ```
/// use pelage_curves::{Chain, DVec3, resample};
/// let line = Chain::catmull_rom(&[DVec3::ZERO, DVec3::X, DVec3::X * 4.0], 0.5)?;
/// let even = resample(&line, 4)?;
/// assert!(even[1].distance(DVec3::X) < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn resample(
    curve: &impl SpaceCurve,
    segments: usize,
) -> Result<Vec<DVec3>, crate::frenet::FrenetError> {
    let measure = crate::frenet::Measure::new(curve)?;
    let point = |i: usize| {
        let s = measure.total() * (i as f64 / segments.max(1) as f64);
        let (piece, t) = measure.locate(curve, s);
        curve.at(piece, t)[0]
    };
    Ok((0..=segments).map(point).collect())
}
