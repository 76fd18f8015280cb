//! Closed surfaces of any number of triangles, for measuring.

use libm::{cos, sin};
use pelage::surface::{Mesh, PolygonMesh};
use std::f64::consts::TAU;

/// A surface by its name.
pub struct Surface {
    pub name: &'static str,
    pub mesh: Mesh,
}

/// The three surfaces of the tables: 70 thousand, 400 thousand and 1.09 million
/// triangles, the last as many as document 004 took.
pub fn surfaces() -> Vec<Surface> {
    let surface = |name, columns, rows, shape: fn(f64, f64) -> [f64; 3]| Surface {
        name,
        mesh: sheet(columns, rows, shape),
    };
    vec![
        surface("torus", 264, 132, torus),
        surface("knot", 1000, 200, knot),
        surface("wrinkled ball", 1044, 522, wrinkled_ball),
    ]
}

/// A grid over the unit square of texture, two triangles a cell. The corners come from
/// formulas without rounding apart, so that every mesh is sound.
fn sheet(columns: u32, rows: u32, shape: fn(f64, f64) -> [f64; 3]) -> Mesh {
    let mut mesh = PolygonMesh::default();
    let [across, up] = [columns, rows].map(|n| move |i: u32| i as f64 / n as f64);
    for y in 0..=rows {
        for x in 0..=columns {
            let point = shape(across(x), up(y));
            mesh.positions.push(point.map(|c| c as f32));
        }
    }
    for y in 0..rows {
        for x in 0..columns {
            for corner in [[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]] {
                let [x, y] = [x + corner[0], y + corner[1]];
                mesh.corner_vertices.push(y * (columns + 1) + x);
                mesh.corner_uvs.push([across(x) as f32, up(y) as f32]);
            }
            mesh.face_sizes.extend([3, 3]);
        }
    }
    // The grid has triangles, and every corner names a vertex of it.
    Mesh::new(mesh).expect("a grid is a mesh")
}

fn torus(u: f64, v: f64) -> [f64; 3] {
    let (a, b) = (TAU * u, TAU * v);
    let radius = 1.0 + 0.4 * cos(b);
    [radius * cos(a), 0.4 * sin(b), -radius * sin(a)]
}

/// A tube about a trefoil knot.
fn knot(u: f64, v: f64) -> [f64; 3] {
    let centre = |a: f64| {
        [
            sin(a) + 2.0 * sin(2.0 * a),
            cos(a) - 2.0 * cos(2.0 * a),
            -sin(3.0 * a),
        ]
    };
    let (a, b) = (TAU * u, TAU * v);
    let [p, q] = [centre(a), centre(a + 1e-3)];
    let along: [f64; 3] = std::array::from_fn(|k| q[k] - p[k]);
    let side = unit(cross(along, [0.0, 0.0, 1.0]));
    let up = unit(cross(side, along));
    std::array::from_fn(|k| p[k] + 0.5 * (cos(b) * side[k] + sin(b) * up[k]))
}

fn wrinkled_ball(u: f64, v: f64) -> [f64; 3] {
    let (a, b) = (TAU * u, 0.5 * TAU * (v - 0.5));
    let wrinkles = 0.03 * sin(40.0 * b) * cos(30.0 * a) * cos(b);
    let radius = 1.0 + wrinkles;
    [
        radius * cos(b) * cos(a),
        radius * sin(b),
        -radius * cos(b) * sin(a),
    ]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = a.iter().map(|x| x * x).sum::<f64>().sqrt();
    a.map(|x| x / length)
}
