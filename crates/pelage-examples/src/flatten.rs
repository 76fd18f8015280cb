//! Flattening a chart with little stretch: as rigid as possible.
//!
//! Liu, Zhang, Xu, Gotsman, Gortler, "A local/global approach to mesh
//! parameterization" (2008), started either from a direction field that texture u
//! shall follow (one Poisson solve) or from a map. Cotangent weights are clamped
//! above zero, which keeps the system definite on obtuse triangles.

use crate::sheet::Sheet;
use glam::{DVec2, DVec3};

/// What the flattening starts from.
pub enum Start<'a> {
    /// u follows this direction at a place with this normal.
    Along(&'a dyn Fn(DVec3, DVec3) -> DVec3),
    /// This map of a place.
    Map(&'a dyn Fn(DVec3) -> DVec2),
}

/// A triangle in its own plane: edge `k` goes from corner `k` to the next.
struct Flat {
    edges: [DVec2; 3],
    weights: [f64; 3],
    /// Cosine and sine of the turn from the triangle's plane to the chart.
    turn: DVec2,
}

/// Vertices' neighbours with weights: the Laplacian in compressed rows.
struct Laplacian {
    starts: Vec<u32>,
    columns: Vec<u32>,
    weights: Vec<f64>,
    diagonal: Vec<f64>,
}

/// Texture coordinates, in units of length, of each point of the sheet.
pub fn flatten(sheet: &Sheet, start: &Start, rounds: usize) -> Vec<DVec2> {
    let mut flats = flats(sheet, start);
    let system = laplacian(sheet, &flats);
    let mut uv: Vec<DVec2> = match start {
        Start::Map(map) => sheet.points.iter().map(|&p| map(p)).collect(),
        Start::Along(_) => {
            let mut uv = vec![DVec2::ZERO; sheet.points.len()];
            solve(&system, sheet, &flats, &mut uv, 600);
            uv
        }
    };
    for round in 0..rounds {
        turn(sheet, &mut flats, &uv);
        let steps = if round + 1 == rounds { 200 } else { 60 };
        solve(&system, sheet, &flats, &mut uv, steps);
    }
    uv
}

fn flats(sheet: &Sheet, start: &Start) -> Vec<Flat> {
    (sheet.corners.iter())
        .map(|c| {
            let p = c.map(|v| sheet.points[v as usize]);
            let normal = (p[1] - p[0]).cross(p[2] - p[0]).normalize_or(DVec3::Y);
            let wanted = match start {
                Start::Along(field) => field((p[0] + p[1] + p[2]) / 3.0, normal),
                Start::Map(_) => p[1] - p[0],
            };
            let along = (wanted - normal * wanted.dot(normal))
                .try_normalize()
                .unwrap_or_else(|| (p[1] - p[0]).normalize_or(DVec3::X));
            let across = normal.cross(along);
            let edge = |k: usize| p[(k + 1) % 3] - p[k];
            Flat {
                edges: [0, 1, 2].map(|k| DVec2::new(edge(k).dot(along), edge(k).dot(across))),
                weights: [0, 1, 2].map(|k| {
                    let (a, b) = (edge((k + 1) % 3), -edge((k + 2) % 3));
                    let cotangent = a.dot(-b) / a.cross(b).length().max(1e-300);
                    (-cotangent).max(0.02)
                }),
                turn: DVec2::X,
            }
        })
        .collect()
}

fn laplacian(sheet: &Sheet, flats: &[Flat]) -> Laplacian {
    let n = sheet.points.len();
    let mut entries: Vec<(u32, u32, f64)> = Vec::with_capacity(flats.len() * 6);
    for (corners, flat) in sheet.corners.iter().zip(flats) {
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            entries.push((a, b, flat.weights[k]));
            entries.push((b, a, flat.weights[k]));
        }
    }
    entries.sort_by_key(|e| (e.0, e.1));
    let mut out = Laplacian {
        starts: vec![0; n + 1],
        columns: Vec::new(),
        weights: Vec::new(),
        diagonal: vec![1e-9; n],
    };
    for (row, column, weight) in entries {
        let fresh = out.starts[row as usize + 1] == 0;
        if !fresh && out.columns.last() == Some(&column) {
            if let Some(last) = out.weights.last_mut() {
                *last += weight;
            }
        } else {
            out.columns.push(column);
            out.weights.push(weight);
        }
        out.starts[row as usize + 1] = out.columns.len() as u32;
        out.diagonal[row as usize] += weight;
    }
    for i in 1..=n {
        out.starts[i] = out.starts[i].max(out.starts[i - 1]);
    }
    out
}

/// The local step: the turn that best carries each triangle onto its image.
fn turn(sheet: &Sheet, flats: &mut [Flat], uv: &[DVec2]) {
    for (corners, flat) in sheet.corners.iter().zip(flats) {
        let mut sum = DVec2::ZERO;
        for k in 0..3 {
            let image = uv[corners[(k + 1) % 3] as usize] - uv[corners[k] as usize];
            let edge = flat.edges[k];
            sum += DVec2::new(image.dot(edge), edge.perp_dot(image)) * flat.weights[k];
        }
        flat.turn = sum.try_normalize().unwrap_or(flat.turn);
    }
}

/// The global step: conjugate gradients with a diagonal preconditioner, from
/// the `uv` there are.
fn solve(system: &Laplacian, sheet: &Sheet, flats: &[Flat], uv: &mut [DVec2], steps: usize) {
    let mut residual = vec![DVec2::ZERO; uv.len()];
    for (corners, flat) in sheet.corners.iter().zip(flats) {
        for k in 0..3 {
            let pull = flat.turn.rotate(flat.edges[k]) * flat.weights[k];
            residual[corners[(k + 1) % 3] as usize] += pull;
            residual[corners[k] as usize] -= pull;
        }
    }
    let mut image = vec![DVec2::ZERO; uv.len()];
    apply(system, uv, &mut image);
    for (r, i) in residual.iter_mut().zip(&image) {
        *r -= *i;
    }
    let scaled = |r: &[DVec2]| -> Vec<DVec2> {
        r.iter()
            .zip(&system.diagonal)
            .map(|(r, d)| *r / *d)
            .collect()
    };
    let mut z = scaled(&residual);
    let mut direction = z.clone();
    // u and v share the matrix and are solved side by side.
    let dots = |a: &[DVec2], b: &[DVec2]| a.iter().zip(b).map(|(a, b)| *a * *b).sum::<DVec2>();
    let ratio = |a: DVec2, b: DVec2| {
        let part = |a: f64, b: f64| if b.abs() > 1e-300 { a / b } else { 0.0 };
        DVec2::new(part(a.x, b.x), part(a.y, b.y))
    };
    let mut rz = dots(&residual, &z);
    let enough = rz * 1e-14;
    for _ in 0..steps {
        apply(system, &direction, &mut image);
        let alpha = ratio(rz, dots(&direction, &image));
        for i in 0..uv.len() {
            uv[i] += alpha * direction[i];
            residual[i] -= alpha * image[i];
        }
        z = scaled(&residual);
        let next = dots(&residual, &z);
        if next.x <= enough.x && next.y <= enough.y {
            break;
        }
        let beta = ratio(next, rz);
        rz = next;
        for (d, z) in direction.iter_mut().zip(&z) {
            *d = *z + beta * *d;
        }
    }
}

fn apply(system: &Laplacian, x: &[DVec2], out: &mut [DVec2]) {
    for (i, out) in out.iter_mut().enumerate() {
        let row = system.starts[i] as usize..system.starts[i + 1] as usize;
        let mut sum = x[i] * system.diagonal[i];
        for (&column, &weight) in system.columns[row.clone()].iter().zip(&system.weights[row]) {
            sum -= x[column as usize] * weight;
        }
        *out = sum;
    }
}
