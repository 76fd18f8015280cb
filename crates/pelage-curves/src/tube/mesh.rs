//! From rings to triangles.

use super::rings::Ring;
use super::{Section, TubeError, ears};
use glam::{DVec2, DVec3, Vec2, Vec3};

/// A triangle mesh as plain arrays.
///
/// It is watertight where positions are: vertices that stand on one place with different
/// normals or texture coordinates (seams, creases, rims of caps) have the same bits there,
/// and joined by place every edge is met by as many triangles one way as the other, at
/// every edge but those of open ends.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TubeMesh {
    /// A vertex each; the unit of the curve.
    pub positions: Vec<Vec3>,
    /// Unit, outward; a vertex each.
    pub normals: Vec<Vec3>,
    /// A vertex each. On the side: fraction of the section's perimeter, and of the length,
    /// both by arc length, 0..=1. On a flat cap: the section, fitted into 0..=1.
    pub uvs: Vec<Vec2>,
    /// Indices of vertices, counter-clockwise seen from outside. None of them is without
    /// two different corners.
    pub triangles: Vec<[u32; 3]>,
}

impl TubeMesh {
    fn push(&mut self, position: DVec3, normal: DVec3, uv: DVec2) {
        self.positions.push(position.as_vec3());
        self.normals.push(normal.as_vec3());
        self.uvs.push(uv.as_vec2());
    }

    /// Leaves out a triangle two of whose corners are one place: the point of a tip, or
    /// what has rounded to one. The edges of its neighbours meet without it.
    fn triangle(&mut self, corners: [u32; 3]) {
        let [a, b, c] = corners.map(|i| self.positions[i as usize]);
        if a != b && b != c && c != a {
            self.triangles.push(corners);
        }
    }

    /// The side of a tube; `closed` if the last ring is the first.
    pub(super) fn side(section: &Section, rings: &[Ring], closed: bool) -> Result<Self, TubeError> {
        let columns = section.columns();
        let (around, count) = (columns.len(), rings.len());
        check_size(section, count)?;
        let mut mesh = Self::default();
        let (start, end) = (rings[0].s, rings[count - 1].s);
        let first = rings.iter().take_while(|ring| ring.cap.is_some()).count();
        let body = &rings[first..count - first];
        for (i, ring) in rings.iter().enumerate() {
            let slopes = match ring.cap {
                Some(angle) => Slopes::Cap(angle),
                None => Slopes::at(body, i - first, closed),
            };
            let v = if end > start {
                (ring.s - start) / (end - start)
            } else {
                0.0
            };
            for column in columns {
                let point = section.points()[column.point];
                let normal = slopes.normal(ring, point, column.normal);
                mesh.push(ring.place(point), normal, DVec2::new(column.u, v));
            }
        }
        for ring in 0..count as u32 - 1 {
            for (j, _) in columns.iter().enumerate().filter(|(_, c)| c.joined) {
                let a = ring * around as u32 + j as u32;
                let (b, c, d) = (a + 1, a + 1 + around as u32, a + around as u32);
                mesh.triangle([a, b, c]);
                mesh.triangle([a, c, d]);
            }
        }
        mesh.within_range()
    }

    /// Closes the side with a flat cap over `ring`, facing along or against its tangent.
    pub(super) fn cap(&mut self, section: &Section, ring: &Ring, forward: bool) {
        let points = section.points();
        let first = self.positions.len() as u32;
        let (low, high) = points
            .iter()
            .fold((points[0], points[0]), |(l, h), &p| (l.min(p), h.max(p)));
        let size = (high - low).max_element();
        let facing = if forward {
            ring.frame.tangent
        } else {
            -ring.frame.tangent
        };
        for &point in points {
            self.push(ring.place(point), facing, (point - low) / size);
        }
        for [a, b, c] in ears::triangles(points) {
            let [a, b, c] = [a, b, c].map(|i| first + i);
            self.triangle(if forward { [a, b, c] } else { [a, c, b] });
        }
    }

    fn within_range(self) -> Result<Self, TubeError> {
        match self.positions.iter().all(|p| p.is_finite()) {
            true => Ok(self),
            false => Err(TubeError::TooFar),
        }
    }
}

/// Refuses more vertices than 32-bit indices count, those of two caps included.
pub(super) fn check_size(section: &Section, rings: usize) -> Result<(), TubeError> {
    let around = section.columns().len();
    match (rings as u128 + 3) * around as u128 > u32::MAX as u128 {
        true => Err(TubeError::TooMany { around, rings }),
        false => Ok(()),
    }
}

impl Ring {
    /// Where a point of the section stands.
    fn place(&self, point: DVec2) -> DVec3 {
        self.center + self.offset(point)
    }

    fn offset(&self, point: DVec2) -> DVec3 {
        (self.frame.normal * point.x + self.frame.binormal * point.y) * self.radius
    }
}

/// What tells the slope of the side along the tube.
enum Slopes<'a> {
    /// Two rings beside one, each with how far along the tube it is: the neighbours, or at
    /// an end of the curve the next two.
    Body([Option<(&'a Ring, f64)>; 2]),
    /// The circle that a round cap follows, at an angle.
    Cap(f64),
}

impl<'a> Slopes<'a> {
    fn at(rings: &'a [Ring], i: usize, closed: bool) -> Self {
        let last = rings.len() - 1;
        let beside = |j: usize| Some((rings.get(j)?, rings.get(j)?.s - rings[i].s));
        let length = rings[last].s - rings[0].s;
        Self::Body(match i {
            0 if closed => [beside(last - 1).map(|(r, s)| (r, s - length)), beside(1)],
            0 => [beside(1), beside(2)],
            i if i < last => [beside(i - 1), beside(i + 1)],
            _ if closed => [beside(last - 1), beside(1).map(|(r, s)| (r, s + length))],
            _ => [beside(last - 1), last.checked_sub(2).and_then(beside)],
        })
    }

    /// Unit normal of the side where `ring` has `point`: across the section's outline and
    /// the line that the point follows along the tube, so that taper, twist and bend are
    /// all seen. Where the side folds over itself, or stands still, it is the section's
    /// normal.
    fn normal(&self, ring: &Ring, point: DVec2, outward: DVec2) -> DVec3 {
        let frame = &ring.frame;
        let plain = frame.normal * outward.x + frame.binormal * outward.y;
        let around = frame.binormal * outward.x - frame.normal * outward.y;
        let normal = crate::frenet::unit(around.cross(self.along(ring, point)));
        // The tip of a round cap faces along the tube, where rounding decides about aside.
        let fits = |n: &DVec3| n.dot(plain) > 0.0 || n.dot(frame.tangent).abs() > 0.99;
        normal.filter(fits).unwrap_or(plain)
    }

    /// Direction of the line that `point` follows; by the slope of the parabola through
    /// three rings.
    fn along(&self, ring: &Ring, point: DVec2) -> DVec3 {
        let frame = &ring.frame;
        let here = ring.place(point);
        let slope = |beside: Option<(&Ring, f64)>| {
            let (other, step) = beside.filter(|b| b.1 != 0.0)?;
            Some(((other.place(point) - here) / step, step))
        };
        match self {
            Self::Cap(angle) => {
                let offset = frame.normal * point.x + frame.binormal * point.y;
                frame.tangent * libm::cos(*angle) - offset * libm::sin(*angle)
            }
            Self::Body(beside) => match beside.map(slope) {
                [Some((a, p)), Some((b, q))] if p != q => (a * q - b * p) / (q - p),
                [Some((only, _)), _] | [None, Some((only, _))] => only,
                [None, None] => frame.tangent,
            },
        }
    }
}
