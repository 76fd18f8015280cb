//! Super-Helices against other ways to write a strand with fewer numbers.
//!
//! Fits strands of five kinds by formula and the guides of the examples `head` and `animal`,
//! and counts what each way needs to stay within 1 % of the length, what ten elements come
//! to, and how long it takes. Writes `super_helices.md` and its pictures into a folder:
//!
//! ```text
//! cargo run --release -p pelage --example super_helices -- docs/results
//! cargo run --release -p pelage --example super_helices -- FOLDER CURVES.usda
//! ```
//!
//! A second argument names a file of curves to fit as well.

// Of the plots of the command only one kind is drawn here.
#[allow(dead_code)]
#[path = "../../src/cli/plot.rs"]
mod plot;

mod methods;
mod pictures;
mod strands;

use methods::{Method, Spline, Target};
use pelage::curves::DVec3;
use pelage::curves::super_helix::{Goal, Settings, fit};
use pelage::strands::StrandBuffer;
use plot::{Axes, Line, logarithmic};
use rayon::prelude::*;
use std::error::Error;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;
use strands::Kind;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Strands of each kind, and points of each.
const STRANDS: u32 = 40;
const POINTS: usize = 100;

/// The bound that all are held to, as a part of the length.
const BOUND: f64 = 0.01;

/// Finer bounds, and the kinds of strands that are held to them.
const BOUNDS: [f64; 4] = [0.01, 0.003, 0.001, 0.000_5];
const FINER: [&str; 2] = ["wavy", "curly"];

/// Most elements that the other ways are tried with.
const MOST: usize = 120;

/// How often each fit is timed.
const ROUNDS: usize = 7;

/// Curves through vertices, at equal arc length (0) or by the nearest point (1).
const SPLINES: [(Spline, usize); 3] = [
    (Spline::CatmullRom, 0),
    (Spline::CatmullRom, 1),
    (Spline::Polygon, 1),
];

/// Strands that are fitted on all threads for the rate.
const MANY: u32 = 10_000;

/// Strands of one kind.
struct Family {
    name: String,
    points: f64,
    targets: Vec<Target>,
}

fn main() -> Result<()> {
    let mut arguments = std::env::args().skip(1);
    let folder = PathBuf::from(arguments.next().unwrap_or("docs/results".into()));
    let mut families = families()?;
    if let Some(file) = arguments.next() {
        families.push(of_file(Path::new(&file))?);
    }
    let mut report = String::from(HEAD);
    bound_table(&mut report, &families)?;
    finer_table(&mut report, &families)?;
    ten_table(&mut report, &families)?;
    rate(&mut report)?;
    std::fs::write(folder.join("super_helices.md"), &report)?;
    std::fs::write(folder.join("super_helices.svg"), sheet(&families)?)?;
    std::fs::write(folder.join("super_helices_errors.svg"), errors(&families)?)?;
    print!("{report}");
    Ok(())
}

const HEAD: &str = "# Super-Helices

Made by `cargo run --release -p pelage --example super_helices -- docs/results`. Strands of
five kinds by formula, 40 of each, 100 points each, and guides of the examples `head` and
`animal`. Errors are the largest distance at equal parts of the arc length, in percent of the
length; times are of one core, each strand's best of seven.

- *fit*: `super_helix::fit`. An element is four numbers (length, twist, two curvatures).
- *joints not moved*: the same, its elements ending where the reduction leaves them.
- *floating tangents*: helices through points of the target at equal steps, after
  Derouet-Jourdan, Bertails-Descoubes and Thollot (2013); four numbers each too.
- *root to tip*: each element fitted from where the one before ended.
- *Catmull-Rom*: spans of the centripetal curve through points of the target at equal steps,
  three numbers each; *nearest* measures it by the distance to the nearest point instead,
  where those before are measured at equal arc length; *polygon*: straight edges, likewise.

";

fn families() -> Result<Vec<Family>> {
    let mut families = Vec::new();
    for kind in Kind::ALL {
        let strands = (0..STRANDS).map(|i| kind.strand(i, POINTS));
        families.push(Family::new(kind.name(), strands)?);
    }
    for name in ["head", "animal"] {
        let example = pelage::examples::example(name).ok_or("no such example")?;
        let (_, guides) = example.guides.ok_or("an example without guides")?;
        let title = format!("{name}'s guides");
        families.push(Family::new(&title, some(&guides).into_iter())?);
    }
    Ok(families)
}

fn of_file(path: &Path) -> Result<Family> {
    let file = pelage::io::read_curves(path, None)?;
    let strands = file.sets.iter().flat_map(|set| some(&set.curves));
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    Family::new(&name, strands)
}

/// At most [`STRANDS`] strands, evenly picked.
fn some(all: &StrandBuffer) -> Vec<Vec<DVec3>> {
    let step = all.len().div_ceil(STRANDS as usize).max(1);
    let points = |i: usize| all.strand_points(i).iter().map(|p| p.as_dvec3()).collect();
    (0..all.len()).step_by(step).map(points).collect()
}

impl Family {
    fn new(name: &str, strands: impl Iterator<Item = Vec<DVec3>>) -> Result<Self> {
        let strands: Vec<_> = strands.collect();
        let targets = strands.iter().map(|s| Target::new(s));
        Ok(Self {
            name: name.into(),
            points: strands.iter().map(Vec::len).sum::<usize>() as f64 / strands.len() as f64,
            targets: targets.collect::<Result<_>>()?,
        })
    }

    /// The mean of `value` over the strands; `None` where one of them has none.
    fn mean(&self, value: impl Fn(&Target) -> Result<Option<f64>>) -> Result<Option<f64>> {
        let mut sum = 0.0;
        for target in &self.targets {
            match value(target)? {
                Some(value) => sum += value,
                None => return Ok(None),
            }
        }
        Ok(Some(sum / self.targets.len() as f64))
    }
}

impl Family {
    /// Elements that `method` needs to keep `bound`.
    fn elements(&self, method: Method, bound: f64) -> Result<Option<f64>> {
        self.mean(|target| {
            let curve = method.within(target, bound, MOST)?;
            Ok(curve.map(|curve| curve.elements().len() as f64))
        })
    }

    /// Spans that a curve through vertices needs to keep `bound`, measured as `way` says.
    fn spans(&self, spline: Spline, way: usize, bound: f64) -> Result<Option<f64>> {
        self.mean(|target| {
            for spans in 1..=MOST {
                if target.spline_misses(spline, spans)?[way] <= bound {
                    return Ok(Some(spans as f64));
                }
            }
            Ok(None)
        })
    }
}

fn told(number: Option<f64>) -> String {
    number.map_or(format!("> {MOST}"), |x| format!("{x:.1}"))
}

/// What each way needs to keep the bound.
fn bound_table(report: &mut String, families: &[Family]) -> Result<()> {
    writeln!(report, "## Within 1 % of the length\n")?;
    writeln!(
        report,
        "Mean over the strands of the elements (spans) needed. *fewer numbers*: those of the points\n\
         over those of the fit, four an element and six for the root.\n"
    )?;
    let names = Method::ALL.map(Method::name).join(" | ");
    writeln!(
        report,
        "| strands | points | {names} | Catmull-Rom | nearest | polygon | ratios | fewer numbers | ms a fit |\n|---|{}",
        "---|".repeat(11)
    )?;
    for family in families {
        let mut cells = Vec::new();
        for method in Method::ALL {
            cells.push(family.elements(method, BOUND)?);
        }
        for (spline, way) in SPLINES {
            cells.push(family.spans(spline, way, BOUND)?);
        }
        let own = cells[0].unwrap_or(f64::NAN);
        let [spline, polygon] = [5, 6].map(|k| own / cells[k].unwrap_or(f64::NAN));
        writeln!(
            report,
            "| {} | {:.0} | {} | {spline:.2}, {polygon:.2} | {:.1} | {:.2} |",
            family.name,
            family.points,
            cells
                .iter()
                .map(|c| told(*c))
                .collect::<Vec<_>>()
                .join(" | "),
            3.0 * family.points / (4.0 * own + 6.0),
            milliseconds(family, Goal::RelativeError(BOUND))?,
        )?;
    }
    writeln!(
        report,
        "\n*ratios*: elements of the fit over spans of the Catmull-Rom curve, and over edges of the\n\
         polygon, each by its nearest points. Waves in a plane change the side they bend to\n\
         twice each, and an element has one side: half a wave is the most that one can be.\n"
    )?;
    Ok(())
}

/// How the ratios change with the bound.
fn finer_table(report: &mut String, families: &[Family]) -> Result<()> {
    writeln!(
        report,
        "## Within finer bounds\n\n\
         Elements of the fit, at equal arc length; edges of the polygon and spans of the\n\
         Catmull-Rom curve, by their nearest points; and the elements over each of them.\n\n\
         | strands | within | fit | polygon | Catmull-Rom | ratios |\n|---|---|---|---|---|---|"
    )?;
    for family in families
        .iter()
        .filter(|family| FINER.contains(&&*family.name))
    {
        for bound in BOUNDS {
            let fit = family.elements(Method::Fit, bound)?;
            let polygon = family.spans(Spline::Polygon, 1, bound)?;
            let spline = family.spans(Spline::CatmullRom, 1, bound)?;
            let ratio = |spans: Option<f64>| {
                let both = fit.zip(spans);
                both.map_or(f64::NAN, |(fit, spans)| fit / spans)
            };
            writeln!(
                report,
                "| {} | {} % | {} | {} | {} | {:.2}, {:.2} |",
                family.name,
                100.0 * bound,
                told(fit),
                told(polygon),
                told(spline),
                ratio(polygon),
                ratio(spline),
            )?;
        }
    }
    writeln!(report)?;
    Ok(())
}

/// What ten elements come to.
fn ten_table(report: &mut String, families: &[Family]) -> Result<()> {
    let names = Method::ALL.map(Method::name).join(" | ");
    writeln!(
        report,
        "## Ten elements\n\nMean error in percent of the length.\n"
    )?;
    writeln!(
        report,
        "| strands | {names} | ms a fit |\n|---|{}",
        "---|".repeat(5)
    )?;
    for family in families {
        write!(report, "| {} |", family.name)?;
        for method in Method::ALL {
            let error = |target: &Target| Ok(Some(target.miss(&method.elements(target, 10)?)));
            let mean = family.mean(error)?.unwrap_or(f64::NAN);
            write!(report, " {:.3} |", 100.0 * mean)?;
        }
        writeln!(
            report,
            " {:.2} |",
            milliseconds(family, Goal::Elements(10))?
        )?;
    }
    writeln!(report)?;
    Ok(())
}

/// Mean over the strands of the best time of each: other work on the machine only slows.
fn milliseconds(family: &Family, goal: Goal) -> Result<f64> {
    let mut sum = 0.0;
    for target in &family.targets {
        let mut best = f64::INFINITY;
        for _ in 0..ROUNDS {
            let started = Instant::now();
            fit(&target.curve, &Settings::new(goal))?;
            best = best.min(started.elapsed().as_secs_f64());
        }
        sum += best;
    }
    Ok(1e3 * sum / family.targets.len() as f64)
}

/// Many strands of all kinds on all threads.
fn rate(report: &mut String) -> Result<()> {
    let strands: Vec<_> = (0..MANY)
        .map(|i| Kind::ALL[i as usize % 5].strand(i, POINTS))
        .collect();
    let started = Instant::now();
    let fits: Vec<[usize; 2]> = strands
        .par_iter()
        .map(|points| {
            let target = pelage::curves::Chain::catmull_rom(points, 0.5).ok()?;
            let found = fit(&target, &Settings::new(Goal::RelativeError(BOUND))).ok()?;
            found
                .kept
                .then(|| [found.curve.numbers(), found.curve.elements().len()])
        })
        .collect::<Option<_>>()
        .ok_or("a bound was not kept")?;
    let seconds = started.elapsed().as_secs_f64();
    let numbers: usize = fits.iter().map(|f| f[0]).sum();
    let points = MANY as usize * POINTS;
    let six = fits.iter().filter(|f| 6 * f[0] <= 3 * POINTS).count();
    writeln!(
        report,
        "## Many strands\n\n\
         {MANY} strands of {POINTS} points, the five kinds by turns, to 1 % of the length: \
         {seconds:.1} s on {} threads, every bound kept. {numbers} numbers instead of {}, \
         {:.1} times fewer ({:.2} times fewer than there are points); {:.1} % of the strands have \
         at least six times fewer numbers than their points have.\n\n\
         ![Strands and fits](super_helices.svg)\n\n\
         Grey: the target. Each method with as many elements as the fit needs for 1 %.\n\n\
         ![Error by elements](super_helices_errors.svg)",
        rayon::current_num_threads(),
        3 * points,
        3.0 * points as f64 / numbers as f64,
        points as f64 / numbers as f64,
        100.0 * six as f64 / f64::from(MANY),
    )?;
    Ok(())
}

/// The first strand of each kind by each method, with as many elements as the fit needs.
fn sheet(families: &[Family]) -> Result<String> {
    let columns: Vec<_> = families
        .iter()
        .map(|f| (f.name.as_str(), &f.targets[0]))
        .collect();
    let mut rows = Vec::new();
    for method in Method::ALL {
        let mut fits = Vec::new();
        for (_, target) in &columns {
            let own = Method::Fit
                .within(target, BOUND, MOST)?
                .ok_or("a bound was not kept")?;
            fits.push(match method {
                Method::Fit => own,
                _ => method.elements(target, own.elements().len())?,
            });
        }
        rows.push((method, fits));
    }
    Ok(pictures::sheet(&columns, &rows))
}

/// Error against elements, the mean over wavy and curly strands.
fn errors(families: &[Family]) -> Result<String> {
    let mut lines = Vec::new();
    for family in &families[1..3] {
        for method in [Method::Fit, Method::Floating, Method::Naive] {
            let mut points = Vec::new();
            for elements in [2, 3, 4, 6, 8, 11, 16, 23, 32] {
                let error = |t: &Target| Ok(Some(100.0 * t.miss(&method.elements(t, elements)?)));
                let mean = family.mean(error)?.unwrap_or(f64::NAN);
                points.push((elements as f64, mean));
            }
            let name = format!("{}, {}", family.name, method.name());
            lines.push(Line { name, points });
        }
    }
    let axes = Axes {
        title: "Strands as Super-Helices",
        x: "elements",
        y: "largest error, percent of the length",
    };
    Ok(logarithmic(&axes, &lines)?)
}
