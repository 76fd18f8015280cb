//! `[cut]` and `[scale]`: how long hairs are.

use super::entry::Rule;
use super::property::ScalarProperty;
use super::section::section;

section! {
    /// Hairs cut off: what is beyond t = `length` goes, and what stays keeps its place.
    pub struct Cut {
        /// The part of a hair that stays (document 004: Cut_Map): 1 all of it, 0
        /// removes the hair.
        pub length: ScalarProperty = ScalarProperty::new(1.0) => Rule::between(0.0, 1.0),
    }
}

section! {
    /// Hairs scaled about their roots: `p *= amount · (1 - random · ξ)`.
    pub struct Scale {
        /// Factor of the length (document 004: Scale).
        pub amount: ScalarProperty = ScalarProperty::new(1.0) => Rule::at_least(0.0),
        /// How much shorter hairs may be at random (document 004: Random_Scale): 0
        /// none, 1 down to nothing.
        pub random: ScalarProperty = ScalarProperty::new(0.0) => Rule::between(0.0, 1.0),
    }
}
