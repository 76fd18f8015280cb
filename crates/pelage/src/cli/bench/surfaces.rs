//! Closed surfaces of any number of triangles, for measuring.

use libm::{cos, sin};
use pelage::surface::{Mesh, PolygonMesh};
use std::f64::consts::TAU;

/// A surface by its name.
pub struct Surface {
    pub name: &'static str,
    pub mesh: Mesh,
}

/// A formula over the unit square, and the columns and rows of its grid.
struct Shape(&'static str, [u32; 2], fn(f64, f64) -> [f64; 3]);

const SHAPES: [Shape; 3] = [
    Shape("torus", [264, 132], torus),
    Shape("knot", [1000, 200], knot),
    Shape("wrinkled ball", [1044, 522], wrinkled_ball),
];

/// The three surfaces of the tables: 70 thousand, 400 thousand and 1.09 million
/// triangles, the last as many as document 004 took. Each is made when it is its turn.
pub fn surfaces() -> impl ExactSizeIterator<Item = Surface> {
    SHAPES.iter().map(Shape::build)
}

/// The first of them.
pub fn first_surface() -> Surface {
    SHAPES[0].build()
}

impl Shape {
    fn build(&self) -> Surface {
        let Shape(name, [columns, rows], formula) = *self;
        Surface {
            name,
            // The grid has faces, and the formulas give numbers.
            mesh: Mesh::new(PolygonMesh::sheet(columns, rows, formula)).expect("a grid is a mesh"),
        }
    }
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
