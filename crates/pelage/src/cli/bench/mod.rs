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
use super::say::Say;
use anyhow::{Context, Result};
use pelage::io::AtomicFile;
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;

/// Measures, prints the tables and writes what was asked for.
pub fn run(args: &BenchArgs, say: &Say) -> Result<ExitCode> {
    let results = sampling::run(args.quick, say);
    say.line(results.tables().trim_end());
    if let Some(path) = &args.json {
        let mut text = serde_json::to_string_pretty(&results.rows())?;
        text.push('\n');
        write(path, &text)?;
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

fn write(path: &Path, text: &str) -> Result<()> {
    let write = || {
        let mut file = AtomicFile::create(path)?;
        file.write_all(text.as_bytes())?;
        file.commit()
    };
    write().with_context(|| format!("cannot write {}", path.display()))
}
