//! Why a groom cannot be compiled to a plan.

use crate::guide::FarGuide;
use crate::recipe::Channel;
use pelage_surface::{Mesh, MeshError};
use std::path::PathBuf;

/// Why a groom cannot be compiled to a plan. Prints the reason; [`PlanError::key`] says
/// which key of the recipe it concerns.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// The polygons of the rest mesh are no surface.
    #[error("{0}")]
    Mesh(#[from] MeshError),
    /// A posed mesh does not fit the rest mesh.
    #[error("{path}: {error}", path = .path.display())]
    Pose {
        /// The file of the pose.
        path: PathBuf,
        /// What is wrong with it.
        error: MeshError,
    },
    /// A property needs a map, but the surface has no texture coordinates.
    #[error(
        "reads the map {map:?}, but the surface has no UVs; \
        add UVs to the mesh or remove the map"
    )]
    NoUvs {
        /// The property.
        key: String,
        /// The map as the recipe writes it.
        map: String,
    },
    /// Whoever loads images left one out.
    #[error("the map {} was not loaded", .map.display())]
    MapNotLoaded {
        /// The property.
        key: String,
        /// The path that should have been loaded.
        map: PathBuf,
    },
    /// A density below zero.
    #[error(
        "{}: texel (column {x}, row {y} from the top, counted from 0), channel {channel}, \
        is {value}; a density must be at least 0: paint it 0 or more, or read another channel",
        .file.display()
    )]
    NegativeDensity {
        /// The property.
        key: String,
        /// The image.
        file: PathBuf,
        /// Column.
        x: u32,
        /// Row from the top.
        y: u32,
        /// Channel that the recipe reads.
        channel: Channel,
        /// What was found, decoded.
        value: f32,
    },
    /// No triangle has an area.
    #[error("every triangle is degenerate; no hair can grow")]
    NoSurface,
    /// There are hairs to make but no guide to make them from.
    #[error("there are none; hair needs at least one")]
    NoGuides,
    /// Guides that lie off the surface.
    #[error("{} farther from the surface than guides.tolerance = {tolerance}: {}; \
        move them or raise the tolerance", count(.far.len()), listed(.far))]
    FarGuides {
        /// All of them.
        far: Vec<FarGuide>,
        /// The distance allowed.
        tolerance: f32,
    },
    /// A guide with a vertex that is NaN, infinite or so far away that lengths overflow.
    #[error(
        "vertex {vertex} of guide {index} is not finite or has a coordinate over {limit:e}; \
        scale the scene down",
        limit = Mesh::FARTHEST
    )]
    GuideNotFinite {
        /// Guide.
        index: usize,
        /// Vertex of it.
        vertex: usize,
    },
    /// A guide without length.
    #[error("guide {index} has no two different vertices")]
    GuideTooShort {
        /// Guide.
        index: usize,
    },
    /// An interpolation group that hairs can fall in but no guide does.
    #[error(
        "no guide grows in group {group} ({color}), whose hairs need one; \
        add a guide there or change groups.map"
    )]
    GroupWithoutGuides {
        /// Group.
        group: u32,
        /// Its colour in the map.
        color: String,
    },
    /// Hairs of more segments than can be written.
    #[error("{found} segments; a hair has at most {limit}")]
    TooManySegments {
        /// Segments asked for.
        found: u32,
        /// How many are allowed.
        limit: u32,
    },
    /// Posed guides that are not those at rest.
    #[error("{found} guides, but {expected} at rest; both need the same, in the same order")]
    PosedGuides {
        /// Guides of the pose.
        found: usize,
        /// Guides at rest.
        expected: usize,
    },
    /// More clumps than are kept in memory.
    #[error("makes {found} clumps; a level has at most {limit}")]
    TooManyClumps {
        /// The property.
        key: String,
        /// Clumps asked for.
        found: u64,
        /// How many are allowed.
        limit: u64,
    },
    /// More fibres a hair than are made at once.
    #[error("{found} fibres; hairs of as many segments have at most {limit} each")]
    TooManyFibers {
        /// Fibres asked for.
        found: u32,
        /// How many are allowed.
        limit: u32,
    },
    /// More roots of blue noise than are kept in memory.
    #[error(
        "{found} hairs; blue noise is kept in memory and has at most {limit}, \
        roots.pattern = \"stratified\" any number"
    )]
    TooMuchBlueNoise {
        /// Hairs asked for.
        found: u64,
        /// How many are allowed.
        limit: u64,
    },
    /// A map of groups that is no map of groups.
    #[error(
        "holds more than {limit} colours; groups need flat colours, \
        or segments listed by colour"
    )]
    TooManyGroups {
        /// How many are allowed.
        limit: usize,
    },
}

impl PlanError {
    /// The key of the recipe that the error concerns, dotted.
    pub fn key(&self) -> &str {
        match self {
            PlanError::Mesh(_) | PlanError::NoSurface => "surface.mesh",
            PlanError::Pose { .. } => "surface.posed",
            PlanError::NoUvs { key, .. }
            | PlanError::MapNotLoaded { key, .. }
            | PlanError::TooManyClumps { key, .. }
            | PlanError::NegativeDensity { key, .. } => key,
            PlanError::TooMuchBlueNoise { .. } => "hair.count",
            PlanError::NoGuides
            | PlanError::FarGuides { .. }
            | PlanError::GuideNotFinite { .. }
            | PlanError::GuideTooShort { .. } => "guides",
            PlanError::PosedGuides { .. } => "guides.posed",
            PlanError::TooManyFibers { .. } => "strand.count",
            PlanError::TooManySegments { .. } => "groups.segments",
            PlanError::GroupWithoutGuides { .. } | PlanError::TooManyGroups { .. } => "groups.map",
        }
    }
}

fn count(n: usize) -> String {
    if n == 1 {
        "1 guide is".into()
    } else {
        format!("{n} guides are")
    }
}

fn listed(far: &[FarGuide]) -> String {
    const SHOWN: usize = 8;
    let mut text: Vec<String> = far
        .iter()
        .take(SHOWN)
        .map(|f| format!("guide {} by {:.4}", f.index, f.distance))
        .collect();
    if far.len() > SHOWN {
        text.push(format!("and {} more", far.len() - SHOWN));
    }
    text.join(", ")
}
