//! Writing triangle meshes: OBJ, PLY, GLB and USD, whole or not at all.

mod glb;
mod text;

use crate::{AtomicFile, usdc};
use pelage_curves::{Vec2, Vec3};
use pelage_strands::SinkError;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// A triangle mesh as arrays: positions, normals and texture coordinates a vertex.
#[derive(Clone, Copy, Debug)]
pub struct Triangles<'a> {
    /// Positions; finite.
    pub positions: &'a [Vec3],
    /// Unit normals, one a position.
    pub normals: &'a [Vec3],
    /// Texture coordinates, origin lower left, one a position.
    pub uvs: &'a [Vec2],
    /// Indices of positions, counter-clockwise from outside.
    pub triangles: &'a [[u32; 3]],
}

/// The extensions of [`write_mesh`].
pub const MESH_EXTENSIONS: [&str; 5] = ["obj", "ply", "glb", "usda", "usdc"];

/// Writes `mesh` into the file `path`, whose extension is one of [`MESH_EXTENSIONS`]. Y is up
/// and the unit is left open, where a format asks for them.
///
/// # Errors
///
/// An extension that is another, arrays that do not fit each other, or what the system says.
///
/// ```
/// use pelage_curves::{Vec2, Vec3};
/// use pelage_io::{Triangles, read_mesh, write_mesh};
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("triangle.glb");
/// let mesh = Triangles {
///     positions: &[Vec3::ZERO, Vec3::X, Vec3::Y],
///     normals: &[Vec3::Z; 3],
///     uvs: &[Vec2::ZERO, Vec2::X, Vec2::Y],
///     triangles: &[[0, 1, 2]],
/// };
/// write_mesh(&path, &mesh)?;
/// assert_eq!(read_mesh(&path, None)?.mesh.face_sizes, [3]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_mesh(path: &Path, mesh: &Triangles) -> Result<(), SinkError> {
    let name = path.display().to_string();
    let failed = |error: io::Error| SinkError::io(&name, error);
    mesh.check()
        .map_err(|message| SinkError::new(&name, message))?;
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    let write: fn(&mut dyn Write, &Triangles) -> io::Result<()> = match &*extension {
        "obj" => text::obj,
        "ply" => ply,
        "glb" => glb::glb,
        "usda" => text::usda,
        // Its tables name places in the file, which it therefore keeps for itself.
        "usdc" => return usdc::write_mesh(path, mesh).map_err(failed),
        other => {
            let known = MESH_EXTENSIONS.join(", .");
            let message = format!("meshes are not written as .{other}; there are .{known}");
            return Err(SinkError::new(&name, message));
        }
    };
    let mut file = BufWriter::new(AtomicFile::create(path).map_err(failed)?);
    write(&mut file, mesh).map_err(failed)?;
    let file = file
        .into_inner()
        .map_err(|error| failed(error.into_error()))?;
    file.commit().map_err(failed)
}

impl Triangles<'_> {
    /// The least and the greatest corner of the box around it.
    pub(crate) fn extent(&self) -> [Vec3; 2] {
        let least = self.positions.iter().copied().reduce(Vec3::min);
        let greatest = self.positions.iter().copied().reduce(Vec3::max);
        [least, greatest].map(Option::unwrap_or_default)
    }

    /// Whether the arrays fit each other.
    fn check(&self) -> Result<(), String> {
        let count = self.positions.len();
        if self.triangles.is_empty() {
            return Err("a mesh without triangles".into());
        }
        for (name, found) in [("normals", self.normals.len()), ("UVs", self.uvs.len())] {
            if found != count {
                return Err(format!("{found} {name} for {count} positions"));
            }
        }
        let mut corners = self.triangles.iter().flatten();
        match corners.find(|corner| **corner as usize >= count) {
            Some(corner) => Err(format!("a triangle names vertex {corner} of {count}")),
            None => Ok(()),
        }
    }
}

/// Binary PLY, little endian, with the names that other programs use.
fn ply(file: &mut dyn Write, mesh: &Triangles) -> io::Result<()> {
    let properties = ["x", "y", "z", "nx", "ny", "nz", "s", "t"];
    let properties: String = properties
        .iter()
        .map(|name| format!("property float {name}\n"))
        .collect();
    write!(
        file,
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n{properties}\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.positions.len(),
        mesh.triangles.len(),
    )?;
    for ((position, normal), uv) in mesh.positions.iter().zip(mesh.normals).zip(mesh.uvs) {
        let numbers = position.to_array().into_iter().chain(normal.to_array());
        for number in numbers.chain(uv.to_array()) {
            file.write_all(&number.to_le_bytes())?;
        }
    }
    for triangle in mesh.triangles {
        file.write_all(&[3])?;
        for corner in triangle {
            file.write_all(&corner.to_le_bytes())?;
        }
    }
    Ok(())
}
