//! Floating tangents: a chain of helices through given points.
//!
//! Source: the ideas of A. Derouet-Jourdan, F. Bertails-Descoubes and J. Thollot, "Floating
//! tangents for approximating spatial curves with G1 piecewise helices", CAGD 2013. Two
//! points with tangents are the ends of a helix of less than a turn where both tangents make
//! one angle with the chord (A. Ghosh's condition). The points stay, and the tangents move
//! as little as they can, in the sense of least squares, until every two neighbours do.
//!
//! A helix looks the same turned by half about its middle normal, which is along the
//! difference of the tangents. What is left is one angle, half the turn, found by bisection:
//! the angle between chord and tangents grows with it.

use crate::frenet::{Frame, SpaceCurve, unit};
use crate::super_helix::error::FitError;
use crate::super_helix::target::Target;
use crate::super_helix::{Element, SuperHelix};
use glam::{DMat3, DVec3};

/// Linearised rounds in which tangents come to fit. In the second half nothing pulls them
/// back to what was wished, so that the conditions are met to rounding.
const ROUNDS: usize = 40;

/// `helices` through as many points and one of the target, at equal steps of arc length.
/// Its length is near the target's. A target without length gives elements without length.
///
/// # Errors
///
/// [`FitError::Target`], [`FitError::NoElements`].
pub fn floating_tangents(target: &impl SpaceCurve, helices: usize) -> Result<SuperHelix, FitError> {
    let target = Target::new(target)?;
    if helices == 0 {
        return Err(FitError::NoElements);
    }
    if target.length <= 0.0 {
        let parts = vec![Element::default(); helices];
        return Ok(SuperHelix::of_parts(target.start, DMat3::IDENTITY, parts));
    }
    let samples = target.sampled(helices);
    let chords = samples.points.windows(2).map(|p| p[1] - p[0]);
    let chords: Vec<DVec3> = chords.collect();
    let tangents = floated(&chords, &samples.tangents);
    let mut frame = Frame::new(tangents[0], DVec3::ZERO);
    let root = DMat3::from_cols(frame.tangent, frame.normal, frame.binormal);
    let mut elements = Vec::with_capacity(helices);
    for (chord, ends) in chords.iter().zip(tangents.windows(2)) {
        let helix = Helix::between(*chord, ends[0], ends[1]);
        let bend = helix.normal * helix.curvature;
        // q2 bends towards the first normal, q1 away from the second.
        let element = Element {
            length: helix.length * target.length,
            twist: helix.torsion / target.length,
            curvatures: [-bend.dot(frame.binormal), bend.dot(frame.normal)]
                .map(|k| k / target.length),
        };
        let base = DMat3::from_cols(frame.tangent, frame.normal, frame.binormal);
        let end = SuperHelix::of_parts(DVec3::ZERO, base, vec![element]).at(element.length);
        frame = Frame::new(ends[1], end.frame.normal);
        elements.push(element);
    }
    Ok(SuperHelix::of_parts(target.start, root, elements))
}

/// The unit tangents nearest to `wished` whose neighbours make one angle with the chord
/// between them: Newton steps on the conditions, each a tridiagonal system.
fn floated(chords: &[DVec3], wished: &[DVec3]) -> Vec<DVec3> {
    let chords: Vec<DVec3> = chords
        .iter()
        .map(|&c| unit(c).unwrap_or(DVec3::ZERO))
        .collect();
    let mut tangents = wished.to_vec();
    for round in 0..ROUNDS {
        let pull = f64::from(round < ROUNDS / 2);
        let flat = |v: DVec3, t: DVec3| v - t * v.dot(t);
        // What each tangent would be without conditions, in its own tangent plane.
        let free: Vec<DVec3> = tangents
            .iter()
            .zip(wished)
            .map(|(&t, &w)| flat((w - t) * pull, t))
            .collect();
        let sides: Vec<[DVec3; 2]> = (0..chords.len())
            .map(|i| {
                [
                    flat(chords[i], tangents[i]),
                    flat(chords[i], tangents[i + 1]),
                ]
            })
            .collect();
        let [mut diagonal, mut beside, mut right] = [Vec::new(), Vec::new(), Vec::new()];
        for (i, [start, end]) in sides.iter().enumerate() {
            let miss = (tangents[i] - tangents[i + 1]).dot(chords[i]);
            right.push(miss + start.dot(free[i]) - end.dot(free[i + 1]));
            diagonal.push(start.length_squared() + end.length_squared() + 1e-9);
            beside.push(sides.get(i + 1).map_or(0.0, |next| -end.dot(next[0])));
        }
        let pulls = tridiagonal(diagonal, &beside, right);
        for i in 0..tangents.len() {
            let mut to = free[i];
            if let Some([start, _]) = sides.get(i) {
                to -= *start * pulls[i];
            }
            if i > 0 {
                to += sides[i - 1][1] * pulls[i - 1];
            }
            tangents[i] = unit(tangents[i] + to).unwrap_or(tangents[i]);
        }
    }
    tangents
}

/// The solution of a symmetric tridiagonal system (Thomas).
fn tridiagonal(mut diagonal: Vec<f64>, beside: &[f64], mut right: Vec<f64>) -> Vec<f64> {
    for i in 1..right.len() {
        let factor = beside[i - 1] / diagonal[i - 1];
        diagonal[i] -= factor * beside[i - 1];
        right[i] -= factor * right[i - 1];
    }
    for i in (0..right.len()).rev() {
        let after = right.get(i + 1).copied().unwrap_or(0.0);
        right[i] = (right[i] - beside[i] * after) / diagonal[i];
    }
    right
}

/// A helix of less than a turn.
struct Helix {
    length: f64,
    curvature: f64,
    torsion: f64,
    /// Unit normal at its start.
    normal: DVec3,
}

impl Helix {
    /// The one along `chord` with unit tangents at its ends that make one angle with it.
    fn between(chord: DVec3, start: DVec3, end: DVec3) -> Self {
        let distance = chord.length();
        let along = unit(chord).unwrap_or(start);
        let across = (end - start) / 2.0;
        let side = across.length();
        let straight = Self {
            length: distance,
            curvature: 0.0,
            torsion: 0.0,
            normal: Frame::new(start, DVec3::ZERO).normal,
        };
        let Some(normal) = unit(across).filter(|_| side > 1e-9 && side < 1.0) else {
            return straight;
        };
        let third = along.cross(normal);
        let middle = (start + end) / 2.0;
        let off = libm::atan2(middle.dot(third), middle.dot(along));
        let half = half_turn(side, off.abs());
        let slant = (side / libm::sin(half)).min(1.0);
        let rise = (1.0 - slant * slant).max(0.0).sqrt();
        // Chord and length, and the turn of the frame over half of it.
        let sinc = libm::sin(half) / half;
        let length = distance / libm::hypot(rise, slant * sinc);
        let speed = 2.0 * half / length;
        // Right-handed where the mean tangent lies towards the third axis.
        let handed = 1f64.copysign(off);
        let to_axis = libm::atan2(slant * sinc, rise);
        let axis = along * libm::cos(to_axis) + third * (libm::sin(to_axis) * handed);
        let ahead = normal.cross(axis) * handed;
        Self {
            length,
            curvature: speed * slant,
            torsion: speed * rise * handed,
            normal: normal * libm::cos(half) + ahead * libm::sin(half),
        }
    }
}

/// Half the turn of a helix whose tangents at the ends are `2 side` apart and whose chord
/// and mean tangent are `off` radians apart.
fn half_turn(side: f64, off: f64) -> f64 {
    let least = libm::asin(side.min(1.0));
    let (mut low, mut high) = (least, std::f64::consts::PI - least);
    for _ in 0..60 {
        let half = (low + high) / 2.0;
        let sine = libm::sin(half);
        let slant = (side / sine).min(1.0);
        let rise = (1.0 - slant * slant).max(0.0).sqrt();
        let chord = libm::atan2(slant * sine / half, rise);
        let mean = libm::atan2(slant * libm::cos(half), rise);
        match chord - mean < off {
            true => low = half,
            false => high = half,
        }
    }
    (low + high) / 2.0
}
