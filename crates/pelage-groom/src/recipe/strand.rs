//! `[strand]`: each hair a bundle of fibres (document 004, 2.2.7).

use super::entry::Rule;
use super::property::ScalarProperty;
use super::section::section;

section! {
    /// Each hair a bundle of fibres around it (document 004, 2.2.7): with the normal N and
    /// the binormal B of the hair at a vertex, and a place (x, y) in the unit disc for each
    /// fibre, `p += splay (x' N + aspect y' B) + offset t³ N`, where (x', y') is (x, y) turned
    /// by `twist · t`; then the fibre is scaled about the root by `1 - randomize · ξ`.
    pub struct Strand {
        /// Fibres a hair (document 004: Multi_Strand_Count); 0 leaves hairs single.
        pub count: u32 = 0 => Rule::at_least(0.0),
        /// Angle by which the bundle turns from root to tip, in degrees (document
        /// 004: Twist).
        pub twist: ScalarProperty = ScalarProperty::new(0.0) => Rule::ANY.degrees(),
        /// Extent of the bundle along the binormal over that along the normal
        /// (document 004: Aspect).
        pub aspect: ScalarProperty = ScalarProperty::new(1.0) => Rule::at_least(0.0),
        /// Shift of the tip along the normal, in units of the mesh (document 004:
        /// Offset).
        pub offset: ScalarProperty = ScalarProperty::new(0.0) => Rule::ANY.length(),
        /// How much shorter fibres may be at random (document 004:
        /// Randomize_Strand).
        pub randomize: ScalarProperty = ScalarProperty::new(0.0) => Rule::between(0.0, 1.0),
        /// Distance of fibres from the hair.
        pub splay: Splay = Splay::default() => Rule::ANY,
    }
}

section! {
    /// Largest distance of fibres from the hair, in units of the mesh:
    /// `w · (root before the middle, tip behind it) + (1 - w) · center` with `w = 4 (t - ½)²`.
    pub struct Splay {
        /// Distance at the root (document 004: Root_Splay). A ramp here tells the
        /// whole hair; leave `center` and `tip` out.
        pub root: ScalarProperty = ScalarProperty::new(0.0)
            => Rule::at_least(0.0).length().with_ramp(),
        /// Distance half-way (document 004: Center_Splay).
        pub center: ScalarProperty = ScalarProperty::new(0.0) => Rule::at_least(0.0).length(),
        /// Distance at the tip (document 004: Tip_Splay).
        pub tip: ScalarProperty = ScalarProperty::new(0.0) => Rule::at_least(0.0).length(),
        /// Whether fibres have the length of their hair, as wide or twisted bundles do not.
        pub preserve_length: bool = false => Rule::ANY,
    }
}
