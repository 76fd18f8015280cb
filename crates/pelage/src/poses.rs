//! Where the posed surface and the posed guides of each frame come from.

use crate::load::read_guides;
use pelage_curves::Vec3;
use pelage_groom::recipe::{Recipe, RecipeError};
use pelage_groom::{PlanError, Pose};
use pelage_io::{ReadError, mesh_frames, read_curves, read_mesh};
use pelage_surface::{Mesh, PolygonMesh};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// How `surface.posed` or `guides.posed` names its poses.
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
    /// Reads `path` as one pose of a mesh, a `####` sequence or a file with time samples.
    pub fn of_mesh(path: &Path) -> Result<Self, ReadError> {
        Self::new(path, |path| Ok(mesh_frames(path)?.len()))
    }

    /// The same of guides.
    pub fn of_guides(path: &Path) -> Result<Self, ReadError> {
        Self::new(path, |path| {
            let sets = read_curves(path, None)?.sets;
            Ok(sets.iter().map(|set| set.frames.len()).max().unwrap_or(0))
        })
    }

    fn new(
        path: &Path,
        samples: impl FnOnce(&Path) -> Result<usize, ReadError>,
    ) -> Result<Self, ReadError> {
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
        let (samples, path) = (samples(path)?, path.to_owned());
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
    pub fn polygons(&self, frame: f64) -> Result<Option<PolygonMesh>, ReadError> {
        match self.path(frame) {
            None => Ok(None),
            Some(path) => Ok(Some(read_mesh(&path, self.time(frame))?.mesh)),
        }
    }
}

/// What a groom has of one kind in each frame, the last one kept.
#[derive(Debug)]
struct Frames<T> {
    source: PoseSource,
    last: Option<(PathBuf, Option<f64>, Arc<T>)>,
}

impl<T> Frames<T> {
    fn new(source: PoseSource) -> Self {
        Self { source, last: None }
    }

    /// That of `frame`, which `read` takes from a file at a time; `None` at rest.
    fn at(
        &mut self,
        frame: f64,
        read: impl FnOnce(&Path, Option<f64>) -> Result<T, RecipeError>,
    ) -> Result<Option<Arc<T>>, RecipeError> {
        let Some(path) = self.source.path(frame) else {
            return Ok(None);
        };
        let time = self.source.time(frame);
        if let Some((last, at, kept)) = &self.last
            && *last == path
            && *at == time
        {
            return Ok(Some(kept.clone()));
        }
        let found = Arc::new(read(&path, time)?);
        self.last = Some((path, time, found.clone()));
        Ok(Some(found))
    }
}

/// Loads the poses of a groom, keeping the last one.
#[derive(Debug)]
pub struct PoseFiles {
    surface: Frames<Mesh>,
    guides: Frames<Vec<Vec<Vec3>>>,
    keep_file_normals: bool,
}

impl PoseFiles {
    /// Poses of a surface and of guides; see [`Mesh::posed`] for `keep_file_normals`.
    pub fn new(surface: PoseSource, guides: PoseSource, keep_file_normals: bool) -> Self {
        Self {
            surface: Frames::new(surface),
            guides: Frames::new(guides),
            keep_file_normals,
        }
    }

    /// The key that has a pose for each frame, if one has.
    pub fn animated_key(&self) -> Option<&'static str> {
        let sources = [
            ("surface.posed", &self.surface.source),
            ("guides.posed", &self.guides.source),
        ];
        let animated = sources.iter().find(|(_, source)| source.is_animated());
        animated.map(|(key, _)| *key)
    }

    /// The surface of `rest` at frame `frame`; `None` is the rest pose itself.
    pub fn surface(
        &mut self,
        recipe: &Recipe,
        rest: &Mesh,
        frame: f64,
    ) -> Result<Option<Arc<Mesh>>, RecipeError> {
        let keep_file_normals = self.keep_file_normals;
        let at_key = |message: String| recipe.error_at("surface.posed", message);
        self.surface.at(frame, |path, time| {
            let polygons = read_mesh(path, time).map_err(|e| at_key(e.to_string()))?;
            let posed = rest.posed(&polygons.mesh, keep_file_normals);
            posed.map_err(|error| {
                let path = path.to_owned();
                at_key(PlanError::Pose { path, error }.to_string())
            })
        })
    }

    /// The pose of frame `frame`, with the surface of `rest`.
    pub fn pose(&mut self, recipe: &Recipe, rest: &Mesh, frame: f64) -> Result<Pose, RecipeError> {
        let guides = self.guides.at(frame, |path, time| {
            read_guides(path, time).map_err(|e| recipe.error_at("guides.posed", e.to_string()))
        })?;
        Ok(Pose {
            surface: self.surface(recipe, rest, frame)?,
            guides,
            time: frame,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sequence_counts_with_leading_zeros() {
        let source = PoseSource::of_mesh("a/body.####.obj".as_ref()).unwrap();
        assert_eq!(source.path(7.0), Some("a/body.0007.obj".into()));
        assert_eq!(source.path(12345.0), Some("a/body.12345.obj".into()));
        assert!(source.is_animated());
    }
}
