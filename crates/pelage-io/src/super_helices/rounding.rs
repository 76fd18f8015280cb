//! What rounding to 32 bits does to a Super-Helix, as a true bound.

use super::{frame, wide};
use pelage_curves::DVec3;
use pelage_curves::frenet::Frame;
use pelage_curves::super_helix::{Element, FitError, SuperHelix};

/// A curve with its numbers rounded.
pub(super) struct Rounded {
    pub curve: SuperHelix,
    /// The root's tangent and first normal as they are kept.
    pub tangent: [f32; 3],
    pub normal: [f32; 3],
    /// No place of it is farther than this from the exact one's at an equal part of the
    /// length.
    pub moved: f64,
}

impl Rounded {
    pub fn new(exact: &SuperHelix) -> Result<Self, FitError> {
        let root = exact.root();
        let [tangent, normal] =
            [root.frame.tangent, root.frame.normal].map(|v| v.as_vec3().to_array());
        let elements: Vec<Element> = exact.elements().iter().map(rounded).collect();
        let start = wide(root.position.as_vec3().to_array());
        let turned = frame(tangent, normal);
        let curve = SuperHelix::new(start, turned, &elements)?;
        Ok(Self {
            moved: start.distance(root.position)
                + moved(exact, &elements, angle(&root.frame, &turned)),
            curve,
            tangent,
            normal,
        })
    }
}

fn rounded(element: &Element) -> Element {
    let short = |x: f64| f64::from(x as f32);
    Element {
        length: short(element.length),
        twist: short(element.twist),
        curvatures: element.curvatures.map(short),
    }
}

/// Frames that start `turn` apart and turn at rates ω and ω' are at most turn + ∫|ω - ω'|
/// apart, and so are tangents; positions by that times the length. Where elements end
/// elsewhere, the rates of two of them meet for as long as the ends are apart; and a place
/// at the same part of another length is as much farther on as that differs.
fn moved(exact: &SuperHelix, kept: &[Element], turn: f64) -> f64 {
    let (mut turn, mut apart) = (turn, 0.0);
    for (exact, kept) in exact.elements().iter().zip(kept) {
        let before = f64::abs(apart);
        apart += exact.length - kept.length;
        let rate = exact.rate().length().max(kept.rate().length());
        turn += exact.length * exact.rate().distance(kept.rate());
        turn += rate * (before + apart.abs());
    }
    turn * exact.length() + apart.abs()
}

/// At least the angle between two frames over the sine of its half: the chord.
fn angle(a: &Frame, b: &Frame) -> f64 {
    let apart = |u: DVec3, v: DVec3| u.distance_squared(v);
    let sum = apart(a.tangent, b.tangent) + apart(a.normal, b.normal);
    (sum + apart(a.binormal, b.binormal)).sqrt()
}

/// The nearest number of 32 bits that is not less.
pub(super) fn up(value: f64) -> f32 {
    let short = value as f32;
    match f64::from(short) < value {
        true => short.next_up(),
        false => short,
    }
}
