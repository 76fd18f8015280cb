//! What can be typed.

use super::import::Dialect;
use super::values::{
    ErrorBound, detail, error_bound, frames, not_negative, open_range, size, vector, whole,
};
use anyhow::{Result, bail};
use clap::{Args, Parser, Subcommand, ValueEnum, ValueHint};
use pelage::Recipe;
use std::ops::Range;
use std::path::{Path, PathBuf};

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
  pelage sample groom.toml -n 1000 -o roots.npz   where hairs stand, without hair
  pelage inspect hair.usdc                        what is in a file, and what is wrong
  pelage import --from stubble old.ma -o new.toml  a recipe from an older program";

/// A command.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Make a furry animal: recipe, 200,000 hairs as USD, and a picture.
    Demo(DemoArgs),
    /// Write an example groom to start from.
    Init(InitArgs),
    /// Grow the hairs of a recipe into a file.
    Generate(GenerateArgs),
    /// Write or show the roots of hairs, without growing them.
    Sample(SampleArgs),
    /// Render a picture of a file of hair.
    Render(RenderArgs),
    /// Tell what a file holds, and everything that is wrong with it.
    Inspect(InspectArgs),
    /// Tell how curves bend: curvature, torsion, helicity and length, as tables and plots.
    Analyze(AnalyzeArgs),
    /// Sweep curves to solid meshes: branches, cables, braids, hair for printing.
    Tube(TubeArgs),
    /// Fit Super-Helices to curves: few numbers a strand, for simulators and small files.
    Fit(FitArgs),
    /// Measure the figures of docs/results again, on this machine.
    Bench(BenchArgs),
    /// Draw each property in a strip of pictures, from low to high.
    Gallery(GalleryArgs),
    /// Make a recipe from the parameters of another hair generator.
    Import(ImportArgs),
    /// Print the JSON Schema of groom.toml, for editors, or a page of all properties.
    #[command(after_help = "Examples:\n  pelage schema > groom.schema.json\n  \
        pelage schema --markdown > properties.md")]
    Schema {
        /// Print every property explained, as Markdown.
        #[arg(long)]
        markdown: bool,
    },
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
    /// Threads to use; 0 is one a core. The bytes are the same for any number.
    #[arg(long, default_value_t = 0, value_name = "N")]
    pub threads: usize,
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

/// `pelage gallery`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  pelage gallery -o docs/gallery\n  \
    pelage gallery -o look --only frizz.tip --only kink.tip --size 480x480")]
pub struct GalleryArgs {
    /// Folder for the strips, one JPEG file a property; it is made where it is missing.
    #[arg(long, short, value_hint = ValueHint::DirPath)]
    pub output: PathBuf,
    /// A property to draw, such as width.tip; may be given several times. Left out, all.
    #[arg(long, value_name = "KEY")]
    pub only: Vec<String>,
    /// Size of a picture; a strip has up to four.
    #[arg(long, default_value = "200x200", value_parser = size, value_name = "WxH")]
    pub size: (u32, u32),
    /// Threads to use; 0 is one a core.
    #[arg(long, default_value_t = 0)]
    pub threads: usize,
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
    /// Threads to use; 0 is one a core. The bytes are the same for any number.
    #[arg(long, default_value_t = 0, value_name = "N")]
    pub threads: usize,
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

/// `pelage import`.
#[derive(Debug, Args)]
#[command(after_help = IMPORT_EXAMPLES)]
pub struct ImportArgs {
    /// A Maya ASCII scene or MEL script with `setAttr` lines, or a list of `name = value`
    /// lines. Of a scene, the first hair is taken.
    #[arg(value_hint = ValueHint::FilePath)]
    pub file: PathBuf,
    /// The program whose parameters they are.
    #[arg(long, value_enum, value_name = "PROGRAM")]
    pub from: Dialect,
    /// The recipe to write. It tells what was not mapped in its last lines.
    #[arg(long, short, value_hint = ValueHint::FilePath, value_name = "FILE")]
    pub output: PathBuf,
    /// Overwrite a file that is there.
    #[arg(long)]
    pub force: bool,
}

const IMPORT_EXAMPLES: &str = "\
Examples:
  pelage import --from stubble scene.ma -o groom.toml
  pelage import --from shave hair.mel -o groom.toml

Of Shave, the long names of its Maya node are known, such as hairCount, not the short
ones that Maya writes into scenes.";

/// `pelage bench`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  pelage bench sampling\n  \
    pelage bench sampling -o results --json results/sampling.json\n  \
    pelage bench generation -o results\n  \
    pelage bench curves -o results")]
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
    /// Growing hairs: seconds and cost by stage, with everything made and with what
    /// was taken of the rest pose kept.
    Generation,
    /// Space curves: rates, errors of steps along them, and ways to mix curls. Compares
    /// with the packages of the Python that PELAGE_PYTHON names.
    Curves,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }
}
