//! As many threads as were asked for.

use super::args::{Command, ThreadArgs};
use anyhow::{Result, anyhow};

/// Threads that run at once on this machine.
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, |n| n.get())
}

/// Lets `command` work with no more threads than it was given, whatever it does: reading files
/// and preparing maps too.
pub fn limit(command: &Command) -> Result<()> {
    let threads = match command {
        Command::Demo(args) => args.threads,
        Command::Generate(args) => args.run.threads,
        Command::Sample(args) => args.run.threads,
        Command::Render(args) => args.threads,
        Command::Fit(args) => args.threads,
        Command::Gallery(args) => args.threads,
        _ => ThreadArgs::default(),
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.count());
    pool.build_global()
        .map_err(|error| anyhow!("--threads {}: {error}; ask for fewer", threads.count()))
}
