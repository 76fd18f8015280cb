//! The direction grown guides lean in: one vector, or a map of directions.

use std::path::Path;

use schemars::{Schema, SchemaGenerator};
use serde::ser::{Serialize, SerializeMap, Serializer};
use toml::Spanned;
use toml::de::DeValue;

use super::embed::deserialize;
use super::entry::{Entry, Leaf, Rule};
use super::limits::Limits;
use super::map::{Blend, MapUse};
use super::number;
use super::path::FilePath;
use super::reader::{Reader, join};

/// What an error says a comb may be.
const EXPECTED: &str = "a direction [x, y, z], not all 0, or { map = \"comb.png\" }";

/// The keys of the table form.
const KEYS: &[&str] = &["map", "wrap", "space"];

/// The direction that guides lean in.
#[derive(Clone, Debug, PartialEq)]
pub enum Comb {
    /// A direction in the object space of the mesh, of any length but 0. What
    /// counts at a root is its part in the tangent plane; where that vanishes,
    /// the tangent along +u.
    Vector([f32; 3]),
    /// A map whose first two channels c hold, as 2c − 1, the parts of the
    /// direction along the tangent (+u) and the binormal (tangent × normal).
    /// Read as linear unless it says otherwise; 0.5, 0.5 is no direction.
    Map(MapUse),
}

impl Default for Comb {
    fn default() -> Self {
        Self::Vector([1.0, 0.0, 0.0])
    }
}

impl Comb {
    fn read_vector(
        value: &Spanned<DeValue<'_>>,
        key: &str,
        reader: &mut Reader<'_>,
    ) -> Option<[f32; 3]> {
        let items = number::list::<3>(value, key, EXPECTED, reader)?;
        let mut vector = [0.0; 3];
        for (i, item) in items.into_iter().enumerate() {
            let name = format!("{key}[{i}]");
            vector[i] = number::number(item, &name, Limits::ANY, reader)? as f32;
        }
        if vector == [0.0; 3] {
            reader.out_of_range(key, value, EXPECTED.to_owned());
            return None;
        }
        Some(vector)
    }
}

impl Entry for Comb {
    fn read(&mut self, value: &Spanned<DeValue<'_>>, key: &str, _: Rule, reader: &mut Reader<'_>) {
        let Some(table) = value.get_ref().as_table() else {
            if let Some(vector) = Self::read_vector(value, key, reader) {
                *self = Self::Vector(vector);
            }
            return;
        };
        let standard = MapUse::new(FilePath::default(), None, Blend::Multiply);
        let map = MapUse::read(table, key, standard, KEYS, reader);
        reader.refuse_others(table, key, KEYS);
        match map {
            Some(map) => *self = Self::Map(map),
            None => reader.missing(&join(key, "map"), value.span(), Some("a map of directions")),
        }
    }

    fn schema(&self, _: Rule, _: &mut SchemaGenerator) -> Schema {
        schemars::json_schema!({
            "anyOf": [
                {
                    "type": "array",
                    "items": { "type": "number" },
                    "minItems": 3,
                    "maxItems": 3,
                },
                {
                    "type": "object",
                    "properties": {
                        "map": { "$ref": "#/$defs/image" },
                        "wrap": { "$ref": "#/$defs/wrap" },
                        "space": { "$ref": "#/$defs/space" },
                    },
                    "required": ["map"],
                    "additionalProperties": false,
                },
            ],
        })
    }

    fn walk<'a>(&'a self, key: &str, doc: &'static str, visit: &mut dyn FnMut(Leaf<'a>)) {
        let maps = match self {
            Self::Vector(_) => vec![],
            Self::Map(map) => vec![(key.to_owned(), map)],
        };
        visit(Leaf {
            maps,
            ..Leaf::of(key, self, doc)
        });
    }

    fn settle(&mut self, folder: &Path) {
        if let Self::Map(map) = self {
            map.path.settle(folder);
        }
    }
}

impl Serialize for Comb {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Vector(vector) => vector.serialize(serializer),
            Self::Map(map) => {
                let mut table = serializer.serialize_map(None)?;
                map.write(None, Blend::Multiply, &mut table)?;
                table.end()
            }
        }
    }
}

deserialize!(Comb, Rule::ANY);
