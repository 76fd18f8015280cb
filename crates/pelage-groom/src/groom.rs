//! A recipe with everything it names, loaded: what a plan is compiled from.

use crate::maps::Images;
use crate::recipe::Recipe;
use pelage_curves::Vec3;
use pelage_surface::PolygonMesh;

/// A recipe with everything it names. Nothing here is checked yet.
#[derive(Clone, Debug)]
pub struct Groom {
    /// The recipe.
    pub recipe: Recipe,
    /// The mesh at rest.
    pub mesh: PolygonMesh,
    /// Whether normals of the mesh's file are used; `false` computes them, which
    /// suits grooms whose posed files lack normals (law: a rigid motion moves every
    /// hair rigidly, so rest and pose must get theirs the same way).
    pub keep_file_normals: bool,
    /// Every image named by a map of the recipe, by its resolved path.
    pub images: Images,
    /// The guide curves of `guides.curves`, root first, in the space of the mesh at
    /// rest; empty where the recipe grows its own.
    pub guides: Vec<Vec<Vec3>>,
}
