//! The image that tells groups apart.

use std::ops::Deref;
use std::path::Path;

use schemars::{Schema, SchemaGenerator};
use serde::{Serialize, Serializer};
use toml::Spanned;
use toml::de::DeValue;

use super::embed::deserialize;
use super::entry::{Entry, Leaf, Rule};
use super::map::{Blend, MapUse};
use super::path::FilePath;
use super::reader::Reader;

/// A map read by its codes: no filtering, no change of colour space. A recipe
/// writes its path alone; it repeats outside 0..1.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupMap(MapUse);

impl GroupMap {
    /// The group map at `path`.
    pub fn new(path: FilePath) -> Self {
        Self(MapUse::new(path, None, Blend::Multiply))
    }
}

impl Default for GroupMap {
    fn default() -> Self {
        Self::new(FilePath::default())
    }
}

impl Deref for GroupMap {
    type Target = MapUse;

    fn deref(&self) -> &MapUse {
        &self.0
    }
}

impl Entry for GroupMap {
    fn read(
        &mut self,
        value: &Spanned<DeValue<'_>>,
        key: &str,
        rule: Rule,
        reader: &mut Reader<'_>,
    ) {
        self.0.path.read(value, key, rule, reader);
    }

    fn schema(&self, rule: Rule, generator: &mut SchemaGenerator) -> Schema {
        self.0.path.schema(rule, generator)
    }

    fn walk<'a>(&'a self, key: &str, doc: &'static str, visit: &mut dyn FnMut(Leaf<'a>)) {
        visit(Leaf {
            maps: vec![(key.to_owned(), &self.0)],
            ..Leaf::of(key, self, doc)
        });
    }

    fn settle(&mut self, folder: &Path) {
        self.0.path.settle(folder);
    }
}

impl Serialize for GroupMap {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.path.serialize(serializer)
    }
}

deserialize!(GroupMap, Rule::ANY);
