//! What every example's mesh, atlas and guides keep to; the examples' tests call
//! these.

use crate::model::Model;
use crate::raster::canvas;
use crate::relax::{Triangles, shape_quality};
use crate::sdf::Solid;
use glam::DVec3;
use pelage_strands::StrandBuffer;
use std::collections::HashMap;

/// Every edge has two triangles that name it in opposite senses, and the triangles
/// around each vertex form one fan.
pub fn assert_closed_manifold(mesh: &Triangles) {
    let mut after: HashMap<(u32, u32), u32> = HashMap::new();
    for t in &mesh.triangles {
        for k in 0..3 {
            let [a, b, c] = [t[k], t[(k + 1) % 3], t[(k + 2) % 3]];
            assert!(
                after.insert((a, b), c).is_none(),
                "edge {a}-{b} twice at {}",
                mesh.positions[a as usize]
            );
        }
    }
    let mut degree = vec![0; mesh.positions.len()];
    for &(a, b) in after.keys() {
        assert!(after.contains_key(&(b, a)), "edge {a}-{b} is open");
        degree[a as usize] += 1;
    }
    let mut walked = vec![false; mesh.positions.len()];
    for &(a, b) in after.keys() {
        if std::mem::replace(&mut walked[a as usize], true) {
            continue;
        }
        let (mut at, mut steps) = (b, 0);
        loop {
            at = after[&(a, at)];
            steps += 1;
            if at == b {
                break;
            }
        }
        assert_eq!(steps, degree[a as usize], "vertex {a} has two fans");
    }
    assert!(walked.iter().all(|&w| w), "a vertex without a triangle");
}

/// No triangle is thinner than `least` of [`shape_quality`] and all look outwards.
pub fn assert_well_shaped(mesh: &Triangles, least: f64) {
    for t in &mesh.triangles {
        let p = t.map(|v| mesh.positions[v as usize]);
        assert!(shape_quality(p) > least, "{p:?}");
        let normal: DVec3 = t.iter().map(|&v| mesh.normals[v as usize]).sum();
        assert!((p[1] - p[0]).cross(p[2] - p[0]).dot(normal) > 0.0, "{p:?}");
    }
}

/// Coordinates are in 0..1 and no texel belongs to two triangles.
pub fn assert_atlas(model: &Model) {
    let inside = |x: f64| (0.0..=1.0).contains(&x);
    assert!(
        model
            .uvs
            .iter()
            .flatten()
            .all(|p| inside(p.x) && inside(p.y))
    );
    assert_eq!(canvas(&model.uvs, 2048).overlapping, Vec::<[u32; 2]>::new());
}

/// How much an atlas stretches: the greatest and the mean ratio of lengths in the
/// worst and the best direction of a triangle.
pub fn stretch(model: &Model) -> (f64, f64) {
    let (mut worst, mut sum, mut area_sum) = (1.0f64, 0.0, 0.0);
    for (t, uv) in model.mesh.triangles.iter().zip(&model.uvs) {
        let p = t.map(|v| model.mesh.positions[v as usize]);
        let (a, b) = (p[1] - p[0], p[2] - p[0]);
        let x = a.normalize();
        let (ax, bx) = (a.length(), b.dot(x));
        let by = (b - x * bx).length();
        let (ua, ub) = (uv[1] - uv[0], uv[2] - uv[0]);
        let (du, dv) = (ua / ax, (ub - ua * (bx / ax)) / by);
        let (e, g, f) = (du.length_squared(), dv.length_squared(), du.dot(dv));
        let root = ((e - g) * (e - g) + 4.0 * f * f).sqrt();
        let ratio = ((e + g + root) / (e + g - root).max(1e-30)).sqrt();
        worst = worst.max(ratio);
        sum += ratio * ax * by;
        area_sum += ax * by;
    }
    (worst, sum / area_sum)
}

/// Roots lie on their triangles, the rest of each guide outside the solid.
pub fn assert_guides<P: Copy + PartialEq>(
    solid: &Solid<P>,
    model: &Model,
    guides: &StrandBuffer,
    vertices: usize,
) {
    for s in 0..guides.len() {
        let points = guides.strand_points(s);
        assert_eq!(points.len(), vertices);
        let triangle = model.mesh.triangles[guides.triangle[s] as usize];
        let root: DVec3 = (0..3)
            .map(|k| model.mesh.positions[triangle[k] as usize] * guides.barycentric[s][k] as f64)
            .sum();
        assert!(root.distance(points[0].as_dvec3()) < 1e-6, "guide {s}");
        for (k, p) in points.iter().enumerate().skip(1) {
            let d = solid.distance(p.as_dvec3());
            assert!(d > 0.0, "vertex {k} of guide {s} is {d} deep at {p}");
        }
    }
}
