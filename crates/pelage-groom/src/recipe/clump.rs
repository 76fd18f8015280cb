//! `[clump]`: hairs drawn together.

use super::entry::Rule;
use super::group_map::GroupMap;
use super::property::ScalarProperty;
use super::section::section;
use super::word::words;

words! {
    /// What clumps form around.
    pub enum ClumpAround {
        /// Points spread evenly over the surface.
        Points = "points",
        /// The roots of the guides.
        Guides = "guides",
        /// The middle of each area of one colour of `map`.
        Map = "map",
    }
}

section! {
    /// Hairs drawn together, as wet or matted hair is.
    pub struct Clump {
        /// Levels of clumps, each drawing hairs to the middles of its own, which the
        /// levels before it have drawn together already: list coarse ones first.
        pub levels: Vec<ClumpLevel> = Vec::new() => Rule::ANY,
    }
}

section! {
    /// A level of clumps: `p += ((1 - t) root + t tip) (1 - random · ξ) (m - p)`, where m is
    /// the point of the hair in the middle of the clump that is as far from its root, and ξ
    /// is drawn for the clump. Which clump a hair belongs to is told by where its root is at
    /// rest, so that it stays when there are more hairs or they stand otherwise.
    pub struct ClumpLevel {
        /// What clumps form around.
        pub around: ClumpAround = ClumpAround::Points => Rule::ANY,
        /// Mean distance between clumps around points, of which there is one on each
        /// `size` × `size` of surface.
        pub size: Option<f32> = None => Rule::above(0.0).length(),
        /// The image whose colours are clumps, read without filtering. Black leaves hairs
        /// free.
        pub map: Option<GroupMap> = None => Rule::ANY,
        /// How far hairs are drawn to the middle of their clump at the root, where 1 is
        /// wholly. The root itself stays on the surface.
        pub root: ScalarProperty = ScalarProperty::new(0.0) => Rule::between(0.0, 1.0).with_ramp(),
        /// How far they are at the tip.
        pub tip: ScalarProperty = ScalarProperty::new(1.0) => Rule::between(0.0, 1.0),
        /// How much less of it clumps may have at random, each as a whole.
        pub random: ScalarProperty = ScalarProperty::new(0.0) => Rule::between(0.0, 1.0),
        /// Whether hairs keep their length, which being drawn aside makes longer.
        pub preserve_length: bool = false => Rule::ANY,
    }
}
