//! Polygons into triangles.
//!
//! Triangles and convex quadrilaterals are split directly (the quadrilateral along
//! its shorter diagonal); everything else goes to ear clipping (`earcut`) in the
//! plane that fits the polygon best.

use earcut::Earcut;
use pelage_curves::Vec3;

/// The corners of each triangle, as indices into `corner_vertices`; a polygon's
/// triangles follow each other and keep its orientation.
pub(crate) fn triangulate(
    positions: &[Vec3],
    face_sizes: &[u32],
    corner_vertices: &[u32],
) -> Vec<[u32; 3]> {
    let mut triangles = Vec::with_capacity(face_sizes.len() * 2);
    let mut clipper = Clipper::default();
    let mut first = 0u32;
    for &size in face_sizes {
        let corners = &corner_vertices[first as usize..(first + size) as usize];
        let at = |k: usize| positions[corners[k] as usize];
        match size {
            0..=2 => {}
            3 => triangles.push([first, first + 1, first + 2]),
            4 => match convex_quad(at(0), at(1), at(2), at(3)) {
                Some(split) => triangles.extend(split.map(|t| t.map(|k| first + k))),
                None => clipper.clip(first, size, at, &mut triangles),
            },
            _ => clipper.clip(first, size, at, &mut triangles),
        }
        first += size;
    }
    triangles
}

/// The two triangles of a convex quadrilateral, `None` where it is not convex.
fn convex_quad(a: Vec3, b: Vec3, c: Vec3, d: Vec3) -> Option<[[u32; 3]; 2]> {
    let normal = (c - a).cross(d - b);
    let turns = [(a, b, c), (b, c, d), (c, d, a), (d, a, b)];
    if turns
        .iter()
        .any(|&(p, q, r)| (q - p).cross(r - q).dot(normal) <= 0.0)
    {
        return None;
    }
    Some(if a.distance_squared(c) <= b.distance_squared(d) {
        [[0, 1, 2], [0, 2, 3]]
    } else {
        [[0, 1, 3], [1, 2, 3]]
    })
}

#[derive(Default)]
struct Clipper {
    earcut: Earcut<f64>,
    plane: Vec<[f64; 2]>,
    indices: Vec<u32>,
}

impl Clipper {
    fn clip(
        &mut self,
        first: u32,
        size: u32,
        at: impl Fn(usize) -> Vec3,
        triangles: &mut Vec<[u32; 3]>,
    ) {
        let n = size as usize;
        let origin = at(0).as_dvec3();
        // Newell's normal: twice the area vector, whatever the polygon's shape.
        let normal = (1..n.saturating_sub(1))
            .map(|k| (at(k).as_dvec3() - origin).cross(at(k + 1).as_dvec3() - origin))
            .sum::<pelage_curves::DVec3>();
        let (u, v) = normal
            .try_normalize()
            .map_or((pelage_curves::DVec3::X, pelage_curves::DVec3::Y), |n| {
                n.any_orthonormal_pair()
            });
        self.plane.clear();
        self.plane.extend((0..n).map(|k| {
            let p = at(k).as_dvec3() - origin;
            [p.dot(u), p.dot(v)]
        }));
        self.earcut
            .earcut(self.plane.iter().copied(), &[], &mut self.indices);
        for t in self.indices.chunks_exact(3) {
            let [a, b, c] = [t[0], t[1], t[2]].map(|k| at(k as usize).as_dvec3());
            let [p, q, r] = [t[0], t[1], t[2]].map(|k| first + k);
            let flipped = (b - a).cross(c - a).dot(normal) < 0.0;
            triangles.push(if flipped { [p, r, q] } else { [p, q, r] });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn an_l_shape_is_filled_exactly_once() {
        let outline = [(0., 0.), (3., 0.), (3., 1.), (1., 1.), (1., 3.), (0., 3.)];
        let positions: Vec<_> = outline.iter().map(|&(x, y)| Vec3::new(0.0, x, y)).collect();
        let triangles = triangulate(&positions, &[6], &[0, 1, 2, 3, 4, 5]);
        let area: f32 = triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|k| positions[k as usize]);
                (b - a).cross(c - a).x / 2.0
            })
            .sum();
        assert!((area - 5.0).abs() < 1e-5, "signed area {area}");
        assert_eq!(triangles.len(), 4);
    }

    proptest! {
        #[test]
        fn any_polygon_gives_valid_corners(
            points in prop::collection::vec(prop::array::uniform3(-2i8..3), 3..12)
        ) {
            let positions: Vec<_> =
                points.iter().map(|p| Vec3::new(p[0] as f32, p[1] as f32, p[2] as f32)).collect();
            let corners: Vec<u32> = (0..points.len() as u32).collect();
            let triangles = triangulate(&positions, &[points.len() as u32], &corners);
            prop_assert!(triangles.len() <= points.len() - 2);
            prop_assert!(triangles.iter().flatten().all(|&k| (k as usize) < points.len()));
        }
    }
}
