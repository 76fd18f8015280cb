//! `pelage bench curves`: rates and errors of space curves (documents 000 and 003).

mod errors;
mod guides;
mod rates;

use super::python::answer;
use super::{Findings, machine};
use crate::cli::analyze::frames::picture;
use crate::cli::files::json;
use crate::cli::plot::{Axes, Line, logarithmic};
use crate::cli::progress::Bar;
use crate::cli::say::Say;
use anyhow::Result;
use pelage::curves::{Chain, DVec3};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write;

/// The same spline by Python packages: millions of points a second, with three derivatives.
const PEERS: &str = include_str!("peers.py");

/// What the tables of the page are.
const PREFACE: &str = "
Rates are of one thread, the best of several runs over arrays that stay in the cache, in
f64 where nothing else is said. *Synthesis* puts curves together of curvature and torsion
that differ from vertex to vertex; *one shape placed* has the ordered exponential made ahead
(document 000, section 3.1). Compare within a run: a machine that others share changes its
speed from minute to minute.
";

/// How errors are measured.
const ERRORS: &str = "
Curves of length 10, stepped along by a helix for each step (ours), by equations 26 and 37
of document 000 as printed, and by Euler's method. The error is the largest distance from the
reference at any point both have, over the length. The *cyclone* is figure 1 of the document:
a radius of curvature that grows evenly, at constant helicity.
";

/// How strands are mixed.
const MIXED: &str = "
Strands between three curled guides of random phases (of 4 turns, radius 0.1, height 1, 48
segments) and, below, of 3½ to 4½ turns, by random weights: the mean of vertices of document
004, and the three options of document 000, section 4.3; option 1 is what a groom does with
`interpolation.space = \"frenet\"`. *Orthogonality* is the largest entry of M Mᵀ - 1 on the
mean, for the mean M of the bases and for the basis made of it. *Radius kept* is that of the
curls over that of their guides; *leans* is the angle between the axes of strand and guides.
What the guides need once is made ahead for all. Option 1 and vertices are f32, as a groom has
them.
";

/// Everything that was measured.
#[derive(Serialize)]
pub struct Results {
    rates: Vec<rates::Rate>,
    /// Millions a second by Python packages.
    peers: BTreeMap<String, f64>,
    errors: Vec<errors::Row>,
    /// How well the reference of the errors agrees with itself at twice the step.
    doubt: f64,
    mixed: Vec<guides::Row>,
    machine: String,
}

/// Measures everything; `quick` takes few rounds.
pub fn run(quick: bool, say: &Say) -> Result<Results> {
    let machine = machine();
    let bar = Bar::new(say, 4, "tables");
    let effort = match quick {
        true => rates::Effort { runs: 1, rounds: 1 },
        false => rates::Effort {
            runs: 15,
            rounds: 10,
        },
    };
    let rates = rates::measure(effort)?;
    bar.set(1);
    let peers = if quick {
        BTreeMap::new()
    } else {
        answer(PEERS, &())?.unwrap_or_default()
    };
    bar.set(2);
    let (errors, doubt) = errors::measure();
    bar.set(3);
    let mixed = match quick {
        true => guides::measure(20, 1),
        false => guides::measure(500, 15),
    }?;
    Ok(Results {
        rates,
        peers,
        errors,
        doubt,
        mixed,
        machine,
    })
}

impl Results {
    /// All of it, to be printed and written.
    pub fn findings(&self) -> Result<Findings> {
        let tables = self.tables();
        Ok(Findings {
            data: json(self)?,
            files: vec![
                ("curves.md", self.page(&tables)),
                ("curves-errors.svg", self.plot()?),
                ("curves-kept.svg", guides::kept()?),
                ("curves-frames.svg", frames()?),
            ],
            tables,
        })
    }

    fn page(&self, tables: &str) -> String {
        let version = env!("CARGO_PKG_VERSION");
        let machine = &self.machine;
        format!(
            "# Curves\n\nMade by `pelage bench curves -o docs/results --json \
            docs/results/curves.json`, version {version}, on {machine}.\n\
            {PREFACE}\n{tables}\n![Errors](curves-errors.svg)\n\n\
            ![Three curls of other phases, mixed](curves-kept.svg)\n\n## Frames\n\n\
            An S in a plane that goes on in space, with its normals by the rules of document \
            003 and by double reflection, as `pelage analyze` draws them for any curve: Frenet's \
            jump at inflections, those of an up-axis where the curve goes straight up.\n\n\
            ![Frames by four rules](curves-frames.svg)\n"
        )
    }

    fn tables(&self) -> String {
        let mut text = String::new();
        // Writing to a String cannot fail.
        let _ = self.write_rates(&mut text);
        let _ = self.write_errors(&mut text);
        let _ = self.write_mixed(&mut text);
        text
    }

    fn write_rates(&self, text: &mut String) -> std::fmt::Result {
        writeln!(
            text,
            "## Rates, million points a second\n\n| | M/s |\n|---|---|"
        )?;
        for rates::Rate { what, rate } in &self.rates {
            writeln!(text, "| {what} | {rate:.1} |")?;
        }
        for (package, rate) in &self.peers {
            writeln!(
                text,
                "| cubic B-spline, value and three derivatives, by {package} (Python) | {rate:.3} |"
            )?;
        }
        if self.peers.is_empty() {
            writeln!(
                text,
                "\nNot compared with scipy, splipy and geomdl: set PELAGE_PYTHON to a Python \
                that has them."
            )?;
        }
        Ok(())
    }

    fn write_errors(&self, text: &mut String) -> std::fmt::Result {
        let doubt = self.doubt;
        writeln!(
            text,
            "\n## Errors per unit of length\n{ERRORS}The reference agrees with itself at twice \
            the step to {doubt:.0e}.\n\n\
            | curve | steps | ours | document 000 | Euler |\n|---|---|---|---|---|"
        )?;
        for row in &self.errors {
            writeln!(
                text,
                "| {} | {} | {:.1e} | {:.1e} | {:.1e} |",
                row.shape, row.steps, row.ours, row.document, row.euler
            )?;
        }
        Ok(())
    }

    fn write_mixed(&self, text: &mut String) -> std::fmt::Result {
        writeln!(
            text,
            "\n## Strands between curls\n{MIXED}\n\
            | guides differ in | mixed | length error | once mended | orthogonality | once mended \
            | radius kept | leans | ns a vertex |\n|{}",
            "---|".repeat(9)
        )?;
        for row in &self.mixed {
            let percent = |x: f64| format!("{:.1} %", 100.0 * x);
            // What is not mended has one error.
            let mended = match row.mixed.starts_with("integrals") {
                true => format!("{:.0e}", row.length_error[1]),
                false => "–".into(),
            };
            let bases = row
                .orthogonality
                .map(|bases| bases.map(|off| format!("{off:.1e}")));
            let [mean, own] = bases.unwrap_or(["–", "–"].map(String::from));
            writeln!(
                text,
                "| {} | {} | {} | {mended} | {mean} | {own} | {} | {:.1}° | {:.1} |",
                row.differ,
                row.mixed,
                percent(row.length_error[0]),
                percent(row.radius),
                row.lean,
                row.nanoseconds,
            )?;
        }
        Ok(())
    }

    /// Errors on the cyclone, which no method has for nothing.
    fn plot(&self) -> Result<String> {
        let line = |name: &str, of: fn(&errors::Row) -> f64| Line {
            name: name.into(),
            points: self
                .errors
                .iter()
                .filter(|row| row.shape == "cyclone")
                .map(|row| (row.steps as f64, of(row)))
                .collect(),
        };
        let axes = Axes {
            title: "Errors along the cyclone of document 000",
            x: "steps over a length of 10",
            y: "error per unit of length",
        };
        let lines = [
            line("ours", |row| row.ours),
            line("document 000, equation 37", |row| row.document),
            line("Euler", |row| row.euler),
        ];
        logarithmic(&axes, &lines)
    }
}

/// The frames of a curve that has what each rule fails at.
fn frames() -> Result<String> {
    let point = |i: usize| {
        let t = i as f64 / 59.0;
        let turn = t * std::f64::consts::TAU;
        let aside = if t > 0.5 {
            0.35 * libm::sin(3.0 * turn)
        } else {
            0.0
        };
        DVec3::new(0.6 * libm::sin(turn), 3.0 * t, aside)
    };
    let points: Vec<DVec3> = (0..60).map(point).collect();
    picture(&Chain::catmull_rom(&points, 0.5)?)
}
