//! `[flyaway]`: hairs that stray.

use super::entry::Rule;
use super::property::ScalarProperty;
use super::section::section;

section! {
    /// Hairs that stray from the others, each its own way, and keep their length: those with
    /// `ξ < percent / 100`, by `p += strength · length · t² · d`, where d is a unit vector
    /// drawn for the hair, away from the skin.
    pub struct Flyaway {
        /// How many hairs do, in per cent.
        pub percent: ScalarProperty = ScalarProperty::new(0.0)
            => Rule::between(0.0, 100.0).unit("per cent"),
        /// How far their tips stray, in lengths of the hair. By as much, at most wholly,
        /// they leave their clump.
        pub strength: ScalarProperty = ScalarProperty::new(0.5) => Rule::at_least(0.0),
    }
}
