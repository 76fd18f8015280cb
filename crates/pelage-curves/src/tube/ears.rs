//! A simple polygon in triangles, by clipping ears.
//!
//! Every vertex is kept, also those in the middle of a straight edge: a cap has to share
//! every edge of the tube's last ring, or the mesh leaks there. (Libraries that
//! triangulate leave such vertices out.) Quadratic in the vertices.

use glam::DVec2;

/// Triangles of the polygon through `points`, which goes counter-clockwise; two fewer than
/// points, counter-clockwise. Every edge of the polygon is an edge of one triangle,
/// whatever the points.
pub(super) fn triangles(points: &[DVec2]) -> Vec<[u32; 3]> {
    let mut left: Vec<u32> = (0..points.len() as u32).collect();
    let mut triangles = Vec::with_capacity(points.len().saturating_sub(2));
    let mut at = 0;
    while left.len() > 3 {
        let n = left.len();
        let corner = |i: usize| [left[(i + n - 1) % n], left[i % n], left[(i + 1) % n]];
        let ears = (at..at + n).map(|i| i % n);
        // Rounding can leave none: then any will do, as its edges still close.
        let ear = ears.clone().find(|&i| is_ear(points, &left, corner(i)));
        let ear = ear.unwrap_or(at % n);
        triangles.push(corner(ear));
        left.remove(ear);
        // Not the next, which would make a fan of slivers.
        at = ear + 1;
    }
    if let &[a, b, c] = &left[..] {
        triangles.push([a, b, c]);
    }
    triangles
}

/// Whether a corner turns left and holds no other vertex, on its edges neither.
fn is_ear(points: &[DVec2], left: &[u32], corner: [u32; 3]) -> bool {
    let [a, b, c] = corner.map(|i| points[i as usize]);
    let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
    side(a, b, c) > 0.0
        && left.iter().filter(|i| !corner.contains(i)).all(|&i| {
            let p = points[i as usize];
            side(a, b, p) < 0.0 || side(b, c, p) < 0.0 || side(c, a, p) < 0.0
        })
}
