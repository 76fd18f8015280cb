//! `animal`: a fox cub whose fur is combed, coloured and cut by maps.

mod guides;
mod maps;
mod pattern;
mod pelt;
mod regions;
mod shape;

use crate::example::Example;
use crate::sdf::Solid;
use shape::Part;

/// How finely the animal is made; tests use less than [`Detail::FULL`].
#[derive(Clone, Copy, Debug)]
pub struct Detail {
    /// Cells of the grid the surface is found with.
    pub step: f64,
    /// Texels a side of each map.
    pub texels: usize,
    /// Guides asked for.
    pub guides: usize,
}

impl Detail {
    /// What users get: about 40,000 triangles.
    pub const FULL: Self = Self {
        step: 0.0105,
        texels: 1024,
        guides: 1400,
    };
}

/// The example.
pub fn example(detail: &Detail) -> Example {
    let body: Solid<Part> = shape::body();
    let model = pelt::model(&body, detail.step);
    let maps = maps::maps(&body, &model, detail.texels);
    let guides = guides::guides(&body, &model, detail.guides);
    Example {
        name: "animal",
        summary: "a fox cub: combed guides, maps for density, length and colour",
        recipe: include_str!("groom.toml").to_owned(),
        mesh_file: "animal.obj",
        mesh: model.polygon_mesh(),
        maps,
        guides: Some(("guides.obj", guides)),
        curves: None,
    }
}

#[cfg(test)]
mod tests;
