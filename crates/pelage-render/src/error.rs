//! Why no picture came out.

use std::path::PathBuf;

/// A picture could not be made or written.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// A setting outside its range; the caller's fault.
    #[error("{name} is {found}; it must be {allowed}")]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// What was found, as text.
        found: String,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// An array of a strand buffer or mesh whose length does not match; the
    /// caller's fault.
    #[error("{array} has {found} entries, not {expected}")]
    WrongCount {
        /// Which array.
        array: &'static str,
        /// Entries found.
        found: usize,
        /// Entries expected.
        expected: usize,
    },
    /// Indices that point outside their array; the caller's fault.
    #[error("{array} points outside its array at entry {entry}")]
    OutOfRange {
        /// Which array holds the index.
        array: &'static str,
        /// Where in it.
        entry: usize,
    },
    /// More curve vertices than 32-bit indices can tell apart.
    #[error("the strands need {found} vertices once cut for rendering; at most {limit} fit")]
    TooLarge {
        /// Vertices needed.
        found: u64,
        /// Vertices allowed.
        limit: u64,
    },
    /// The machine would not start the threads asked for.
    #[error("cannot start {threads} threads: {reason}")]
    Threads {
        /// Threads asked for.
        threads: usize,
        /// What the system said.
        reason: String,
    },
    /// The picture could not be encoded or written.
    #[error("cannot write {}: {reason}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What went wrong.
        reason: String,
    },
}

impl RenderError {
    /// A setting `name` that is `found` but must be `allowed`.
    pub(crate) fn setting(name: &'static str, found: impl ToString, allowed: &'static str) -> Self {
        Self::Setting {
            name,
            found: found.to_string(),
            allowed,
        }
    }
}
