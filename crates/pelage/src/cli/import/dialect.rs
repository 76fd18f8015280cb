//! What the names of another hair generator mean here.

use super::{shave, stubble};
use clap::ValueEnum;
use std::fmt::{Display, Formatter};

/// A program whose parameters can be imported.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Dialect {
    /// Shave and a Haircut.
    Shave,
    /// Stubble, the generator of document 004.
    Stubble,
}

impl Display for Dialect {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Dialect::Shave => "Shave and a Haircut",
            Dialect::Stubble => "Stubble",
        })
    }
}

/// What is known of a name.
#[derive(Clone, Debug, PartialEq)]
pub enum Meaning {
    /// It is a key of ours; `frizz.frequency[0]` is the first of three.
    Key(String, Unit),
    /// It is about the same as a key of ours, but what its numbers are is not known.
    Unsure(&'static str, &'static str),
    /// There is nothing like it here, and why.
    Without(&'static str),
}

/// How the numbers of a name become those of a key.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Unit {
    /// As they are.
    Same,
    /// Radians that become degrees.
    Radians,
}

/// What `name` means in `from`; `None` where it is not known to be a name of it.
pub fn meaning(from: Dialect, name: &str) -> Option<Meaning> {
    match from {
        Dialect::Shave => shave::meaning(name),
        Dialect::Stubble => stubble::meaning(name),
    }
}

/// Whether nodes of a scene of the type `kind` hold the hair of `from`.
pub fn is_hair(from: Dialect, kind: &str) -> bool {
    let kind = kind.to_ascii_lowercase();
    match from {
        Dialect::Shave => kind.starts_with("shavehair"),
        Dialect::Stubble => kind.contains("hairshape") || kind.contains("stubble"),
    }
}

/// The name that `from` has for the number of hairs.
pub fn example(from: Dialect) -> &'static str {
    match from {
        Dialect::Shave => "hairCount",
        Dialect::Stubble => "interpolated_hair_count",
    }
}
