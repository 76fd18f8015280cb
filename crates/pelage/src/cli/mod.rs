//! The command line: arguments in, words and exit codes out.
//!
//! Exit codes: 0 done; 1 something failed, said in words on standard error; 2 the
//! command line itself is wrong; 3 `inspect` found something wrong with a file, or strands
//! of `fit` miss the bound.

mod analyze;
mod args;
mod bench;
mod curves;
mod demo;
mod files;
mod fit;
mod gallery;
mod generate;
mod import;
mod init;
mod inspect;
mod pages;
mod picture;
mod plot;
mod progress;
mod sample;
mod say;
mod space;
mod stats;
mod threads;
mod tube;
mod values;

use anyhow::Result;
use args::{Cli, Command};
use clap::Parser;
use say::Say;
use std::process::ExitCode;

/// `inspect` found faults.
const FAULTS_FOUND: u8 = 3;

/// Runs the command that the process was started with.
pub fn run() -> ExitCode {
    let cli = Cli::parse();
    let say = Say::new(cli.quiet);
    let limited = threads::limit(&cli.command);
    let done = limited.and_then(|()| perform(cli.command, &say));
    match done {
        Ok(code) => code,
        Err(error) => {
            say.error(&error);
            ExitCode::FAILURE
        }
    }
}

fn perform(command: Command, say: &Say) -> Result<ExitCode> {
    match command {
        Command::Demo(args) => demo::run(&args, say),
        Command::Init(args) => init::run(&args, say),
        Command::Generate(args) => generate::run(&args, say),
        Command::Sample(args) => sample::run(&args, say),
        Command::Render(args) => picture::run(&args, say),
        Command::Inspect(args) => inspect::run(&args, say),
        Command::Analyze(args) => analyze::run(&args, say),
        Command::Fit(args) => fit::run(&args, say),
        Command::Tube(args) => tube::run(&args, say),
        Command::Bench(args) => bench::run(&args, say),
        Command::Gallery(args) => gallery::run(&args, say),
        Command::Schema { markdown } => pages::schema(markdown),
        Command::Import(args) => import::run(&args, say),
        Command::Completions { shell } => pages::completions(shell),
        Command::Man { folder } => pages::man(folder.as_deref(), say),
    }
}
