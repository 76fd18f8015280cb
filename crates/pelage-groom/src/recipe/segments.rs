//! Segments a hair, for all hairs or group by group.

use std::collections::BTreeMap;

use schemars::{Schema, SchemaGenerator};
use serde::{Serialize, Serializer};
use serde_json::json;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::color::hex_codes;
use super::embed::deserialize;
use super::entry::{Entry, Leaf, Rule};
use super::reader::{Reader, join};

/// Segments of the hairs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Segments {
    /// One number for all.
    All(u32),
    /// A number for each colour of the group map, by the 8-bit codes of the
    /// image, red, green, blue. A texel belongs to the listed colour nearest to it.
    ByColor(BTreeMap<[u8; 3], u32>),
}

impl Default for Segments {
    fn default() -> Self {
        Self::All(1)
    }
}

impl Segments {
    /// What the numbers may be.
    pub(crate) const RULE: Rule = Rule::at_least(1.0);

    fn read_colors(
        table: &DeTable<'_>,
        key: &str,
        rule: Rule,
        reader: &mut Reader<'_>,
    ) -> BTreeMap<[u8; 3], u32> {
        let mut segments = BTreeMap::new();
        for (name, value) in table.iter() {
            let text = name.get_ref().as_ref();
            let inner = join(key, text);
            reader.find(table, &inner, text);
            let Some(codes) = hex_codes(text) else {
                reader.wrong_key(&inner, name, "a colour \"#rrggbb\"");
                continue;
            };
            let mut number = 1_u32;
            number.read(value, &inner, rule, reader);
            if segments.insert(codes, number).is_some() {
                reader.wrong_key(&inner, name, "each colour once, whatever its case");
            }
        }
        segments
    }
}

impl Entry for Segments {
    fn read(
        &mut self,
        value: &Spanned<DeValue<'_>>,
        key: &str,
        rule: Rule,
        reader: &mut Reader<'_>,
    ) {
        match value.get_ref() {
            DeValue::Table(table) if table.is_empty() => {
                reader.wrong_type(key, value, "at least one colour".to_owned());
            }
            DeValue::Table(table) => {
                *self = Self::ByColor(Self::read_colors(table, key, rule, reader));
            }
            DeValue::Integer(_) => {
                let mut number = 1_u32;
                number.read(value, key, rule, reader);
                *self = Self::All(number);
            }
            _ => {
                let expected = rule.limits.describe("a whole number");
                let expected = format!("{expected} or a table {{ \"#rrggbb\" = number, … }}");
                reader.wrong_type(key, value, expected);
            }
        }
    }

    fn schema(&self, rule: Rule, _: &mut SchemaGenerator) -> Schema {
        let number = rule.limits.schema("integer");
        schemars::json_schema!({
            "anyOf": [
                number,
                {
                    "type": "object",
                    "patternProperties": { "^#[0-9a-fA-F]{6}$": json!(number) },
                    "additionalProperties": false,
                    "minProperties": 1,
                },
            ],
        })
    }

    fn walk<'a>(&'a self, key: &str, doc: &'static str, visit: &mut dyn FnMut(Leaf<'a>)) {
        visit(Leaf::of(key, self, doc));
    }
}

impl Serialize for Segments {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::All(number) => number.serialize(serializer),
            Self::ByColor(colors) => serializer.collect_map(
                (colors.iter()).map(|([r, g, b], n)| (format!("#{r:02x}{g:02x}{b:02x}"), n)),
            ),
        }
    }
}

deserialize!(Segments, Segments::RULE);
