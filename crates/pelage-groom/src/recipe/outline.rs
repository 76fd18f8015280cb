//! What is to be known of every key, for pages and programs: made of the same lists as
//! the reader and the schema (see `section.rs`).

use schemars::generate::SchemaSettings;
use serde_json::Value;

use super::Recipe;
use super::entry::{Entry, Rule};
use super::schema::description;

/// How a doc comment names what document 004 calls a key.
const ANCESTOR: &str = " (document 004: ";

/// A section of a recipe with what is to be known of its keys.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionOutline {
    /// Dotted key.
    pub key: String,
    /// What it is for.
    pub does: String,
    /// Its keys, without those of the sections in it.
    pub keys: Vec<KeyOutline>,
}

/// What is to be known of a key.
#[derive(Clone, Debug, PartialEq)]
pub struct KeyOutline {
    /// Dotted key.
    pub key: String,
    /// What it does; where it takes a few words, a line for each of them.
    pub does: String,
    /// What document 004 calls it; three names where it has one for each axis.
    pub ancestors: Vec<String>,
    /// The values it takes, in words.
    pub values: String,
    /// The unit of its numbers.
    pub unit: Option<&'static str>,
    /// The value without the key, as TOML.
    pub default: Option<String>,
    /// Whether a recipe must have it.
    pub required: bool,
    /// Whether a map can modulate it.
    pub map: bool,
    /// Whether it takes a ramp.
    pub ramp: bool,
}

/// Every section of a recipe, in the order of the layout.
///
/// ```
/// let sections = pelage_groom::recipe::outline();
/// let keys: Vec<_> = sections.iter().flat_map(|section| &section.keys).collect();
/// let tip = keys.iter().find(|key| key.key == "width.tip").unwrap();
/// assert_eq!(tip.ancestors, ["Tip_Thickness"]);
/// assert!(tip.map && !tip.ramp);
/// ```
pub fn outline() -> Vec<SectionOutline> {
    let mut sections: Vec<SectionOutline> = Vec::new();
    let mut generator = SchemaSettings::draft2020_12().into_generator();
    let mut tell = |told: Told| match told {
        // The recipe itself.
        Told::Section { key, .. } if key.is_empty() => {}
        Told::Section { key, doc } => sections.push(SectionOutline {
            key,
            does: description(doc),
            keys: Vec::new(),
        }),
        Told::Key(key) => {
            let section = key.key.rsplit_once('.').map_or("", |(section, _)| section);
            let home = sections.iter_mut().rfind(|home| home.key == section);
            home.into_iter()
                .for_each(|home| home.keys.push(key.clone()));
        }
    };
    Recipe::default().outline("", "", Rule::ANY, &mut generator, &mut tell);
    sections
}

/// What an [`Entry`] tells of itself.
pub(crate) enum Told {
    /// It is a table.
    Section { key: String, doc: &'static str },
    /// It is a value.
    Key(KeyOutline),
}

impl KeyOutline {
    /// What is known of `key` by its schema.
    pub(crate) fn new(key: &str, doc: &str, rule: Rule, schema: &Value) -> Self {
        let mut does = description(doc);
        let ancestors = take_ancestors(&mut does);
        let choice = schema.get("enum").is_some();
        if let Some(words) = schema["description"].as_str().filter(|_| choice) {
            does = format!("{does}\n{words}");
        }
        Self {
            key: key.to_owned(),
            does,
            ancestors,
            values: values(schema),
            unit: rule.unit,
            default: None,
            required: rule.required,
            map: takes(schema, "map"),
            ramp: takes(schema, "ramp"),
        }
    }
}

/// Takes the names of document 004 out of `does`.
fn take_ancestors(does: &mut String) -> Vec<String> {
    let Some(start) = does.find(ANCESTOR) else {
        return Vec::new();
    };
    let end = does[start..]
        .find(')')
        .map_or(does.len(), |end| start + end + 1);
    let inside = &does[start + ANCESTOR.len()..end];
    let name = inside
        .split(|c: char| !c.is_alphanumeric() && c != '_')
        .next();
    let name = name.unwrap_or_default();
    let axes = match inside.contains("and so on") {
        true => &["_X_", "_Y_", "_Z_"][..],
        false => &["_X_"],
    };
    let names = axes.iter().map(|axis| name.replace("_X_", axis)).collect();
    does.replace_range(start..end, "");
    names
}

/// The plain form of a value that has others too.
fn plain(schema: &Value) -> &Value {
    match schema["anyOf"].get(0) {
        Some(first) => first,
        None => schema,
    }
}

/// Whether one of the forms is a table with the key `name`.
fn takes(schema: &Value, name: &str) -> bool {
    let forms = schema["anyOf"].as_array().into_iter().flatten();
    let here = forms
        .into_iter()
        .any(|form| form["properties"].get(name).is_some());
    here || schema.get("items").is_some_and(|item| takes(item, name))
}

/// The values that a schema allows, in words.
fn values(schema: &Value) -> String {
    if let Some(words) = schema["enum"].as_array() {
        let words: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
        return words.join(", ");
    }
    let form = plain(schema);
    if form.get("anyOf").is_some() {
        return "a colour".to_owned();
    }
    match form["type"].as_str() {
        Some("array") => format!("three, each {}", values(&form["items"])),
        Some("integer") => format!("whole, {}", interval(form)),
        Some("boolean") => "true or false".to_owned(),
        Some("string") => "a file".to_owned(),
        _ => interval(form),
    }
}

fn interval(schema: &Value) -> String {
    // What the type holds anyway is no limit worth a word.
    let max = schema["maximum"]
        .as_f64()
        .filter(|max| *max < f64::from(u32::MAX));
    let above = schema["exclusiveMinimum"].as_f64();
    match (schema["minimum"].as_f64(), above, max) {
        (Some(min), _, Some(max)) => format!("{min} to {max}"),
        (Some(min), _, None) => format!("{min} and up"),
        (None, Some(min), _) => format!("above {min}"),
        _ => "any number".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_of_the_schema_is_told() {
        fn keys(path: &str, schema: &Value, all: &mut Vec<String>) {
            for (name, key) in schema["properties"].as_object().into_iter().flatten() {
                let path = format!("{path}{name}");
                if key.get("properties").is_some() {
                    keys(&format!("{path}."), key, all);
                } else if key["items"].get("properties").is_some() {
                    keys(&format!("{path}[]."), &key["items"], all);
                } else {
                    all.push(path);
                }
            }
        }
        let mut expected = Vec::new();
        keys("", &super::super::schema(), &mut expected);
        let told = outline().into_iter().flat_map(|section| section.keys);
        let mut told: Vec<String> = told.map(|key| key.key).collect();
        told.sort();
        expected.sort();
        assert_eq!(told, expected);
    }
}
