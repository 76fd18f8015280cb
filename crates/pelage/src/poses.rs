//! Where the posed surface of each frame comes from.

use pelage_groom::PlanError;
use pelage_groom::recipe::{Recipe, RecipeError};
use pelage_io::{mesh_frames, read_mesh};
use pelage_surface::{Mesh, PolygonMesh};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// How `surface.posed` names its poses.
#[derive(Clone, Debug, PartialEq)]
pub enum PoseSource {
    /// The rest pose is the only one.
    Rest,
    /// One pose for every frame.
    File(PathBuf),
    /// A file a frame: the text before and after the digits, and how many there are
    /// at least.
    Sequence {
        /// Path up to the digits.
        before: String,
        /// Path after the digits.
        after: String,
        /// Digits, filled with zeros.
        digits: usize,
    },
    /// A file with time samples.
    Samples(PathBuf),
}

impl PoseSource {
    /// Reads `path` as one pose, a `####` sequence or a file with time samples.
    pub fn new(path: &Path) -> Result<Self, pelage_io::ReadError> {
        let text = path.to_string_lossy();
        if let Some(first) = text.find('#') {
            let digits = text[first..].chars().take_while(|&c| c == '#').count();
            let (before, after) = (text[..first].into(), text[first + digits..].into());
            return Ok(PoseSource::Sequence {
                before,
                after,
                digits,
            });
        }
        let samples = mesh_frames(path)?.len();
        let path = path.to_owned();
        Ok(if samples > 1 {
            PoseSource::Samples(path)
        } else {
            PoseSource::File(path)
        })
    }

    /// Whether different frames have different poses.
    pub fn is_animated(&self) -> bool {
        matches!(self, PoseSource::Sequence { .. } | PoseSource::Samples(_))
    }

    /// The file of frame `frame`; `None` for the rest pose.
    pub fn path(&self, frame: f64) -> Option<PathBuf> {
        match self {
            PoseSource::Rest => None,
            PoseSource::File(path) | PoseSource::Samples(path) => Some(path.clone()),
            PoseSource::Sequence {
                before,
                after,
                digits,
            } => Some(format!("{before}{:0digits$}{after}", frame as i64).into()),
        }
    }

    fn time(&self, frame: f64) -> Option<f64> {
        matches!(self, PoseSource::Samples(_)).then_some(frame)
    }

    /// The polygons of frame `frame`; `None` for the rest pose.
    pub fn polygons(&self, frame: f64) -> Result<Option<PolygonMesh>, pelage_io::ReadError> {
        match self.path(frame) {
            None => Ok(None),
            Some(path) => Ok(Some(read_mesh(&path, self.time(frame))?.mesh)),
        }
    }
}

/// Loads the poses of a groom, keeping the last one.
#[derive(Debug)]
pub struct PoseFiles {
    source: PoseSource,
    keep_file_normals: bool,
    last: Option<(PathBuf, Option<f64>, Arc<Mesh>)>,
}

impl PoseFiles {
    /// Poses of `source`; see [`Mesh::posed`] for `keep_file_normals`.
    pub fn new(source: PoseSource, keep_file_normals: bool) -> Self {
        Self {
            source,
            keep_file_normals,
            last: None,
        }
    }

    /// How the poses are named.
    pub fn source(&self) -> &PoseSource {
        &self.source
    }

    /// The surface of `rest` at frame `frame`; `None` is the rest pose itself.
    pub fn pose(
        &mut self,
        recipe: &Recipe,
        rest: &Mesh,
        frame: f64,
    ) -> Result<Option<Arc<Mesh>>, RecipeError> {
        let Some(path) = self.source.path(frame) else {
            return Ok(None);
        };
        let time = self.source.time(frame);
        if let Some((last, at, mesh)) = &self.last
            && *last == path
            && *at == time
        {
            return Ok(Some(mesh.clone()));
        }
        let at_key = |message: String| recipe.error_at("surface.posed", message);
        let polygons = read_mesh(&path, time)
            .map_err(|e| at_key(e.to_string()))?
            .mesh;
        let mesh = rest
            .posed(&polygons, self.keep_file_normals)
            .map_err(|error| {
                at_key(
                    PlanError::Pose {
                        path: path.clone(),
                        error,
                    }
                    .to_string(),
                )
            })?;
        let mesh = Arc::new(mesh);
        self.last = Some((path, time, mesh.clone()));
        Ok(Some(mesh))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sequence_counts_with_leading_zeros() {
        let source = PoseSource::new("a/body.####.obj".as_ref()).unwrap();
        assert_eq!(source.path(7.0), Some("a/body.0007.obj".into()));
        assert_eq!(source.path(12345.0), Some("a/body.12345.obj".into()));
        assert!(source.is_animated());
    }
}
