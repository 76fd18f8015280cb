//! Even quads on the surface, then triangles.
//!
//! Vertices slide towards the mean of their neighbours within the tangent plane
//! and are brought back to the surface by Newton steps, all at once (Jacobi), so
//! that the result does not depend on an order or a thread count.

use crate::polygonise::Quads;
use crate::sdf::Solid;
use glam::DVec3;
use rayon::prelude::*;

/// Triangles with a smooth normal a vertex.
#[derive(Clone, Debug, Default)]
pub struct Triangles {
    /// Vertex positions.
    pub positions: Vec<DVec3>,
    /// Unit normal of each vertex.
    pub normals: Vec<DVec3>,
    /// Three vertices a triangle, anticlockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl Triangles {
    /// Adds another mesh that shares no vertex with this one.
    pub fn append(&mut self, other: &Triangles) {
        let base = self.positions.len() as u32;
        self.positions.extend_from_slice(&other.positions);
        self.normals.extend_from_slice(&other.normals);
        self.triangles
            .extend(other.triangles.iter().map(|t| t.map(|v| v + base)));
    }
}

/// Slides vertices for `rounds`, then splits the quads.
pub fn relaxed<P: Copy + PartialEq + Sync + Send>(
    solid: &Solid<P>,
    mut net: Quads,
    rounds: usize,
) -> Triangles {
    let neighbours = neighbours(&net);
    for _ in 0..rounds {
        net.positions = (0..net.positions.len())
            .into_par_iter()
            .map(|i| {
                let p = net.positions[i];
                let ring = &neighbours[i];
                let mean = ring
                    .iter()
                    .map(|&j| net.positions[j as usize])
                    .sum::<DVec3>()
                    / ring.len().max(1) as f64;
                let gradient = solid.gradient(p);
                let steep = gradient.length_squared().max(1e-3);
                let slide = mean - p;
                let moved = p + (slide - gradient * (slide.dot(gradient) / steep)) * 0.6;
                // One Newton step with the slope from before the slide.
                moved - gradient * (solid.distance(moved) / steep)
            })
            .collect();
    }
    let positions: Vec<DVec3> = (net.positions.par_iter())
        .map(|&p| solid.project(p, 8))
        .collect();
    let normals = positions.par_iter().map(|&p| solid.normal(p)).collect();
    let triangles = net
        .quads
        .iter()
        .flat_map(|q| split(&positions, q))
        .collect();
    Triangles {
        positions,
        normals,
        triangles,
    }
}

fn neighbours(net: &Quads) -> Vec<Vec<u32>> {
    let mut rings = vec![Vec::with_capacity(6); net.positions.len()];
    for quad in &net.quads {
        for k in 0..4 {
            let (a, b) = (quad[k], quad[(k + 1) % 4]);
            // The neighbouring quad names the edge the other way round.
            rings[a as usize].push(b);
        }
    }
    rings
}

/// The split whose narrowest triangle is the less narrow one.
fn split(positions: &[DVec3], q: &[u32; 4]) -> [[u32; 3]; 2] {
    let one = [[q[0], q[1], q[2]], [q[0], q[2], q[3]]];
    let other = [[q[0], q[1], q[3]], [q[1], q[2], q[3]]];
    let worst = |pair: &[[u32; 3]; 2]| {
        let quality = |t: &[u32; 3]| shape_quality(t.map(|v| positions[v as usize]));
        quality(&pair[0]).min(quality(&pair[1]))
    };
    if worst(&one) >= worst(&other) {
        one
    } else {
        other
    }
}

/// 1 for an equilateral triangle, 0 for a degenerate one: area over the mean
/// square of the sides.
pub fn shape_quality(t: [DVec3; 3]) -> f64 {
    let area2 = (t[1] - t[0]).cross(t[2] - t[0]).length();
    let sides =
        t[0].distance_squared(t[1]) + t[1].distance_squared(t[2]) + t[2].distance_squared(t[0]);
    area2 * 2.0 * 1.732_050_807_568_877_2 / sides
}
