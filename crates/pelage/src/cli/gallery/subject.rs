//! What the pictures of the gallery show: grooms made by code, each with its camera.

use anyhow::{Context, Result};
use pelage::groom::recipe::{Strip, Subject};
use pelage::groom::{Groom, Images};
use pelage::render::Camera;
use pelage::surface::{ImageMap, PolygonMesh, hash};
use pelage::{Plan, Recipe};
use std::path::Path;
use std::sync::Arc;

/// Texels of a map along a side.
const MAP_SIZE: u32 = 256;

/// What all subjects have.
const HAIR: &[(&str, &str)] = &[
    ("surface.mesh", "'made.obj'"),
    ("guides.grow.seed", "3"),
    ("hair.seed", "7"),
    ("color.root", "'#4a3020'"),
    ("color.tip", "'#d0a468'"),
    ("color.space", "'oklab'"),
];

const FUR: &[(&str, &str)] = &[
    ("guides.grow.count", "400"),
    ("guides.grow.length", "0.3"),
    ("guides.grow.lean", "35.0"),
    ("guides.grow.comb", "[0.25, -1.0, 0.0]"),
    ("guides.grow.segments", "8"),
    ("hair.count", "9000"),
    ("width.root", "0.012"),
    ("width.tip", "0.002"),
];

const TUFT: &[(&str, &str)] = &[
    ("guides.grow.count", "40"),
    ("guides.grow.length", "0.9"),
    ("guides.grow.lean", "12.0"),
    ("guides.grow.comb", "[1.0, 0.0, 0.3]"),
    ("guides.grow.segments", "16"),
    ("hair.count", "120"),
    ("width.root", "0.012"),
    ("width.tip", "0.003"),
];

const STRANDS: &[(&str, &str)] = &[
    ("guides.grow.count", "40"),
    ("guides.grow.length", "0.9"),
    ("guides.grow.lean", "25.0"),
    ("guides.grow.comb", "[1.0, 0.0, 0.3]"),
    ("guides.grow.segments", "24"),
    ("hair.count", "6"),
    ("roots.pattern", "'blue-noise'"),
    ("strand.count", "20"),
    ("width.root", "0.008"),
    ("width.tip", "0.003"),
];

/// The recipe of `strip` with its property at `value`, as text.
pub fn recipe(strip: &Strip, value: &str) -> String {
    let own = match strip.on {
        Subject::Fur => FUR,
        Subject::Tuft => TUFT,
        Subject::Strands => STRANDS,
    };
    let common = HAIR.iter().chain(own).chain(strip.with);
    let mut lines: Vec<(String, String)> = Vec::new();
    let common = common.map(|(key, value)| (key.to_string(), value.to_string()));
    // What comes later takes the place of what was there.
    for (key, value) in common.chain([strip.line(value)]) {
        match lines.iter_mut().find(|(there, _)| *there == key) {
            Some((_, old)) => *old = value,
            None => lines.push((key, value)),
        }
    }
    let lines = lines
        .iter()
        .map(|(key, value)| format!("{key} = {value}\n"));
    lines.collect()
}

/// The surfaces of all subjects, made once: the ball takes longer than a small picture.
pub struct Surfaces {
    ball: PolygonMesh,
}

impl Surfaces {
    pub fn new() -> Result<Self> {
        let ball = pelage::examples::example("ball").context("the ball is missing")?;
        Ok(Self { ball: ball.mesh })
    }

    /// Compiles the recipe `text` on the surface of `subject`.
    pub fn plan(&self, subject: Subject, text: &str) -> Result<Plan> {
        let recipe = Recipe::parse(text, Path::new("gallery.toml"))?;
        let mut images = Images::new();
        for (_, used) in recipe.maps() {
            let image = map(&used.path.written);
            images.insert(used.path.resolved.clone(), Arc::new(image));
        }
        Ok(Plan::new(Groom {
            mesh: self.of(subject),
            recipe,
            keep_file_normals: true,
            images,
            guides: Vec::new(),
        })?)
    }

    fn of(&self, subject: Subject) -> PolygonMesh {
        match subject {
            Subject::Fur => self.ball.clone(),
            Subject::Tuft | Subject::Strands => {
                PolygonMesh::sheet(4, 4, |u, v| [u - 0.5, 0.0, 0.5 - v])
            }
        }
    }
}

/// The map `name`: a gradient, spots, or patches of flat colours.
fn map(name: &str) -> ImageMap {
    let texel = |x: u32, y: u32| -> [f32; 3] {
        let [u, v] = [x, y].map(|i| (i as f32 + 0.5) / MAP_SIZE as f32);
        match name {
            "gradient.png" => [u; 3],
            "spots.png" => {
                let [x, y] = [u * 12.0, v * 6.0].map(|x| x - x.floor() - 0.5);
                [if x * x + y * y < 0.1 { 1.0 } else { 0.05 }; 3]
            }
            _ => {
                let patch = hash((u * 16.0) as u64 * 64 + (v * 8.0) as u64);
                [0, 1, 2].map(|k| (64 + (patch >> (8 * k)) % 192) as f32 / 255.0)
            }
        }
    };
    let texels = (0..MAP_SIZE * MAP_SIZE).flat_map(|i| texel(i % MAP_SIZE, i / MAP_SIZE));
    // As many finite texels as the size says.
    ImageMap::new(MAP_SIZE, MAP_SIZE, 3, texels.collect::<Vec<f32>>(), true)
        .expect("a map is a map")
}

/// From where `subject` is seen, the same in all pictures.
pub fn camera(subject: Subject) -> Camera {
    let (from, to, fov) = match subject {
        Subject::Fur => ([2.2, 1.4, 4.2], [0.0, 0.0, 0.0], 33.0),
        Subject::Tuft | Subject::Strands => ([1.0, 1.5, 3.4], [0.16, 0.42, 0.0], 26.0),
    };
    Camera {
        from,
        to,
        up: [0.0, 1.0, 0.0],
        fov,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pelage::groom::recipe::STRIPS;

    #[test]
    fn the_recipe_of_every_picture_is_right() {
        for strip in STRIPS {
            for value in strip.values {
                let text = recipe(strip, value);
                let read = Recipe::parse(&text, Path::new("gallery.toml"));
                assert!(read.is_ok(), "{text}\n{}", read.unwrap_err());
            }
        }
    }
}
