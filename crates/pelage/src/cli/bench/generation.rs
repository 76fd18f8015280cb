//! `pelage bench generation`: the cost of hairs by stage, as document 004 tells it
//! (4.2.1), cold and with the rest pose captured.

use super::bars::Bars;
use super::cost::{Row, bytes_of_a_hair, captured, cold, copying, warm};
use super::scenes::{Scene, scenes};
use super::{Findings, machine};
use crate::cli::files::json;
use crate::cli::progress::Bar;
use crate::cli::say::{Say, grouped};
use crate::cli::threads::cores;
use anyhow::Result;
use pelage::Order;
use pelage::groom::Stage;
use std::fmt::Write;

/// What the scenes and columns of the page are.
const PREFACE: &str = "
A ball of 9,024 triangles with 1,000 guides, of which 3 shape a hair; hairs of 5 and of 15
segments into the null sink: a million single hairs, or 200,000 of 5 fibres each in the
scenes `strands`. `plain` sets scale, frizz, kink, mutant hair, the variation of colour, and
colour, opacity and width from root to tip, and no map; `five maps` has maps of 1024² texels
for density, scale, colour, opacity and width, as document 004 compares (section 4.2).
`strands` is plain too, with splay, twist and shortening. Hairs come in the order of their
indices, or *along the surface* (`--order surface`), neighbours after each other.
*Cold* is everything from roots to the
sink; *warm* keeps what was captured of the rest pose, as the frames of an animation can,
and evaluates a pose. The best of five runs counts. *Of copying* is the bytes handed to the
sink a second, over those that as many threads read and write when they copy plain memory,
measured in the same run: 100 % would be hair at the speed of a copy. *Peak memory* is the
process's in the cold runs, with the plans and maps of all scenes. Compare within a table:
a machine that others share changes its speed from minute to minute, and two threads gain
little where others have the second core.

Of the steps of document 004's tables 4.3 and 4.4, *generate sample* and *hair root* are
`roots`; *interpolate* is `weights` and `interpolate`; *frizz*, *kink* and *curve frame* are
`frizz`, `kink` and `frames`; *fiber from a single hair* is `strand`; *other properties* are
`maps` and `look`; *finalizing hair* is `thin` and `world`; *output hair* is `sink`.
";

/// Everything that was measured.
pub struct Results {
    rows: Vec<Row>,
    /// Bytes of a hair, row by row.
    bytes: Vec<f64>,
    /// Threads, and bytes a second that they copy.
    copying: Vec<(usize, f64)>,
    /// What it was measured on.
    machine: String,
}

/// How much to measure.
struct Effort {
    hairs: u64,
    map_size: u32,
    runs: usize,
    /// Bytes of the array that is copied.
    copied: usize,
}

const FULL: Effort = Effort {
    hairs: 1_000_000,
    map_size: 1024,
    runs: 5,
    copied: 256 << 20,
};

const QUICK: Effort = Effort {
    hairs: 3_000,
    map_size: 64,
    runs: 1,
    copied: 1 << 20,
};

/// Measures everything; `quick` takes few hairs.
pub fn run(quick: bool, say: &Say) -> Result<Results> {
    let effort = if quick { QUICK } else { FULL };
    let machine = machine();
    let mut threads = vec![1, cores()];
    threads.dedup();
    let scenes = scenes(effort.hairs, effort.map_size)?;
    let ordered: Vec<(&Scene, Order)> = scenes
        .iter()
        .flat_map(|scene| [Order::Index, Order::Surface].map(|order| (scene, order)))
        .collect();
    let bar = Bar::new(
        say,
        2 * (ordered.len() * threads.len()) as u64,
        "measurements",
    );
    // All cold runs come first: what is kept for the warm ones would count as theirs.
    let mut colds = Vec::new();
    for &(scene, order) in &ordered {
        for &n in &threads {
            colds.push(cold(&scene.plan, order, n, effort.runs)?);
            bar.set(colds.len() as u64);
        }
    }
    let copying = threads
        .iter()
        .map(|&n| (n, copying(n, effort.copied, effort.runs)))
        .collect();
    let (mut rows, mut bytes) = (Vec::new(), Vec::new());
    for &(scene, order) in &ordered {
        let captures = captured(&scene.plan, order);
        let of_a_hair = bytes_of_a_hair(scene)?;
        for &n in &threads {
            let seconds = warm(&scene.plan, &captures, n, effort.runs)?;
            rows.push(Row::new((scene, order), n, &colds[rows.len()], seconds));
            bytes.push(of_a_hair);
            bar.set((colds.len() + rows.len()) as u64);
        }
    }
    Ok(Results {
        bytes,
        rows,
        copying,
        machine,
    })
}

impl Results {
    /// All of it, to be printed and written.
    pub fn findings(&self) -> Result<Findings> {
        let tables = self.tables();
        Ok(Findings {
            data: json(&self.rows)?,
            files: vec![
                ("generation.md", self.page(&tables)),
                ("generation-stages.svg", self.plot()?),
            ],
            tables,
        })
    }

    fn page(&self, tables: &str) -> String {
        let version = env!("CARGO_PKG_VERSION");
        let machine = &self.machine;
        format!(
            "# Generation\n\nMade by `pelage bench generation -o docs/results --json \
            docs/results/generation.json`, version {version}, on {machine}.\n\
            {PREFACE}\n{tables}![Cost by stage](generation-stages.svg)\n"
        )
    }

    fn tables(&self) -> String {
        let mut text = String::new();
        // Writing to a String cannot fail.
        let _ = self.write_seconds(&mut text);
        for (order, name) in [
            (Order::Index, "in the order of the indices"),
            (Order::Surface, "along the surface"),
        ] {
            let _ = self.write_stages(order, name, &mut text);
        }
        text
    }

    fn write_seconds(&self, text: &mut String) -> std::fmt::Result {
        let curves = self.rows.first().map_or(0, |row| row.hairs);
        writeln!(text, "## {} curves\n", grouped(curves))?;
        writeln!(
            text,
            "| scene | hairs | fibres | CVs | threads | cold, s | M hairs/s | of copying | warm, s | M hairs/s | \
            of copying | peak memory, MB |\n|{}",
            "---|".repeat(12)
        )?;
        for (row, bytes) in self.rows.iter().zip(&self.bytes) {
            let rates = |seconds: f64| {
                let rate = row.hairs as f64 / seconds;
                let share = 100.0 * rate * bytes / self.copied_by(row.threads);
                format!("{seconds:.3} | {:.2} | {share:.0} %", rate / 1e6)
            };
            let peak = row
                .peak_bytes
                .map_or("?".into(), |b| format!("{:.0}", b as f64 / 1e6));
            writeln!(
                text,
                "| {} | {} | {} | {} | {} | {} | {} | {peak} |",
                row.scene,
                grouped(row.hairs),
                row.fibers,
                row.cvs,
                row.threads,
                rates(row.seconds_cold),
                rates(row.seconds_warm),
            )?;
        }
        let copied = self.copying.iter().map(|(threads, rate)| {
            let threads = match threads {
                1 => "one thread".to_owned(),
                n => format!("{n} threads"),
            };
            format!("{:.1} GB/s by {threads}", rate / 1e9)
        });
        let copied: Vec<String> = copied.collect();
        writeln!(text, "\nCopying memory: {}.\n", copied.join(", "))
    }

    fn copied_by(&self, threads: usize) -> f64 {
        let found = self.copying.iter().find(|(n, _)| *n == threads);
        found.map_or(f64::NAN, |(_, rate)| *rate)
    }

    /// The rows of one thread, whose stages take the time they take.
    fn single(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| row.threads == 1)
    }

    fn write_stages(&self, order: Order, title: &str, text: &mut String) -> std::fmt::Result {
        writeln!(
            text,
            "## Nanoseconds a hair by stage, {title}, cold, one thread\n"
        )?;
        let rows: Vec<&Row> = self.single().filter(|row| row.order == order).collect();
        let names: Vec<String> = rows.iter().map(|row| name(row)).collect();
        writeln!(text, "| stage | {} |", names.join(" | "))?;
        writeln!(text, "|---|{}", "---|".repeat(names.len()))?;
        let sum = |row: &Row| Stage::ALL.iter().map(|s| row.nanoseconds(s.name())).sum();
        for stage in Stage::ALL.map(Stage::name) {
            let cell = |row: &Row| {
                let (spent, all): (f64, f64) = (row.nanoseconds(stage), sum(row));
                format!("{spent:.1} ({:.0} %)", 100.0 * spent / all)
            };
            let cells: Vec<String> = rows.iter().map(|row| cell(row)).collect();
            writeln!(text, "| {stage} | {} |", cells.join(" | "))?;
        }
        let sums = rows.iter().map(|row| format!("{:.1}", sum(row)));
        writeln!(text, "| all | {} |\n", sums.collect::<Vec<_>>().join(" | "))
    }

    fn plot(&self) -> Result<String> {
        let stages = Stage::ALL.map(Stage::name);
        let bar = |row: &Row| (name(row), stages.map(|s| row.nanoseconds(s)).into());
        let bars: Vec<(String, Vec<f64>)> = self.single().map(bar).collect();
        let plot = Bars {
            title: "Cost by stage, cold, one thread",
            x: "nanoseconds a hair",
            parts: &stages,
            bars: &bars,
        };
        plot.svg()
    }
}

/// What a scene is called in tables and plots.
fn name(row: &Row) -> String {
    format!("{}, {} CVs", row.scene, row.cvs)
}
