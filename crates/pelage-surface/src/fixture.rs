//! Surfaces and maps that several tests share.

use crate::{ImageMap, Mesh, PolygonMesh};

/// A wavy sheet of `n × n` squares over the unit square, with UVs.
pub(crate) fn sheet(n: u32) -> Mesh {
    let wave = |u, v| [u, v, 0.2 * libm::sin(5.0 * u)];
    Mesh::new(PolygonMesh::sheet(n, n, wave)).unwrap()
}

pub(crate) fn spots() -> ImageMap {
    let texels: Vec<f32> = (0..64 * 64)
        .map(|i| {
            if (i / 7 + i / 64 / 5) % 3 == 0 {
                0.0
            } else {
                (i % 11) as f32
            }
        })
        .collect();
    ImageMap::new(64, 64, 1, texels, false).unwrap()
}

/// Maps of every kind that tests go through, with their names.
pub(crate) fn maps() -> Vec<(&'static str, ImageMap)> {
    let map = |texel: &dyn Fn(u32, u32) -> f32| {
        let texels: Vec<f32> = (0..64 * 64).map(|i| texel(i % 64, i / 64)).collect();
        ImageMap::new(64, 64, 1, texels, false).unwrap()
    };
    let noise = |x: u32, y: u32| (crate::hash((y * 64 + x) as u64) >> 40) as f32 / (1 << 24) as f32;
    vec![
        ("uniform", map(&|_, _| 0.7)),
        ("checkerboard", map(&|x, y| ((x / 8 + y / 8) % 2) as f32)),
        ("noise", map(&noise)),
        (
            "heavy tail",
            map(&|x, y| 1.0 / (noise(x, y) * noise(x, y) + 1e-3)),
        ),
        (
            "one bright texel",
            map(&|x, y| if (x, y) == (40, 9) { 1e6 } else { 1.0 }),
        ),
    ]
}
