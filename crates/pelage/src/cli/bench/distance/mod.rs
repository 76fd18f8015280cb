//! How fast roots that keep their distance are made, and how well they keep it.

mod peers;
mod spectrum;

use super::maps::Map;
use super::measure::{fastest, pool_of};
use super::methods::sampler;
use super::order::samples;
use super::surfaces::Surface;
use crate::cli::plot::Line;
use anyhow::Result;
use peers::Peer;
use pelage::surface::quality::smallest_distance_ratio;
use pelage::surface::{BlueNoise, Mesh, RootPdf, RootSampler, SurfacePoint};
use std::fmt::Write;
use std::time::Instant;

/// First roots of which the smallest distance is told.
const PREFIXES: [u64; 4] = [1_000, 10_000, 100_000, 1_000_000];

/// What the table is.
const HEADING: &str = "
## Blue noise, million roots a second, one thread

`BlueNoise` makes a million roots that keep their distance, at every prefix. Columns on the
right have the smallest distance of two roots among the first so many, over the largest that
so many could keep at the density there. Maps whose texels leap leave less of it: a root
between two densities is too near by one of them. The radial power spectra below are those of
2,048 roots on a square, means of 16 seeds: what keeps its distance has little power at
frequencies below that of its spacing.
";

/// How well roots keep their distance.
pub struct Distances {
    maps: Vec<Apart>,
    spectra: Vec<Line>,
    /// Beside other programs; empty where not asked for.
    peers: Vec<Peer>,
}

/// Roots that keep their distance, by one map.
#[derive(Clone, Debug)]
struct Apart {
    map: &'static str,
    /// Millions of roots a second.
    rate: f64,
    /// [`smallest_distance_ratio`] of [`PREFIXES`], as far as there are so many.
    ratios: Vec<f64>,
}

/// Measures roots of `surface` by each of `maps`, and beside other programs; `quick` makes
/// few, and only ours.
pub fn measure(surface: &Surface, maps: &[Map], quick: bool) -> Result<Distances> {
    let prefixes = &PREFIXES[..if quick { 1 } else { PREFIXES.len() }];
    let by_map = || {
        maps.iter()
            .map(|map| apart(surface, map, prefixes))
            .collect()
    };
    let pool = pool_of(1);
    Ok(Distances {
        maps: pool.install(by_map),
        spectra: spectrum::measure(if quick { 1 } else { 16 }),
        peers: match quick {
            true => Vec::new(),
            false => pool.install(|| peers::measure(surface))?,
        },
    })
}

fn apart(surface: &Surface, map: &Map, prefixes: &[u64]) -> Apart {
    let count = prefixes[prefixes.len() - 1];
    let (mesh, sampler) = (&surface.mesh, sampler(&surface.mesh, map));
    let (seconds, places) = made(mesh, &sampler, count);
    let area = mesh.surface_area();
    let samples = samples(mesh, &RootPdf::new(&sampler, mesh), area, places.iter());
    let ratio = |&prefix: &u64| smallest_distance_ratio(&samples[..prefix as usize], area);
    Apart {
        map: map.name,
        rate: count as f64 / 1e6 / seconds,
        ratios: prefixes.iter().map(ratio).collect(),
    }
}

/// Our roots, and the seconds that the fastest of some runs took.
fn made(mesh: &Mesh, sampler: &RootSampler, count: u64) -> (f64, Vec<SurfacePoint>) {
    let mut places = Vec::new();
    let seconds = fastest(3, || {
        let started = Instant::now();
        let roots = BlueNoise::new(mesh, sampler, count);
        let seconds = started.elapsed().as_secs_f64();
        places.clear();
        roots.roots(0..count, &mut places);
        seconds
    });
    (seconds, places)
}

impl Distances {
    /// The plot of the spectra, as the text of an SVG file.
    pub fn plot(&self) -> Result<String> {
        spectrum::plot(&self.spectra)
    }
}

/// Writes the tables, each below its heading.
pub fn write_tables(distances: &Distances, text: &mut String) -> std::fmt::Result {
    let rows = &distances.maps;
    writeln!(text, "{HEADING}")?;
    let prefixes = rows.first().map_or(0, |row| row.ratios.len());
    let prefixes: Vec<String> = PREFIXES[..prefixes].iter().map(u64::to_string).collect();
    writeln!(text, "| map | M roots/s | {} |", prefixes.join(" | "))?;
    writeln!(text, "|---|---|{}", "---|".repeat(prefixes.len()))?;
    for Apart { map, rate, ratios } in rows {
        let ratios: Vec<String> = ratios.iter().map(|r| format!("{r:.2}")).collect();
        writeln!(text, "| {map} | {rate:.2} | {} |", ratios.join(" | "))?;
    }
    match distances.peers.is_empty() {
        true => Ok(()),
        false => peers::write_table(&distances.peers, text),
    }
}
