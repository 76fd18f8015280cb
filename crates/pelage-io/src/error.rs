//! What can go wrong when reading a file, and whose fault it is.

use std::fmt;
use std::path::{Path, PathBuf};

/// Whose fault an error is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blame {
    /// The world: the file is missing, a folder, unreadable.
    World,
    /// The file: its contents break the rules of its format.
    File,
    /// Ours: the file may be right, but uses what we do not read.
    Unsupported,
    /// A limit: counts larger than the file or the machine can hold.
    Limit,
}

/// A file could not be read.
///
/// Prints as `FILE: PLACE: what was found; what to do`.
#[derive(Debug)]
pub struct ReadError {
    /// The file.
    pub path: PathBuf,
    /// Whose fault it is.
    pub blame: Blame,
    /// Where in the file: "line 12", "byte 128", "/World/hair.points".
    pub place: Option<String>,
    /// What was found and what is allowed.
    pub message: String,
    /// What to do about it, where we know.
    pub help: Option<String>,
}

impl ReadError {
    /// An error of `path` that is `blame`'s fault.
    pub fn new(path: &Path, blame: Blame, message: impl Into<String>) -> Self {
        Self {
            path: path.into(),
            blame,
            place: None,
            message: message.into(),
            help: None,
        }
    }

    /// The operating system would not let us read `path`.
    pub fn world(path: &Path, error: &std::io::Error) -> Self {
        Self::new(path, Blame::World, error.to_string())
    }

    /// The contents of `path` break the rules of its format.
    pub fn file(path: &Path, message: impl Into<String>) -> Self {
        Self::new(path, Blame::File, message)
    }

    /// `path` uses something that we do not read.
    pub fn unsupported(path: &Path, message: impl Into<String>) -> Self {
        Self::new(path, Blame::Unsupported, message)
    }

    /// Adds where in the file.
    pub fn at(mut self, place: impl Into<String>) -> Self {
        self.place = Some(place.into());
        self
    }

    /// Adds what to do about it.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.path.display())?;
        if let Some(place) = &self.place {
            write!(f, "{place}: ")?;
        }
        f.write_str(&self.message)?;
        if let Some(help) = &self.help {
            write!(f, "; {help}")?;
        }
        Ok(())
    }
}

impl std::error::Error for ReadError {}
