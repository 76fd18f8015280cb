//! How fast the tables of a surface are made and roots drawn, by their index and along the
//! surface.
//!
//! `cargo bench -p pelage-surface --bench roots -- [ROUNDS]`. The torus of `pelage bench
//! sampling`, 10^7 roots written to memory, one thread, the best of some rounds.

use libm::{cos, pow, sin};
use pelage_surface::{Density, ImageMap, Mesh, PolygonMesh, RootSampler, SurfacePoint, Wrap, hash};
use std::error::Error;
use std::f64::consts::TAU;
use std::time::Instant;

const ROOTS: usize = 10_000_000;

/// Texels along a side of a map.
const SIDE: u32 = 1024;

/// Brightness of a texel by a number of its own in 0..1.
type Texel = fn(f64) -> f64;

const MAPS: [(&str, Texel); 3] = [
    ("uniform", |_| 1.0),
    ("noise", |dice| dice),
    ("embers", |dice| match dice < 0.1 {
        true => 0.01 + pow(0.1 / (dice + 1e-7), 1.2),
        false => 0.01,
    }),
];

fn main() -> Result<(), Box<dyn Error>> {
    // Cargo adds `--bench`.
    let mut arguments = std::env::args().skip(1).filter(|a| !a.starts_with("--"));
    let rounds: usize = arguments.next().map_or(Ok(5), |a| a.parse())?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let torus = Mesh::new(PolygonMesh::sheet(264, 132, |u, v| {
        let (a, b) = (TAU * u, TAU * v);
        let radius = 1.0 + 0.4 * cos(b);
        [radius * cos(a), 0.4 * sin(b), -radius * sin(a)]
    }))?;
    for (name, texel) in MAPS {
        let dice = |i: u32| (hash(i as u64) >> 11) as f64 / (1u64 << 53) as f64;
        let texels: Vec<f32> = (0..SIDE * SIDE).map(|i| texel(dice(i)) as f32).collect();
        let map = ImageMap::new(SIDE, SIDE, 1, texels, false)?;
        pool.install(|| measure(name, &torus, &map, rounds))?;
    }
    Ok(())
}

fn measure(name: &str, mesh: &Mesh, map: &ImageMap, rounds: usize) -> Result<(), &'static str> {
    let density = Density {
        value: 1.0,
        map: Some((map, 0, Wrap::Repeat)),
    };
    let [mut make, mut by_index, mut along] = [f64::INFINITY; 3];
    let (mut hairs, mut roots) = (vec![0; ROOTS], vec![SurfacePoint::default(); ROOTS]);
    let mut pieces = 0;
    for _ in 0..rounds {
        let begun = Instant::now();
        let sampler = RootSampler::new(mesh, &density, 1).ok_or("no density")?;
        make = make.min(begun.elapsed().as_secs_f64());
        let begun = Instant::now();
        sampler.fill(0, &mut roots);
        by_index = by_index.min(begun.elapsed().as_secs_f64());
        let begun = Instant::now();
        sampler.fill_in(0, 1 << 64, 0..ROOTS as u64, &mut hairs, &mut roots);
        along = along.min(begun.elapsed().as_secs_f64());
        pieces = sampler.piece_count();
    }
    let rate = |seconds: f64| ROOTS as f64 / 1e6 / seconds;
    println!(
        "{name}: {pieces} pieces in {:.1} ms; {:.1} M roots/s by index, {:.1} along the surface",
        make * 1e3,
        rate(by_index),
        rate(along)
    );
    Ok(())
}
