//! Density maps of the kinds that document 004 measures with (4.1).

use pelage::surface::{ImageMap, hash};

/// A density map by its name.
pub struct Map {
    pub name: &'static str,
    pub image: ImageMap,
}

/// All kinds at `size` × `size` texels.
pub fn maps(size: u32) -> Vec<Map> {
    NAMES.iter().map(|name| map(name, size)).collect()
}

const NAMES: [&str; 7] = [
    "uniform",
    "checkerboard",
    "noise 8",
    "noise 64",
    "noise 512",
    "sun",
    "embers",
];

/// The map `name`; the name must be one of [`maps`]'s.
pub fn map(name: &'static str, size: u32) -> Map {
    let texel = |x: u32, y: u32| {
        let [u, v] = [x, y].map(|i| (i as f64 + 0.5) / size as f64);
        match name {
            "checkerboard" => ((u < 0.5) != (v < 0.5)) as u32 as f64,
            "noise 8" => noise(u * 8.0, v * 8.0),
            "noise 64" => noise(u * 64.0, v * 64.0),
            "noise 512" => noise(u * 512.0, v * 512.0),
            // A sky with a sun of a few texels, 10^6 times as bright.
            "sun" => {
                let apart = libm::hypot(u - 0.3, v - 0.7);
                0.2 + 0.8 * v + if apart < 0.004 { 1e6 } else { 0.0 }
            }
            // A tenth of the texels glow, their brightness without a mean scale.
            "embers" => {
                let dice = dice(x, y);
                0.01 + if dice < 0.1 {
                    libm::pow(0.1 / (dice + 1e-7), 1.2)
                } else {
                    0.0
                }
            }
            _ => 1.0,
        }
    };
    let texels: Vec<f32> = (0..size * size)
        .map(|i| texel(i % size, i / size) as f32)
        .collect();
    // As many finite texels as the size says.
    let image = ImageMap::new(size, size, 1, texels, false).expect("a map is a map");
    Map { name, image }
}

/// A number in 0..1 for a lattice point.
fn dice(x: u32, y: u32) -> f64 {
    (hash((y as u64) << 32 | x as u64) >> 11) as f64 / (1u64 << 53) as f64
}

/// Smooth noise in 0..1 over a lattice of unit cells.
fn noise(x: f64, y: f64) -> f64 {
    let (column, row) = (x.floor(), y.floor());
    let ease = |t: f64| t * t * (3.0 - 2.0 * t);
    let (s, t) = (ease(x - column), ease(y - row));
    let at = |dx: u32, dy: u32| dice(column as u32 + dx, row as u32 + dy);
    let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
    mix(mix(at(0, 0), at(1, 0), s), mix(at(0, 1), at(1, 1), s), t)
}
