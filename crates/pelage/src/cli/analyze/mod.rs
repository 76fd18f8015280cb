//! `pelage analyze`: how curves bend.

pub mod frames;
mod measure;
mod report;

use super::args::AnalyzeArgs;
use super::curves;
use super::files::{json, write};
use super::progress::Bar;
use super::say::{Say, grouped};
use anyhow::{Context, Result, bail};
use measure::measure;
use report::{PROFILES, Report, of_one, plots};
use std::process::ExitCode;

/// Measures every curve of a file and writes the report.
pub fn run(args: &AnalyzeArgs, say: &Say) -> Result<ExitCode> {
    let (strands, _) = curves::read(&args.file, args.frame)?;
    if strands.is_empty() {
        bail!("{}: there are no curves in it", args.file.display());
    }
    if let Some(strand) = args.strand.filter(|&strand| strand >= strands.len()) {
        bail!("--strand {strand}: there are {} curves", strands.len());
    }
    let steps = args.steps as usize;
    let bar = Bar::new(say, strands.len() as u64, "curves");
    let kept = strands.len().div_ceil(PROFILES);
    let taken = measure(&strands, steps, kept, |done| bar.set(done as u64));
    drop(bar);
    let report = Report::new(&taken, args);
    let cannot = || format!("cannot write the report into {}", args.output.display());
    std::fs::create_dir_all(&args.output).with_context(cannot)?;
    let mut pictures = plots(&taken, steps)?;
    pictures.extend(of_one(&strands, report.strand(), steps)?);
    for (name, picture) in pictures {
        write(&args.output.join(name), &picture)?;
    }
    write(&args.output.join("statistics.json"), &json(&report)?)?;
    write(&args.output.join("report.md"), &report.page())?;
    say.line(report.table());
    say.line(format_args!(
        "{}: {} curves",
        args.output.join("report.md").display(),
        grouped(strands.len() as u64)
    ));
    Ok(ExitCode::SUCCESS)
}
