//! `[guides.grow]`: guides made by rule, for fur that needs no artist's curves.

use super::comb::Comb;
use super::entry::Rule;
use super::property::ScalarProperty;
use super::section::section;

section! {
    /// Guides grown by rule: spread over the surface like hairs (so they follow
    /// `roots.density`), leaning from the normal toward the comb direction.
    pub struct Grow {
        /// Number of guides.
        pub count: u32 = 500 => Rule::at_least(1.0),
        /// Chooses where the guides stand, apart from `hair.seed`; whole numbers up
        /// to 2^64 - 1.
        pub seed: u64 = 0 => Rule::at_least(0.0),
        /// Length of a guide, in units of the mesh.
        pub length: ScalarProperty = ScalarProperty::new(1.0) => Rule::at_least(0.0).length().required(),
        /// Segments of a guide; it has one vertex more.
        pub segments: u32 = 8 => Rule::at_least(1.0),
        /// Angle from the normal of the surface toward the comb direction, in
        /// degrees: 0 stands up, 90 lies flat.
        pub lean: ScalarProperty = ScalarProperty::new(0.0) => Rule::between(0.0, 180.0).degrees(),
        /// The direction to lean in. Left out, the tangent along +u.
        pub comb: Option<Comb> = None => Rule::ANY,
        /// A helix around the line of each guide. Excludes `bend`.
        pub curl: Curl = Curl::default() => Rule::ANY,
        /// Guides shaped by curvature and torsion. Excludes `curl`.
        pub bend: Bend = Bend::default() => Rule::ANY,
    }
}

section! {
    /// A helix around the line of a guide.
    pub struct Curl {
        /// Radius, in units of the mesh; 0 is straight.
        pub radius: ScalarProperty = ScalarProperty::new(0.0) => Rule::at_least(0.0).length(),
        /// Turns from root to tip, to the left where negative.
        pub turns: ScalarProperty = ScalarProperty::new(0.0) => Rule::ANY.unit("turns"),
    }
}

section! {
    /// Guides shaped by curvature and torsion along them (document 000): wavy, curly and
    /// coily hair without drawing. A guide leaves its root leaning by `lean`; from there
    /// `dT/ds = κ N`, `dN/ds = τ B - κ T`, with N first toward the comb direction. Where both
    /// are the same all along, the guide is a helix; with `curvature` alone a circle, which
    /// closes at 360.
    pub struct Bend {
        /// How far the guide turns along itself, in degrees over its whole length; negative
        /// away from the comb direction. A ramp gives the rate along the guide.
        pub curvature: ScalarProperty = ScalarProperty::new(0.0) => Rule::ANY.degrees().with_ramp(),
        /// How far the plane it bends in turns about it, in degrees over its whole length;
        /// positive for a right-handed screw. A ramp gives the rate along the guide.
        pub torsion: ScalarProperty = ScalarProperty::new(0.0) => Rule::ANY.degrees().with_ramp(),
        /// How far that plane is turned at the root.
        pub roll: ScalarProperty = ScalarProperty::new(0.0) => Rule::ANY.degrees(),
        /// The part of a full turn by which it is turned at random, guide by guide.
        pub random: ScalarProperty = ScalarProperty::new(0.0) => Rule::between(0.0, 1.0),
    }
}
