//! What commands about curves take.

use super::{CameraArgs, ThreadArgs};
use crate::cli::values::{ErrorBound, detail, error_bound, not_negative};
use clap::{Args, ValueEnum, ValueHint};
use std::path::PathBuf;

/// `pelage analyze`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  pelage analyze guides.usda -o report\n  \
    pelage analyze hair.npz -o report --strand 42 --steps 64")]
pub struct AnalyzeArgs {
    /// A file of curves: USD, .npz, .hair or OBJ polylines.
    #[arg(value_hint = ValueHint::FilePath)]
    pub file: PathBuf,
    /// Folder for the report: report.md, statistics.json, plots and pictures; it is made where
    /// it is missing.
    #[arg(long, short, value_hint = ValueHint::DirPath)]
    pub output: PathBuf,
    /// The curve to plot and to draw frames of, counted from 0. Left out, the one that bends as much as
    /// half of them.
    #[arg(long, value_name = "N")]
    pub strand: Option<usize>,
    /// Steps of equal length in which each curve is looked at.
    #[arg(long, default_value_t = 32, value_parser = clap::value_parser!(u32).range(2..=4096))]
    pub steps: u32,
    /// The time to look at, where the file has several.
    #[arg(long, value_name = "F")]
    pub frame: Option<f64>,
}

/// `pelage tube`.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  pelage tube branches.usda -o tree.usdc --radius 0.1 --tip-radius 0.01\n  \
    pelage tube hair.npz -o hair.ply --sides 6 --caps round"
)]
pub struct TubeArgs {
    /// A file of curves: USD, .npz, .hair or OBJ polylines.
    #[arg(value_hint = ValueHint::FilePath)]
    pub file: PathBuf,
    /// The mesh: .obj, .ply, .glb, .usda or .usdc.
    #[arg(long, short, value_hint = ValueHint::FilePath)]
    pub output: PathBuf,
    /// Radius at the start of each curve. Left out, half of the file's widths.
    #[arg(long, value_name = "R", value_parser = not_negative)]
    pub radius: Option<f32>,
    /// Radius at the end; left out, that at the start.
    #[arg(long, value_name = "R", requires = "radius", value_parser = not_negative)]
    pub tip_radius: Option<f32>,
    /// Sides of the section, which is a regular polygon with smooth normals.
    #[arg(long, default_value_t = 12, value_parser = clap::value_parser!(u32).range(3..=4096))]
    pub sides: u32,
    /// How the section is kept from turning about the curve.
    #[arg(long, value_enum, default_value_t)]
    pub framing: FramingKind,
    /// How ends are closed.
    #[arg(long, value_enum, default_value_t)]
    pub caps: CapKind,
    /// Bend from ring to ring: fewer degrees are more triangles.
    #[arg(long, value_name = "DEGREES", default_value_t = 6.0, value_parser = detail)]
    pub detail: f32,
    /// The time to take, where the file has several.
    #[arg(long, value_name = "F")]
    pub frame: Option<f64>,
}

/// `pelage fit`.
#[derive(Debug, Args)]
#[command(after_help = FIT_EXAMPLES)]
pub struct FitArgs {
    /// A file of curves: USD, .npz, .hair or OBJ polylines. With --decode, one of fits.
    #[arg(value_hint = ValueHint::FilePath)]
    pub file: PathBuf,
    /// The fits: .json, .npz (the smallest), or .usdc (with the decoded curves
    /// beside the numbers). With --decode, the curves: .usdc, .usda, .npz or .rib.
    #[arg(long, short, value_hint = ValueHint::FilePath, value_name = "FILE")]
    pub output: PathBuf,
    /// Elements of each strand: as near as so many come. An element is a piece of a helix.
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u32).range(1..=10_000),
        conflicts_with = "max_error"
    )]
    pub elements: Option<u32>,
    /// As few elements as keep the error: a length, or a percentage of each strand's length.
    /// Left out, and without --elements, 1%.
    #[arg(long, value_name = "E", value_parser = error_bound)]
    pub max_error: Option<ErrorBound>,
    /// Write the curves of a file of fits again.
    #[arg(long, conflicts_with_all = ["elements", "max_error", "picture", "frame"])]
    pub decode: bool,
    /// Vertices of each decoded strand. Left out, as many as it was fitted with.
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u32).range(2..=1_048_576),
        requires = "decode"
    )]
    pub vertices: Option<u32>,
    /// Also draw the strands, their fits, and these coloured by error, side by side.
    #[arg(long, value_hint = ValueHint::FilePath, value_name = "PNG")]
    pub picture: Option<PathBuf>,
    /// The time to fit, where the file has several.
    #[arg(long, value_name = "F", allow_negative_numbers = true)]
    pub frame: Option<f64>,
    #[command(flatten)]
    pub threads: ThreadArgs,
    #[command(flatten)]
    pub camera: CameraArgs,
}

const FIT_EXAMPLES: &str = "\
Examples:
  pelage fit guides.usda -o guides.json
  pelage fit hair.npz -o fits.npz --max-error 0.5% --picture fits.png
  pelage fit hair.usdc -o fits.usdc --elements 6
  pelage fit --decode fits.json -o hair.usdc

Wherever curves are read (guides of a recipe, `pelage tube`, `pelage render`), fits are
read as the curves that they decode to. Exits with 3 where a strand misses the bound.";

/// How frames go along a curve.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum FramingKind {
    /// As little twist as there can be.
    #[default]
    DoubleReflection,
    /// Each frame turned as the tangent turns.
    Propagated,
    /// Toward where the curve bends; turns over at inflections.
    Frenet,
    /// Upright by +Y; turns over where the curve does.
    UpAxis,
}

/// How the ends of a tube are closed.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum CapKind {
    /// Not at all.
    Open,
    /// By a flat lid.
    #[default]
    Flat,
    /// By half a sphere.
    Round,
}
