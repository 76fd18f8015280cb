//! `[output]` and `[voxels]`: what becomes of finished hairs.

use super::entry::Rule;
use super::section::section;

section! {
    /// What is written of finished hairs.
    pub struct Output {
        /// Cosine of the bend below which a vertex is kept (document 004:
        /// Skip_Threshold): vertices where the hair is straighter are dropped; 1
        /// keeps all.
        pub skip_threshold: f32 = 1.0 => Rule::between(0.0, 1.0),
        /// Whether a normal is written at each vertex (document 004:
        /// CalculateNormals).
        pub normals: bool = true => Rule::ANY,
    }
}

section! {
    /// Caches for rendering, cut into boxes.
    pub struct Voxels {
        /// Boxes along x, y and z (document 004: Voxels_Dimensions). The hair is
        /// the same for any number.
        pub resolution: [u32; 3] = [1, 1, 1] => Rule::at_least(1.0),
    }
}
