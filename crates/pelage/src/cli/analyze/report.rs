//! The report: statistics of all curves, and plots.

use super::frames;
use super::measure::{Measured, Taken, points};
use crate::cli::args::AnalyzeArgs;
use crate::cli::plot::{Axes, Line, linear};
use anyhow::Result;
use pelage::StrandBuffer;
use pelage::curves::frenet::{Apparatus, CatmullRom, Sample, Segment};
use serde::Serialize;

/// Most curves whose profiles are kept for the plot of all; they are chosen evenly.
pub const PROFILES: usize = 20_000;

/// Parts of all curves that statistics are told at.
const QUANTILES: [(&str, f64); 5] = [
    ("least", 0.0),
    ("5 %", 0.05),
    ("median", 0.5),
    ("95 %", 0.95),
    ("most", 1.0),
];

/// A measure of all curves.
#[derive(Debug, Serialize)]
struct Statistic {
    name: &'static str,
    unit: &'static str,
    /// Curves that have it.
    count: usize,
    mean: f64,
    /// At the parts of [`QUANTILES`].
    quantiles: [f64; 5],
}

/// What is told of a file.
#[derive(Debug, Serialize)]
pub struct Report {
    file: String,
    curves: usize,
    /// Curves that have no length or a vertex that is no number.
    left_out: usize,
    steps: u32,
    strand: usize,
    statistics: Vec<Statistic>,
}

impl Report {
    /// The report of what was `taken` apart.
    pub fn new(taken: &[Option<Taken>], args: &AnalyzeArgs) -> Self {
        let measured: Vec<Option<Measured>> = (taken.iter())
            .map(|one| one.as_ref().map(|taken| taken.measured))
            .collect();
        let measured = &measured[..];
        let file = args.file.file_name().unwrap_or_default().to_string_lossy();
        Self {
            file: file.into_owned(),
            curves: measured.len(),
            left_out: measured.iter().filter(|m| m.is_none()).count(),
            steps: args.steps,
            strand: args.strand.unwrap_or_else(|| usual(measured)),
            statistics: statistics(measured),
        }
    }

    /// The curve that is plotted by itself.
    pub fn strand(&self) -> usize {
        self.strand
    }

    /// The statistics as a table of Markdown.
    pub fn table(&self) -> String {
        let names: Vec<&str> = QUANTILES.iter().map(|(name, _)| *name).collect();
        let mut text = format!("| | unit | mean | {} |\n|---|---|", names.join(" | "));
        text += &"---|".repeat(QUANTILES.len() + 1);
        for statistic in &self.statistics {
            let cells: Vec<String> = statistic.quantiles.iter().map(|x| number(*x)).collect();
            let (name, unit, mean) = (statistic.name, statistic.unit, number(statistic.mean));
            text += &format!("\n| {name} | {unit} | {mean} | {} |", cells.join(" | "));
        }
        text
    }

    /// The whole report as Markdown.
    pub fn page(&self) -> String {
        let left_out = match self.left_out {
            0 => String::new(),
            n => format!(
                ", {n} of them left out: without length, or with vertices that are no numbers"
            ),
        };
        format!(
            "# {}\n\n{} curves{left_out}, each in {} steps of equal length. Curvature and \
            torsion are radians per unit of length of the file; the bend of a curve is its \
            curvature along all of it, its helicity torsion over curvature.\n\n{}\n\n\
            ![Curvature of all curves](curvature.svg)\n\n![Torsion of all curves](torsion.svg)\n\n\
            ![Curve {}](strand.svg)\n\n\
            Frames along it by four rules: the line that goes round it has the direction of the \
            normals, so what turns or jumps there turns a ribbon or a tube.\n\n\
            ![Its frames](frames.svg)\n",
            self.file,
            self.curves,
            self.steps,
            self.table(),
            self.strand,
        )
    }
}

/// A curve that bends as much as half of them.
fn usual(measured: &[Option<Measured>]) -> usize {
    let found = measured.iter().enumerate();
    let mut bends: Vec<(f64, usize)> = found
        .filter_map(|(i, m)| Some((m.as_ref()?.bend, i)))
        .collect();
    if bends.is_empty() {
        return 0;
    }
    let middle = bends.len() / 2;
    let order = |a: &(f64, usize), b: &(f64, usize)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
    bends.select_nth_unstable_by(middle, order).1.1
}

fn statistics(measured: &[Option<Measured>]) -> Vec<Statistic> {
    type Part = fn(&Measured) -> Option<f64>;
    let parts: [(&str, &str, Part); 7] = [
        ("length", "units", |m| Some(m.length)),
        ("ends apart", "of the length", |m| Some(m.straightness)),
        ("bend", "degrees", |m| Some(m.bend)),
        ("curvature", "1 / unit", |m| Some(m.curvature)),
        ("largest curvature", "1 / unit", |m| Some(m.most_curvature)),
        ("torsion", "1 / unit", |m| Some(m.torsion)),
        ("helicity", "", |m| m.helicity),
    ];
    let statistic = |(name, unit, part): (&'static str, &'static str, Part)| {
        let mut values: Vec<f64> = measured.iter().flatten().filter_map(part).collect();
        values.sort_by(f64::total_cmp);
        let count = values.len();
        (count > 0).then(|| Statistic {
            name,
            unit,
            count,
            mean: values.iter().sum::<f64>() / count as f64,
            quantiles: QUANTILES.map(|(_, part)| quantile(&values, part)),
        })
    };
    parts.into_iter().filter_map(statistic).collect()
}

/// The value that a `part` of `sorted`, which are some, is not above.
fn quantile(sorted: &[f64], part: f64) -> f64 {
    sorted[((sorted.len() - 1) as f64 * part).round() as usize]
}

fn number(x: f64) -> String {
    match x.abs() {
        0.0 => "0".into(),
        1e-3..1e6 => format!("{x:.4}"),
        _ => format!("{x:.3e}"),
    }
}

/// Plots and pictures, each with the name of its file.
pub type Files = Vec<(&'static str, String)>;

/// The plots of all curves.
pub fn plots(taken: &[Option<Taken>], steps: usize) -> Result<Files> {
    let kept = taken.iter().flatten();
    let profiles: Vec<&[Segment]> = kept.filter_map(|t| t.segments.as_deref()).collect();
    let all = |title, part: fn(&Segment) -> f64| {
        let axes = Axes {
            title,
            x: "fraction of the length",
            y: "radians per unit",
        };
        linear(&axes, &bands(&profiles, steps, part))
    };
    if profiles.is_empty() {
        return Ok(Vec::new());
    }
    let curvature = all("Curvature of all curves", |s| s.curvature)?;
    let torsion = all("Torsion of all curves", |s| s.torsion)?;
    Ok(vec![("curvature.svg", curvature), ("torsion.svg", torsion)])
}

/// The plot of one curve, and the picture of its frames.
pub fn of_one(strands: &StrandBuffer, strand: usize, steps: usize) -> Result<Files> {
    let points = points(strands, strand);
    let Ok(curve) = CatmullRom::new(&points) else {
        return Ok(Vec::new());
    };
    let Ok(samples) = Sample::along(&curve, steps) else {
        return Ok(Vec::new());
    };
    let title = format!("Curve {strand}");
    let axes = Axes {
        title: &title,
        x: "length",
        y: "radians per unit",
    };
    let one = Apparatus::of_samples(&samples)?;
    let plot = linear(&axes, &profile(&one.segments))?;
    let frames = frames::picture(&curve)?;
    Ok(vec![("strand.svg", plot), ("frames.svg", frames)])
}

/// The middle of all profiles and where nine of ten lie.
fn bands(profiles: &[&[Segment]], steps: usize, part: fn(&Segment) -> f64) -> Vec<Line> {
    let mut lines = [("median", 0.5), ("5 %", 0.05), ("95 %", 0.95)].map(|(name, at)| {
        let line = Line {
            name: name.into(),
            points: Vec::new(),
        };
        (at, line)
    });
    for step in 0..steps {
        let mut values: Vec<f64> = profiles
            .iter()
            .map(|profile| part(&profile[step]))
            .collect();
        values.sort_by(f64::total_cmp);
        let t = (step as f64 + 0.5) / steps as f64;
        for (at, line) in &mut lines {
            line.points.push((t, quantile(&values, *at)));
        }
    }
    lines.map(|(_, line)| line).into()
}

/// Curvature and torsion of one curve.
fn profile(segments: &[Segment]) -> Vec<Line> {
    let line = |name: &str, part: fn(&Segment) -> f64| {
        let mut s = 0.0;
        let points = segments.iter().map(|segment| {
            s += segment.length;
            (s - segment.length / 2.0, part(segment))
        });
        Line {
            name: name.into(),
            points: points.collect(),
        }
    };
    vec![
        line("curvature", |s| s.curvature),
        line("torsion", |s| s.torsion),
    ]
}
