//! glTF 2.0 meshes: `.gltf` and `.glb`.
//!
//! Source: Khronos, "glTF 2.0 Specification" (2021). Crate `gltf` parses the JSON;
//! every index, offset and count in it is checked here, because the crate's own
//! validation panics on a POSITION accessor that does not exist and never asks
//! whether the buffers are long enough.
//!
//! Limits: skins, morph targets, sparse and compressed accessors are not applied;
//! the latter two are refused. Of several scenes the default one counts.

use crate::gltf_buffers::Buffers;
use crate::source::read_bytes;
use crate::{Blame, ReadError};
use glam::{DMat3, DMat4, DQuat, DVec3};
use gltf::Gltf;
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::scene::Node;
use gltf::json::validation::Checked;
use gltf::json::{Index, Root};
use pelage_surface::PolygonMesh;
use std::path::Path;

/// The triangles of all meshes of the default scene of `path`, in its world space
/// (metres, +Y up), node after node.
///
/// Texture coordinates are the first set, turned to a lower-left origin. They, and
/// likewise normals, are kept only where every triangle has them: half an attribute
/// is none. External buffers are read from files beside `path`.
pub fn read_gltf_mesh(path: &Path) -> Result<PolygonMesh, ReadError> {
    parse_gltf_mesh(&read_bytes(path)?, path)
}

/// Like [`read_gltf_mesh`], of `bytes`; `path` names them in errors and tells where
/// to look for external buffers.
pub fn parse_gltf_mesh(bytes: &[u8], path: &Path) -> Result<PolygonMesh, ReadError> {
    // The decoder subtracts the header's size from the length it states.
    if bytes.starts_with(b"glTF") && u32_at(bytes, 8).is_none_or(|length| length < 20) {
        return Err(ReadError::file(path, "the GLB header is cut short"));
    }
    let gltf = Gltf::from_slice_without_validation(bytes)
        .map_err(|error| ReadError::file(path, error.to_string()))?;
    let root = gltf.document.as_json();
    refuse_unknown_extensions(root, path)?;
    let buffers = Buffers::new(root, gltf.blob.as_deref(), path);
    let mut builder = Builder {
        root,
        path,
        work_left: WORK_PER_BYTE
            .saturating_mul(bytes.len() as u64)
            .max(LEAST_WORK),
        buffers,
        mesh: PolygonMesh::default(),
        all_uvs: true,
        all_normals: true,
    };
    builder.walk()?;
    builder.finish()
}

fn u32_at(bytes: &[u8], at: usize) -> Option<u32> {
    let bytes = bytes.get(at..at + 4)?;
    Some(u32::from_le_bytes(bytes.try_into().ok()?))
}

/// Extensions that a file may require without changing its triangles.
fn is_harmless(extension: &str) -> bool {
    let prefixes = ["KHR_materials_", "KHR_texture_", "EXT_texture_"];
    extension == "KHR_mesh_quantization"
        || extension == "KHR_lights_punctual"
        || prefixes.iter().any(|prefix| extension.starts_with(prefix))
}

fn refuse_unknown_extensions(root: &Root, path: &Path) -> Result<(), ReadError> {
    match root.extensions_required.iter().find(|e| !is_harmless(e)) {
        None => Ok(()),
        Some(extension) => {
            let short: String = extension.chars().take(60).collect();
            let message = format!("the file requires extension {short}, which is not read");
            Err(ReadError::unsupported(path, message).help("export without it"))
        }
    }
}

/// Vertices and indices a scene may have, for each byte of its file: an index takes
/// a byte or more, so this lets every mesh be repeated four times at least.
const WORK_PER_BYTE: u64 = 4;
/// What any file, however small, may have: a million costs 24 MB.
const LEAST_WORK: u64 = 1 << 20;
/// What a primitive costs besides its vertices and indices, in the same unit.
const WORK_PER_PRIMITIVE: u64 = 16;

struct Builder<'a> {
    root: &'a Root,
    path: &'a Path,
    buffers: Buffers<'a>,
    /// What may still be added. Nodes can repeat one mesh without end; this keeps
    /// the result a small factor of the file.
    work_left: u64,
    mesh: PolygonMesh,
    all_uvs: bool,
    all_normals: bool,
}

impl<'a> Builder<'a> {
    /// Visits every node of the scene once, parents before children.
    fn walk(&mut self) -> Result<(), ReadError> {
        let mut seen = vec![false; self.root.nodes.len()];
        let mut stack: Vec<_> = self
            .scene_nodes()?
            .into_iter()
            .rev()
            .map(|node| (node, DMat4::IDENTITY))
            .collect();
        while let Some((index, world_from_parent)) = stack.pop() {
            let place = format!("nodes[{index}]");
            let Some(node) = self.root.nodes.get(index) else {
                return Err(self.error(&place, "this node does not exist"));
            };
            if std::mem::replace(&mut seen[index], true) {
                return Err(self.error(&place, "this node is reached twice; nodes form a tree"));
            }
            let world_from_node = world_from_parent * parent_from_node(node);
            if !world_from_node.is_finite() {
                return Err(self.error(&place, "its transform is not finite"));
            }
            if let Some(mesh) = node.mesh {
                self.add_mesh(mesh.value(), world_from_node)?;
            }
            let children = node.children.iter().flatten().rev();
            stack.extend(children.map(|child| (child.value(), world_from_node)));
        }
        Ok(())
    }

    /// Top nodes of the default scene; without scenes, nodes that are no children.
    fn scene_nodes(&self) -> Result<Vec<usize>, ReadError> {
        let first = (!self.root.scenes.is_empty()).then_some(0);
        if let Some(index) = self.root.scene.map(|scene| scene.value()).or(first) {
            let place = format!("scenes[{index}]");
            let scene = self
                .root
                .scenes
                .get(index)
                .ok_or_else(|| self.error(&place, "this scene does not exist"))?;
            return Ok(scene.nodes.iter().map(Index::value).collect());
        }
        let mut is_child = vec![false; self.root.nodes.len()];
        for child in self
            .root
            .nodes
            .iter()
            .flat_map(|n| n.children.iter().flatten())
        {
            if let Some(is_child) = is_child.get_mut(child.value()) {
                *is_child = true;
            }
        }
        Ok((0..is_child.len()).filter(|&i| !is_child[i]).collect())
    }

    fn add_mesh(&mut self, index: usize, world_from_node: DMat4) -> Result<(), ReadError> {
        let Some(mesh) = self.root.meshes.get(index) else {
            let place = format!("meshes[{index}]");
            return Err(self.error(&place, "this mesh does not exist"));
        };
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            let place = format!("meshes[{index}].primitives[{p}]");
            self.add_primitive(primitive, world_from_node, &place)?;
        }
        Ok(())
    }

    fn add_primitive(
        &mut self,
        primitive: &Primitive,
        world_from_node: DMat4,
        place: &str,
    ) -> Result<(), ReadError> {
        self.spend(WORK_PER_PRIMITIVE, place)?;
        let triangles: fn(&[u32]) -> Vec<[u32; 3]> = match primitive.mode {
            Checked::Valid(Mode::Triangles) => list_triangles,
            Checked::Valid(Mode::TriangleStrip) => strip_triangles,
            Checked::Valid(Mode::TriangleFan) => fan_triangles,
            Checked::Valid(_) => return Ok(()),
            Checked::Invalid => return Err(self.error(place, "an unknown mode")),
        };
        let attribute = |semantic| primitive.attributes.get(&Checked::Valid(semantic)).copied();
        let Some(positions) = attribute(Semantic::Positions) else {
            return Err(self.error(place, "it has no POSITION"));
        };
        let counts = [Some(positions), primitive.indices].into_iter().flatten();
        let cost = counts.map(|accessor| self.buffers.count(accessor)).sum();
        self.spend(cost, place)?;
        let positions = self.buffers.vectors::<3>(positions, place, "POSITION")?;
        let indices = match primitive.indices {
            Some(accessor) => self.buffers.indices(accessor, place)?,
            None => (0..positions.len() as u32).collect(),
        };
        if let Some(index) = indices.iter().find(|&&i| i as usize >= positions.len()) {
            let message = format!("index {index} of {} vertices", positions.len());
            return Err(self.error(place, &message));
        }
        if indices.len() % 3 != 0 && primitive.mode == Checked::Valid(Mode::Triangles) {
            let message = format!("{} indices are no triangles", indices.len());
            return Err(self.error(place, &message));
        }
        let mut triangles = triangles(&indices);
        if DMat3::from_mat4(world_from_node).determinant() < 0.0 {
            // A mirror turns triangles inside out (specification, 3.7.4).
            triangles
                .iter_mut()
                .for_each(|triangle| triangle.swap(1, 2));
        }
        let normals = attribute(Semantic::Normals);
        let uvs = attribute(Semantic::TexCoords(0));
        self.add_normals(normals, &triangles, positions.len(), world_from_node, place)?;
        self.add_uvs(uvs, &triangles, positions.len(), place)?;
        self.add_triangles(&positions, &triangles, world_from_node, place)
    }

    fn add_triangles(
        &mut self,
        positions: &[[f32; 3]],
        triangles: &[[u32; 3]],
        world_from_node: DMat4,
        place: &str,
    ) -> Result<(), ReadError> {
        let base = self.mesh.positions.len();
        if base + positions.len() > u32::MAX as usize {
            return Err(self.too_large(place));
        }
        for position in positions {
            let world = world_from_node.transform_point3(DVec3::from(position.map(f64::from)));
            self.mesh.positions.push(world.as_vec3().to_array());
        }
        self.mesh.face_sizes.extend(triangles.iter().map(|_| 3));
        let corners = triangles.as_flattened().iter();
        self.mesh
            .corner_vertices
            .extend(corners.map(|&i| base as u32 + i));
        Ok(())
    }

    fn add_normals(
        &mut self,
        accessor: Option<Index<gltf::json::Accessor>>,
        triangles: &[[u32; 3]],
        vertices: usize,
        world_from_node: DMat4,
        place: &str,
    ) -> Result<(), ReadError> {
        let Some(accessor) = accessor.filter(|_| self.all_normals) else {
            self.all_normals &= triangles.is_empty();
            return Ok(());
        };
        let normals = self.buffers.vectors::<3>(accessor, place, "NORMAL")?;
        self.check_count(normals.len(), vertices, place, "NORMAL")?;
        let world_from_normal = cofactors(DMat3::from_mat4(world_from_node));
        let world: Vec<_> = normals
            .iter()
            .map(|n| world_from_normal * DVec3::from(n.map(f64::from)))
            .map(|n| n.normalize_or_zero().as_vec3().to_array())
            .collect();
        let corners = triangles.as_flattened().iter();
        self.mesh
            .corner_normals
            .extend(corners.map(|&i| world[i as usize]));
        Ok(())
    }

    fn add_uvs(
        &mut self,
        accessor: Option<Index<gltf::json::Accessor>>,
        triangles: &[[u32; 3]],
        vertices: usize,
        place: &str,
    ) -> Result<(), ReadError> {
        let Some(accessor) = accessor.filter(|_| self.all_uvs) else {
            self.all_uvs &= triangles.is_empty();
            return Ok(());
        };
        let uvs = self.buffers.vectors::<2>(accessor, place, "TEXCOORD_0")?;
        self.check_count(uvs.len(), vertices, place, "TEXCOORD_0")?;
        let corners = triangles.as_flattened().iter();
        self.mesh.corner_uvs.extend(corners.map(|&i| {
            let [u, v] = uvs[i as usize];
            [u, 1.0 - v]
        }));
        Ok(())
    }

    fn check_count(
        &self,
        found: usize,
        vertices: usize,
        place: &str,
        name: &str,
    ) -> Result<(), ReadError> {
        if found == vertices {
            return Ok(());
        }
        let message = format!("{found} entries of {name} for {vertices} vertices");
        Err(self.error(place, &message))
    }

    fn spend(&mut self, work: u64, place: &str) -> Result<(), ReadError> {
        self.work_left = self
            .work_left
            .checked_sub(work)
            .ok_or_else(|| self.too_large(place))?;
        Ok(())
    }

    fn too_large(&self, place: &str) -> ReadError {
        let message = "the nodes repeat their meshes too often for one surface";
        ReadError::new(self.path, Blame::Limit, message).at(place)
    }

    fn error(&self, place: &str, message: &str) -> ReadError {
        ReadError::file(self.path, message).at(place)
    }

    fn finish(mut self) -> Result<PolygonMesh, ReadError> {
        if self.mesh.face_sizes.is_empty() {
            let message = "there is no triangle in the scene";
            return Err(ReadError::file(self.path, message));
        }
        if !self.all_normals {
            self.mesh.corner_normals = Vec::new();
        }
        if !self.all_uvs {
            self.mesh.corner_uvs = Vec::new();
        }
        Ok(self.mesh)
    }
}

/// The matrix by which normals turn: the inverse transpose times the determinant's
/// absolute value, which exists where the inverse does not.
fn cofactors(m: DMat3) -> DMat3 {
    let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis];
    let sign = if m.determinant() < 0.0 { -1.0 } else { 1.0 };
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign
}

fn parent_from_node(node: &Node) -> DMat4 {
    if let Some(matrix) = node.matrix {
        return DMat4::from_cols_array(&matrix.map(f64::from));
    }
    let vector =
        |v: Option<[f32; 3]>, default| v.map_or(default, |v| DVec3::from(v.map(f64::from)));
    let rotation = node.rotation.map_or(DQuat::IDENTITY, |rotation| {
        let rotation = DQuat::from_array(rotation.0.map(f64::from));
        match rotation.length_squared() > 0.0 {
            true => rotation.normalize(),
            false => DQuat::IDENTITY,
        }
    });
    DMat4::from_scale_rotation_translation(
        vector(node.scale, DVec3::ONE),
        rotation,
        vector(node.translation, DVec3::ZERO),
    )
}

fn list_triangles(indices: &[u32]) -> Vec<[u32; 3]> {
    indices.as_chunks::<3>().0.to_vec()
}

/// Every second triangle of a strip runs backwards.
fn strip_triangles(indices: &[u32]) -> Vec<[u32; 3]> {
    let triangle = |(i, w): (usize, &[u32])| match i % 2 {
        0 => [w[0], w[1], w[2]],
        _ => [w[0], w[2], w[1]],
    };
    indices.windows(3).enumerate().map(triangle).collect()
}

fn fan_triangles(indices: &[u32]) -> Vec<[u32; 3]> {
    let Some((&centre, rim)) = indices.split_first() else {
        return Vec::new();
    };
    rim.windows(2).map(|w| [w[0], w[1], centre]).collect()
}

#[cfg(test)]
#[path = "gltf_tests.rs"]
mod tests;
