//! From a `groom.toml` to strands: the recipe, the plan it compiles to, and the
//! pipeline that runs it.
//!
//! ```text
//! Recipe + files = Groom → Plan → capture (rest) → evaluate (pose) → Sink
//! ```
//!
//! Everything that can fail does so while the [`Plan`] is made.

mod blocks;
mod bundles;
mod capture;
mod clock;
mod clump_middles;
mod clumps;
mod code_map;
pub mod color;
mod color_profile;
mod columns;
mod curves;
mod error;
mod evaluate;
mod generate;
mod groom;
mod groups;
mod grow;
mod grow_bend;
mod guide;
mod guide_set;
mod guide_shapes;
mod in_order;
pub mod lanes;
mod locator;
mod looks;
mod maps;
mod missing_tiles;
mod mix;
mod neighbors;
pub mod noise;
mod noise_fields;
mod order;
mod plan;
mod pose;
mod profile;
pub mod random;
pub mod recipe;
mod root_plan;
mod shape;
mod shared_lists;
pub mod stages;
mod stay;
mod texture;
mod weigh;
mod write_roots;

pub use capture::{Capture, Dropped};
pub use clock::{Clock, Stage};
pub use error::PlanError;
pub use evaluate::Scratch;
pub use generate::{GenerateError, Poses, Report, Request, generate};
pub use groom::Groom;
pub use groups::{Group, Groups};
pub use guide::{FarGuide, Guide};
pub use locator::{Locator, Near};
pub use maps::{ColorField, Images, ScalarField};
pub use noise_fields::NoiseFields;
pub use order::Order;
pub use plan::Plan;
pub use pose::{Pose, Posed};
pub use root_plan::RootPlan;
pub use texture::Texture;
pub use write_roots::write_roots;
