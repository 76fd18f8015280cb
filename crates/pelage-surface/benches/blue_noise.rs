//! How fast roots that keep their distance are made, and how well they keep it.
//!
//! `cargo bench -p pelage-surface --bench blue_noise -- [ROOTS] [THREADS]`. Rates are told
//! by the clock and by the processor time of the one thread that does the work (Linux
//! only), which other programs on the machine disturb less.

use pelage_curves::Vec3;
use pelage_surface::quality::{Sample, smallest_distance_ratio};
use pelage_surface::{BlueNoise, Density, ImageMap, Mesh, PolygonMesh, RootSampler, Wrap};
use std::f32::consts::TAU;
use std::time::Instant;

const ROUNDS: usize = 3;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Cargo adds `--bench`.
    let mut arguments = std::env::args().skip(1).filter(|a| !a.starts_with("--"));
    let roots: u64 = arguments.next().map_or(Ok(1_000_000), |a| a.parse())?;
    let threads: usize = arguments.next().map_or(Ok(1), |a| a.parse())?;
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()?;
    let mesh = Mesh::new(bumpy_torus(264, 132))?;
    let map = blotches();
    println!(
        "{roots} roots on {} triangles, {threads} threads",
        mesh.triangles().len()
    );
    for (name, map) in [("uniform", None), ("map", Some((&map, 0, Wrap::Repeat)))] {
        let density = Density { value: 1.0, map };
        let sampler = RootSampler::new(&mesh, &density, 7).ok_or("no density")?;
        pool.install(|| measure(name, &mesh, &density, &sampler, roots));
    }
    Ok(())
}

fn measure(name: &str, mesh: &Mesh, density: &Density, sampler: &RootSampler, roots: u64) {
    let (mut wall, mut busy) = (f64::INFINITY, f64::INFINITY);
    let mut made = None;
    for _ in 0..ROUNDS {
        let (start, before) = (Instant::now(), thread_seconds());
        made = Some(BlueNoise::new(mesh, sampler, roots));
        wall = wall.min(start.elapsed().as_secs_f64());
        busy = busy.min(thread_seconds() - before);
    }
    let rate = |seconds: f64| roots as f64 / 1e6 / seconds;
    println!(
        "{name}: {wall:.3} s, {:.2} M roots/s; thread {busy:.3} s, {:.2} M roots/s",
        rate(wall),
        rate(busy)
    );
    let Some(made) = made else { return };
    let area = mesh.surface_area();
    let mean = sampler.weighted_area() / area;
    let mut places = Vec::new();
    made.roots(0..roots, &mut places);
    let samples: Vec<Sample> = places
        .into_iter()
        .map(|root| {
            let [a, b, c] = mesh.corners(root.triangle as usize);
            let uv = mesh.uv(&root);
            let map = density
                .map
                .map_or(1.0, |(m, k, w)| m.sample(uv.x, uv.y, k, w));
            Sample {
                position: mesh.position(&root),
                normal: (b - a).cross(c - a).normalize_or_zero(),
                density: map as f64 / mean,
            }
        })
        .collect();
    let mut prefix = 10;
    while prefix <= samples.len() {
        for n in [prefix, prefix * 17 / 10, prefix * 3, prefix * 54 / 10] {
            if let Some(samples) = samples.get(..n) {
                print!(" {n}: {:.3}", smallest_distance_ratio(samples, area));
            }
        }
        println!();
        prefix *= 10;
    }
}

/// Processor time of this thread in seconds.
fn thread_seconds() -> f64 {
    std::fs::read_to_string("/proc/thread-self/schedstat")
        .ok()
        .and_then(|s| s.split(' ').next()?.parse::<f64>().ok())
        .map_or(f64::NAN, |nanoseconds| nanoseconds / 1e9)
}

/// A torus of `n × m` squares with bumps, and UVs.
fn bumpy_torus(n: u32, m: u32) -> PolygonMesh {
    let mut mesh = PolygonMesh::default();
    for i in 0..n {
        for j in 0..m {
            let (a, b) = (TAU * i as f32 / n as f32, TAU * j as f32 / m as f32);
            let tube = 0.4 + 0.05 * libm::sinf(7.0 * a) * libm::cosf(5.0 * b);
            let ring = 1.0 + tube * libm::cosf(b);
            mesh.positions.push(
                Vec3::new(
                    ring * libm::cosf(a),
                    ring * libm::sinf(a),
                    tube * libm::sinf(b),
                )
                .to_array(),
            );
            mesh.face_sizes.push(4);
            for (di, dj) in [(0, 0), (1, 0), (1, 1), (0, 1)] {
                mesh.corner_vertices.push((i + di) % n * m + (j + dj) % m);
                mesh.corner_uvs
                    .push([(i + di) as f32 / n as f32, (j + dj) as f32 / m as f32]);
            }
        }
    }
    mesh
}

/// A map that swings smoothly between 0.1 and 1.
fn blotches() -> ImageMap {
    const SIDE: u32 = 512;
    let texel = |i: u32| {
        let (x, y) = (
            (i % SIDE) as f32 / SIDE as f32,
            (i / SIDE) as f32 / SIDE as f32,
        );
        0.55 + 0.45 * libm::sinf(TAU * 3.0 * x) * libm::sinf(TAU * 2.0 * y)
    };
    ImageMap::new(
        SIDE,
        SIDE,
        1,
        (0..SIDE * SIDE).map(texel).collect::<Vec<f32>>(),
        false,
    )
    .unwrap_or_else(|error| unreachable!("a map of that size: {error:?}"))
}
