//! How fast roots are drawn, and the tables for them made.
//!
//! `cargo bench -p pelage-surface --bench roots`. One thread; rates by its processor time.

use libm::{cos, pow, sin};
use pelage_surface::{Density, ImageMap, Mesh, PolygonMesh, RootSampler, SurfacePoint, Wrap, hash};
use std::f64::consts::TAU;
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1).filter(|a| !a.starts_with("--"));
    let only = arguments.next().unwrap_or_default();
    let what = arguments.next().unwrap_or_default();
    let rounds: usize = arguments.next().map_or(Ok(5), |a| a.parse())?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let torus = Mesh::new(PolygonMesh::sheet(264, 132, |u, v| {
        let (a, b) = (TAU * u, TAU * v);
        let radius = 1.0 + 0.4 * cos(b);
        [radius * cos(a), 0.4 * sin(b), -radius * sin(a)]
    }))?;
    let mut roots = vec![SurfacePoint::default(); 10_000_000];
    for name in [
        "uniform",
        "checkerboard",
        "noise 8",
        "noise 512",
        "sun",
        "embers",
    ] {
        if !name.starts_with(&only) {
            continue;
        }
        let map = map(name, 1024);
        let density = Density {
            value: 1.0,
            map: Some((&map, 0, Wrap::Repeat)),
        };
        let mut make = f64::INFINITY;
        let mut sampler = None;
        for _ in 0..if what == "fill" || what == "in" {
            1
        } else {
            rounds
        } {
            sampler = None;
            let start = thread_seconds();
            let s = pool.install(|| {
                let t = thread_seconds();
                let s = RootSampler::new(&torus, &density, 1);
                (s, thread_seconds() - t)
            });
            let _ = start;
            sampler = s.0;
            make = make.min(s.1);
        }
        let sampler = sampler.ok_or("black")?;
        let (mut fill, mut wall, mut along) = (f64::INFINITY, f64::INFINITY, f64::INFINITY);
        for _ in 0..rounds {
            if what != "in" && what != "make" {
                let (t, w) = (thread_seconds(), Instant::now());
                sampler.fill(0, &mut roots);
                fill = fill.min(thread_seconds() - t);
                wall = wall.min(w.elapsed().as_secs_f64());
            }
            if what != "fill" && what != "make" {
                let t = thread_seconds();
                let mut next = 0;
                sampler.roots_in(0, 1 << 64, 10_000_000, |hairs, places| {
                    let _ = hairs;
                    roots[next..next + places.len()].copy_from_slice(places);
                    next += places.len();
                });
                along = along.min(thread_seconds() - t);
            }
        }
        let sum = roots.iter().step_by(997).fold(0u64, |h, r| {
            hash(h ^ r.triangle as u64 ^ (r.barycentric[1].to_bits() as u64) << 32)
        });
        println!(
            "{name:12} {:7} pieces  {:6.1} ms  fill {:6.1} M/s (wall {:6.1})  along {:6.1} M/s  {:.1} MB {sum:x}",
            sampler.piece_count(),
            make * 1e3,
            10.0 / fill,
            10.0 / wall,
            10.0 / along,
            sampler.bytes() as f64 / 1e6
        );
    }
    Ok(())
}

/// Processor time of this thread in seconds.
fn thread_seconds() -> f64 {
    std::fs::read_to_string("/proc/thread-self/schedstat")
        .ok()
        .and_then(|s| s.split(' ').next()?.parse::<f64>().ok())
        .map_or(f64::NAN, |nanoseconds| nanoseconds / 1e9)
}

fn map(name: &str, size: u32) -> ImageMap {
    let texel = |x: u32, y: u32| {
        let [u, v] = [x, y].map(|i| (i as f64 + 0.5) / size as f64);
        match name {
            "checkerboard" => ((u < 0.5) != (v < 0.5)) as u32 as f64,
            "noise 8" => noise(u * 8.0, v * 8.0),
            "noise 512" => noise(u * 512.0, v * 512.0),
            "sun" => {
                0.2 + 0.8 * v
                    + if libm::hypot(u - 0.3, v - 0.7) < 0.004 {
                        1e6
                    } else {
                        0.0
                    }
            }
            "embers" => {
                let dice = dice(x, y);
                0.01 + if dice < 0.1 {
                    pow(0.1 / (dice + 1e-7), 1.2)
                } else {
                    0.0
                }
            }
            _ => 1.0,
        }
    };
    let texels = (0..size * size)
        .map(|i| texel(i % size, i / size) as f32)
        .collect();
    ImageMap::new(size, size, 1, texels, false).unwrap()
}

fn dice(x: u32, y: u32) -> f64 {
    (hash((y as u64) << 32 | x as u64) >> 11) as f64 / (1u64 << 53) as f64
}

fn noise(x: f64, y: f64) -> f64 {
    let (column, row) = (x.floor(), y.floor());
    let ease = |t: f64| t * t * (3.0 - 2.0 * t);
    let (s, t) = (ease(x - column), ease(y - row));
    let at = |dx: u32, dy: u32| dice(column as u32 + dx, row as u32 + dy);
    let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
    mix(mix(at(0, 0), at(1, 0), s), mix(at(0, 1), at(1, 1), s), t)
}
