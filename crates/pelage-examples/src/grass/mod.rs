//! `grass`: a meadow on rolling ground with a path, grown guides and tall tufts.

use crate::example::Example;
use crate::hash::{fractal, smoothstep};
use crate::raster::{image, quantised, srgb};
use glam::{DVec2, DVec3};
use pelage_surface::{ImageMap, PolygonMesh};

/// Faces a side.
const FACES: usize = 80;
/// Length of a side; y is up and the middle lies at the origin.
const SIDE: f64 = 4.0;
/// Texels a side of each map.
const TEXELS: u32 = 512;

/// The example.
pub fn example() -> Example {
    Example {
        name: "grass",
        summary: "a meadow with a path: grown guides, patches by a density map",
        recipe: include_str!("groom.toml").to_owned(),
        mesh_file: "ground.obj",
        mesh: ground(),
        maps: vec![
            ("density.png", painted(|p| [density(p)])),
            ("length.png", painted(|p| [length(p)])),
            ("root_color.png", painted(|p| srgb(root_color(p)))),
            ("tip_color.png", painted(|p| srgb(tip_color(p)))),
            ("skin.png", painted(|p| srgb(soil_color(p)))),
        ],
        guides: None,
        curves: None,
    }
}

/// The place on the plane of texture coordinates: u along x, v away along -z.
fn place(uv: DVec2) -> DVec2 {
    DVec2::new(uv.x - 0.5, 0.5 - uv.y) * SIDE
}

/// Height of the ground.
fn height(p: DVec2) -> f64 {
    let hills = 0.28 * fractal(61, DVec3::new(p.x * 0.45, 0.5, p.y * 0.45));
    let bumps = 0.02 * fractal(62, DVec3::new(p.x * 2.5, 0.5, p.y * 2.5));
    hills + bumps - 0.05 * on_path(p)
}

fn ground() -> PolygonMesh {
    let mut mesh = PolygonMesh::default();
    let uv = |i: usize, j: usize| DVec2::new(i as f64, j as f64) / FACES as f64;
    let vertex = |i: usize, j: usize| (j * (FACES + 1) + i) as u32;
    for j in 0..=FACES {
        for i in 0..=FACES {
            let p = place(uv(i, j));
            mesh.positions
                .push([p.x as f32, height(p) as f32, p.y as f32]);
        }
    }
    for j in 0..FACES {
        for i in 0..FACES {
            mesh.face_sizes.push(4);
            for (i, j) in [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)] {
                mesh.corner_vertices.push(vertex(i, j));
                mesh.corner_uvs.push(uv(i, j).as_vec2().to_array());
                mesh.corner_normals
                    .push(normal(place(uv(i, j))).as_vec3().to_array());
            }
        }
    }
    mesh
}

fn normal(p: DVec2) -> DVec3 {
    let h = 1e-4;
    let slope = |e: DVec2| (height(p + e * h) - height(p - e * h)) / (2.0 * h);
    DVec3::new(-slope(DVec2::X), 1.0, -slope(DVec2::Y)).normalize()
}

fn painted<const N: usize>(paint: impl Fn(DVec2) -> [f64; N]) -> ImageMap {
    let mut texels = Vec::with_capacity((TEXELS * TEXELS) as usize * N);
    for y in 0..TEXELS {
        for x in 0..TEXELS {
            let uv = DVec2::new(x as f64 + 0.5, TEXELS as f64 - y as f64 - 0.5) / TEXELS as f64;
            texels.extend(paint(place(uv)).map(quantised));
        }
    }
    image(TEXELS, TEXELS, N as u32, texels)
}

/// Noise over the plane, in -1..1.
fn patches(channel: u64, p: DVec2, frequency: f64) -> f64 {
    fractal(channel, DVec3::new(p.x * frequency, 0.5, p.y * frequency))
}

/// 1 on the path that winds from the front to the back.
fn on_path(p: DVec2) -> f64 {
    let middle = 0.55 * libm::sin(p.y * 1.3 + 0.6) + 0.10 * patches(71, p, 0.8);
    let away = (p.x - middle).abs() + 0.05 * patches(72, p, 4.0);
    1.0 - smoothstep(0.13, 0.30, away)
}

fn density(p: DVec2) -> f64 {
    let tufts = smoothstep(-0.55, 0.25, patches(73, p, 1.7));
    (0.25 + 0.75 * tufts) * (1.0 - on_path(p))
}

fn length(p: DVec2) -> f64 {
    let tall = smoothstep(-0.5, 0.6, patches(74, p, 0.9));
    (0.45 + 0.55 * tall) * (1.0 - 0.6 * on_path(p))
}

/// 0 where the meadow is lush, 1 where it is dry.
fn dry(p: DVec2) -> f64 {
    smoothstep(-0.1, 0.7, patches(75, p, 1.1)).max(0.5 * on_path(p))
}

fn root_color(p: DVec2) -> [f64; 3] {
    let lush = DVec3::new(0.020, 0.060, 0.010);
    lush.lerp(DVec3::new(0.10, 0.085, 0.025), dry(p)).to_array()
}

fn tip_color(p: DVec2) -> [f64; 3] {
    let shade = 0.5 + 0.5 * patches(76, p, 6.0);
    let lush = DVec3::new(0.13, 0.32, 0.035).lerp(DVec3::new(0.24, 0.42, 0.06), shade);
    lush.lerp(DVec3::new(0.55, 0.48, 0.17), dry(p)).to_array()
}

fn soil_color(p: DVec2) -> [f64; 3] {
    let grain = 0.5 + 0.5 * patches(77, p, 14.0);
    let soil = DVec3::new(0.05, 0.035, 0.02).lerp(DVec3::new(0.09, 0.065, 0.04), grain);
    soil.lerp(DVec3::new(0.22, 0.16, 0.10), on_path(p))
        .to_array()
}
