//! `pelage fit`: curves as Super-Helices, and back.

mod decode;
mod picture;
mod report;
mod strand;

use super::args::FitArgs;
use super::curves;
use super::generate::options;
use super::progress::Bar;
use super::say::Say;
use super::values::ErrorBound;
use anyhow::{Result, bail};
use pelage::StrandBuffer;
use pelage::curves::super_helix::Goal;
use pelage::io::{SUPER_HELIX_EXTENSIONS, SuperHelices, read_curves, write_super_helices};
use rayon::prelude::*;
use report::Report;
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;
use strand::Fitted;

/// The bound where neither it nor a number of elements is asked for: a part of the length.
const USUAL: ErrorBound = ErrorBound::Part(0.01);

/// Some strand is farther from its curve than was asked for; the file is written.
const MISSED: u8 = 3;

/// Fits Super-Helices to curves, or decodes them.
pub fn run(args: &FitArgs, say: &Say) -> Result<ExitCode> {
    if args.decode {
        return decode::run(args, say);
    }
    refuse_other_extensions(&args.output)?;
    let started = Instant::now();
    let file = read_curves(&args.file, args.frame)?;
    let strands = curves::of(&file);
    if strands.is_empty() {
        bail!("{}: there are no curves in it", args.file.display());
    }
    let wish = Wish::of(args);
    let fitted = fit_all(&strands, &wish, say)?;
    let mut helices = SuperHelices {
        up_axis: file.up_axis,
        meters_per_unit: file.meters_per_unit,
        ..SuperHelices::default()
    };
    for (index, fitted) in fitted.iter().enumerate() {
        fitted.push(&mut helices, strands.strand_points(index), index)?;
    }
    // It may be the file that is written.
    let before = report::size(&args.file);
    write_super_helices(&args.output, &helices, &options(false))?;
    let report = Report::new(args, &wish, &strands, &helices, &fitted, before);
    report.say(say, started.elapsed());
    if let Some(path) = &args.picture {
        let up = file.up_axis.unwrap_or_default();
        picture::draw(&strands, &helices, &wish, &report, up, args, path, say)?;
    }
    Ok(match report.missed.is_empty() {
        true => ExitCode::SUCCESS,
        false => ExitCode::from(MISSED),
    })
}

/// What is asked of every fit.
pub struct Wish {
    goal: Goal,
    /// `None` where a number of elements is asked for.
    bound: Option<ErrorBound>,
}

impl Wish {
    fn of(args: &FitArgs) -> Self {
        // What rounding to 32 bits mostly adds at most is left to it.
        const LEFT: f64 = 1.0 - 1e-3;
        let bound = args.max_error.unwrap_or(USUAL);
        match args.elements {
            Some(elements) => Self {
                goal: Goal::Elements(elements as usize),
                bound: None,
            },
            None => Self {
                goal: match bound {
                    ErrorBound::Length(length) => Goal::Error(length * LEFT),
                    ErrorBound::Part(part) => Goal::RelativeError(part * LEFT),
                },
                bound: Some(bound),
            },
        }
    }
}

/// Before the work, which may take long.
fn refuse_other_extensions(output: &Path) -> Result<()> {
    let extension = output.extension().unwrap_or_default().to_string_lossy();
    if !SUPER_HELIX_EXTENSIONS.contains(&&*extension.to_ascii_lowercase()) {
        bail!(
            "{}: Super-Helices are written as .{}; to write curves again, add --decode",
            output.display(),
            SUPER_HELIX_EXTENSIONS.join(", .")
        );
    }
    Ok(())
}

/// Every strand of `strands`, fitted by many threads; their number changes nothing.
fn fit_all(strands: &StrandBuffer, wish: &Wish, say: &Say) -> Result<Vec<Fitted>> {
    let bar = Bar::new(say, strands.len() as u64, "strands");
    let done = AtomicU64::new(0);
    let one = |index| {
        let fitted = Fitted::new(strands.strand_points(index), wish, index);
        bar.set(done.fetch_add(1, Ordering::Relaxed) + 1);
        fitted
    };
    (0..strands.len()).into_par_iter().map(one).collect()
}
