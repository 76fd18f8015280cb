//! The moving basis of a curve.

use glam::DVec3;

/// An orthonormal, right-handed basis: document 000's F = (T, N, B).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Unit tangent.
    pub tangent: DVec3,
    /// Unit normal: where the curve bends to if its curvature is positive.
    pub normal: DVec3,
    /// Unit binormal, `tangent × normal`.
    pub binormal: DVec3,
}

impl Frame {
    /// Tangent +X, normal +Y, binormal +Z.
    pub const IDENTITY: Self = Self {
        tangent: DVec3::X,
        normal: DVec3::Y,
        binormal: DVec3::Z,
    };

    /// A frame from a tangent and a normal that need not be perpendicular or units. What
    /// is too small to have a direction is replaced: the tangent by +Z, the normal by some
    /// perpendicular.
    ///
    /// ```
    /// use pelage_curves::{DVec3, frenet::Frame};
    /// let frame = Frame::new(DVec3::X * 3.0, DVec3::new(1.0, 1.0, 0.0));
    /// assert_eq!(frame, Frame::IDENTITY);
    /// ```
    pub fn new(tangent: DVec3, normal: DVec3) -> Self {
        let tangent = unit(tangent).unwrap_or(DVec3::Z);
        let normal = perpendicular(normal, tangent).unwrap_or_else(|| any_perpendicular(tangent));
        Self {
            tangent,
            normal,
            binormal: tangent.cross(normal),
        }
    }

    /// The frame with normal and binormal turned round: the same curve with the other
    /// sign of curvature.
    pub(super) fn turned_round(self) -> Self {
        Self {
            normal: -self.normal,
            binormal: -self.binormal,
            ..self
        }
    }

    /// The vector with coordinates `local` along tangent, normal and binormal.
    #[inline(always)]
    pub fn vector(&self, local: DVec3) -> DVec3 {
        self.tangent * local.x + self.normal * local.y + self.binormal * local.z
    }
}

/// `vector` as a unit vector, unless it is too small or too large to tell.
#[inline]
pub(crate) fn unit(vector: DVec3) -> Option<DVec3> {
    let square = vector.length_squared();
    if (1e-200..1e200).contains(&square) {
        return Some(vector / square.sqrt());
    }
    // Brings the square into range first: lengths may be 1e-200.
    let largest = vector.abs().max_element();
    let scaled = vector / largest;
    (largest > 0.0 && scaled.is_finite()).then(|| scaled / scaled.length())
}

/// Unit part of `vector` perpendicular to the unit `tangent`, if more than rounding.
pub(crate) fn perpendicular(vector: DVec3, tangent: DVec3) -> Option<DVec3> {
    let vector = unit(vector)?;
    let part = vector - tangent * vector.dot(tangent);
    if part.length_squared() < 1e-24 {
        return None;
    }
    // Twice, so that what the first subtraction left is gone too.
    let part = unit(part)?;
    unit(part - tangent * part.dot(tangent))
}

/// Some unit vector perpendicular to the unit `tangent`.
fn any_perpendicular(tangent: DVec3) -> DVec3 {
    let aside = match tangent.x.abs() < 0.8 {
        true => DVec3::X,
        false => DVec3::Y,
    };
    perpendicular(aside, tangent).unwrap_or(DVec3::X)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn frames_are_orthonormal_whatever_they_are_made_of(
            tangent in prop::array::uniform3(-2i8..3), normal in prop::array::uniform3(-2i8..3),
            exponent in -300i32..300,
        ) {
            let vector = |v: [i8; 3]| DVec3::from(v.map(f64::from));
            let scale = libm::pow(10.0, exponent as f64);
            let Frame { tangent, normal, binormal } =
                Frame::new(vector(tangent) * scale, vector(normal));
            for v in [tangent, normal, binormal] {
                prop_assert!((v.length() - 1.0).abs() < 1e-15);
            }
            prop_assert!(tangent.dot(normal).abs() < 1e-15);
            prop_assert!(tangent.cross(normal).distance(binormal) < 1e-15);
        }
    }
}
