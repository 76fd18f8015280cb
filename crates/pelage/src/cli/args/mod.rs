//! What can be typed.

mod curves;
mod hairs;
mod view;

pub use curves::{AnalyzeArgs, CapKind, FitArgs, FramingKind, TubeArgs};
pub use hairs::{GenerateArgs, SampleArgs, Shown};
pub use view::{CameraArgs, RenderArgs, Shading, ViewArgs};

use super::import::Dialect;
use super::threads::cores;
use super::values::{size, threads};
use clap::{Args, Parser, Subcommand, ValueEnum, ValueHint};
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

/// Threads of a command.
#[derive(Clone, Copy, Debug, Default, Args)]
pub struct ThreadArgs {
    /// Threads to use; 0 is one a core. The bytes are the same for any number.
    #[arg(long = "threads", default_value_t = 0, value_parser = threads, value_name = "N")]
    asked: usize,
}

impl ThreadArgs {
    /// How many there are to be, at least 1.
    pub fn count(self) -> usize {
        match self.asked {
            0 => cores(),
            asked => asked,
        }
    }
}

/// `pelage demo`.
#[derive(Debug, Args)]
pub struct DemoArgs {
    /// Where to put everything.
    #[arg(default_value = "pelage-demo", value_hint = ValueHint::DirPath)]
    pub folder: PathBuf,
    #[command(flatten)]
    pub threads: ThreadArgs,
    /// Size of the picture.
    #[arg(long, default_value = "1280x720", value_parser = size, value_name = "WxH")]
    pub size: (u32, u32),
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
    #[command(flatten)]
    pub threads: ThreadArgs,
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
    /// Drawing roots: rates, preprocessing and memory against other methods. Compares
    /// with the packages of the Python that PELAGE_PYTHON names.
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
