//! Checks of the workspace that cargo does not make.
//!
//! `cargo run -p checks` proves that crates depend downwards only (ARCHITECTURE.md) and
//! that every dependency has a licence that a program under MIT or Apache-2.0 may use.

mod layers;
mod licences;
mod metadata;

use anyhow::{Result, bail};

fn main() -> Result<()> {
    let metadata = metadata::read()?;
    let mut problems = layers::problems(&metadata);
    problems.extend(licences::problems(&metadata));
    if problems.is_empty() {
        println!(
            "layers and licences of {} packages are right",
            metadata.packages.len()
        );
        return Ok(());
    }
    problems.iter().for_each(|problem| eprintln!("{problem}"));
    bail!("{} problems", problems.len())
}
