//! From the path of a recipe to a plan: every file it names is read here.

use crate::poses::{PoseFiles, PoseSource};
use crate::udim;
use pelage_curves::Vec3;
use pelage_groom::recipe::{GuideSource, Recipe, RecipeError, Up};
use pelage_groom::{Groom, Images, Order, Plan, Request, RootPlan};
use pelage_io::{
    MeshFile, ReadError, read_curves, read_image, read_mesh, strands_through_vertices,
};
use pelage_strands::{StreamInfo, UpAxis};
use std::collections::hash_map::Entry;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

/// A recipe with everything it names, compiled.
#[derive(Debug)]
pub struct Loaded {
    /// The recipe.
    pub recipe: Recipe,
    /// The plan.
    pub plan: Plan,
    /// The poses of the surface and the guides.
    pub poses: PoseFiles,
    /// Up axis and unit, from the recipe or else the mesh.
    pub info: StreamInfo,
}

impl Loaded {
    /// A request for `hairs` on `threads` threads, as a still.
    pub fn request(&self, hairs: Range<u64>, threads: usize) -> Request {
        Request {
            order: Order::default(),
            frame: 0.0,
            hairs,
            threads,
            info: self.info.clone(),
        }
    }
}

/// Reads the recipe at `path` and all that it names, and compiles it.
///
/// An error tells the place in the recipe of whatever is wrong, in it or in a file it
/// names.
pub fn load(path: &Path) -> Result<Loaded, RecipeError> {
    load_with(Recipe::load(path)?)
}

/// As [`load`], from a recipe that was read (and maybe changed) before.
pub fn load_with(recipe: Recipe) -> Result<Loaded, RecipeError> {
    let surface = Surface::read(&recipe)?;
    let guides = match recipe.guides.source() {
        Some(GuideSource::Curves(file)) => read_guides(&file.resolved, None)
            .map_err(|e| recipe.error_at("guides.curves", e.to_string()))?,
        _ => Vec::new(),
    };
    let posed = match &recipe.guides.posed {
        None => PoseSource::Rest,
        Some(posed) => PoseSource::of_guides(&posed.resolved)
            .map_err(|e| recipe.error_at("guides.posed", e.to_string()))?,
    };
    let images = read_images(&recipe, |_| true)?;
    let (groom, poses, info) = surface.groom(&recipe, images, guides, posed);
    let plan = Plan::new(groom).map_err(|e| recipe.error_at(e.key(), e.to_string()))?;
    Ok(Loaded {
        recipe,
        plan,
        poses,
        info,
    })
}

/// The roots of a recipe with everything they need, compiled.
#[derive(Debug)]
pub struct LoadedRoots {
    /// The recipe.
    pub recipe: Recipe,
    /// Where hairs stand.
    pub plan: RootPlan,
    /// The poses of the surface.
    pub poses: PoseFiles,
    /// Up axis and unit, from the recipe or else the mesh.
    pub info: StreamInfo,
}

/// Reads only what the roots of `recipe` need: the surface, and the maps of its
/// sections `roots` and `groups`. Neither guides nor other maps need be there.
pub fn load_roots(recipe: Recipe) -> Result<LoadedRoots, RecipeError> {
    let surface = Surface::read(&recipe)?;
    let images = read_images(&recipe, RootPlan::needs)?;
    let (groom, poses, info) = surface.groom(&recipe, images, Vec::new(), PoseSource::Rest);
    let plan = RootPlan::new(groom).map_err(|e| recipe.error_at(e.key(), e.to_string()))?;
    Ok(LoadedRoots {
        recipe,
        plan,
        poses,
        info,
    })
}

/// The surface of a recipe as its files give it.
struct Surface {
    rest: MeshFile,
    poses: PoseSource,
    keep_file_normals: bool,
}

impl Surface {
    fn read(recipe: &Recipe) -> Result<Self, RecipeError> {
        let at =
            |key: &'static str| move |error: ReadError| recipe.error_at(key, error.to_string());
        let rest = read_mesh(&recipe.surface.mesh.resolved, None).map_err(at("surface.mesh"))?;
        let poses = match &recipe.surface.posed {
            None => PoseSource::Rest,
            Some(posed) => PoseSource::of_mesh(&posed.resolved).map_err(at("surface.posed"))?,
        };
        Ok(Self {
            keep_file_normals: keep_file_normals(&rest, &poses),
            rest,
            poses,
        })
    }

    fn groom(
        self,
        recipe: &Recipe,
        images: Images,
        guides: Vec<Vec<Vec3>>,
        posed_guides: PoseSource,
    ) -> (Groom, PoseFiles, StreamInfo) {
        let info = stream_info(recipe, &self.rest);
        let groom = Groom {
            recipe: recipe.clone(),
            mesh: self.rest.mesh,
            keep_file_normals: self.keep_file_normals,
            images,
            guides,
        };
        (
            groom,
            PoseFiles::new(self.poses, posed_guides, self.keep_file_normals),
            info,
        )
    }
}

/// Normals of a file serve only where rest and pose both have them (law 4). A pose
/// that cannot be read yet is looked at again, and reported, when its frame comes.
fn keep_file_normals(rest: &MeshFile, source: &PoseSource) -> bool {
    let first = match source {
        PoseSource::Rest => return true,
        PoseSource::Sequence { .. } => return false,
        PoseSource::File(_) => 0.0,
        PoseSource::Samples(path) => pelage_io::mesh_frames(path)
            .ok()
            .and_then(|f| f.first().copied())
            .unwrap_or(0.0),
    };
    let has = |mesh: &pelage_surface::PolygonMesh| !mesh.corner_normals.is_empty();
    let posed = source.polygons(first).ok().flatten();
    has(&rest.mesh) && posed.is_some_and(|mesh| has(&mesh))
}

/// The vertices of all curves of a file, at `time` where it has time.
pub(crate) fn read_guides(path: &Path, time: Option<f64>) -> Result<Vec<Vec<Vec3>>, ReadError> {
    let file = read_curves(path, time)?;
    let mut guides = Vec::new();
    for set in &file.sets {
        let strands = strands_through_vertices(set);
        guides.extend((0..strands.len()).map(|i| strands.strand_points(i).to_vec()));
    }
    Ok(guides)
}

/// The images of the properties that are `needed`, by key.
fn read_images(recipe: &Recipe, needed: impl Fn(&str) -> bool) -> Result<Images, RecipeError> {
    let mut images = Images::new();
    for (key, used) in recipe.maps().into_iter().filter(|(key, _)| needed(key)) {
        let at_key = |error: ReadError| recipe.error_at(&key, error.to_string());
        for file in udim::files(&used.path).map_err(at_key)? {
            if let Entry::Vacant(place) = images.entry(file) {
                let image = read_image(place.key()).map_err(at_key)?;
                place.insert(Arc::new(image));
            }
        }
    }
    Ok(images)
}

fn stream_info(recipe: &Recipe, rest: &MeshFile) -> StreamInfo {
    let standard = StreamInfo::default();
    StreamInfo {
        up_axis: match recipe.surface.up {
            Some(Up::Y) => UpAxis::Y,
            Some(Up::Z) => UpAxis::Z,
            None => rest.up_axis.unwrap_or(standard.up_axis),
        },
        meters_per_unit: recipe
            .surface
            .meters_per_unit
            .or(rest.meters_per_unit)
            .unwrap_or(standard.meters_per_unit),
        ..standard
    }
}
