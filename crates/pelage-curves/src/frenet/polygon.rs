//! The Frenet–Serret apparatus of a polygon: bends and twists.
//!
//! Between two edges a polygon *bends* about the normal of their plane, and from bend to
//! bend that plane *twists* about the edge they share: the discrete κ ds and τ ds of
//! document 000, section 4.2. The polygon comes back from them to rounding however
//! coarse it is, which no sampling of a smooth curve does; a polygon inscribed in a circle
//! or a helix has one bend and one twist everywhere.
//!
//! Signs as for smooth curves: a plane that would turn by more than a quarter is turned
//! round and the bend is negative, so an S has bends of both signs and no twist. Where
//! the polygon is straight its plane stays. On the whole it bends to its normal. f64, radians, the unit of the vertices.

use super::analysis::bends_back;
use super::frame::unit;
use super::{Frame, FrenetError};
use glam::DVec3;

/// An edge and the corner before it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Turn {
    /// Length of the edge.
    pub length: f64,
    /// How far the plane of the corner is twisted, about the edge before, from that of
    /// the corner before: -π/2..=π/2. 0 for the first two edges.
    pub twist: f64,
    /// Angle between the edge before and this one: -π..=π. 0 for the first edge.
    pub bend: f64,
}

/// A polygon as where it starts, how it is turned there, and its edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    /// First vertex.
    pub start: DVec3,
    /// Tangent along the first edge, binormal perpendicular to the first corner's plane.
    pub frame: Frame,
    /// Its edges, one less than vertices.
    pub turns: Vec<Turn>,
}

impl Polygon {
    /// Takes the polygon through `vertices` apart. Corners of an angle below `straight`
    /// (radians, not negative) count as none: 0 for exact vertices, more where what is
    /// less is noise.
    ///
    /// Edges without length have no bend; a polygon without length has some frame.
    ///
    /// # Errors
    ///
    /// [`FrenetError::Empty`] for no vertices, [`FrenetError::NotFinite`] for one that is
    /// not, or that is so far from the one before that their distance is not.
    ///
    /// ```
    /// use pelage_curves::{DVec3, frenet::polygon::Polygon};
    /// let corner = [DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y];
    /// let polygon = Polygon::of(&corner, 0.0)?;
    /// assert_eq!(polygon.turns[1].bend, std::f64::consts::FRAC_PI_2);
    /// # Ok::<(), pelage_curves::frenet::FrenetError>(())
    /// ```
    pub fn of(vertices: &[DVec3], straight: f64) -> Result<Self, FrenetError> {
        let start = *vertices.first().ok_or(FrenetError::Empty)?;
        let edges = vertices.windows(2).map(|v| v[1] - v[0]);
        let finite = |v: &DVec3| v.length_squared().is_finite();
        if let Some(index) = vertices.iter().position(|v| !finite(v)) {
            return Err(FrenetError::NotFinite { index });
        }
        if let Some(edge) = edges.clone().position(|e| !finite(&e)) {
            return Err(FrenetError::NotFinite { index: edge + 1 });
        }
        let directions = directions(edges.clone());
        let first = directions.first().copied().unwrap_or(DVec3::Z);
        let planes = directions.windows(2).map(|d| plane(d[0], d[1], straight));
        let binormal = planes.clone().flatten().next().unwrap_or(DVec3::ZERO);
        let frame = Frame::new(first, binormal.cross(first));
        let mut turns: Vec<Turn> = edges
            .map(|edge| Turn {
                length: edge.length(),
                ..Turn::default()
            })
            .collect();
        let mut carried = frame.binormal;
        for (i, plane) in planes.enumerate() {
            let (before, after) = (directions[i], directions[i + 1]);
            let corner = corner(before, after, carried, plane);
            (turns[i + 1].twist, turns[i + 1].bend, carried) = corner;
        }
        let back = bends_back(turns.iter().map(|turn| turn.bend));
        if back {
            turns.iter_mut().for_each(|turn| turn.bend = -turn.bend);
        }
        Ok(Self {
            start,
            frame: if back { frame.turned_round() } else { frame },
            turns,
        })
    }

    /// The vertices, one more than turns.
    pub fn points(&self) -> Vec<DVec3> {
        let (mut point, mut frame) = (self.start, self.frame);
        let mut points = vec![point];
        points.extend(self.turns.iter().map(|turn| {
            let normal = turned(frame.normal, frame.binormal, turn.twist);
            let binormal = turned(frame.binormal, -frame.normal, turn.twist);
            frame = Frame {
                tangent: turned(frame.tangent, normal, turn.bend),
                normal: turned(normal, -frame.tangent, turn.bend),
                binormal,
            };
            point += frame.tangent * turn.length;
            point
        }));
        points
    }
}

/// `vector` turned by `angle` towards `aside`, both units and perpendicular.
fn turned(vector: DVec3, aside: DVec3, angle: f64) -> DVec3 {
    vector * libm::cos(angle) + aside * libm::sin(angle)
}

/// Unit directions of edges; an edge without length has that before it, else the first.
fn directions(edges: impl Iterator<Item = DVec3> + Clone) -> Vec<DVec3> {
    let mut before = edges.clone().find_map(unit).unwrap_or(DVec3::Z);
    edges
        .map(|edge| {
            before = unit(edge).unwrap_or(before);
            before
        })
        .collect()
}

/// Unit normal of the plane of two directions, unless they are one line.
fn plane(before: DVec3, after: DVec3, straight: f64) -> Option<DVec3> {
    let across = before.cross(after);
    let (sine, cosine) = (across.length(), before.dot(after));
    // Less than this is rounding, also where an edge runs back along the one before.
    let bends = sine > 1e-14 && libm::atan2(sine, cosine) > straight;
    bends.then(|| unit(across)).flatten()
}

/// Twist, bend and binormal of the corner between two unit directions, after the binormal
/// `carried`, which is perpendicular to `before`.
fn corner(before: DVec3, after: DVec3, carried: DVec3, plane: Option<DVec3>) -> (f64, f64, DVec3) {
    let Some(plane) = plane else {
        let back = before.dot(after) < 0.0;
        let bend = if back { std::f64::consts::PI } else { 0.0 };
        // What rounding, or noise, has bent is taken out.
        let frame = Frame::new(after, carried.cross(after));
        return (0.0, bend, frame.binormal);
    };
    let (binormal, sign) = match plane.dot(carried) < 0.0 {
        true => (-plane, -1.0),
        false => (plane, 1.0),
    };
    let twist = libm::atan2(before.dot(carried.cross(binormal)), carried.dot(binormal));
    let bend = libm::atan2(before.cross(after).length(), before.dot(after));
    (twist, sign * bend, binormal)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector(p: [i8; 3]) -> DVec3 {
        DVec3::from(p.map(f64::from))
    }

    proptest! {
        /// Small integers: edges without length, straight parts and folds are common.
        #[test]
        fn vertices_come_back_to_rounding(
            points in prop::collection::vec(prop::array::uniform3(-2i8..3), 1..40),
            exponent in -30i32..30,
        ) {
            let unit = libm::pow(10.0, exponent as f64);
            let points: Vec<DVec3> = points.into_iter().map(|p| vector(p) * unit).collect();
            let polygon = Polygon::of(&points, 0.0).unwrap();
            for (p, q) in points.iter().zip(polygon.points()) {
                prop_assert!(p.distance(q) < 1e-11 * unit, "{} {}", p, q);
            }
            for turn in &polygon.turns {
                prop_assert!(turn.twist.abs() < std::f64::consts::FRAC_PI_2 + 1e-9);
                prop_assert!(turn.bend.abs() <= std::f64::consts::PI);
            }
        }

        #[test]
        fn a_polygon_in_a_helix_has_one_bend_and_one_twist(
            pitch in -3.0f64..3.0, step in 0.01f64..1.5,
        ) {
            let at = |i: usize| i as f64 * step;
            let points: Vec<DVec3> = (0..12)
                .map(|i| DVec3::new(libm::cos(at(i)), libm::sin(at(i)), pitch * at(i)))
                .collect();
            let turns = Polygon::of(&points, 0.0).unwrap().turns;
            for turn in &turns[2..] {
                prop_assert!((turn.bend - turns[1].bend).abs() < 1e-10);
                prop_assert!((turn.twist - turns[2].twist).abs() < 1e-6);
                prop_assert!(turn.bend > 0.0 && turn.twist * pitch >= -1e-9);
            }
        }
    }

    #[test]
    fn an_s_bends_both_ways_and_does_not_twist_also_with_a_straight_part_between() {
        let s = [[0, 0], [1, 0], [2, 1], [2, 2], [2, 3], [3, 4], [4, 4]];
        let points = s.map(|[x, y]| vector([x, y, 0]));
        let turns = Polygon::of(&points, 0.0).unwrap().turns;
        let signs: Vec<f64> = turns.iter().map(|t| t.bend.signum()).collect();
        assert!(signs[1] > 0.0 && signs[2] > 0.0 && turns[3].bend == 0.0);
        assert!(signs[4] < 0.0 && signs[5] < 0.0);
        assert!(turns.iter().all(|t| t.twist == 0.0));
    }

    #[test]
    fn what_is_no_polygon_is_told_and_what_is_a_point_is_one() {
        assert_eq!(Polygon::of(&[], 0.0), Err(FrenetError::Empty));
        let far = [DVec3::ZERO, DVec3::X * 1e200];
        for bad in [[DVec3::X, DVec3::NAN], [DVec3::X, DVec3::INFINITY], far] {
            let found = Polygon::of(&bad, 0.0);
            assert_eq!(found, Err(FrenetError::NotFinite { index: 1 }));
        }
        let point = Polygon::of(&[DVec3::ONE], 0.0).unwrap();
        assert_eq!(point.points(), [DVec3::ONE]);
    }
}
