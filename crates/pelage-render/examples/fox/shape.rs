//! The body as blended round cones, and its skin as surface nets.

use pelage_curves::Vec3;
use pelage_surface::Mesh;
use std::collections::HashMap;

/// A cone with round ends, from the end where fur starts to where it points.
pub struct Part {
    pub name: &'static str,
    pub a: Vec3,
    pub b: Vec3,
    pub radii: [f32; 2],
    /// Length of its fur.
    pub fur: f32,
}

const fn part(name: &'static str, a: [f32; 3], b: [f32; 3], radii: [f32; 2], fur: f32) -> Part {
    Part {
        name,
        a: Vec3::from_array(a),
        b: Vec3::from_array(b),
        radii,
        fur,
    }
}

/// The fox looks along +Z; left and right are mirrored in X.
static PARTS: [Part; 17] = [
    part(
        "chest",
        [0.0, 1.02, 0.52],
        [0.0, 1.06, 0.10],
        [0.30, 0.285],
        0.20,
    ),
    part(
        "belly",
        [0.0, 1.06, 0.10],
        [0.0, 1.08, -0.50],
        [0.275, 0.255],
        0.17,
    ),
    part(
        "rump",
        [0.0, 1.08, -0.40],
        [0.0, 1.06, -0.68],
        [0.265, 0.20],
        0.17,
    ),
    part(
        "neck",
        [0.0, 1.46, 0.80],
        [0.0, 1.12, 0.50],
        [0.165, 0.25],
        0.20,
    ),
    part(
        "skull",
        [0.0, 1.56, 0.98],
        [0.0, 1.52, 0.82],
        [0.165, 0.185],
        0.10,
    ),
    part(
        "cheek",
        [0.055, 1.50, 1.02],
        [0.15, 1.44, 0.86],
        [0.10, 0.095],
        0.15,
    ),
    part(
        "snout",
        [0.0, 1.45, 1.33],
        [0.0, 1.505, 1.08],
        [0.052, 0.105],
        0.035,
    ),
    part(
        "nose",
        [0.0, 1.468, 1.375],
        [0.0, 1.462, 1.36],
        [0.032, 0.036],
        0.0,
    ),
    part(
        "eye",
        [0.079, 1.588, 1.113],
        [0.079, 1.586, 1.10],
        [0.031, 0.031],
        0.0,
    ),
    part(
        "ear",
        [0.095, 1.68, 0.88],
        [0.165, 1.90, 0.85],
        [0.075, 0.018],
        0.055,
    ),
    part(
        "foreleg",
        [0.145, 0.95, 0.50],
        [0.15, 0.42, 0.53],
        [0.15, 0.066],
        0.075,
    ),
    part(
        "foreshin",
        [0.15, 0.42, 0.53],
        [0.15, 0.09, 0.55],
        [0.064, 0.052],
        0.04,
    ),
    part(
        "forepaw",
        [0.15, 0.06, 0.54],
        [0.15, 0.055, 0.63],
        [0.060, 0.056],
        0.03,
    ),
    part(
        "thigh",
        [0.15, 1.00, -0.50],
        [0.16, 0.58, -0.50],
        [0.21, 0.10],
        0.10,
    ),
    part(
        "shin",
        [0.16, 0.58, -0.50],
        [0.16, 0.10, -0.68],
        [0.086, 0.053],
        0.045,
    ),
    part(
        "hindpaw",
        [0.16, 0.06, -0.66],
        [0.16, 0.055, -0.55],
        [0.060, 0.056],
        0.03,
    ),
    part(
        "tail",
        [0.0, 1.05, -0.80],
        [0.0, 0.62, -1.52],
        [0.095, 0.075],
        0.26,
    ),
];

/// How far apart parts begin to blend.
const BLEND: f32 = 0.07;

/// The body near a place.
pub struct Nearby {
    /// The part that is nearest.
    pub part: &'static Part,
    /// Mean direction of the fur of the parts around.
    pub flow: Vec3,
    /// Mean length of their fur.
    pub fur: f32,
    /// Place along the nearest part, 0..=1.
    pub along: f32,
}

fn mirrored(p: Vec3) -> Vec3 {
    Vec3::new(p.x.abs(), p.y, p.z)
}

fn part_distance(part: &Part, p: Vec3) -> (f32, f32) {
    let axis = part.b - part.a;
    let t = ((p - part.a).dot(axis) / axis.length_squared()).clamp(0.0, 1.0);
    let radius = part.radii[0] + (part.radii[1] - part.radii[0]) * t;
    let mut offset = p - part.a - axis * t;
    // Ears are flat.
    if part.name == "ear" {
        offset.z *= 2.2;
    }
    (offset.length() - radius, t)
}

/// Signed distance to the body at `p`, about.
pub fn distance(p: Vec3) -> f32 {
    let q = mirrored(p);
    let mut nearest = f32::INFINITY;
    for part in &PARTS {
        let (d, _) = part_distance(part, q);
        let blend = if part.fur == 0.0 { 0.008 } else { BLEND };
        let h = (blend - (nearest - d).abs()).max(0.0) / blend;
        nearest = nearest.min(d) - h * h * blend * 0.25;
    }
    nearest
}

/// Unit normal of the level set through `p`.
pub fn normal(p: Vec3) -> Vec3 {
    let e = 2e-3;
    let along = |axis: Vec3| distance(p + axis * e) - distance(p - axis * e);
    Vec3::new(along(Vec3::X), along(Vec3::Y), along(Vec3::Z)).normalize_or(Vec3::Y)
}

/// What the body is like around `p`.
pub fn nearby(p: Vec3) -> Nearby {
    let q = mirrored(p);
    let (mut flow, mut fur, mut total) = (Vec3::ZERO, 0.0, 0.0);
    let mut nearest = (f32::INFINITY, &PARTS[0], 0.0);
    for part in &PARTS {
        let (d, t) = part_distance(part, q);
        if d < nearest.0 {
            nearest = (d, part, t);
        }
        let weight = (-d.max(0.0) / 0.045).exp();
        flow += (part.b - part.a).normalize() * weight;
        fur += part.fur * weight;
        total += weight;
    }
    if p.x < 0.0 {
        flow.x = -flow.x;
    }
    let bare = nearest.1.fur == 0.0;
    Nearby {
        part: nearest.1,
        flow: flow.normalize_or(Vec3::NEG_Z),
        fur: if bare { 0.0 } else { fur / total },
        along: nearest.2,
    }
}

/// The skin as triangles, from naive surface nets over cells of `cell`.
pub fn skin(cell: f32) -> Mesh {
    let low = Vec3::new(-0.6, -0.08, -1.75);
    let dims = [
        (1.2 / cell) as i32,
        (2.15 / cell) as i32,
        (3.3 / cell) as i32,
    ];
    let corner = |i: [i32; 3]| low + Vec3::new(i[0] as f32, i[1] as f32, i[2] as f32) * cell;
    let mut values = HashMap::new();
    let mut value = |i: [i32; 3]| *values.entry(i).or_insert_with(|| distance(corner(i)));
    let mut net = Net::default();
    for z in 1..dims[2] {
        for y in 1..dims[1] {
            for x in 1..dims[0] {
                let here = value([x, y, z]);
                for axis in 0..3 {
                    let mut next = [x, y, z];
                    next[axis] += 1;
                    let there = value(next);
                    if (here < 0.0) != (there < 0.0) {
                        net.face([x, y, z], axis, here < 0.0);
                    }
                }
            }
        }
    }
    net.mesh(|cell_index| {
        let mut p = corner(cell_index) + Vec3::splat(0.5 * cell);
        for _ in 0..4 {
            p -= normal(p) * distance(p);
        }
        p
    })
}

/// Quads between cells.
#[derive(Default)]
struct Net {
    cells: HashMap<[i32; 3], u32>,
    order: Vec<[i32; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl Net {
    fn vertex(&mut self, cell: [i32; 3]) -> u32 {
        let fresh = self.order.len() as u32;
        let order = &mut self.order;
        *self.cells.entry(cell).or_insert_with(|| {
            order.push(cell);
            fresh
        })
    }

    /// The quad around the edge from `from` along `axis`.
    fn face(&mut self, from: [i32; 3], axis: usize, outwards: bool) {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let around = [[-1, -1], [0, -1], [0, 0], [-1, 0]];
        let mut quad = around.map(|[du, dv]| {
            let mut cell = from;
            cell[u] += du;
            cell[v] += dv;
            self.vertex(cell)
        });
        if !outwards {
            quad.reverse();
        }
        self.triangles.push([quad[0], quad[1], quad[2]]);
        self.triangles.push([quad[0], quad[2], quad[3]]);
    }

    fn mesh(self, place: impl Fn([i32; 3]) -> Vec3) -> Mesh {
        let positions: Vec<Vec3> = self.order.iter().map(|&c| place(c)).collect();
        let normals: Vec<Vec3> = positions.iter().map(|&p| normal(p)).collect();
        let corner = |v: u32| normals[v as usize].to_array();
        Mesh {
            normals: self.triangles.iter().map(|t| t.map(corner)).collect(),
            positions: positions.iter().map(|p| p.to_array()).collect(),
            triangles: self.triangles,
            uvs: Vec::new(),
            tangents: Vec::new(),
        }
    }
}
