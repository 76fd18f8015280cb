//! What commands that draw pictures take.

use super::ThreadArgs;
use crate::cli::values::{size, vector};
use clap::{Args, ValueEnum, ValueHint};
use std::path::PathBuf;

/// `pelage render`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  pelage render hair.usdc -o hair.png\n  \
    pelage render hair.usdc -o side.png --surface body.obj --from 3,1,0 --to 0,0.5,0")]
pub struct RenderArgs {
    /// A file of hair: USD, .npz, .hair or OBJ polylines.
    #[arg(value_hint = ValueHint::FilePath)]
    pub file: PathBuf,
    /// The picture, a PNG.
    #[arg(long, short, value_hint = ValueHint::FilePath, value_name = "PNG")]
    pub output: PathBuf,
    /// The mesh under the hair.
    #[arg(long, value_hint = ValueHint::FilePath, value_name = "MESH")]
    pub surface: Option<PathBuf>,
    /// The time to show, where the file has several.
    #[arg(long, value_name = "F", allow_negative_numbers = true)]
    pub frame: Option<f64>,
    #[command(flatten)]
    pub threads: ThreadArgs,
    #[command(flatten)]
    pub view: ViewArgs,
}

/// Camera, quality and hairs of a picture.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Picture")]
pub struct ViewArgs {
    #[command(flatten)]
    pub camera: CameraArgs,
    /// Draw hairs as round tubes instead of ribbons that face the camera.
    #[arg(long)]
    pub round: bool,
    /// How hairs reflect light.
    #[arg(long, value_enum, default_value_t, value_name = "MODEL")]
    pub shading: Shading,
    /// Image with the colours of the surface, by its UVs.
    #[arg(long, value_hint = ValueHint::FilePath, value_name = "IMAGE")]
    pub skin: Option<PathBuf>,
}

/// Camera and quality of a picture.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Picture")]
pub struct CameraArgs {
    /// Size of the picture.
    #[arg(long, default_value = "1280x720", value_parser = size, value_name = "WxH")]
    pub size: (u32, u32),
    /// Samples a pixel; more are smoother and slower.
    #[arg(long, value_name = "N")]
    pub samples: Option<u32>,
    /// Where the camera is; left out, it frames everything.
    #[arg(long, value_parser = vector, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub from: Option<[f32; 3]>,
    /// What the camera looks at.
    #[arg(long, value_parser = vector, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub to: Option<[f32; 3]>,
    /// Vertical field of view in degrees.
    #[arg(long, value_name = "DEGREES")]
    pub fov: Option<f32>,
}

/// A model of how hairs reflect light.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum Shading {
    /// Marschner's lobes with dual scattering.
    #[default]
    Marschner,
    /// Kajiya and Kay's: plainer and a little faster.
    KajiyaKay,
}
