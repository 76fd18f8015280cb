//! Curves whose helicity, torsion over curvature, is constant.
//!
//! Source: document 000, section 3.2, equations 17–25. Their basis has a closed form in
//! q = ∫κ ds, whatever the curvature. Their tangent keeps its angle to one axis (Lancret),
//! so they wind but cannot bend as a whole.

use super::Frame;
use glam::DVec3;

/// A curve of constant helicity, as the basis where it starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Helical {
    /// Basis at q = 0.
    pub frame: Frame,
    /// Torsion over curvature; any finite number, 0 for a plane curve.
    pub helicity: f64,
}

impl Helical {
    /// The basis where the integral of the curvature from the start is `q` (radians).
    ///
    /// ```
    /// use pelage_curves::frenet::{Frame, Helical};
    /// let plane = Helical { frame: Frame::IDENTITY, helicity: 0.0 };
    /// let quarter = plane.at(std::f64::consts::FRAC_PI_2);
    /// assert!(quarter.tangent.distance(Frame::IDENTITY.normal) < 1e-15);
    /// ```
    pub fn at(&self, q: f64) -> Frame {
        let h = self.helicity;
        let root = (1.0 + h * h).sqrt();
        let angle = q * root;
        let (sine, half) = (libm::sin(angle), libm::sin(angle / 2.0));
        let versine = 2.0 * half * half;
        let Frame {
            tangent,
            normal,
            binormal,
        } = self.frame;
        let gamma = (binormal * h - tangent) / root;
        Frame {
            tangent: tangent + (normal * sine + gamma * versine) / root,
            normal: normal * (1.0 - versine) + gamma * sine,
            binormal: binormal - (normal * sine + gamma * versine) * (h / root),
        }
    }

    /// The unit axis to which the tangent keeps its angle, whose cosine is h / √(1 + h²)
    /// (equation 25).
    pub fn axis(&self) -> DVec3 {
        let h = self.helicity;
        (self.frame.tangent * h + self.frame.binormal) / (1.0 + h * h).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frenet::{Segment, Step};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_closed_form_is_a_helix_step_and_keeps_its_angle_to_the_axis(
            helicity in -20.0f64..20.0, q in -9.0f64..9.0,
        ) {
            let curve = Helical { frame: Frame::IDENTITY, helicity };
            let step = Step::new(Segment { length: 1.0, curvature: q, torsion: q * helicity });
            let (closed, stepped) = (curve.at(q), step.frame(&Frame::IDENTITY));
            prop_assert!(closed.tangent.distance(stepped.tangent) < 1e-12);
            prop_assert!(closed.normal.distance(stepped.normal) < 1e-12);
            prop_assert!(closed.binormal.distance(stepped.binormal) < 1e-12);
            let cosine = helicity / (1.0 + helicity * helicity).sqrt();
            prop_assert!((closed.tangent.dot(curve.axis()) - cosine).abs() < 1e-13);
        }
    }
}
