//! `head`: a bust with long parted hair: two groups of guides that never mix.

mod guides;
mod maps;
mod shape;
mod unwrap;

use crate::example::Example;

/// How finely the head is made.
#[derive(Clone, Copy, Debug)]
pub struct Detail {
    /// Cells of the grid the surface is found with, metres.
    pub step: f64,
    /// Texels a side of each map.
    pub texels: usize,
    /// Guides asked for.
    pub guides: usize,
}

impl Detail {
    /// What users get: about 20,000 triangles.
    pub const FULL: Self = Self {
        step: 0.0059,
        texels: 512,
        guides: 320,
    };
}

/// The example.
pub fn example(detail: &Detail) -> Example {
    let bust = shape::bust();
    let model = unwrap::model(&bust, detail.step);
    let maps = maps::maps(&model, detail.texels);
    let guides = guides::guides(&bust, &model, detail.guides);
    Example {
        name: "head",
        summary: "a bust with long hair: a parting from two interpolation groups",
        recipe: include_str!("groom.toml").to_owned(),
        mesh_file: "head.obj",
        mesh: model.polygon_mesh(),
        maps,
        guides: Some(("guides.obj", guides)),
        curves: None,
    }
}

#[cfg(test)]
mod tests;
