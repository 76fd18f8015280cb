//! Polygons of `UsdGeomMesh` prims, in world space.
//!
//! Subdivision surfaces are read as their cage. Source of the counts and of the
//! winding: OpenUSD `pxr/usd/usdGeom/schema.usda`, class `Mesh`.

use super::stage::Scene;
use super::values::Entry;
use super::xform::{transform_normals, transform_points};
use crate::ReadError;
use openusd::sdf;
use pelage_surface::PolygonMesh;

/// The meshes among `prims` as one. Where only some have texture coordinates the
/// others get zeros; where only some have normals none are kept.
pub(super) fn read(
    scene: &Scene,
    prims: &[sdf::Path],
    time: Option<f64>,
) -> Result<PolygonMesh, ReadError> {
    let mut all = PolygonMesh::default();
    let mut normals = true;
    for prim in prims {
        let mesh = read_one(scene, prim, time)?;
        let base = u32::try_from(all.positions.len());
        let whole = u32::try_from(all.positions.len() + mesh.positions.len());
        let (Ok(base), Ok(_)) = (base, whole) else {
            return Err(scene.error(prim, "the meshes together have more than 2^32 vertices"));
        };
        normals &= !mesh.corner_normals.is_empty() || mesh.corner_vertices.is_empty();
        if !all.corner_uvs.is_empty() || !mesh.corner_uvs.is_empty() {
            all.corner_uvs.resize(all.corner_vertices.len(), [0.0; 2]);
            all.corner_uvs.extend(&mesh.corner_uvs);
            let corners = all.corner_vertices.len() + mesh.corner_vertices.len();
            all.corner_uvs.resize(corners, [0.0; 2]);
        }
        let shifted = mesh.corner_vertices.iter().map(|v| v.saturating_add(base));
        all.corner_vertices.extend(shifted);
        all.positions.extend(mesh.positions);
        all.face_sizes.extend(mesh.face_sizes);
        all.corner_normals.extend(mesh.corner_normals);
    }
    if !normals {
        all.corner_normals.clear();
    }
    Ok(all)
}

/// Faces of a mesh, and for each corner that is kept its place in the file.
struct Topology {
    sizes: Vec<u32>,
    vertices: Vec<u32>,
    /// Of each kept corner: its number in the file.
    corner_of: Vec<usize>,
    /// Of each kept corner: the number of its face in the file.
    face_of: Vec<usize>,
    file_faces: usize,
    file_corners: usize,
}

fn read_one(scene: &Scene, prim: &sdf::Path, time: Option<f64>) -> Result<PolygonMesh, ReadError> {
    let mut positions: Vec<[f32; 3]> = required(scene, prim, "points", time)?;
    let world = scene.world_from(prim, time)?;
    let left_handed = scene.token(prim, "orientation")?.as_deref() == Some("leftHanded");
    // A mirroring transform turns faces inside out, and so does left-handedness.
    let flip = left_handed != (world.determinant() < 0.0);
    let topology = Topology::read(scene, prim, time, flip, positions.len())?;
    let names = Primvars {
        scene,
        prim,
        time,
        topology: &topology,
        points: positions.len(),
    };
    let uvs = names.uvs()?;
    let mut normals = names.normals()?;
    transform_points(&mut positions, &world);
    transform_normals(&mut normals, &world);
    Ok(PolygonMesh {
        positions,
        face_sizes: topology.sizes,
        corner_vertices: topology.vertices,
        corner_uvs: uvs,
        corner_normals: normals,
    })
}

fn required<T: Entry>(
    scene: &Scene,
    prim: &sdf::Path,
    name: &str,
    time: Option<f64>,
) -> Result<Vec<T>, ReadError> {
    let value = scene.value(prim, name, time)?;
    let value = value.ok_or_else(|| scene.error(prim, format!("the mesh has no {name}")))?;
    T::entries(value).ok_or_else(|| {
        let message = format!("it is not of type {}", T::KIND);
        scene.error(format!("{prim}.{name}"), message)
    })
}

impl Topology {
    fn read(
        scene: &Scene,
        prim: &sdf::Path,
        time: Option<f64>,
        flip: bool,
        points: usize,
    ) -> Result<Self, ReadError> {
        let sizes: Vec<i64> = required(scene, prim, "faceVertexCounts", time)?;
        let vertices: Vec<i64> = required(scene, prim, "faceVertexIndices", time)?;
        check_topology(&sizes, &vertices, points)
            .map_err(|(name, message)| scene.error(format!("{prim}.{name}"), message))?;
        let mut hole = vec![false; sizes.len()];
        let holes = scene.value(prim, "holeIndices", time)?;
        for face in holes.and_then(i64::entries).unwrap_or_default() {
            if let Some(hole) = usize::try_from(face).ok().and_then(|f| hole.get_mut(f)) {
                *hole = true;
            }
        }
        let mut topology = Self {
            sizes: Vec::new(),
            vertices: Vec::new(),
            corner_of: Vec::new(),
            face_of: Vec::new(),
            file_faces: sizes.len(),
            file_corners: vertices.len(),
        };
        let mut start = 0;
        for (face, &size) in sizes.iter().enumerate() {
            let corners = start..start + size as usize;
            start = corners.end;
            if !hole[face] {
                topology.push(face, corners, &vertices, flip);
            }
        }
        Ok(topology)
    }

    /// Adds a face. A flipped one keeps its first corner and turns the others.
    fn push(&mut self, face: usize, corners: std::ops::Range<usize>, vertices: &[i64], flip: bool) {
        self.sizes.push(corners.len() as u32);
        let (start, end) = (corners.start, corners.end);
        for corner in corners {
            let from = if flip && corner > start {
                end - (corner - start)
            } else {
                corner
            };
            self.vertices.push(vertices[from] as u32);
            self.corner_of.push(from);
            self.face_of.push(face);
        }
    }
}

/// The array at fault and what is wrong with it.
fn check_topology(
    sizes: &[i64],
    vertices: &[i64],
    points: usize,
) -> Result<(), (&'static str, String)> {
    if let Some(face) = sizes.iter().position(|&s| s < 0) {
        let message = format!("face {face} has {} corners", sizes[face]);
        return Err(("faceVertexCounts", message));
    }
    let corners: i128 = sizes.iter().map(|&s| s as i128).sum();
    if corners != vertices.len() as i128 {
        let message = format!(
            "it has {} entries, but faceVertexCounts add up to {corners}",
            vertices.len()
        );
        return Err(("faceVertexIndices", message));
    }
    match vertices.iter().position(|&v| v < 0 || v >= points as i64) {
        Some(corner) => Err((
            "faceVertexIndices",
            format!(
                "entry {corner} names vertex {}; the mesh has {points} points",
                vertices[corner]
            ),
        )),
        None => Ok(()),
    }
}

/// Attributes of a mesh that vary over it.
struct Primvars<'a> {
    scene: &'a Scene,
    prim: &'a sdf::Path,
    time: Option<f64>,
    topology: &'a Topology,
    points: usize,
}

impl Primvars<'_> {
    /// `primvars:st`, else the first primvar of a type of texture coordinates.
    fn uvs(&self) -> Result<Vec<[f32; 2]>, ReadError> {
        let prim = self.scene.stage.prim(self.prim.clone());
        let names = self.scene.property_names(self.prim)?;
        let mut candidates = Vec::new();
        for name in names.iter().filter(|n| n.starts_with("primvars:")) {
            let type_name = prim.attribute(name.clone()).type_name();
            let type_name = self.scene.decoded(self.prim, type_name)?;
            let type_name = type_name.map(String::from).unwrap_or_default();
            let is_st = name.as_str() == "primvars:st";
            if is_st || type_name.starts_with("texCoord2") {
                candidates.push((!is_st, name.to_string()));
            }
        }
        candidates.sort_by_key(|(other, _)| *other);
        match candidates.first() {
            Some((_, name)) => self.corners(name, "constant"),
            None => Ok(Vec::new()),
        }
    }

    /// `primvars:normals`, else `normals`; empty for none.
    fn normals(&self) -> Result<Vec<[f32; 3]>, ReadError> {
        let primvar = self.corners("primvars:normals", "vertex")?;
        match primvar.is_empty() {
            true => self.corners("normals", "vertex"),
            false => Ok(primvar),
        }
    }

    /// An attribute as one entry a kept corner; empty where it has no value.
    /// `fallback` is the interpolation of an attribute that does not name one.
    fn corners<T: Entry>(&self, name: &str, fallback: &str) -> Result<Vec<T>, ReadError> {
        let place = || format!("{}.{name}", self.prim);
        let Some(value) = self.scene.value(self.prim, name, self.time)? else {
            return Ok(Vec::new());
        };
        let entries = T::entries(value)
            .ok_or_else(|| self.scene.error(place(), format!("it is not {}", T::KIND)))?;
        let indices = self
            .scene
            .value(self.prim, &format!("{name}:indices"), self.time)?;
        let entries = match indices.and_then(i64::entries) {
            Some(indices) => {
                gather(&entries, &indices).map_err(|message| self.scene.error(place(), message))?
            }
            None => entries,
        };
        let interpolation = self.scene.interpolation(self.prim, name)?;
        let interpolation = interpolation.as_deref().unwrap_or(fallback);
        let topology = self.topology;
        let (expected, places): (usize, Box<dyn Iterator<Item = usize>>) = match interpolation {
            "faceVarying" => (
                topology.file_corners,
                Box::new(topology.corner_of.iter().copied()),
            ),
            "vertex" | "varying" => (
                self.points,
                Box::new(topology.vertices.iter().map(|&v| v as usize)),
            ),
            "uniform" => (
                topology.file_faces,
                Box::new(topology.face_of.iter().copied()),
            ),
            _ => (1, Box::new(topology.vertices.iter().map(|_| 0))),
        };
        if entries.len() != expected {
            let found = entries.len();
            let message = format!("it has {found} entries, not {expected} ({interpolation})");
            return Err(self.scene.error(place(), message));
        }
        Ok(places.map(|i| entries[i]).collect())
    }
}

/// Entries picked by `indices`.
pub(super) fn gather<T: Copy>(entries: &[T], indices: &[i64]) -> Result<Vec<T>, String> {
    let pick = |(place, &index): (usize, &i64)| {
        let entry = usize::try_from(index).ok().and_then(|i| entries.get(i));
        entry.copied().ok_or_else(|| {
            format!(
                "its index {place} is {index}; it has {} entries",
                entries.len()
            )
        })
    };
    indices.iter().enumerate().map(pick).collect()
}
