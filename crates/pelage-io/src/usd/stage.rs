//! Opens a USD stage so that no file can end the process.

use super::resolver::{Guarded, layer_at, load, unsound};
use super::{arcs, names};
use crate::ReadError;
use openusd::{sdf, usd};
use pelage_strands::UpAxis;
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// Bytes of stack for composing a stage, which calls itself for every level of
/// prims and arcs.
const STACK: usize = 256 << 20;

/// Prims visited at most; references to references can multiply without end.
const MAX_PRIMS: usize = 250_000;

/// Levels of prims; a prim that inherits its parent has a child without end.
const MAX_DEPTH: usize = 64;

/// An open stage and the file it came from.
pub(super) struct Scene {
    pub(super) path: PathBuf,
    pub(super) stage: usd::Stage,
}

/// What files say about their space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Metadata {
    pub(super) up_axis: Option<UpAxis>,
    pub(super) meters_per_unit: Option<f64>,
}

/// Opens `path` and lets `read` take what it needs.
pub(super) fn with_scene<T: Send>(
    path: &Path,
    read: impl FnOnce(&Scene) -> Result<T, ReadError> + Send,
) -> Result<T, ReadError> {
    // The guards refuse what would exhaust memory or a large stack. Counts and
    // indices that contradict each other in smaller ways still make the reader
    // panic; that is the file's fault, and the stage is dropped with all it holds.
    let outcome = std::thread::scope(|scope| {
        let reader = std::thread::Builder::new().stack_size(STACK);
        match reader.spawn_scoped(scope, || read(&Scene::open(path)?)) {
            Ok(thread) => thread.join(),
            Err(error) => Ok(Err(ReadError::world(path, &error))),
        }
    });
    outcome.unwrap_or_else(|_| {
        let message = "its contents contradict each other, so it cannot be read";
        Err(ReadError::file(path, message).help("check it with usdchecker, or write it again"))
    })
}

impl Scene {
    fn open(path: &Path) -> Result<Self, ReadError> {
        // Opened by the resolver as well, but its errors would not say whose fault.
        let bytes = load(path)?;
        let absolute = std::path::absolute(path).map_err(|e| ReadError::world(path, &e))?;
        let Some(name) = absolute.to_str() else {
            return Err(ReadError::unsupported(path, "its name is not UTF-8"));
        };
        // Under the name that references to it resolve to, so that circles close.
        let place = absolute
            .canonicalize()
            .map_err(|e| ReadError::world(path, &e))?;
        let checked = arcs::check(&layer_at(&place), &bytes);
        checked.map_err(|broken| unsound(path, broken))?;
        drop(bytes);
        let resolver = Guarded::default();
        let refused = resolver.refused.clone();
        let stage = usd::Stage::builder().resolver(resolver).open(name);
        let stage = stage.map_err(|error| {
            let message = match refused.borrow_mut().take() {
                Some(message) => message,
                None => format!("no sound USD: {error:#}"),
            };
            ReadError::file(path, one_line(&message))
        })?;
        Ok(Self {
            path: path.into(),
            stage,
        })
    }

    /// An error at a place in this file.
    pub(super) fn error(&self, place: impl Display, message: impl Into<String>) -> ReadError {
        ReadError::file(&self.path, message).at(place.to_string())
    }

    /// Turns what the reader cannot decode into an error.
    pub(super) fn decoded<T>(
        &self,
        place: impl Display,
        result: Result<T, impl Display>,
    ) -> Result<T, ReadError> {
        result.map_err(|error| {
            self.error(place, one_line(&format!("it cannot be decoded: {error:#}")))
        })
    }

    /// Up axis and metres a unit, where the stage says.
    pub(super) fn metadata(&self) -> Result<Metadata, ReadError> {
        let up = self.decoded("upAxis", self.stage.stage_metadata("upAxis"))?;
        let up_axis = up.and_then(|value| match value.try_as_token()?.as_str() {
            "Y" => Some(UpAxis::Y),
            "Z" => Some(UpAxis::Z),
            _ => None,
        });
        let unit = self.stage.stage_metadata("metersPerUnit");
        let unit = match self.decoded("metersPerUnit", unit)? {
            Some(sdf::Value::Double(unit)) => Some(unit),
            _ => None,
        };
        Ok(Metadata {
            up_axis,
            meters_per_unit: unit.filter(|u| u.is_finite() && *u > 0.0),
        })
    }

    /// Paths of the prims whose type `wanted` accepts, in the order of the file:
    /// active, defined, loaded and not abstract, instances included. Left out are
    /// prims of purpose `guide` or `proxy`, and prototypes of point instancers.
    pub(super) fn prims(&self, wanted: &str) -> Result<Vec<sdf::Path>, ReadError> {
        let mut found = Vec::new();
        let mut pending = vec![sdf::Path::abs_root()];
        let mut visited = 0;
        while let Some(path) = pending.pop() {
            visited += 1;
            if visited > MAX_PRIMS {
                let message = format!("it has more than {MAX_PRIMS} prims");
                return Err(ReadError::new(&self.path, crate::Blame::Limit, message));
            }
            if path.prim_element_count() > MAX_DEPTH {
                let message =
                    format!("prims nest deeper than {MAX_DEPTH}; do they inherit themselves?");
                return Err(self.error(&path, message));
            }
            if !path.is_abs_root() {
                if !self.takes_part(&path)? {
                    continue;
                }
                let type_name = self.type_name(&path)?;
                if type_name == wanted {
                    found.push(path.clone());
                }
                if type_name == "PointInstancer" {
                    continue;
                }
            }
            let children = self.decoded(&path, self.stage.prim(path.clone()).child_names())?;
            for name in children.iter().rev() {
                // Crates list children in a field of their own, whose names are free.
                if !names::is_prim(name) {
                    return Err(self.error(&path, format!("a child cannot be named {name:?}")));
                }
                pending.push(self.decoded(&path, path.append_path(name.as_str()))?);
            }
        }
        self.unresolved()?;
        Ok(found)
    }

    fn takes_part(&self, path: &sdf::Path) -> Result<bool, ReadError> {
        use usd::PrimStatus as Status;
        let status = self.decoded(path, self.stage.prim_status(path.clone()))?;
        let needed = Status::ACTIVE | Status::LOADED | Status::DEFINED;
        if !status.contains(needed) || status.contains(Status::ABSTRACT) {
            return Ok(false);
        }
        let purpose = self.attribute(path, "purpose").get::<sdf::Value>();
        let purpose = self.decoded(path, purpose)?.and_then(|v| v.try_as_token());
        Ok(!matches!(purpose.as_deref(), Some("guide" | "proxy")))
    }

    /// Fails where a part of the scene that was met is missing or unreadable:
    /// hair on half a creature is worse than an error.
    fn unresolved(&self) -> Result<(), ReadError> {
        match self.stage.composition_errors().first() {
            Some(error) => Err(ReadError::file(&self.path, one_line(&error.to_string()))
                .help("put the file it names in place, or flatten the stage first")),
            None => Ok(()),
        }
    }

    /// Type of a prim; empty for none.
    pub(super) fn type_name(&self, path: &sdf::Path) -> Result<String, ReadError> {
        let name = self.decoded(path, self.stage.prim(path.clone()).type_name())?;
        Ok(name.map(String::from).unwrap_or_default())
    }

    /// Names of the properties of a prim. Crates list them in a field of its own, and
    /// the attributes by those names may only be asked for once they are checked.
    pub(super) fn property_names(&self, prim: &sdf::Path) -> Result<Vec<String>, ReadError> {
        let all = self.decoded(prim, self.stage.prim(prim.clone()).property_names())?;
        match all.iter().find(|name| !names::is_property(name)) {
            Some(name) => Err(self.error(prim, format!("no property can have the name {name:?}"))),
            None => Ok(all.iter().map(|name| name.to_string()).collect()),
        }
    }

    /// The attribute `name` of the prim at `path`, whether it is there or not.
    pub(super) fn attribute(&self, path: &sdf::Path, name: &str) -> usd::Attribute {
        self.stage.prim(path.clone()).attribute(name)
    }
}

/// The first line of a message; some parsers draw pictures below it.
fn one_line(message: &str) -> String {
    message.lines().next().unwrap_or_default().into()
}
