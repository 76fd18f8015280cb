//! What is printed from the command's own definition: schema, completions, manual.

use super::args::Cli;
use super::say::Say;
use anyhow::{Context, Result};
use clap::CommandFactory;
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;

/// Prints the JSON Schema of `groom.toml`, or the page that explains its keys.
pub fn schema(markdown: bool) -> Result<ExitCode> {
    let text = match markdown {
        true => pelage::groom::recipe::properties_text(),
        false => pelage::groom::recipe::schema_text(),
    };
    print(text.as_bytes())
}

/// Prints a completion script.
pub fn completions(shell: clap_complete::Shell) -> Result<ExitCode> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "pelage", &mut script);
    print(&script)
}

/// Prints the manual page, or writes the pages of all commands into `folder`.
pub fn man(folder: Option<&Path>, say: &Say) -> Result<ExitCode> {
    let Some(folder) = folder else {
        let mut page = Vec::new();
        clap_mangen::Man::new(Cli::command()).render(&mut page)?;
        return print(&page);
    };
    let cannot = || format!("cannot write manual pages into {}", folder.display());
    std::fs::create_dir_all(folder).with_context(cannot)?;
    clap_mangen::generate_to(Cli::command(), folder).with_context(cannot)?;
    say.line(format_args!("manual pages are in {}", folder.display()));
    Ok(ExitCode::SUCCESS)
}

fn print(bytes: &[u8]) -> Result<ExitCode> {
    match std::io::stdout().lock().write_all(bytes) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(error.into()),
        _ => Ok(ExitCode::SUCCESS),
    }
}
