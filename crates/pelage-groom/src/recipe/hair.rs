//! `[hair]` and `[display]`: how many hairs.

use super::entry::Rule;
use super::section::section;

section! {
    /// How many hairs grow, and the seed of everything random.
    pub struct Hair {
        /// Number of hairs (document 004: Interpolated_Hair_Count). Raising it
        /// keeps the hairs there are.
        pub count: u64 = 10_000 => Rule::at_least(0.0),
        /// Seed of everything random; whole numbers up to 2^64 - 1.
        pub seed: u64 = 0 => Rule::at_least(0.0),
    }
}

section! {
    /// What a viewport shows.
    pub struct Display {
        /// Number of hairs a viewport shows (document 004: Displayed_Hair_Count,
        /// there at most 10 000). It never changes what is written to a file.
        pub count: u64 = 10_000 => Rule::at_least(0.0),
    }
}
