//! Cut: hairs that end before their tip.
//!
//! Source: document 004, section 2.2.8: a hair cut at c ends at C(c), where t is i /
//! segments at vertex i; the vertices behind are not kept, and what stays keeps its
//! place, colour and width (its t). The last two pieces bend a little otherwise than
//! before, since they end elsewhere. Cutting does not depend on where the hair is, so it
//! is done in local space; how many vertices are left depends on the map alone, so it is
//! the same in all frames.

use pelage_curves::{Vec3, catmull_rom};

/// How many of the `vertices` of a hair cut at `cut` in 0..=1 are left.
pub fn kept(vertices: usize, cut: f32) -> usize {
    catmull_rom::kept(vertices, cut)
}

/// Puts the new last vertex of a hair of all its vertices where a cut at `cut` ends it.
pub fn cut(cut: f32, hair: &mut [Vec3]) {
    if let Some((kept, end)) = catmull_rom::cut(hair, cut) {
        hair[kept - 1] = end;
    }
}
