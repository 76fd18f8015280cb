//! `pelage fit --decode`: curves from Super-Helices.

use super::super::args::FitArgs;
use super::super::generate::options;
use super::super::say::{Say, grouped, spent};
use anyhow::Result;
use pelage::io::{read_super_helices, sink_for};
use pelage::strands::StreamInfo;
use std::process::ExitCode;
use std::time::Instant;

/// Writes the curves of a file of fits.
pub fn run(args: &FitArgs, say: &Say) -> Result<ExitCode> {
    let started = Instant::now();
    let mut sink = sink_for(&args.output, &options(false))?;
    let helices = read_super_helices(&args.file)?;
    let strands = helices.decode(args.vertices);
    let usual = StreamInfo::default();
    let info = StreamInfo {
        up_axis: helices.up_axis.unwrap_or(usual.up_axis),
        meters_per_unit: helices.meters_per_unit.unwrap_or(usual.meters_per_unit),
        ..usual
    };
    sink.begin(&info)?;
    sink.begin_frame(0)?;
    sink.write(&strands)?;
    sink.end_frame()?;
    sink.finish()?;
    say.line(format_args!(
        "{}: {} strands, {} vertices ({})",
        args.output.display(),
        grouped(strands.len() as u64),
        grouped(strands.points.len() as u64),
        spent(started.elapsed())
    ));
    Ok(ExitCode::SUCCESS)
}
