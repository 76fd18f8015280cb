//! `pelage bench sampling`: the tables of document 004, section 4.1, measured again.

use super::Findings;
use super::distance::{self, Distances};
use super::maps::{Map, map, maps};
use super::measure::{Effort, Row, measure};
use super::methods::{INTERVAL, METHODS, sampler};
use super::order::{self, Evenness};
use super::picks;
use super::surfaces::{Surface, first_surface, surfaces};
use crate::cli::files::json;
use crate::cli::plot::{Axes, Line, by_name, logarithmic};
use crate::cli::progress::Bar;
use crate::cli::say::Say;
use crate::cli::threads::cores;
use anyhow::Result;
use std::fmt::Write;

/// Texels along a side of the maps, unless a table is about that.
const MAP_SIZE: u32 = 1024;

/// What the methods and maps of the page are.
const PREFACE: &str = "
The methods draw the same number of roots (triangle and barycentrics, written to memory)
by the index of the hair. `guided` is `RootSampler::fill`; `bisection` and `alias` take
the same pieces and numbers one hair after the other; `rejection` picks a triangle by area
and weighs a coin by the map, as document 004 compares (section 4.1). *By interval* is
`RootSampler::fill_in`: the same roots in the order of the surface, with the indices of
their hairs. The best of three runs counts; of preprocessing, the best of as many as take
0.4 s before the roots are drawn, and as long after. `sun` is a sky with a disc of a few
texels, 10^6 times as bright; `embers` has texels whose brightness has no scale. Maps have
1024² texels where nothing else is said. Compare within a row: a machine that others share
changes its speed from row to row.
";

/// Everything that was measured.
pub struct Results {
    /// Surfaces by maps by methods, one thread.
    pub rates: Vec<Row>,
    /// Our method for surfaces by maps where the order is of no matter, one thread.
    pub intervals: Vec<Row>,
    /// Our method for maps of several sizes.
    pub sizes: Vec<Row>,
    /// Our method for several numbers of threads.
    pub threads: Vec<Row>,
    /// How evenly roots are spread by the order of the pieces.
    pub evenness: Vec<Evenness>,
    /// Roots that keep their distance.
    pub distances: Distances,
    /// Picks a second by the size of the grid.
    pub cells: Vec<(&'static str, Vec<f64>)>,
    /// Picks a second from skies, with and without the grid.
    pub skies: Vec<(&'static str, [f64; 2])>,
}

/// Measures everything; `quick` takes one surface and few samples.
pub fn run(quick: bool, say: &Say) -> Result<Results> {
    let effort = match quick {
        true => Effort {
            samples: 1 << 16,
            seconds: 0.05,
            runs: 1,
        },
        false => Effort {
            samples: 10_000_000,
            seconds: 0.4,
            runs: 3,
        },
    };
    let surfaces = surfaces().take(if quick { 1 } else { usize::MAX });
    let maps = maps(if quick { 256 } else { MAP_SIZE });
    let total = surfaces.len() * maps.len() * (METHODS.len() + 1);
    let bar = Bar::new(say, total as u64, "measurements");
    let [mut rates, mut intervals] = [Vec::new(), Vec::new()];
    let mut evenness = Vec::new();
    for surface in surfaces {
        for map in &maps {
            for method in METHODS {
                rates.push(measure(&surface, map, method, 1, effort));
                bar.set((rates.len() + intervals.len()) as u64);
            }
            intervals.push(measure(&surface, map, INTERVAL, 1, effort));
        }
        evenness.extend(order::measure(&surface, &maps, quick));
    }
    let first = &first_surface();
    let weights = |map| {
        let sampler = sampler(&first.mesh, map);
        let all = sampler.distribution();
        (0..all.len())
            .map(|i| all.probability(i))
            .collect::<Vec<_>>()
    };
    Ok(Results {
        sizes: by_size(first, if quick { 64 } else { 512 }, effort),
        threads: by_threads(first, &maps, effort),
        cells: maps
            .iter()
            .map(|map| (map.name, picks::by_cells(&weights(map), effort)))
            .collect(),
        skies: maps
            .iter()
            .map(|map| (map.name, picks::sky(map, effort)))
            .collect(),
        distances: distance::measure(first, &maps, quick)?,
        evenness,
        intervals,
        rates,
    })
}

fn by_size(surface: &Surface, smallest: u32, effort: Effort) -> Vec<Row> {
    [1, 2, 4]
        .map(|times| {
            measure(
                surface,
                &map("embers", smallest * times),
                "guided",
                1,
                effort,
            )
        })
        .into()
}

fn by_threads(surface: &Surface, maps: &[Map], effort: Effort) -> Vec<Row> {
    let cores = cores();
    let doubled = std::iter::successors(Some(1), |n| Some(n * 2));
    let below = doubled.take_while(|&n| n < cores);
    let counts: Vec<usize> = below.chain([cores]).collect();
    let named = |name: &&Map| ["uniform", "embers"].contains(&name.name);
    // Shorter runs, and more: another program on a core slows two threads more than one.
    let effort = Effort {
        seconds: effort.seconds / 8.0,
        runs: effort.runs * 8,
        ..effort
    };
    maps.iter()
        .filter(named)
        .flat_map(|map| counts.iter().map(move |&n| (map, n)))
        .map(|(map, n)| measure(surface, map, "guided", n, effort))
        .collect()
}

impl Results {
    /// All of it, to be printed and written.
    pub fn findings(&self) -> Result<Findings> {
        let mut files = vec![("sampling.md", self.page())];
        files.extend(self.plots()?);
        Ok(Findings {
            tables: self.tables(),
            data: json(&self.rows())?,
            files,
        })
    }

    /// All measurements of whole methods.
    fn rows(&self) -> Vec<&Row> {
        self.rates
            .iter()
            .chain(&self.sizes)
            .chain(&self.threads)
            .collect()
    }

    /// The tables and plots as Markdown, with what they are.
    fn page(&self) -> String {
        let cores = cores();
        let version = env!("CARGO_PKG_VERSION");
        format!(
            "# Sampling\n\nMade by `pelage bench sampling -o docs/results --json \
            docs/results/sampling.json`, version {version}, {cores} cores.\n{PREFACE}\n{}\n\
            ![Rates by map](sampling-rates.svg)\n\n![Rates by grid](sampling-grid.svg)\n\n\
            ![Power spectra of roots](sampling-spectrum.svg)\n",
            self.tables()
        )
    }

    /// The tables as Markdown, each below its heading.
    fn tables(&self) -> String {
        let mut text = String::new();
        // Writing to a String cannot fail.
        let _ = self.write_tables(&mut text);
        text
    }

    fn write_tables(&self, text: &mut String) -> std::fmt::Result {
        writeln!(text, "## Rates, million samples a second, one thread\n")?;
        self.by_method(text, |row| match row.rate() {
            rate if rate < 0.01 => format!("{rate:.0e}"),
            rate => format!("{rate:.2}"),
        })?;
        self.by_interval(text)?;
        writeln!(text, "\n## Preprocessing, milliseconds, one thread\n")?;
        self.by_method(text, |row| format!("{:.1}", row.preprocess_seconds * 1e3))?;
        writeln!(text, "\n## Memory, MB\n")?;
        self.by_method(text, |row| format!("{:.1}", row.bytes as f64 / 1e6))?;
        writeln!(text, "\n## Size of the map (embers)\n")?;
        writeln!(
            text,
            "| map | M samples/s | preprocessing, ms | memory, MB |"
        )?;
        writeln!(text, "|---|---|---|---|")?;
        for row in &self.sizes {
            writeln!(
                text,
                "| {size}² | {:.1} | {:.1} | {:.1} |",
                row.rate(),
                row.preprocess_seconds * 1e3,
                row.bytes as f64 / 1e6,
                size = row.map_size,
            )?;
        }
        self.by_threads(text)?;
        order::write_tables(&self.evenness, text)?;
        distance::write_tables(&self.distances, text)?;
        writeln!(
            text,
            "\n## Cells of the grid an element, million picks a second\n"
        )?;
        let cells: Vec<String> = picks::CELLS.iter().map(|c| c.to_string()).collect();
        writeln!(text, "| map | {} |", cells.join(" | "))?;
        writeln!(text, "|---|{}", "---|".repeat(cells.len()))?;
        for (map, rates) in &self.cells {
            let rates: Vec<String> = rates.iter().map(|r| format!("{r:.1}")).collect();
            writeln!(text, "| {map} | {} |", rates.join(" | "))?;
        }
        writeln!(text, "\n## Maps of the sky, million picks a second\n")?;
        writeln!(text, "| map | with the grid | by bisection | times |")?;
        writeln!(text, "|---|---|---|---|")?;
        for (map, [grid, bisection]) in &self.skies {
            let times = grid / bisection;
            writeln!(text, "| {map} | {grid:.1} | {bisection:.1} | {times:.1} |")?;
        }
        Ok(())
    }

    fn by_interval(&self, text: &mut String) -> std::fmt::Result {
        writeln!(
            text,
            "\n## In the order of the surface, million samples a second, one thread\n"
        )?;
        writeln!(
            text,
            "| surface | map | by index | by interval | times |\n|---|---|---|---|---|"
        )?;
        let guided = self.rates.iter().step_by(METHODS.len());
        for (index, interval) in guided.zip(&self.intervals) {
            let (Row { mesh, map, .. }, [index, interval]) =
                (interval, [index, interval].map(Row::rate));
            let times = interval / index;
            writeln!(
                text,
                "| {mesh} | {map} | {index:.1} | {interval:.1} | {times:.2} |"
            )?;
        }
        Ok(())
    }

    fn by_threads(&self, text: &mut String) -> std::fmt::Result {
        writeln!(text, "\n## Threads\n")?;
        writeln!(
            text,
            "| map | threads | M samples/s | times | preprocessing, ms | times |\n\
            |---|---|---|---|---|---|"
        )?;
        for rows in self.threads.chunk_by(|a, b| a.map == b.map) {
            for row in rows {
                writeln!(
                    text,
                    "| {} | {} | {:.1} | {:.2} | {:.1} | {:.2} |",
                    row.map,
                    row.threads,
                    row.rate(),
                    row.rate() / rows[0].rate(),
                    row.preprocess_seconds * 1e3,
                    rows[0].preprocess_seconds / row.preprocess_seconds,
                )?;
            }
        }
        Ok(())
    }

    /// A table with a column for each method.
    fn by_method(&self, text: &mut String, cell: impl Fn(&Row) -> String) -> std::fmt::Result {
        writeln!(
            text,
            "| surface | triangles | map | {} |",
            METHODS.join(" | ")
        )?;
        writeln!(text, "|---|---|---|{}", "---|".repeat(METHODS.len()))?;
        for rows in self.rates.chunks(METHODS.len()) {
            let cells: Vec<String> = rows.iter().map(&cell).collect();
            let Row {
                mesh,
                triangles,
                map,
                ..
            } = rows[0];
            writeln!(
                text,
                "| {mesh} | {triangles} | {map} | {} |",
                cells.join(" | ")
            )?;
        }
        Ok(())
    }

    /// Plots by the name of their files.
    fn plots(&self) -> Result<Vec<(&'static str, String)>> {
        let cells = self.cells.iter().map(|(map, rates)| Line {
            name: (*map).into(),
            points: picks::CELLS
                .iter()
                .copied()
                .zip(rates.iter().copied())
                .collect(),
        });
        let methods = METHODS.iter().enumerate().map(|(k, method)| Line {
            name: (*method).into(),
            points: self
                .rates
                .chunks(METHODS.len())
                .take(self.cells.len())
                .enumerate()
                .map(|(map, rows)| (map as f64, rows[k].rate()))
                .collect(),
        });
        Ok(vec![
            ("sampling-spectrum.svg", self.distances.plot()?),
            (
                "sampling-grid.svg",
                logarithmic(
                    &Axes {
                        title: "Picks by the size of the grid",
                        x: "cells an element",
                        y: "million picks a second",
                    },
                    &cells.collect::<Vec<_>>(),
                )?,
            ),
            (
                "sampling-rates.svg",
                by_name(
                    &Axes {
                        title: "Samples on the first surface by map, one thread",
                        x: "map",
                        y: "million samples a second",
                    },
                    &self.cells.iter().map(|(map, _)| *map).collect::<Vec<_>>(),
                    &methods.collect::<Vec<_>>(),
                )?,
            ),
        ])
    }
}
