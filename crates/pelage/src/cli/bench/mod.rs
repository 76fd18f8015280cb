//! `pelage bench`: figures of the results, measured again on the machine at hand.

mod maps;
mod measure;
mod methods;
mod order;
mod picks;
mod plot;
mod sampling;
mod surfaces;

use super::args::BenchArgs;
use super::files::{json, write};
use super::say::Say;
use anyhow::{Context, Result};
use std::process::ExitCode;

/// Measures, prints the tables and writes what was asked for.
pub fn run(args: &BenchArgs, say: &Say) -> Result<ExitCode> {
    let results = sampling::run(args.quick, say);
    say.line(results.tables().trim_end());
    if let Some(path) = &args.json {
        write(path, &json(&results.rows())?)?;
    }
    if let Some(folder) = &args.output {
        std::fs::create_dir_all(folder)
            .with_context(|| format!("cannot make the folder {}", folder.display()))?;
        write(&folder.join("sampling.md"), &results.page())?;
        for (name, plot) in results.plots()? {
            write(&folder.join(name), &plot)?;
        }
    }
    Ok(ExitCode::SUCCESS)
}
