//! A Super-Helix: elements end to end from a clamped root frame.

use super::element::{Element, Motion};
use super::error::FitError;
use crate::frenet::{Frame, SpaceCurve};
use glam::{DMat3, DVec3};

/// Largest turn of one element in radians: beyond it the angle's digits are gone.
const LARGEST_TURN: f64 = 1e12;

/// A place on a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Position.
    pub position: DVec3,
    /// Tangent, first and second normal: the frame that the curvatures q1 and q2 are told
    /// in, which is not the Frenet frame.
    pub frame: Frame,
}

/// How a place moves as one element's (q0, q1, q2) change: one column each.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Derivative {
    /// Of the position, per unit of q0, q1 and q2.
    pub shift: [DVec3; 3],
    /// Of the frame: the infinitesimal rotation, in space, per unit of each; a vector v of
    /// the frame changes by `spin × v`.
    pub spin: [DVec3; 3],
}

/// A curve of elements with constant twist and curvatures, frame-continuous (so G1).
///
/// It is a [`SpaceCurve`] with an element a piece: whatever takes those takes it.
///
/// ```
/// use pelage_curves::{DVec3, frenet::Frame};
/// use pelage_curves::super_helix::{Element, SuperHelix};
/// // Half a circle of radius 1 towards the first normal.
/// let half = Element { length: std::f64::consts::PI, twist: 0.0, curvatures: [0.0, 1.0] };
/// let curve = SuperHelix::new(DVec3::ZERO, Frame::IDENTITY, &[half])?;
/// assert!(curve.at(half.length).position.distance(DVec3::Y * 2.0) < 1e-15);
/// # Ok::<(), pelage_curves::super_helix::FitError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct SuperHelix {
    elements: Vec<Element>,
    /// Where elements start, and the end of all; one more than elements.
    nodes: Vec<Node>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Node {
    s: f64,
    position: DVec3,
    frame: DMat3,
}

impl SuperHelix {
    /// The curve that starts at `start` with the orthonormal `frame`.
    ///
    /// # Errors
    ///
    /// [`FitError::NoElements`], [`FitError::Start`], [`FitError::Element`].
    pub fn new(start: DVec3, frame: Frame, elements: &[Element]) -> Result<Self, FitError> {
        if elements.is_empty() {
            return Err(FitError::NoElements);
        }
        let frame = DMat3::from_cols(frame.tangent, frame.normal, frame.binormal);
        if !(start.is_finite() && frame.is_finite()) {
            return Err(FitError::Start);
        }
        let good = |e: &Element| {
            let turn = e.rate().abs().max_element() * e.length;
            e.length >= 0.0 && e.length.is_finite() && e.rate().is_finite() && turn <= LARGEST_TURN
        };
        match elements.iter().position(|e| !good(e)) {
            Some(index) => Err(FitError::Element { index }),
            None => Ok(Self::of_parts(start, frame, elements.to_vec())),
        }
    }

    /// As [`new`](Self::new) for parts that are known to be good.
    pub(super) fn of_parts(start: DVec3, frame: DMat3, elements: Vec<Element>) -> Self {
        let mut node = Node {
            s: 0.0,
            position: start,
            frame,
        };
        let mut nodes = vec![node];
        nodes.extend(elements.iter().map(|element| {
            let motion = Motion::new(element.rate(), element.length);
            node = Node {
                s: node.s + element.length,
                position: node.position + node.frame * motion.shift(),
                frame: node.frame * motion.turn(),
            };
            node
        }));
        Self { elements, nodes }
    }

    /// Its elements, from the root; one at least.
    pub fn elements(&self) -> &[Element] {
        &self.elements
    }

    /// Where it starts and how it is turned there.
    pub fn root(&self) -> Place {
        self.nodes[0].place()
    }

    /// The sum of the elements' lengths, in their order.
    pub fn length(&self) -> f64 {
        self.nodes[self.elements.len()].s
    }

    /// Numbers that make the curve: four an element and six for the root.
    pub fn numbers(&self) -> usize {
        4 * self.elements.len() + 6
    }

    /// The place at arc length `s`, clamped to the curve.
    pub fn at(&self, s: f64) -> Place {
        let (element, inside) = self.locate(s);
        let node = &self.nodes[element];
        let motion = Motion::new(self.elements[element].rate(), inside);
        let place = Node {
            s,
            position: node.position + node.frame * motion.shift(),
            frame: node.frame * motion.turn(),
        };
        place.place()
    }

    /// `segments + 1` points at equal steps of arc length, ends included.
    pub fn points(&self, segments: usize) -> Vec<DVec3> {
        let step = |i: usize| self.length() * (i as f64 / segments.max(1) as f64);
        (0..=segments).map(|i| self.at(step(i)).position).collect()
    }

    /// How the place at arc length `s` moves with each element's (q0, q1, q2), in closed
    /// form. As many as there are elements up to there; later ones move nothing.
    pub fn derivatives(&self, s: f64) -> Vec<Derivative> {
        let here = self.at(s).position;
        let (last, inside) = self.locate(s);
        let derivative = |i: usize| {
            let (node, element) = (&self.nodes[i], &self.elements[i]);
            let within = if i == last { inside } else { element.length };
            let motion = Motion::new(element.rate(), within);
            let spin = node.frame * motion.spin();
            let shift = node.frame * motion.shift_by_rate();
            let end = node.position + node.frame * motion.shift();
            // What comes after the element moves with its end like one body.
            let column = |k: usize| shift.col(k) + spin.col(k).cross(here - end);
            Derivative {
                shift: [0, 1, 2].map(column),
                spin: [0, 1, 2].map(|k| spin.col(k)),
            }
        };
        (0..=last).map(derivative).collect()
    }

    /// The element at `s` and the arc length in it; where two meet, the second.
    fn locate(&self, s: f64) -> (usize, f64) {
        let after = self.nodes.partition_point(|node| node.s <= s);
        let element = after.clamp(1, self.elements.len()) - 1;
        let inside = (s - self.nodes[element].s).clamp(0.0, self.elements[element].length);
        (element, inside)
    }
}

impl Node {
    fn place(&self) -> Place {
        Place {
            position: self.position,
            frame: Frame {
                tangent: self.frame.x_axis,
                normal: self.frame.y_axis,
                binormal: self.frame.z_axis,
            },
        }
    }
}

impl SpaceCurve for SuperHelix {
    fn pieces(&self) -> usize {
        self.elements.len()
    }

    fn at(&self, piece: usize, t: f64) -> [DVec3; 3] {
        let (node, element) = (&self.nodes[piece], &self.elements[piece]);
        let length = element.length;
        let motion = Motion::new(element.rate(), length * t);
        let bend = motion.turn() * DVec3::new(0.0, element.curvatures[1], -element.curvatures[0]);
        [
            node.position + node.frame * motion.shift(),
            node.frame * motion.tangent() * length,
            node.frame * bend * (length * length),
        ]
    }
}

#[cfg(test)]
#[path = "curve_tests.rs"]
mod tests;
