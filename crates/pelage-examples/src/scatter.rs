//! Evenly spread places on a mesh: hashed candidates, thinned to a distance.

use crate::hash::unit;
use crate::model::Model;
use crate::raster::Texel;
use glam::{DVec2, DVec3};
use std::collections::HashMap;

/// Where a guide grows.
#[derive(Clone, Copy, Debug)]
pub struct Root {
    /// The place on the mesh.
    pub texel: Texel,
    /// Its position.
    pub position: DVec3,
    /// The smooth normal there.
    pub normal: DVec3,
    /// Its texture coordinates.
    pub uv: DVec2,
}

/// Candidates for each root asked for: more are more even.
const CANDIDATES: usize = 12;

/// About `count` roots where `wanted` (of position and normal) holds, no two
/// nearer than some distance.
pub fn scatter(
    model: &Model,
    count: usize,
    seed: u64,
    wanted: impl Fn(DVec3, DVec3) -> bool,
) -> Vec<Root> {
    let candidates = candidates(model, count * CANDIDATES, seed, wanted);
    let area_each = candidates.1 / count as f64;
    let candidates = candidates.0;
    // Darts thrown at a plane fill about 0.7 of the hexagonal packing; search the
    // distance that gives the count.
    let (mut low, mut high) = (0.0, (area_each * 1.16).sqrt() * 1.5);
    for _ in 0..20 {
        let middle = 0.5 * (low + high);
        if thinned(&candidates, middle).len() > count {
            low = middle;
        } else {
            high = middle;
        }
    }
    thinned(&candidates, high)
}

/// Places drawn by area, and the area they stand for.
fn candidates(
    model: &Model,
    count: usize,
    seed: u64,
    wanted: impl Fn(DVec3, DVec3) -> bool,
) -> (Vec<Root>, f64) {
    let mut sums = Vec::with_capacity(model.mesh.triangles.len());
    let mut total = 0.0;
    for tri in &model.mesh.triangles {
        let p = tri.map(|v| model.mesh.positions[v as usize]);
        total += 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).length();
        sums.push(total);
    }
    let drawn = |i: u64| {
        let at = unit(seed, i * 3) * total;
        let triangle = sums.partition_point(|&s| s <= at).min(sums.len() - 1);
        let root = unit(seed, i * 3 + 1).sqrt();
        let side = unit(seed, i * 3 + 2);
        place(
            model,
            Texel {
                triangle: triangle as u32,
                weights: [1.0 - root, root * (1.0 - side), root * side],
            },
        )
    };
    let all: Vec<Root> = (0..count as u64)
        .map(drawn)
        .filter(|r| wanted(r.position, r.normal))
        .collect();
    let area = total * all.len() as f64 / count as f64;
    (all, area)
}

fn place(model: &Model, texel: Texel) -> Root {
    let (position, normal) = model.place(&texel);
    let uv = model.uvs[texel.triangle as usize];
    Root {
        texel,
        position,
        normal,
        uv: (0..3).map(|k| uv[k] * texel.weights[k]).sum(),
    }
}

/// Takes candidates in order, leaving out those nearer than `distance` to one
/// already taken.
fn thinned(candidates: &[Root], distance: f64) -> Vec<Root> {
    let cell = |p: DVec3| (p / distance).floor().to_array().map(|x| x as i64);
    let mut grid: HashMap<[i64; 3], Vec<DVec3>> = HashMap::new();
    let mut out = Vec::new();
    for root in candidates {
        let home = cell(root.position);
        let near = (0..27).any(|k| {
            let beside = [
                home[0] + k % 3 - 1,
                home[1] + k / 3 % 3 - 1,
                home[2] + k / 9 - 1,
            ];
            grid.get(&beside).is_some_and(|there| {
                there
                    .iter()
                    .any(|p| p.distance_squared(root.position) < distance * distance)
            })
        });
        if !near {
            grid.entry(home).or_default().push(root.position);
            out.push(*root);
        }
    }
    out
}
