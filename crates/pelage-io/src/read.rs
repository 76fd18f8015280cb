//! Reads whatever a file holds, by what it starts with and by its extension.

use crate::{CurveFile, ReadError, read_npz_curves, usd};
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
    /// OpenUSD text or crate: meshes and curves.
    Usd,
    /// NumPy archive: curves.
    Npz,
}

impl FileKind {
    /// All formats.
    pub const ALL: [FileKind; 2] = [FileKind::Usd, FileKind::Npz];

    /// Extensions, lower case, without the dot.
    pub fn extensions(self) -> &'static [&'static str] {
        match self {
            FileKind::Usd => &["usd", "usda", "usdc"],
            FileKind::Npz => &["npz"],
        }
    }

    /// Whether the format can hold meshes.
    pub fn has_meshes(self) -> bool {
        matches!(self, FileKind::Usd)
    }

    /// Whether the format can hold curves.
    pub fn has_curves(self) -> bool {
        matches!(self, FileKind::Usd | FileKind::Npz)
    }

    fn of_extension(extension: &str) -> Option<Self> {
        let extension = extension.to_ascii_lowercase();
        let mut all = Self::ALL.into_iter();
        all.find(|kind| kind.extensions().contains(&extension.as_str()))
    }

    fn of_content(start: &[u8]) -> Option<Self> {
        if start.starts_with(b"PXR-USDC") || start.starts_with(b"#usda") {
            Some(FileKind::Usd)
        } else {
            None
        }
    }
}

impl fmt::Display for FileKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            FileKind::Usd => "USD",
            FileKind::Npz => "NumPy archive",
        })
    }
}

/// The format of `path`: by its first bytes where they tell, else by its extension.
pub fn sniff(path: &Path) -> Result<FileKind, ReadError> {
    sniff_for(path, |_| true)
}

/// Reads the meshes of `path` as one mesh, at `time` where the format has time.
///
/// Without a time animated meshes give their default, or their first sample.
pub fn read_mesh(path: &Path, time: Option<f64>) -> Result<MeshFile, ReadError> {
    match sniff_for(path, FileKind::has_meshes)? {
        FileKind::Usd => usd::read_usd_mesh(path, None, time),
        kind => Err(without(path, kind, "meshes")),
    }
}

/// Times at which the mesh of `path` is sampled, ascending; empty for a still.
pub fn mesh_frames(path: &Path) -> Result<Vec<f64>, ReadError> {
    match sniff_for(path, FileKind::has_meshes)? {
        FileKind::Usd => usd::usd_mesh_frames(path, None),
        kind if kind.has_meshes() => Ok(Vec::new()),
        kind => Err(without(path, kind, "meshes")),
    }
}

/// Reads the curves of `path`, at `time` where the format has time.
pub fn read_curves(path: &Path, time: Option<f64>) -> Result<CurveFile, ReadError> {
    match sniff_for(path, FileKind::has_curves)? {
        FileKind::Usd => usd::read_usd_curves(path, time),
        FileKind::Npz => read_npz_curves(path),
    }
}

/// As [`sniff`]; errors list the formats that are `wanted`.
fn sniff_for(path: &Path, wanted: impl Fn(FileKind) -> bool) -> Result<FileKind, ReadError> {
    let world = |error: std::io::Error| ReadError::world(path, &error);
    let metadata = std::fs::metadata(path).map_err(world)?;
    if !metadata.is_file() {
        let kind = if metadata.is_dir() {
            "folder"
        } else {
            "device"
        };
        return Err(world(std::io::Error::other(format!(
            "it is a {kind}, not a file"
        ))));
    }
    let mut start = Vec::new();
    let file = std::fs::File::open(path).map_err(world)?;
    file.take(16).read_to_end(&mut start).map_err(world)?;
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

fn without(path: &Path, kind: FileKind, what: &str) -> ReadError {
    let readable = extensions(FileKind::has_meshes);
    ReadError::unsupported(path, format!("a {kind} file holds no {what}"))
        .help(format!("meshes are read from {readable}"))
}
