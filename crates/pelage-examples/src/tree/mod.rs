//! `tree`: branches grown by rule and swept to a mesh, with leaves that are hairs.

mod branches;
mod sweep;

use crate::example::Example;
use crate::raster::{image, quantised};
use branches::LEVELS;
use pelage_surface::ImageMap;

/// Texels of the density map across, and a level's part of them.
const TEXELS: u32 = 64;

/// The example.
pub fn example() -> Example {
    let branches = branches::grow();
    Example {
        name: "tree",
        summary: "a tree: branches as curves with widths, swept to a mesh, and leaves",
        recipe: include_str!("groom.toml").to_owned(),
        mesh_file: "tree.obj",
        mesh: sweep::mesh(&branches),
        maps: vec![("density.png", density())],
        guides: None,
        curves: Some(("branches.usda", sweep::curves(&branches))),
    }
}

/// Leaves stand on the two thinnest levels: each level has its part of the map across.
fn density() -> ImageMap {
    let texel = |i: u32| {
        let column = i % TEXELS;
        let level = column * LEVELS as u32 / TEXELS;
        let leafy = [0.0, 0.0, 0.25, 1.0][level as usize];
        // Not at the foot of a twig, which is the lower end of the map.
        let foot = (i / TEXELS) * 8 > TEXELS * 7;
        quantised(if foot { 0.0 } else { leafy })
    };
    let texels = (0..TEXELS * TEXELS).map(texel).collect();
    image(TEXELS, TEXELS, 1, texels)
}
