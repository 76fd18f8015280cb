//! What commands that grow the hairs of a recipe take, or their roots.

use super::{CameraArgs, ThreadArgs, ViewArgs};
use crate::cli::values::{frames, open_range, whole};
use anyhow::{Result, bail};
use clap::{Args, ValueEnum, ValueHint};
use pelage::Recipe;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Which hairs of a recipe, and how.
#[derive(Clone, Debug, Args)]
pub struct RunArgs {
    /// Only the hairs A to B - 1 of those; either end may be left out.
    #[arg(long, value_parser = open_range, value_name = "A..B")]
    pub range: Option<(Option<u64>, Option<u64>)>,
    /// The frame whose posed surface to use.
    #[arg(long, value_name = "F", allow_negative_numbers = true)]
    pub frame: Option<i64>,
    /// Seed to use instead of the recipe's hair.seed.
    #[arg(long)]
    pub seed: Option<u64>,
    /// The order in which hairs come; each is the same in any.
    #[arg(long, value_enum, default_value_t, value_name = "ORDER")]
    pub order: HairOrder,
    #[command(flatten)]
    pub threads: ThreadArgs,
}

/// The order in which hairs come.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum HairOrder {
    /// By their numbers; along the surface where nothing is written.
    #[default]
    Auto,
    /// By their numbers: the first of them are a thinner coat.
    Index,
    /// Neighbours after each other: faster to make, and nearer together in files and renderers.
    Surface,
}

impl From<HairOrder> for pelage::Order {
    fn from(order: HairOrder) -> Self {
        match order {
            HairOrder::Auto => Self::Auto,
            HairOrder::Index => Self::Index,
            HairOrder::Surface => Self::Surface,
        }
    }
}

impl RunArgs {
    /// The recipe in the file `path` with what was asked for: `count` hairs, and the seed.
    pub fn recipe(&self, path: &Path, count: Option<u64>) -> Result<Recipe> {
        let mut recipe = Recipe::load(path)?;
        recipe.hair.count = count.unwrap_or(recipe.hair.count);
        recipe.hair.seed = self.seed.unwrap_or(recipe.hair.seed);
        Ok(recipe)
    }

    /// The hairs A..B of `count`; `raise` says how to get more.
    pub fn hairs(&self, count: u64, raise: &str) -> Result<Range<u64>> {
        let (first, end) = self.range.unwrap_or((None, None));
        let (first, end) = (first.unwrap_or(0), end.unwrap_or(count));
        if first > end {
            bail!("--range {first}..{end}: the first hair comes after the end");
        }
        if end > count {
            bail!(
                "--range {first}..{end}: there are only {count} hairs; raise {raise} or hair.count"
            );
        }
        Ok(first..end)
    }
}

/// `pelage generate`.
#[derive(Debug, Args)]
#[command(after_help = GENERATE_EXAMPLES)]
pub struct GenerateArgs {
    /// The recipe.
    #[arg(value_hint = ValueHint::FilePath)]
    pub recipe: PathBuf,
    /// Where the hairs go: .usdc, .usda, .npz, .rib, or `null` for nowhere.
    #[arg(long, short, value_hint = ValueHint::FilePath, value_name = "FILE")]
    pub output: PathBuf,
    /// Hairs to make instead of the recipe's hair.count; the first N are the same.
    #[arg(long, value_parser = whole, value_name = "N")]
    pub count: Option<u64>,
    #[command(flatten)]
    pub run: RunArgs,
    /// All frames from A to B into one file (for .rib: one file each).
    #[arg(
        long,
        value_parser = frames,
        value_name = "A-B",
        allow_hyphen_values = true,
        conflicts_with = "frame"
    )]
    pub frames: Option<(i64, i64)>,
    /// Frames a second, for formats that store time.
    #[arg(long, default_value_t = 24.0)]
    pub fps: f64,
    /// Also render a picture of the (first frame's) hair on its surface.
    #[arg(long, value_hint = ValueHint::FilePath, value_name = "PNG")]
    pub picture: Option<PathBuf>,
    /// Write counts, times by stage and cost a hair as JSON; `-` prints them, and nothing else,
    /// to standard output.
    #[arg(long, value_hint = ValueHint::FilePath, value_name = "JSON")]
    pub stats: Option<PathBuf>,
    /// Write curve normals to USD and RIB: readers then draw flat ribbons, not tubes.
    #[arg(long)]
    pub ribbons: bool,
    #[command(flatten)]
    pub view: ViewArgs,
}

const GENERATE_EXAMPLES: &str = "\
Examples:
  pelage generate groom.toml -o hair.usdc
  pelage generate groom.toml -o hair.npz --count 1000
  pelage generate groom.toml -o part.npz --range 0..500000
  pelage generate groom.toml -o hair.usdc --order surface
  pelage generate groom.toml -o hair.usdc --frames 1-48
  pelage generate groom.toml -o null --picture look.png --stats -";

/// `pelage sample`.
#[derive(Debug, Args)]
#[command(after_help = SAMPLE_EXAMPLES)]
pub struct SampleArgs {
    /// The recipe. Of the files it names, only the mesh, its poses and the maps of
    /// `roots` and `groups` are read.
    #[arg(value_hint = ValueHint::FilePath)]
    pub recipe: PathBuf,
    /// Where the roots go: .npz, .ply (a point cloud), or `null` for nowhere.
    #[arg(long, short, value_hint = ValueHint::FilePath, value_name = "FILE")]
    pub output: PathBuf,
    /// Roots to draw instead of the recipe's hair.count; the first N are the same.
    #[arg(short = 'n', long, value_parser = whole, value_name = "N")]
    pub count: Option<u64>,
    #[command(flatten)]
    pub run: RunArgs,
    /// Also render a picture of the surface.
    #[arg(long, value_hint = ValueHint::FilePath, value_name = "PNG")]
    pub picture: Option<PathBuf>,
    /// What the picture shows on the surface.
    #[arg(
        long,
        value_enum,
        default_value_t,
        value_name = "WHAT",
        requires = "picture"
    )]
    pub show: Shown,
    #[command(flatten)]
    pub camera: CameraArgs,
}

const SAMPLE_EXAMPLES: &str = "\
Examples:
  pelage sample groom.toml -n 1_000_000 -o roots.npz
  pelage sample groom.toml -n 10_000 -o roots.ply
  pelage sample groom.toml -n 7_000 -o null --picture roots.png
  pelage sample groom.toml -o null --picture pieces.png --show pieces";

/// What a picture of `pelage sample` shows on the surface.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum Shown {
    /// roots.density, from pale (0) to dark (the most).
    Density,
    /// The pieces that triangles are cut into, each of one density; where no hair
    /// grows there are none.
    Pieces,
    /// A dot for each root.
    #[default]
    Roots,
}
