//! `[interpolation]`: how guides shape the hairs between them.

use super::entry::Rule;
use super::facing::Facing;
use super::section::section;
use super::word::words;

words! {
    /// How guides share a hair among them.
    pub enum Method {
        /// Shepard weights of the nearest guides (document 004, 2.2.4).
        InverseDistance = "inverse-distance",
        /// The nearest guide alone.
        Nearest = "nearest",
        /// Natural neighbours: Sibson's weights over the surface, of all the
        /// guides around a root, however many.
        NaturalNeighbor = "natural-neighbor",
    }
}

words! {
    /// What of the guides is interpolated.
    pub enum InterpolationSpace {
        /// The vertices, in the local frame of the root.
        Vertices = "vertices",
        /// Curvature and torsion along the strand (document 000, 4.3): curls stay
        /// curls between guides whose curls differ in phase.
        Frenet = "frenet",
        /// Lengths, twists and curvatures of Super-Helices fitted to the guides (document
        /// 002): curls stay curls, and what is finer than an element is left out.
        Helix = "helix",
    }
}

section! {
    /// How guides shape the hairs between them: with d the distance of a guide's root at rest
    /// and r that of the nearest guide that is not taken, a guide weighs `((r - d) / (r d))²`
    /// (document 004, 2.2.4), and the hair is the weighted mean of its guides.
    pub struct Interpolation {
        /// Number of guides that shape a hair (document 004:
        /// Interpolation_Samples); a group with fewer uses all it has.
        pub guides: u32 = 3 => Rule::at_least(1.0),
        /// How guides share a hair among them.
        pub method: Method = Method::InverseDistance => Rule::ANY,
        /// What of the guides is interpolated.
        pub space: InterpolationSpace = InterpolationSpace::Vertices => Rule::ANY,
        /// Elements of the Super-Helix that stands for a guide in helix space, of equal
        /// length; never more than the hair has segments. More follow finer detail.
        pub elements: u32 = 8 => Rule::between(1.0, 100.0),
        /// Whether guides that point away from the surface count less: false,
        /// true, or { exponent = a } (document 000, eq. 49).
        pub facing: Facing = Facing::Off => Facing::RULE,
    }
}
