//! How fast roots that keep their distance are made, and how well they keep it.

use super::maps::Map;
use super::measure::{fastest, pool_of};
use super::methods::sampler;
use super::order::samples;
use super::surfaces::Surface;
use pelage::surface::quality::smallest_distance_ratio;
use pelage::surface::{BlueNoise, RootPdf};
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
between two densities is too near by one of them.
";

/// Roots that keep their distance, by one map.
#[derive(Clone, Debug)]
pub struct Apart {
    map: &'static str,
    /// Millions of roots a second.
    rate: f64,
    /// [`smallest_distance_ratio`] of [`PREFIXES`], as far as there are so many.
    ratios: Vec<f64>,
}

/// Measures roots of `surface` by each of `maps`; `quick` makes few.
pub fn measure(surface: &Surface, maps: &[Map], quick: bool) -> Vec<Apart> {
    let prefixes = &PREFIXES[..if quick { 1 } else { PREFIXES.len() }];
    let pool = pool_of(1);
    maps.iter()
        .map(|map| pool.install(|| apart(surface, map, prefixes)))
        .collect()
}

fn apart(surface: &Surface, map: &Map, prefixes: &[u64]) -> Apart {
    let count = prefixes[prefixes.len() - 1];
    let (mesh, sampler) = (&surface.mesh, sampler(&surface.mesh, map));
    let mut places = Vec::new();
    let seconds = fastest(3, || {
        let started = Instant::now();
        let roots = BlueNoise::new(mesh, &sampler, count);
        let seconds = started.elapsed().as_secs_f64();
        places.clear();
        roots.roots(0..count, &mut places);
        seconds
    });
    let area = mesh.surface_area();
    let samples = samples(mesh, &RootPdf::new(&sampler, mesh), area, places.iter());
    let ratio = |&prefix: &u64| smallest_distance_ratio(&samples[..prefix as usize], area);
    Apart {
        map: map.name,
        rate: count as f64 / 1e6 / seconds,
        ratios: prefixes.iter().map(ratio).collect(),
    }
}

/// Writes the table below its heading.
pub fn write_table(rows: &[Apart], text: &mut String) -> std::fmt::Result {
    writeln!(text, "{HEADING}")?;
    let prefixes = rows.first().map_or(0, |row| row.ratios.len());
    let prefixes: Vec<String> = PREFIXES[..prefixes].iter().map(u64::to_string).collect();
    writeln!(text, "| map | M roots/s | {} |", prefixes.join(" | "))?;
    writeln!(text, "|---|---|{}", "---|".repeat(prefixes.len()))?;
    for Apart { map, rate, ratios } in rows {
        let ratios: Vec<String> = ratios.iter().map(|r| format!("{r:.2}")).collect();
        writeln!(text, "| {map} | {rate:.2} | {} |", ratios.join(" | "))?;
    }
    Ok(())
}
