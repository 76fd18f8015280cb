//! What the order of the pieces along the first number gives.
//!
//! The numbers of the hairs are stratified, but the first is one-dimensional: whether
//! roots are spread evenly in space depends on how the pieces lie along it. Ours follow a
//! Hilbert curve; the same pieces are drawn from in the order of the mesh, in no order,
//! and by independent numbers, which no order helps.

use super::maps::Map;
use super::methods::sampler;
use super::surfaces::Surface;
use pelage::surface::quality::{Sample, nearest_distance_ratio};
use pelage::surface::{
    Distribution, Mesh, RootPdf, RootSampler, RootSequence, Spread, SurfacePoint, hash,
};
use std::collections::HashMap;
use std::fmt::Write;

/// Orders and numbers that are compared.
const WAYS: [&str; 4] = ["Hilbert curve", "mesh", "shuffled", "independent"];

/// A measure of every way.
type Values = [f64; WAYS.len()];

/// What the tables are.
const HEADING: &str = "
## Order of the pieces

The first number of a hair picks a piece of surface, so stratified numbers spread roots
evenly in space only if pieces that follow each other are neighbours. The columns draw from
the same pieces: along the Hilbert curve, as `RootSampler` does; in the order of the mesh,
which here is that of the rows of its grid; in no order; and with independent numbers.
Cells of space have 16 roots on the mean. The variance of their number and the mean distance
to the nearest root are relative to those of independent roots; less variance and more
distance is more even. (No order keeps roots apart: for that there is `BlueNoise`.) Means of
4 (100,000 roots) to 64 seeds.";

/// Roots in a cell of space, on the mean.
const ROOTS_A_CELL: f64 = 16.0;

/// How evenly roots are spread, for each of [`WAYS`].
#[derive(Clone, Debug)]
pub struct Evenness {
    mesh: &'static str,
    map: &'static str,
    roots: u64,
    /// Variance of the roots in cells of space over that of independent ones: 1 where
    /// the numbers are, 0 where each cell has what it should.
    variance: Values,
    /// [`nearest_distance_ratio`].
    nearest: Values,
}

/// Measures growing numbers of roots of `surface`; `quick` takes few.
pub fn measure(surface: &Surface, maps: &[Map], quick: bool) -> Vec<Evenness> {
    let counts: &[u64] = match quick {
        true => &[100],
        false => &[100, 1_000, 10_000, 100_000],
    };
    let named = |map: &&Map| ["uniform", "noise 8"].contains(&map.name);
    maps.iter()
        .filter(named)
        .flat_map(|map| counts.iter().map(move |&roots| (map, roots)))
        // Few roots tell little, and cost little.
        .map(|(map, roots)| evenness(surface, map, roots, (400_000 / roots).clamp(4, 64)))
        .collect()
}

/// Measures `roots` roots of `surface` by `map`: the mean of `seeds` seeds.
fn evenness(surface: &Surface, map: &Map, roots: u64, seeds: u64) -> Evenness {
    let sampler = sampler(&surface.mesh, map);
    let field = Field::new(&sampler, surface, roots);
    let [mut variance, mut nearest] = [[0.0; WAYS.len()]; 2];
    for (way, name) in WAYS.iter().enumerate() {
        let ordered = Ordered::new(&sampler, name);
        let spread = match *name {
            "independent" => Spread::Random,
            _ => Spread::Stratified,
        };
        for seed in 0..seeds {
            let drawn = ordered.draw(&RootSequence::new(seed, spread), roots);
            variance[way] += field.variance(&drawn) / seeds as f64;
            let places = drawn.iter().map(|(_, place)| place);
            let samples = samples(&surface.mesh, &field.pdf, field.area, places);
            nearest[way] += nearest_distance_ratio(&samples, field.area) / seeds as f64;
        }
    }
    Evenness {
        mesh: surface.name,
        map: map.name,
        roots,
        variance,
        nearest,
    }
}

/// The pieces of a sampler along the first number in another order.
struct Ordered<'a> {
    sampler: &'a RootSampler,
    order: Vec<u32>,
    distribution: Distribution,
}

impl<'a> Ordered<'a> {
    fn new(sampler: &'a RootSampler, way: &str) -> Self {
        let mut order: Vec<u32> = (0..sampler.piece_count() as u32).collect();
        match way {
            "mesh" => {
                let triangles: Vec<u32> = sampler.piece_centres().map(|c| c.triangle).collect();
                order.sort_by_key(|&piece| triangles[piece as usize]);
            }
            "shuffled" => order.sort_by_cached_key(|&piece| hash(piece as u64)),
            _ => {}
        }
        // Pieces too small for a share of 2^64 stay too small.
        let probability = |piece: u32| sampler.distribution().probability(piece as usize);
        let weight = |&piece: &u32| probability(piece).max(f64::MIN_POSITIVE);
        let weights: Vec<f64> = order.iter().map(weight).collect();
        Self {
            sampler,
            order,
            // Positive numbers, whose sum is 1.
            distribution: Distribution::new(&weights).expect("weights of pieces"),
        }
    }

    /// The first `count` roots, each with its piece.
    fn draw(&self, numbers: &RootSequence, count: u64) -> Vec<(usize, SurfacePoint)> {
        let draw = |hair| {
            let (x, y) = numbers.sample(hair);
            let pick = self.distribution.pick(x);
            let piece = self.order[pick.index] as usize;
            (piece, self.sampler.place_in(piece, pick.rest, y))
        };
        (0..count).map(draw).collect()
    }
}

/// What roots are compared with.
struct Field<'a> {
    pdf: RootPdf<'a>,
    area: f64,
    /// The cell of space that holds the centre of each piece.
    cells: Vec<u32>,
    /// Roots that each cell should have.
    expected: Vec<f64>,
}

impl<'a> Field<'a> {
    fn new(sampler: &'a RootSampler, surface: &'a Surface, roots: u64) -> Self {
        let mesh = &surface.mesh;
        let area = mesh.surface_area();
        let side = (ROOTS_A_CELL * area / roots as f64).sqrt() as f32;
        let (low, _) = mesh.bounds();
        let mut known = HashMap::new();
        let mut cells = Vec::with_capacity(sampler.piece_count());
        let mut expected = Vec::new();
        for (piece, centre) in sampler.piece_centres().enumerate() {
            let at = ((mesh.position(&centre) - low) / side).floor();
            let cell = *known
                .entry(at.to_array().map(|c| c as u32))
                .or_insert(expected.len() as u32);
            expected.resize(expected.len().max(cell as usize + 1), 0.0);
            expected[cell as usize] += sampler.distribution().probability(piece) * roots as f64;
            cells.push(cell);
        }
        Self {
            pdf: RootPdf::new(sampler, mesh),
            area,
            cells,
            expected,
        }
    }

    /// Independent roots vary in each cell by as much as there should be, less their share
    /// in all.
    fn variance(&self, roots: &[(usize, SurfacePoint)]) -> f64 {
        let mut found = vec![0.0; self.expected.len()];
        for (piece, _) in roots {
            found[self.cells[*piece] as usize] += 1.0;
        }
        let count = roots.len() as f64;
        let pairs = found.iter().zip(&self.expected);
        let (square, chance) = pairs.fold((0.0, 0.0), |(square, chance), (found, e)| {
            (
                square + (found - e) * (found - e),
                chance + e * (1.0 - e / count),
            )
        });
        square / chance
    }
}

/// `roots` of a surface of the area `area`, as their distances are measured.
pub fn samples<'a>(
    mesh: &Mesh,
    pdf: &RootPdf,
    area: f64,
    roots: impl Iterator<Item = &'a SurfacePoint>,
) -> Vec<Sample> {
    let sample = |place: &SurfacePoint| Sample {
        position: mesh.position(place),
        normal: mesh.normal(place),
        density: pdf.density(place) * area,
    };
    roots.map(sample).collect()
}

/// A heading, and what of each row stands below it.
type Table = (&'static str, fn(&Evenness) -> Values);

/// Writes the tables, each below its heading.
pub fn write_tables(rows: &[Evenness], text: &mut String) -> std::fmt::Result {
    let tables: [Table; 2] = [
        ("Variance of the roots in cells of space", |row| {
            row.variance
        }),
        ("Mean distance to the nearest root", |row| row.nearest),
    ];
    writeln!(text, "{HEADING}")?;
    for (heading, values) in tables {
        writeln!(text, "\n### {heading}\n")?;
        writeln!(text, "| surface | map | roots | {} |", WAYS.join(" | "))?;
        writeln!(text, "|---|---|---|{}", "---|".repeat(WAYS.len()))?;
        for row in rows {
            let Evenness {
                mesh, map, roots, ..
            } = row;
            let cells = values(row).map(|value| format!("{value:.2}")).join(" | ");
            writeln!(text, "| {mesh} | {map} | {roots} | {cells} |")?;
        }
    }
    Ok(())
}
