//! `pelage analyze`: how curves bend.

mod measure;
mod report;

use super::args::AnalyzeArgs;
use super::curves;
use super::files::{json, write};
use super::say::{Say, grouped};
use anyhow::{Context, Result, bail};
use measure::{Measured, measure};
use report::{Report, plots};
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
    let measured: Vec<Option<Measured>> = measure(&strands, args.steps as usize);
    let report = Report::new(&measured, args);
    let cannot = || format!("cannot write the report into {}", args.output.display());
    std::fs::create_dir_all(&args.output).with_context(cannot)?;
    for (name, plot) in plots(&strands, &measured, report.strand(), args.steps as usize)? {
        write(&args.output.join(name), &plot)?;
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
