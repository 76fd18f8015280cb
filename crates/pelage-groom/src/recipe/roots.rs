//! `[roots]`: where hairs stand.

use super::entry::Rule;
use super::property::ScalarProperty;
use super::section::section;
use super::word::words;

words! {
    /// How roots are spread where the density is even.
    pub enum Pattern {
        /// Elements of a sequence each prefix of which is well spread; any number.
        Stratified = "stratified",
        /// Each by itself, as dice fall: clumps and gaps.
        Random = "random",
        /// Roots that keep their distance, at every prefix. Made ahead and kept in
        /// memory: a second or two and 16 MB a million.
        BlueNoise = "blue-noise",
    }
}

section! {
    /// Where hairs stand.
    pub struct Roots {
        /// Relative density of hairs over the rest surface (document 004:
        /// Density_Map). Only ratios matter: the number of hairs is `hair.count`.
        pub density: ScalarProperty = ScalarProperty::new(1.0) => Rule::at_least(0.0),
        /// How roots are spread where the density is even.
        pub pattern: Pattern = Pattern::Stratified => Rule::ANY,
        /// How far roots move along the normal of the posed mesh, in units of the
        /// mesh: the displacement of the skin's shader. Where hairs grow is not
        /// changed by it.
        pub displacement: ScalarProperty = ScalarProperty::new(0.0) => Rule::ANY.length(),
    }
}
