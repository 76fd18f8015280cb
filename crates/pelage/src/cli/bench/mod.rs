//! `pelage bench`: figures of the results, measured again on the machine at hand.

mod bars;
mod cost;
mod curves;
mod distance;
mod generation;
mod maps;
mod measure;
mod methods;
mod order;
mod picks;
mod python;
mod sampling;
mod scenes;
mod surfaces;

use super::args::{Bench, BenchArgs};
use super::files::write;
use super::say::Say;
use super::threads::cores;
use anyhow::{Context, Result};
use std::process::ExitCode;

/// What was measured, ready to be printed and written.
pub struct Findings {
    /// The tables as Markdown.
    pub tables: String,
    /// The measurements as JSON.
    pub data: String,
    /// Files for the folder of results: their names and what they hold.
    pub files: Vec<(&'static str, String)>,
}

/// Measures, prints the tables and writes what was asked for.
pub fn run(args: &BenchArgs, say: &Say) -> Result<ExitCode> {
    let found = match args.what {
        Bench::Sampling => sampling::run(args.quick, say)?.findings()?,
        Bench::Curves => curves::run(args.quick, say)?.findings()?,
        Bench::Generation => generation::run(args.quick, say)?.findings()?,
    };
    say.line(found.tables.trim_end());
    if let Some(path) = &args.json {
        write(path, &found.data)?;
    }
    if let Some(folder) = &args.output {
        std::fs::create_dir_all(folder)
            .with_context(|| format!("cannot make the folder {}", folder.display()))?;
        for (name, text) in &found.files {
            write(&folder.join(name), text)?;
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// The machine, and how busy it is with other work, where the system tells.
fn machine() -> String {
    let cores = cores();
    let mut text = format!("{}, {cores} cores", std::env::consts::ARCH);
    let line_of = |path: &str, start: &str| {
        let all = std::fs::read_to_string(path).unwrap_or_default();
        let line = all.lines().find(|line| line.starts_with(start));
        line.map(str::to_owned)
    };
    let model = line_of("/proc/cpuinfo", "model name");
    if let Some((_, model)) = model.as_deref().and_then(|line| line.split_once(':')) {
        text += &format!(" of {}", model.trim());
    }
    let load = line_of("/proc/loadavg", "");
    if let Some(load) = load.as_deref().and_then(|line| line.split(' ').next()) {
        text += &format!(", at a load of {load} before it began");
    }
    text
}
