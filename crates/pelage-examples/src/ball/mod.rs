//! `ball`: a sphere with painted maps, the simplest whole groom.

use crate::example::Example;
use crate::hash::{fractal, smoothstep};
use crate::raster::{image, quantised, srgb};
use glam::{DVec2, DVec3};
use pelage_surface::{ImageMap, PolygonMesh};
use std::f64::consts::{PI, TAU};

/// Faces around the equator.
const AROUND: usize = 96;
/// Faces from pole to pole.
const UP: usize = 48;
/// Texels of each map: width and height.
const TEXELS: (u32, u32) = (1024, 512);

/// The example.
pub fn example() -> Example {
    Example {
        name: "ball",
        summary: "a sphere with a painted letter and spots: maps and grown guides",
        recipe: include_str!("groom.toml").to_owned(),
        mesh_file: "ball.obj",
        mesh: sphere(),
        maps: vec![
            ("density.png", painted(|p, uv| [density(p, uv)])),
            ("length.png", painted(|p, uv| [length(p, uv)])),
            (
                "root_color.png",
                painted(|p, uv| srgb(color(p, uv).map(|c| c * 0.45))),
            ),
            ("tip_color.png", painted(|p, uv| srgb(color(p, uv)))),
        ],
        guides: None,
        curves: None,
    }
}

/// The unit direction at a place of the maps: u once around y from -z, so that
/// the middle of the image looks along +z; v from the south pole up.
fn direction(uv: DVec2) -> DVec3 {
    let (sin_around, cos_around) = libm::sincos((uv.x - 0.5) * TAU);
    let (sin_up, cos_up) = libm::sincos((uv.y - 0.5) * PI);
    DVec3::new(cos_up * sin_around, sin_up, cos_up * cos_around)
}

/// Quads between rings, triangles at the poles; one vertex a pole.
fn sphere() -> PolygonMesh {
    let mut mesh = PolygonMesh::default();
    let uv = |i: usize, j: usize| DVec2::new(i as f64 / AROUND as f64, j as f64 / UP as f64);
    let vertex = |i: usize, j: usize| match j {
        0 => 0,
        UP => 1,
        _ => 2 + ((j - 1) * AROUND + i % AROUND) as u32,
    };
    mesh.positions = vec![[0.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
    for j in 1..UP {
        for i in 0..AROUND {
            mesh.positions
                .push(direction(uv(i, j)).as_vec3().to_array());
        }
    }
    for j in 0..UP {
        for i in 0..AROUND {
            let ring: &[(usize, usize)] = &[(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            let corners = match j {
                0 => &[ring[0], ring[2], ring[3]][..],
                _ if j + 1 == UP => &ring[..3],
                _ => ring,
            };
            mesh.face_sizes.push(corners.len() as u32);
            for &(i, j) in corners {
                let mut at = uv(i, j);
                // A pole has no longitude: take the middle of the face's.
                if corners.len() == 3 && (j == 0 || j == UP) {
                    at.x = uv(ring[0].0, j).x + 0.5 / AROUND as f64;
                }
                let position = mesh.positions[vertex(i, j) as usize];
                mesh.corner_vertices.push(vertex(i, j));
                mesh.corner_uvs.push(at.as_vec2().to_array());
                mesh.corner_normals.push(position);
            }
        }
    }
    mesh
}

/// A map of `N` channels from a function of direction and texture coordinates.
fn painted<const N: usize>(paint: impl Fn(DVec3, DVec2) -> [f64; N]) -> ImageMap {
    let (width, height) = TEXELS;
    let mut texels = Vec::with_capacity((width * height) as usize * N);
    for y in 0..height {
        for x in 0..width {
            let u = (x as f64 + 0.5) / width as f64;
            let v = 1.0 - (y as f64 + 0.5) / height as f64;
            let uv = DVec2::new(u, v);
            texels.extend(paint(direction(uv), uv).map(quantised));
        }
    }
    image(width, height, N as u32, texels)
}

/// Distance from a place in the letter's plane to the strokes of a P, which is
/// one unit high.
fn from_letter(q: DVec2) -> f64 {
    let stem_y = q.y.clamp(-0.5, 0.5);
    let stem = q.distance(DVec2::new(-0.22, stem_y));
    // The bowl: two bars and half a ring.
    let q = DVec2::new(q.x, q.y - 0.25);
    let bowl = if q.x < 0.08 {
        let bar = |y: f64| q.distance(DVec2::new(q.x.clamp(-0.22, 0.08), y));
        bar(0.25).min(bar(-0.25))
    } else {
        (q.distance(DVec2::new(0.08, 0.0)) - 0.25).abs()
    };
    stem.min(bowl)
}

/// How far outside the letter a direction is, in radians; negative inside.
fn outside_letter(p: DVec3) -> f64 {
    if p.z < 0.05 {
        return 1.0;
    }
    from_letter(DVec2::new(p.x, p.y) / 0.95) * 0.95 - 0.085
}

/// How far outside the nearest spot a direction is; negative inside.
fn outside_spots(p: DVec3) -> f64 {
    const SPOTS: u32 = 26;
    (0..SPOTS)
        .map(|k| {
            // Fibonacci's spiral spreads points evenly over a sphere.
            let y = 1.0 - (2.0 * k as f64 + 1.0) / SPOTS as f64;
            let (s, c) = libm::sincos(k as f64 * 2.399_963_229_728_653);
            let r = (1.0 - y * y).sqrt();
            p.distance(DVec3::new(r * s, y, r * c)) - 0.10 - 0.05 * ((k * 7 % 5) as f64 / 4.0)
        })
        .fold(f64::MAX, f64::min)
}

/// Full on the letter, a bare moat around it, soft bald spots elsewhere.
fn density(p: DVec3, _: DVec2) -> f64 {
    let letter = outside_letter(p);
    let moat = smoothstep(0.035, 0.075, letter);
    let spots = smoothstep(0.0, 0.10, outside_spots(p)).max(smoothstep(0.35, 0.2, letter));
    (1.0 - smoothstep(0.0, 0.02, letter)).max(moat * spots)
}

/// Long on the letter, longer towards the poles.
fn length(p: DVec3, _: DVec2) -> f64 {
    let letter = 1.0 - smoothstep(0.0, 0.03, outside_letter(p));
    (0.60 + 0.25 * p.y * p.y + 0.08 * fractal(5, p * 5.0)).max(letter)
}

/// Linear colour of the tips: violet with teal swirls, the letter orange.
fn color(p: DVec3, _: DVec2) -> [f64; 3] {
    let swirl = libm::sin(p.y * 7.0 + 2.0 * libm::atan2(p.x, p.z) + 3.0 * fractal(9, p * 1.6));
    let violet = DVec3::new(0.20, 0.06, 0.42);
    let teal = DVec3::new(0.03, 0.36, 0.40);
    let coat = violet.lerp(teal, smoothstep(-0.35, 0.35, swirl));
    let letter = 1.0 - smoothstep(0.02, 0.04, outside_letter(p));
    coat.lerp(DVec3::new(0.90, 0.32, 0.04), letter).to_array()
}
