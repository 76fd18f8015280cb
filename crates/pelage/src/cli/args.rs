//! What can be typed.

use clap::{Args, Parser, Subcommand, ValueEnum, ValueHint};
use std::ops::Range;
use std::path::PathBuf;

/// Grow hair and fur on triangle meshes.
///
/// A recipe (groom.toml) names a mesh, guide curves and maps; Pelage grows the same
/// hairs from it on every machine, and writes or renders them.
#[derive(Debug, Parser)]
#[command(name = "pelage", version, max_term_width = 92, after_help = EXAMPLES)]
pub struct Cli {
    /// Print errors only.
    #[arg(long, short, global = true)]
    pub quiet: bool,
    #[command(subcommand)]
    pub command: Command,
}

const EXAMPLES: &str = "\
Examples:
  pelage demo                                     a furry animal, from nothing
  pelage init meadow --example grass              a recipe of your own to begin with
  pelage generate groom.toml -o hair.usdc         all hairs as USD
  pelage generate groom.toml -o null --stats -    how fast, by stage
  pelage inspect hair.usdc                        what is in a file, and what is wrong";

/// A command.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Make a furry animal: recipe, 200,000 hairs as USD, and a picture.
    Demo(DemoArgs),
    /// Write an example groom to start from.
    Init(InitArgs),
    /// Grow the hairs of a recipe into a file.
    Generate(GenerateArgs),
    /// Render a picture of a file of hair.
    Render(RenderArgs),
    /// Tell what a file holds, and everything that is wrong with it.
    Inspect(InspectArgs),
    /// Measure the figures of docs/results again, on this machine.
    Bench(BenchArgs),
    /// Print the JSON Schema of groom.toml, for editors.
    Schema,
    /// Print a completion script for a shell.
    #[command(after_help = "Example:\n  pelage completions bash > \
        ~/.local/share/bash-completion/completions/pelage")]
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// Print the manual page, or write the pages of all commands into a folder.
    Man {
        /// Folder for one page a command.
        #[arg(value_hint = ValueHint::DirPath)]
        folder: Option<PathBuf>,
    },
}

/// `pelage demo`.
#[derive(Debug, Args)]
pub struct DemoArgs {
    /// Where to put everything.
    #[arg(default_value = "pelage-demo", value_hint = ValueHint::DirPath)]
    pub folder: PathBuf,
    /// Threads to use; 0 is one a core.
    #[arg(long, default_value_t = 0)]
    pub threads: usize,
    /// Size of the picture.
    #[arg(long, default_value = "1280x720", value_parser = size, value_name = "WxH")]
    pub size: (u32, u32),
}

/// `pelage init`.
#[derive(Debug, Args)]
#[command(after_help = "Example:\n  pelage init meadow --example grass\n  \
    pelage generate meadow/groom.toml -o meadow/grass.usdc --picture meadow/grass.png")]
pub struct InitArgs {
    /// Folder to write into; it is made where it is missing.
    #[arg(value_hint = ValueHint::DirPath)]
    pub folder: PathBuf,
    /// Which example.
    #[arg(long, short, default_value = "ball", value_parser = example_names())]
    pub example: String,
    /// Overwrite files that are there.
    #[arg(long)]
    pub force: bool,
}

fn example_names() -> clap::builder::PossibleValuesParser {
    clap::builder::PossibleValuesParser::new(pelage::examples::names())
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
    /// Only the hairs A to B - 1 of those; either end may be left out.
    #[arg(long, value_parser = open_range, value_name = "A..B")]
    pub range: Option<(Option<u64>, Option<u64>)>,
    /// The frame whose posed surface to use.
    #[arg(
        long,
        value_name = "F",
        allow_negative_numbers = true,
        conflicts_with = "frames"
    )]
    pub frame: Option<i64>,
    /// All frames from A to B into one file (for .rib: one file each).
    #[arg(long, value_parser = frames, value_name = "A-B", allow_hyphen_values = true)]
    pub frames: Option<(i64, i64)>,
    /// Frames a second, for formats that store time.
    #[arg(long, default_value_t = 24.0)]
    pub fps: f64,
    /// Seed to use instead of the recipe's hair.seed.
    #[arg(long)]
    pub seed: Option<u64>,
    /// Threads to use; 0 is one a core. The bytes are the same for any number.
    #[arg(long, default_value_t = 0, value_name = "N")]
    pub threads: usize,
    /// Also render a picture of the (first frame's) hair on its surface.
    #[arg(long, value_hint = ValueHint::FilePath, value_name = "PNG")]
    pub picture: Option<PathBuf>,
    /// Write counts, times by stage and cost a hair as JSON; `-` prints them.
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
  pelage generate groom.toml -o hair.usdc --frames 1-48
  pelage generate groom.toml -o null --picture look.png --stats -";

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
    /// Threads to use; 0 is one a core.
    #[arg(long, default_value_t = 0, value_name = "N")]
    pub threads: usize,
    #[command(flatten)]
    pub view: ViewArgs,
}

/// Camera and quality of a picture.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Picture")]
pub struct ViewArgs {
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

/// A model of how hairs reflect light.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum Shading {
    /// Marschner's lobes with dual scattering.
    #[default]
    Marschner,
    /// Kajiya and Kay's: plainer and a little faster.
    KajiyaKay,
}

/// `pelage inspect`.
#[derive(Debug, Args)]
#[command(after_help = "Exits with 0 where nothing is wrong, with 3 where something is.")]
pub struct InspectArgs {
    /// Files to look into.
    #[arg(required = true, value_hint = ValueHint::FilePath)]
    pub files: Vec<PathBuf>,
    /// Print JSON.
    #[arg(long)]
    pub json: bool,
}

/// `pelage bench`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  pelage bench sampling\n  \
    pelage bench sampling -o results --json results/sampling.json")]
pub struct BenchArgs {
    /// What to measure.
    #[arg(value_enum)]
    pub what: Bench,
    /// Folder for the tables and plots.
    #[arg(long, short, value_hint = ValueHint::DirPath, value_name = "FOLDER")]
    pub output: Option<PathBuf>,
    /// File for the measurements as data.
    #[arg(long, value_hint = ValueHint::FilePath, value_name = "JSON")]
    pub json: Option<PathBuf>,
    /// Only try that everything can be measured: a few seconds, worthless figures.
    #[arg(long)]
    pub quick: bool,
}

/// What can be measured.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Bench {
    /// Drawing roots: rates, preprocessing and memory against other methods.
    Sampling,
}

impl GenerateArgs {
    /// The hairs wanted of a groom of `count` hairs.
    pub fn hairs(&self, count: u64) -> Result<Range<u64>, String> {
        let (first, end) = self.range.unwrap_or((None, None));
        let (first, end) = (first.unwrap_or(0), end.unwrap_or(count));
        if first > end {
            return Err(format!(
                "--range {first}..{end}: the first hair comes after the end"
            ));
        }
        if end > count {
            return Err(format!(
                "--range {first}..{end}: there are only {count} hairs; \
                raise --count or hair.count"
            ));
        }
        Ok(first..end)
    }
}

/// A whole number in which `_` may group digits, as in TOML.
fn whole(text: &str) -> Result<u64, String> {
    text.replace('_', "")
        .parse()
        .map_err(|_| "expected a whole number".to_owned())
}

fn open_range(text: &str) -> Result<(Option<u64>, Option<u64>), String> {
    let wrong = || "expected A..B, such as 0..1000 or 500..".to_owned();
    let (first, end) = text.split_once("..").ok_or_else(wrong)?;
    let part = |text: &str| match text {
        "" => Ok(None),
        text => whole(text).map(Some).map_err(|_| wrong()),
    };
    Ok((part(first)?, part(end)?))
}

fn frames(text: &str) -> Result<(i64, i64), String> {
    let wrong = || "expected A-B, such as 1-48".to_owned();
    // The first character may be the sign of A.
    let dash = text
        .char_indices()
        .skip(1)
        .find(|(_, c)| *c == '-')
        .ok_or_else(wrong)?
        .0;
    let first: i64 = text[..dash].parse().map_err(|_| wrong())?;
    let last: i64 = text[dash + 1..].parse().map_err(|_| wrong())?;
    if first > last {
        return Err(format!("frame {first} comes after frame {last}"));
    }
    if last.abs_diff(first) >= 1_000_000 {
        return Err("more than a million frames".into());
    }
    Ok((first, last))
}

fn size(text: &str) -> Result<(u32, u32), String> {
    let parts = text
        .split_once('x')
        .and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
    match parts {
        Some((w @ 1..=16384, h @ 1..=16384)) => Ok((w, h)),
        _ => Err("expected WIDTHxHEIGHT, each 1 to 16384, such as 1280x720".into()),
    }
}

fn vector(text: &str) -> Result<[f32; 3], String> {
    let wrong = || "expected three numbers, such as 0,1.5,-2".to_owned();
    let parts: Vec<f32> = text
        .split(',')
        .map(|p| p.trim().parse())
        .collect::<Result<_, _>>()
        .map_err(|_| wrong())?;
    let vector: [f32; 3] = parts.try_into().map_err(|_| wrong())?;
    if vector.iter().all(|x: &f32| x.is_finite()) {
        Ok(vector)
    } else {
        Err(wrong())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn ranges_and_frames_are_read() {
        assert_eq!(open_range("0..1_000"), Ok((Some(0), Some(1000))));
        assert_eq!(open_range("5.."), Ok((Some(5), None)));
        assert!(open_range("5").is_err());
        assert_eq!(frames("1-48"), Ok((1, 48)));
        assert_eq!(frames("-3--1"), Ok((-3, -1)));
        assert!(frames("4-2").is_err());
        assert_eq!(size("640x480"), Ok((640, 480)));
        assert!(size("640x0").is_err());
        assert_eq!(vector("0, 1.5,-2"), Ok([0.0, 1.5, -2.0]));
    }
}
