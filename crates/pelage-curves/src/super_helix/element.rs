//! One element of a Super-Helix: a part whose frame turns about an axis fixed in it.
//!
//! Source: F. Bertails et al., "Super-Helices for predicting the dynamics of natural hair",
//! 2006, the curve that document 002 fits. With ω = (q0, q1, q2) in the frame R = (t, n1,
//! n2), R' = R [ω]×, so over a length l the frame turns by exp[θ]×, θ = l ω, and the
//! curve shifts by ∫t. With the functions c_k of |θ|² ([`Stumpff`]):
//!
//! exp[θ]× = c0 + c1 [θ]× + c2 θθᵀ, its integral over the length l (c1 + c2 [θ]× + c3 θθᵀ),
//! whose first column is the shift; the same matrix turns a change of θ into the spin that
//! it gives the end (the left Jacobian of SO(3)).

use super::stumpff::Stumpff;
use glam::{DMat3, DVec3};

/// A part of a Super-Helix: twist and curvatures constant, so a piece of a helix.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Element {
    /// Arc length; not negative.
    pub length: f64,
    /// q0: how fast the frame turns about the tangent, radians per unit of length.
    pub twist: f64,
    /// q1 and q2: how fast it turns about its first and second normal, radians per unit of
    /// length. q1 bends the curve away from the second normal, q2 towards the first.
    pub curvatures: [f64; 2],
}

impl Element {
    pub(super) fn new(length: f64, rate: DVec3) -> Self {
        Self {
            length,
            twist: rate.x,
            curvatures: [rate.y, rate.z],
        }
    }

    /// (q0, q1, q2): the Darboux vector, as coordinates in the frame.
    pub fn rate(&self) -> DVec3 {
        DVec3::new(self.twist, self.curvatures[0], self.curvatures[1])
    }

    /// How the frame turns and how far the curve shifts over the element, as coordinates in
    /// the frame (tangent, first and second normal) at its start: what a walk along elements
    /// needs that keeps no [`SuperHelix`](super::SuperHelix).
    ///
    /// ```
    /// use pelage_curves::{DVec3, super_helix::Element};
    /// let quarter = Element { length: 1.0, twist: 0.0, curvatures: [0.0, std::f64::consts::FRAC_PI_2] };
    /// let (turn, shift) = quarter.motion();
    /// assert!((turn * DVec3::X).distance(DVec3::Y) < 1e-15);
    /// assert!(shift.distance(DVec3::new(1.0, 1.0, 0.0) / std::f64::consts::FRAC_PI_2) < 1e-15);
    /// ```
    #[inline(always)]
    pub fn motion(&self) -> (DMat3, DVec3) {
        let motion = Motion::new(self.rate(), self.length);
        (motion.turn(), motion.shift())
    }
}

/// Turn, shift and their derivatives over a length at a rate, as coordinates in the frame
/// at its start.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    angle: DVec3,
    length: f64,
    stumpff: Stumpff,
}

impl Motion {
    #[inline(always)]
    pub fn new(rate: DVec3, length: f64) -> Self {
        let angle = rate * length;
        Self {
            angle,
            length,
            stumpff: Stumpff::at(angle.length_squared()),
        }
    }

    /// The frame at the end.
    #[inline(always)]
    pub fn turn(&self) -> DMat3 {
        let [c0, c1, c2, ..] = self.stumpff.0;
        matrix(c0, c1, c2, self.angle)
    }

    /// The tangent at the end.
    #[inline(always)]
    pub fn tangent(&self) -> DVec3 {
        let [c0, c1, c2, ..] = self.stumpff.0;
        first_column(c0, c1, c2, self.angle)
    }

    /// How far the end is from the start.
    #[inline(always)]
    pub fn shift(&self) -> DVec3 {
        let [_, c1, c2, c3, ..] = self.stumpff.0;
        first_column(c1, c2, c3, self.angle) * self.length
    }

    /// The spin of the end per change of the rate: its columns are infinitesimal rotations.
    #[inline(always)]
    pub fn spin(&self) -> DMat3 {
        let [_, c1, c2, c3, ..] = self.stumpff.0;
        matrix(c1, c2, c3, self.angle) * self.length
    }

    /// The derivative of the shift with respect to the rate.
    #[inline(always)]
    pub fn shift_by_rate(&self) -> DMat3 {
        let [.., c2, c3, _, _] = self.stumpff.0;
        let a = self.angle;
        let slope = first_column(
            self.stumpff.slope(1),
            self.stumpff.slope(2),
            self.stumpff.slope(3),
            a,
        );
        // δ of c1 e + c2 θ × e + c3 θ (θ·e), e the first axis; the c_k move with θ·δ.
        let own = DMat3::from_cols(
            DVec3::new(2.0 * a.x, a.y, a.z) * c3,
            DVec3::new(0.0, c3 * a.x, -c2),
            DVec3::new(0.0, c2, c3 * a.x),
        );
        let outer = DMat3::from_cols(slope * a.x, slope * a.y, slope * a.z);
        (own + outer) * (self.length * self.length)
    }
}

/// `a + b [θ]× + c θθᵀ`.
#[inline(always)]
fn matrix(a: f64, b: f64, c: f64, angle: DVec3) -> DMat3 {
    let (b, outer) = (angle * b, angle * c);
    DMat3::from_cols(
        outer * angle.x + DVec3::new(a, b.z, -b.y),
        outer * angle.y + DVec3::new(-b.z, a, b.x),
        outer * angle.z + DVec3::new(b.y, -b.x, a),
    )
}

#[inline(always)]
fn first_column(a: f64, b: f64, c: f64, angle: DVec3) -> DVec3 {
    DVec3::new(a, b * angle.z, -b * angle.y) + angle * (c * angle.x)
}
