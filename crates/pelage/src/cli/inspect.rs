//! `pelage inspect`: what files hold, and what is wrong with them.

use super::FAULTS_FOUND;
use super::args::InspectArgs;
use super::say::Say;
use anyhow::Result;
use pelage::io::{Inspection, inspect};
use std::process::ExitCode;

/// Looks into every file; one that cannot be read does not keep the others from it.
pub fn run(args: &InspectArgs, say: &Say) -> Result<ExitCode> {
    let mut found: Vec<Inspection> = Vec::new();
    let mut unreadable = false;
    for path in &args.files {
        match inspect(path) {
            Ok(inspection) => found.push(inspection),
            Err(error) => {
                unreadable = true;
                say.error(&error.into());
            }
        }
    }
    if args.json {
        say.line(serde_json::to_string_pretty(&found)?);
    } else {
        found.iter().for_each(|inspection| say.line(inspection));
    }
    Ok(match found.iter().all(Inspection::is_sound) {
        _ if unreadable => ExitCode::FAILURE,
        true => ExitCode::SUCCESS,
        false => ExitCode::from(FAULTS_FOUND),
    })
}
