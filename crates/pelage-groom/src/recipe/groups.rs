//! `[groups]`: which guides a hair listens to, and how many segments it has.

use super::entry::Rule;
use super::group_map::GroupMap;
use super::section::section;
use super::segments::Segments;

section! {
    /// Interpolation groups (document 004: InterpolationGroups): a hair listens to
    /// guides of its own group only.
    pub struct Groups {
        /// An image whose colours tell groups apart; it is read without filtering.
        /// Left out, all hairs are one group.
        pub map: Option<GroupMap> = None => Rule::ANY,
        /// Segments of a hair: one number, or one for each colour of `map`. A hair
        /// has one vertex more. Left out, as many as the guide of the group with
        /// the most segments.
        pub segments: Option<Segments> = None => Segments::RULE,
    }
}
