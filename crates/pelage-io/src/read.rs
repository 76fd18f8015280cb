//! Reads whatever a file holds, by what it starts with and by its extension.

use crate::source::open_file;
use crate::super_helices::{curve_file, is_json};
use crate::{CurveFile, ReadError, read_npz_curves, usd};
use crate::{
    read_gltf_mesh, read_hair, read_obj_curves, read_obj_mesh, read_ply_mesh, read_super_helices,
};
use pelage_strands::UpAxis;
use pelage_surface::PolygonMesh;
use std::fmt;
use std::io::Read;
use std::path::Path;

/// A mesh, and the space it is in.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshFile {
    /// All meshes of the file as one, in world space.
    pub mesh: PolygonMesh,
    /// Up axis, where the file tells.
    pub up_axis: Option<UpAxis>,
    /// Metres a unit, where the file tells.
    pub meters_per_unit: Option<f64>,
}

/// A format that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FileKind {
    /// OpenUSD text, crate or package of them: meshes and curves.
    Usd,
    /// Wavefront OBJ: meshes and polylines.
    Obj,
    /// Stanford PLY: meshes.
    Ply,
    /// glTF text or binary: meshes.
    Gltf,
    /// Cem Yuksel's hair files: curves.
    Hair,
    /// NumPy archive: curves.
    Npz,
    /// Super-Helices as JSON: the curves that they decode to.
    SuperHelices,
}

impl FileKind {
    /// All formats.
    pub const ALL: [FileKind; 7] = [
        FileKind::Usd,
        FileKind::Obj,
        FileKind::Ply,
        FileKind::Gltf,
        FileKind::Hair,
        FileKind::Npz,
        FileKind::SuperHelices,
    ];

    /// Extensions, lower case, without the dot.
    pub fn extensions(self) -> &'static [&'static str] {
        match self {
            FileKind::Usd => &["usd", "usda", "usdc", "usdz"],
            FileKind::Obj => &["obj"],
            FileKind::Ply => &["ply"],
            FileKind::Gltf => &["gltf", "glb"],
            FileKind::Hair => &["hair"],
            FileKind::Npz => &["npz"],
            FileKind::SuperHelices => &["json"],
        }
    }

    /// Whether the format can hold meshes.
    pub fn has_meshes(self) -> bool {
        matches!(
            self,
            FileKind::Usd | FileKind::Obj | FileKind::Ply | FileKind::Gltf
        )
    }

    /// Whether the format can hold curves.
    pub fn has_curves(self) -> bool {
        matches!(
            self,
            FileKind::Usd | FileKind::Obj | FileKind::Hair | FileKind::Npz | FileKind::SuperHelices
        )
    }

    fn of_extension(extension: &str) -> Option<Self> {
        let extension = extension.to_ascii_lowercase();
        let mut all = Self::ALL.into_iter();
        all.find(|kind| kind.extensions().contains(&extension.as_str()))
    }

    fn of_content(start: &[u8]) -> Option<Self> {
        let magics: [(&[u8], FileKind); 6] = [
            (b"PXR-USDC", FileKind::Usd),
            (b"#usda", FileKind::Usd),
            (b"ply\n", FileKind::Ply),
            (b"ply\r", FileKind::Ply),
            (b"glTF", FileKind::Gltf),
            (b"HAIR", FileKind::Hair),
        ];
        let found = magics.iter().find(|(magic, _)| start.starts_with(magic));
        let found = found.map(|(_, kind)| *kind);
        found.or_else(|| is_json(start).then_some(FileKind::SuperHelices))
    }
}

impl fmt::Display for FileKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            FileKind::Usd => "USD",
            FileKind::Obj => "OBJ",
            FileKind::Ply => "PLY",
            FileKind::Gltf => "glTF",
            FileKind::Hair => "hair file",
            FileKind::Npz => "NumPy archive",
            FileKind::SuperHelices => "Super-Helices",
        })
    }
}

/// Bytes at the start of a file that may tell what it is.
const START: u64 = 64;

/// The format of `path`: by its first bytes where they tell, else by its extension.
pub fn sniff(path: &Path) -> Result<FileKind, ReadError> {
    sniff_for(path, |_| true)
}

/// Reads the meshes of `path` as one mesh, at `time` where the format has time.
///
/// Without a time animated meshes give their default, or their first sample.
pub fn read_mesh(path: &Path, time: Option<f64>) -> Result<MeshFile, ReadError> {
    let mesh = match sniff_for(path, FileKind::has_meshes)? {
        FileKind::Usd => return usd::read_usd_mesh(path, None, time),
        FileKind::Obj => read_obj_mesh(path)?,
        FileKind::Ply => read_ply_mesh(path)?,
        // glTF fixes both: metres, Y up.
        FileKind::Gltf => {
            return Ok(MeshFile {
                mesh: read_gltf_mesh(path)?,
                up_axis: Some(UpAxis::Y),
                meters_per_unit: Some(1.0),
            });
        }
        kind => return Err(without(path, kind, "meshes", FileKind::has_meshes)),
    };
    Ok(MeshFile {
        mesh,
        ..MeshFile::default()
    })
}

/// Times at which the mesh of `path` is sampled, ascending; empty for a still.
pub fn mesh_frames(path: &Path) -> Result<Vec<f64>, ReadError> {
    match sniff_for(path, FileKind::has_meshes)? {
        FileKind::Usd => usd::usd_mesh_frames(path, None),
        kind if kind.has_meshes() => Ok(Vec::new()),
        kind => Err(without(path, kind, "meshes", FileKind::has_meshes)),
    }
}

/// Reads the curves of `path`, at `time` where the format has time.
pub fn read_curves(path: &Path, time: Option<f64>) -> Result<CurveFile, ReadError> {
    match sniff_for(path, FileKind::has_curves)? {
        FileKind::Usd => usd::read_usd_curves(path, time),
        FileKind::Obj => read_obj_curves(path),
        FileKind::Hair => read_hair(path),
        FileKind::Npz => read_npz_curves(path, time),
        FileKind::SuperHelices => Ok(curve_file(path, &read_super_helices(path)?)),
        kind => Err(without(path, kind, "curves", FileKind::has_curves)),
    }
}

/// As [`sniff`]; errors list the formats that are `wanted`.
fn sniff_for(path: &Path, wanted: impl Fn(FileKind) -> bool) -> Result<FileKind, ReadError> {
    let mut start = Vec::new();
    let mut file = open_file(path)?.take(START);
    let read = file.read_to_end(&mut start);
    read.map_err(|error| ReadError::world(path, &error))?;
    let extension = path.extension().map(|e| e.to_string_lossy().into_owned());
    let extension = extension.unwrap_or_default();
    let kind = FileKind::of_content(&start).or_else(|| FileKind::of_extension(&extension));
    kind.ok_or_else(|| {
        let message = match extension.as_str() {
            "" => "it has no extension, and its contents do not tell what it is".into(),
            extension => format!(".{extension} is not read"),
        };
        ReadError::unsupported(path, message).help(format!("read are {}", extensions(wanted)))
    })
}

/// The extensions of the formats that are `wanted`, as text.
fn extensions(wanted: impl Fn(FileKind) -> bool) -> String {
    let kinds = FileKind::ALL.into_iter().filter(|kind| wanted(*kind));
    let all = kinds.flat_map(|kind| kind.extensions());
    let dotted: Vec<String> = all.map(|extension| format!(".{extension}")).collect();
    dotted.join(", ")
}

/// The error that a format never holds what is `wanted` of it.
fn without(
    path: &Path,
    kind: FileKind,
    what: &str,
    wanted: impl Fn(FileKind) -> bool,
) -> ReadError {
    ReadError::unsupported(path, format!("a file of the kind {kind} holds no {what}"))
        .help(format!("{what} are read from {}", extensions(wanted)))
}
