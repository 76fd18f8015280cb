//! Weights that heed where a guide points.

use schemars::{Schema, SchemaGenerator};
use serde::ser::{Serialize, SerializeMap, Serializer};
use toml::Spanned;
use toml::de::DeValue;

use super::embed::deserialize;
use super::entry::{Entry, Leaf, Rule};
use super::number::json_decimal;
use super::reader::{Reader, join};

/// The exponent that `facing = true` stands for. Document 000 asks for a ≥ 0
/// only; 2 is the square of Shepard's classic weights.
const EXPONENT: f32 = 2.0;

/// Whether guides that point away from the surface count less: document 000,
/// eq. 49, `|x − x_k|^−a (S · T_k) Θ(S · T_k)`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Facing {
    /// They count like the others: `false`.
    #[default]
    Off,
    /// Weights of eq. 49 with the exponent `a`: `true` stands for 2, and
    /// `{ exponent = a }` for any a of 0 or more.
    On {
        /// The power of the distance, `a`.
        exponent: f32,
    },
}

impl Facing {
    /// What the exponent may be.
    pub(crate) const RULE: Rule = Rule::at_least(0.0);
}

impl Entry for Facing {
    fn read(
        &mut self,
        value: &Spanned<DeValue<'_>>,
        key: &str,
        rule: Rule,
        reader: &mut Reader<'_>,
    ) {
        match value.get_ref() {
            DeValue::Boolean(false) => *self = Self::Off,
            DeValue::Boolean(true) => *self = Self::On { exponent: EXPONENT },
            DeValue::Table(table) => {
                let name = join(key, "exponent");
                let mut exponent = EXPONENT;
                match reader.find(table, &name, "exponent") {
                    Some(found) => exponent.read(found, &name, rule, reader),
                    None => reader.missing(&name, value.span(), Some("the exponent")),
                }
                reader.refuse_others(table, key, &["exponent"]);
                *self = Self::On { exponent };
            }
            _ => {
                let expected = "true, false or { exponent = 2.0 }";
                reader.wrong_type(key, value, expected.to_owned());
            }
        }
    }

    fn schema(&self, rule: Rule, _: &mut SchemaGenerator) -> Schema {
        let mut exponent = rule.limits.schema("number");
        exponent.insert("default".into(), json_decimal(EXPONENT));
        schemars::json_schema!({
            "anyOf": [
                { "type": "boolean" },
                {
                    "type": "object",
                    "properties": { "exponent": exponent },
                    "required": ["exponent"],
                    "additionalProperties": false,
                },
            ],
            "default": false,
        })
    }

    fn walk<'a>(&'a self, key: &str, doc: &'static str, visit: &mut dyn FnMut(Leaf<'a>)) {
        visit(Leaf::of(key, self, doc));
    }
}

impl Serialize for Facing {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Off => serializer.serialize_bool(false),
            Self::On { exponent } => {
                let mut table = serializer.serialize_map(Some(1))?;
                table.serialize_entry("exponent", exponent)?;
                table.end()
            }
        }
    }
}

deserialize!(Facing, Facing::RULE);
