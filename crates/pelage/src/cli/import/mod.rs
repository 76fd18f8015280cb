//! `pelage import`: a recipe from the parameters of another hair generator.
//!
//! What is known of a name for certain becomes a key of the recipe; all else is told with
//! its line and the reason, and never guessed.

mod dialect;
mod recipe;
mod settings;
mod shave;
mod stubble;
#[cfg(test)]
mod tests;

use super::args::ImportArgs;
use super::files::write;
use super::say::Say;
use anyhow::{Context, Result, bail};
pub use dialect::Dialect;
use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::process::ExitCode;

/// Largest file that is read: scenes keep the vertices of their guides as text.
const MOST_BYTES: u64 = 256 << 20;

/// Writes the recipe and tells what is not in it.
pub fn run(args: &ImportArgs, say: &Say) -> Result<ExitCode> {
    if args.output.exists() && !args.force {
        bail!(
            "{}: there is a file already; choose another name or pass --force",
            args.output.display()
        );
    }
    let text = read(&args.file, MOST_BYTES)?;
    let name = args.file.file_name().unwrap_or_default().to_string_lossy();
    let imported = import(&text, args.from, &name)
        .with_context(|| format!("cannot import {}", args.file.display()))?;
    write(&args.output, &imported.toml)?;
    for left in &imported.left_out {
        say.note(format_args!("{}:{left}", args.file.display()));
    }
    say.line(format_args!(
        "{}: {} properties, {} not mapped; name the mesh and the guides in it",
        args.output.display(),
        imported.mapped,
        imported.left_out.len(),
    ));
    Ok(ExitCode::SUCCESS)
}

/// A file's text. Scenes may be in any encoding; names and numbers are ASCII in all.
fn read(path: &Path, most: u64) -> Result<String> {
    let cannot = || format!("cannot read {}", path.display());
    let file = File::open(path).with_context(cannot)?;
    let mut bytes = Vec::new();
    let read = file.take(most + 1).read_to_end(&mut bytes);
    read.with_context(cannot)?;
    if bytes.len() as u64 > most {
        bail!("{}: more than {} MB", path.display(), most >> 20);
    }
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// A recipe made of another program's parameters.
#[derive(Debug)]
struct Imported {
    toml: String,
    /// Properties that the recipe has.
    mapped: usize,
    /// What it has not, and why.
    left_out: Vec<recipe::LeftOut>,
}

/// The recipe of `text`, which came from the file `name`.
fn import(text: &str, from: Dialect, name: &str) -> Result<Imported> {
    let settings = settings::settings(text, |kind| dialect::is_hair(from, kind));
    let imported = recipe::write(&settings, from, name)?;
    if imported.mapped == 0 && imported.left_out.iter().all(|left| !left.known) {
        bail!(
            "no line sets a property of {from}; \
             expected lines such as `setAttr \".{example}\" 5;` or `{example} = 5`",
            example = dialect::example(from),
        );
    }
    Ok(imported)
}
