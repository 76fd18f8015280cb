//! `pelage init`: an example groom to start from.

use super::args::InitArgs;
use super::say::Say;
use anyhow::{Context, Result, bail};
use std::process::ExitCode;

/// Writes an example.
pub fn run(args: &InitArgs, say: &Say) -> Result<ExitCode> {
    let recipe = args.folder.join("groom.toml");
    if recipe.exists() && !args.force {
        bail!(
            "{}: there is a groom already; choose another folder or pass --force",
            recipe.display()
        );
    }
    // The parser has let through known names only.
    let example = pelage::examples::example(&args.example).context("no such example")?;
    let written = pelage::examples::write(&example, &args.folder)
        .with_context(|| format!("cannot write the example into {}", args.folder.display()))?;
    say.line(format_args!("{}: {}", example.name, example.summary));
    for path in &written {
        say.line(format_args!("  {}", path.display()));
    }
    let folder = args.folder.display();
    say.line("Next:");
    say.line(format_args!(
        "  pelage generate {folder}/groom.toml -o {folder}/hair.usdc --picture {folder}/hair.png"
    ));
    if let Some((curves, _)) = &example.curves {
        say.line(format_args!(
            "  pelage tube {folder}/{curves} -o {folder}/swept.glb --caps round"
        ));
    }
    Ok(ExitCode::SUCCESS)
}
