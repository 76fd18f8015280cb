//! The recipe of a groom: a `groom.toml`, read, checked and typed.
//!
//! ```
//! use pelage_groom::recipe::Recipe;
//! use std::path::Path;
//!
//! let text = r#"
//! [surface]
//! mesh = "body.obj"
//!
//! [guides]
//! curves = "guides.usda"
//!
//! [hair]
//! count = 200_000
//!
//! [roots]
//! density = { map = "density.png", channel = "g" }
//! "#;
//! let recipe = Recipe::parse(text, Path::new("hero/groom.toml"))?;
//! assert_eq!(recipe.hair.count, 200_000);
//! assert_eq!(recipe.width.root.value, 0.02);
//!
//! let (key, map) = &recipe.maps()[0];
//! assert_eq!(key, "roots.density");
//! assert_eq!(map.path.resolved, Path::new("hero/density.png"));
//! # Ok::<(), pelage_groom::recipe::RecipeError>(())
//! ```
//!
//! Each section is a struct declared once, with its keys, ranges, defaults and
//! documentation; reading, checking, errors, the JSON Schema and serde's traits all
//! come from that declaration.
//!
//! A recipe can be read and written by way of serde too, in the same layout:
//!
//! ```
//! use pelage_groom::recipe::Recipe;
//!
//! let json = r#"{ "surface": { "mesh": "body.obj" }, "guides": { "curves": "g.usda" } }"#;
//! let recipe: Recipe = serde_json::from_str(json)?;
//! let again: Recipe = serde_json::from_str(&serde_json::to_string(&recipe)?)?;
//! assert_eq!(again, recipe);
//!
//! let wrong = r#"{ "surface": { "mesh": "body.obj", "upp": "y" }, "guides": {} }"#;
//! let error = serde_json::from_str::<Recipe>(wrong).unwrap_err().to_string();
//! assert!(error.contains("surface.upp: unknown key"));
//! assert!(error.contains("guides: missing"));
//! # Ok::<(), serde_json::Error>(())
//! ```
//!
//! [`Recipe::parse`] is the one that knows lines and columns.

mod check;
mod clump;
mod color;
mod coloring;
mod comb;
mod embed;
mod entry;
mod error;
mod excerpt;
mod facing;
mod flyaway;
mod frizz;
mod group_map;
mod groups;
mod grow;
mod guides;
mod hair;
mod interpolation;
mod kink;
mod length;
mod limits;
mod list;
mod look;
mod map;
mod number;
mod origin;
mod outline;
mod output;
mod page;
mod parse;
mod path;
mod property;
mod ramp;
mod reader;
mod roots;
mod scalar;
mod schema;
mod section;
mod segments;
mod strand;
mod strips;
mod suggest;
mod surface;
mod syntax;
mod template;
mod word;

pub use clump::{Clump, ClumpAround, ClumpLevel};
pub use coloring::{ColorSpace, Coloring, Mutant, Variation};
pub use comb::Comb;
pub use error::{Problem, ProblemKind, RecipeError};
pub use excerpt::Place;
pub use facing::Facing;
pub use flyaway::Flyaway;
pub use frizz::{Frizz, FrizzAnimation};
pub use group_map::GroupMap;
pub use groups::Groups;
pub use grow::{Bend, Curl, Grow};
pub use guides::{GuideSource, Guides};
pub use hair::{Display, Hair};
pub use interpolation::{Interpolation, InterpolationSpace, Method};
pub use kink::Kink;
pub use length::{Cut, Scale};
pub use look::{Opacity, Width};
pub use map::{Blend, Channel, MapSpace, MapUse};
pub use outline::{KeyOutline, SectionOutline, outline};
pub use output::{Output, Voxels};
pub use page::properties_text;
pub use path::FilePath;
pub use pelage_surface::Wrap;
pub use property::{ColorProperty, Property, ScalarProperty};
pub use ramp::Ramp;
pub use roots::{Pattern, Roots};
pub use schema::{schema, schema_text};
pub use segments::Segments;
pub use strand::{Splay, Strand};
pub use strips::{STRIPS, Strip, Subject, WITHOUT_STRIP};
pub use surface::{Surface, Up};

use entry::Rule;
use origin::Origin;

section::table! {
    /// The recipe of a groom: surface, guides and the properties of its hair.
    /// Lengths are in the unit of the mesh, angles in degrees, colours linear RGB,
    /// and files relative to the folder of the recipe.
    pub struct Recipe {
        /// The mesh that grows hair.
        pub surface: Surface = Surface::default() => Rule::ANY.required(),
        /// The curves that shape the hair: a file, or guides grown by rule.
        pub guides: Guides = Guides::default() => Rule::ANY.required(),
        /// How many hairs grow, and the seed of everything random.
        pub hair: Hair = Hair::default() => Rule::ANY,
        /// What a viewport shows.
        pub display: Display = Display::default() => Rule::ANY,
        /// Where hairs stand.
        pub roots: Roots = Roots::default() => Rule::ANY,
        /// Which guides a hair listens to, and how many segments it has.
        pub groups: Groups = Groups::default() => Rule::ANY,
        /// How guides shape the hairs between them.
        pub interpolation: Interpolation = Interpolation::default() => Rule::ANY,
        /// Hairs cut off.
        pub cut: Cut = Cut::default() => Rule::ANY,
        /// Hairs scaled about their roots.
        pub scale: Scale = Scale::default() => Rule::ANY,
        /// Noise that bends a hair as a whole.
        pub frizz: Frizz = Frizz::default() => Rule::ANY,
        /// Noise along each hair.
        pub kink: Kink = Kink::default() => Rule::ANY,
        /// Hairs drawn together.
        pub clump: Clump = Clump::default() => Rule::ANY,
        /// Hairs that stray.
        pub flyaway: Flyaway = Flyaway::default() => Rule::ANY,
        /// Colour from root to tip.
        pub color: Coloring = Coloring::default() => Rule::ANY,
        /// Opacity from root to tip.
        pub opacity: Opacity = Opacity::default() => Rule::ANY,
        /// Diameter from root to tip.
        pub width: Width = Width::default() => Rule::ANY,
        /// Each hair a bundle of fibres.
        pub strand: Strand = Strand::default() => Rule::ANY,
        /// What is written of finished hairs.
        pub output: Output = Output::default() => Rule::ANY,
        /// Caches for rendering, cut into boxes.
        pub voxels: Voxels = Voxels::default() => Rule::ANY,
        ;
        /// Where the recipe was written.
        origin: Origin
    }
}
