//! The JSON Schema of recipes, for completion and checks in editors.
//!
//! It is made of the same lists as the reader (see `section.rs`), so what an
//! editor accepts a recipe accepts; what only the whole recipe can tell (keys
//! that exclude each other, stages that are not there yet) is left to the
//! reader.

use schemars::{JsonSchema, Schema, SchemaGenerator, generate::SchemaSettings};
use serde_json::{Map, Value, json};

use super::Recipe;
use super::entry::{Entry, Rule};

/// The JSON Schema (draft 2020-12) of a `groom.toml`.
///
/// ```
/// let schema = pelage_groom::recipe::schema();
/// let count = &schema["properties"]["hair"]["properties"]["count"];
/// assert_eq!(count["default"], 10_000);
/// assert_eq!(count["minimum"], 0);
/// ```
pub fn schema() -> Value {
    let generator = SchemaSettings::draft2020_12().into_generator();
    generator.into_root_schema_for::<Recipe>().to_value()
}

/// [`schema`] as text, as it is checked in.
pub fn schema_text() -> String {
    // Values with string keys only always print.
    let text = serde_json::to_string_pretty(&schema()).unwrap_or_default();
    text + "\n"
}

impl JsonSchema for Recipe {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "groom.toml".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        Recipe::default().schema(Rule::ANY, generator)
    }
}

/// The first paragraphs of a doc comment as running text.
pub(crate) fn description(doc: &str) -> String {
    let paragraphs = doc.split("\n\n").map(|paragraph| {
        let words: Vec<_> = paragraph.split_whitespace().collect();
        words.join(" ")
    });
    let kept: Vec<_> = paragraphs.filter(|text| !text.is_empty()).collect();
    kept.join("\n\n")
}

/// A reference to the definition `name`, made of `schema` at its first use.
pub(crate) fn shared(
    generator: &mut SchemaGenerator,
    name: &str,
    doc: &str,
    schema: Value,
) -> Value {
    let definitions = generator.definitions_mut();
    if !definitions.contains_key(name) {
        let mut schema = schema;
        if !doc.is_empty() {
            schema["description"] = json!(doc);
        }
        definitions.insert(name.to_owned(), schema);
    }
    json!({ "$ref": format!("#/$defs/{name}") })
}

/// The schema of a table in the making.
pub(crate) struct Table {
    doc: &'static str,
    keys: Map<String, Value>,
    required: Vec<&'static str>,
}

impl Table {
    /// A table without keys.
    pub(crate) fn new(doc: &'static str) -> Self {
        Self {
            doc,
            keys: Map::new(),
            required: Vec::new(),
        }
    }

    /// Adds a key whose default is `value`.
    pub(crate) fn key(
        &mut self,
        name: &'static str,
        doc: &str,
        rule: Rule,
        value: &impl Entry,
        generator: &mut SchemaGenerator,
    ) {
        let mut schema = value.schema(rule, generator);
        let mut text = description(doc);
        if let Some(words) = schema.get("description").and_then(Value::as_str)
            && schema.get("enum").is_some()
        {
            text = format!("{text}\n\n{words}");
        }
        schema.insert("description".into(), json!(text));
        if rule.required {
            self.required.push(name);
            schema.remove("default");
        }
        self.keys.insert(name.to_owned(), schema.to_value());
    }

    /// The finished schema.
    pub(crate) fn finish(self) -> Schema {
        let mut schema = schemars::json_schema!({
            "type": "object",
            "description": description(self.doc),
            "properties": self.keys,
            "additionalProperties": false,
        });
        if !self.required.is_empty() {
            schema.insert("required".into(), json!(self.required));
        }
        schema
    }
}
