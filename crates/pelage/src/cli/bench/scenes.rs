//! Grooms whose generation is measured, made by code: as document 004 has them (4.2.1),
//! with the properties that are there.

use super::maps::map;
use anyhow::{Context, Result};
use pelage::groom::{Groom, Images};
use pelage::{Plan, Recipe};
use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;

/// What no scene changes.
const SURFACE: &str = r#"
surface.mesh = "ball.obj"
guides.grow = { count = 1000, length = 0.3, lean = 40 }
interpolation.guides = 3
frizz.frequency = [2, 2, 2]
kink.frequency = [20, 20, 20]
color.space = "hsv"
"#;

/// Each property with its value, and one of our maps for the scene that has maps. A
/// property that arrives gets its line here.
const PROPERTIES: [(&str, &str, Option<&str>); 16] = [
    ("roots.density", "1.0", Some("noise 512")),
    ("scale.amount", "1.0", Some("noise 8")),
    ("scale.random", "0.3", None),
    ("frizz.root", "0.01", None),
    ("frizz.tip", "0.05", None),
    ("kink.root", "0.0", None),
    ("kink.tip", "0.01", None),
    ("color.root", r##""#3b2a1e""##, Some("noise 64")),
    ("color.tip", r##""#d9b98a""##, None),
    ("color.mutant.percent", "3.0", None),
    ("color.variation.hue", "10.0", None),
    ("color.variation.value", "0.1", None),
    ("opacity.root", "1.0", None),
    ("opacity.tip", "0.6", Some("checkerboard")),
    ("width.root", "0.002", Some("noise 64")),
    ("width.tip", "0.0", None),
];

/// What the scenes of multi-strands have beside, and how many hairs they have fewer.
const STRANDS: &str = "strand.count = 5
strand.splay = { root = 0.002, center = 0.006, tip = 0.004 }
strand.twist = 90
strand.randomize = 0.2
";
const FIBERS: u32 = 5;

/// Segments of the hairs of document 004's tables.
const SEGMENTS: [u32; 2] = [5, 15];

/// A groom to measure.
pub struct Scene {
    pub name: &'static str,
    pub segments: u32,
    /// Fibres of a hair; 1 where hairs are single.
    pub fibers: u32,
    pub plan: Plan,
}

/// All scenes, of `hairs` hairs or as many fibres, with maps of `map_size`² texels.
pub fn scenes(hairs: u64, map_size: u32) -> Result<Vec<Scene>> {
    let kinds = [
        ("plain", None, 1),
        ("five maps", Some(map_size), 1),
        ("strands", None, FIBERS),
    ];
    let all = kinds
        .into_iter()
        .flat_map(|kind| SEGMENTS.map(|segments| (kind, segments)));
    all.map(|((name, maps, fibers), segments)| {
        let plan = plan(hairs / fibers as u64, segments, maps, fibers);
        Ok(Scene {
            name,
            segments,
            fibers,
            plan: plan.with_context(|| format!("the scene {name:?}"))?,
        })
    })
    .collect()
}

fn plan(hairs: u64, segments: u32, map_size: Option<u32>, fibers: u32) -> Result<Plan> {
    let recipe = recipe(hairs, segments, map_size.is_some(), fibers)?;
    let ball = pelage::examples::example("ball").context("the ball is missing")?;
    let mut images = Images::new();
    if let Some(size) = map_size {
        for name in PROPERTIES.iter().filter_map(|(_, _, map)| *map) {
            let image = || Arc::new(map(name, size).image);
            images.entry(name.into()).or_insert_with(image);
        }
    }
    Ok(Plan::new(Groom {
        recipe,
        mesh: ball.mesh,
        keep_file_normals: true,
        images,
        guides: Vec::new(),
    })?)
}

fn recipe(hairs: u64, segments: u32, maps: bool, fibers: u32) -> Result<Recipe> {
    let mut text = format!("{SURFACE}hair.count = {hairs}\ngroups.segments = {segments}\n");
    if fibers > 1 {
        text += STRANDS;
    }
    for (key, value, map) in PROPERTIES {
        // Writing to a String cannot fail.
        let _ = match map.filter(|_| maps) {
            Some(map) => writeln!(text, "{key} = {{ value = {value}, map = {map:?} }}"),
            None => writeln!(text, "{key} = {value}"),
        };
    }
    Ok(Recipe::parse(&text, Path::new("scene.toml"))?)
}
