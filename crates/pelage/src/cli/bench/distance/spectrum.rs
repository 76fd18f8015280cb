//! Radial power spectra: how evenly roots lie, by distance (Ulichney 1987).

use crate::cli::bench::methods::even_sampler;
use crate::cli::plot::{Axes, Line, linear};
use anyhow::Result;
use pelage::surface::quality::radial_power_spectrum;
use pelage::surface::{BlueNoise, Mesh, PolygonMesh, RootSampler, Spread, SurfacePoint};

/// Roots on the square, and how many of them are the first part that is looked at, too.
const ROOTS: u64 = 2048;
const FIRST: u64 = ROOTS / 4;

/// The highest frequency, over the root of the number of roots.
const HIGHEST: f64 = 2.5;

/// The spectra of all ways to spread roots, as means over `seeds`: powers by frequencies over
/// the root of the number of roots.
pub fn measure(seeds: u64) -> Vec<Line> {
    let square = PolygonMesh::sheet(1, 1, |u, v| [u, v, 0.0]);
    // The grid has a face, and the formula gives numbers.
    let square = &Mesh::new(square).expect("a grid is a mesh");
    let line = |name: &str, count, draw: &dyn Fn(RootSampler, u64) -> Vec<SurfacePoint>| {
        let roots = |seed| draw(even_sampler(square, seed), count);
        Line {
            name: name.into(),
            points: mean(seeds, |seed| spectrum(square, &roots(seed))),
        }
    };
    let drawn = |spread| {
        move |sampler: RootSampler, count| {
            let mut roots = Vec::new();
            sampler.with_spread(spread).roots(0..count, &mut roots);
            roots
        }
    };
    let apart = |sampler: RootSampler, count| {
        let mut roots = Vec::new();
        BlueNoise::new(square, &sampler, count).roots(0..count, &mut roots);
        roots
    };
    vec![
        line("random", ROOTS, &drawn(Spread::Random)),
        line("stratified", ROOTS, &drawn(Spread::Stratified)),
        line("blue noise", ROOTS, &apart),
        // More roots begin with the same ones.
        line("the first quarter of it", FIRST, &apart),
    ]
}

fn spectrum(square: &Mesh, roots: &[SurfacePoint]) -> Vec<(f64, f64)> {
    let flat = roots.iter().map(|root| {
        let place = square.position(root);
        [place.x as f64, place.y as f64]
    });
    let points: Vec<[f64; 2]> = flat.collect();
    let unit = (points.len() as f64).sqrt();
    let mut spectrum = radial_power_spectrum(&points, (HIGHEST * unit) as usize);
    spectrum
        .iter_mut()
        .for_each(|(frequency, _)| *frequency /= unit);
    spectrum
}

/// The mean over seeds 1 to `seeds`; all have the same frequencies.
fn mean(seeds: u64, spectrum: impl Fn(u64) -> Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    let mut sum = spectrum(1);
    for seed in 2..=seeds {
        let next = spectrum(seed);
        sum.iter_mut()
            .zip(next)
            .for_each(|(sum, next)| sum.1 += next.1);
    }
    sum.iter_mut().for_each(|sum| sum.1 /= seeds as f64);
    sum
}

/// The plot, as the text of an SVG file.
pub fn plot(lines: &[Line]) -> Result<String> {
    let axes = Axes {
        title: "Radial power spectra of roots on a square",
        x: "frequency, in roots of the number of roots",
        y: "power, over that of white noise",
    };
    linear(&axes, lines)
}
