//! Lists of tables: `[[section.key]]` in a `groom.toml`.

use std::path::Path;

use schemars::{Schema, SchemaGenerator};
use serde::Serialize;
use serde_json::json;
use toml::Spanned;
use toml::de::DeValue;

use super::entry::{Entry, Leaf, Rule};
use super::outline::Told;
use super::reader::Reader;

/// A list as one leaf, with the maps of all its items; item `i` is named `key[i]`.
pub(super) fn leaf<'a, T: Entry + Serialize>(
    items: &'a [T],
    key: &str,
    doc: &'static str,
) -> Leaf<'a> {
    let mut all = Leaf::of(key, &items, doc);
    for (i, item) in items.iter().enumerate() {
        item.walk(&format!("{key}[{i}]"), doc, &mut |leaf| {
            all.maps.extend(leaf.maps);
        });
    }
    all
}

/// Lists of sections, entry `i` named `key[i]`. A list is empty where the key is absent.
impl<T: Entry + Default + Serialize> Entry for Vec<T> {
    fn read(
        &mut self,
        value: &Spanned<DeValue<'_>>,
        key: &str,
        rule: Rule,
        reader: &mut Reader<'_>,
    ) {
        let Some(items) = value.get_ref().as_array() else {
            return reader.wrong_type(key, value, "a list of tables".to_owned());
        };
        self.clear();
        for (i, item) in items.iter().enumerate() {
            let name = format!("{key}[{i}]");
            let mut entry = T::default();
            reader.remember(&name, item);
            entry.read(item, &name, rule, reader);
            self.push(entry);
        }
    }

    fn schema(&self, rule: Rule, generator: &mut SchemaGenerator) -> Schema {
        schemars::json_schema!({
            "type": "array",
            "items": T::default().schema(rule, generator),
            "default": json!([]),
        })
    }

    fn walk<'a>(&'a self, key: &str, doc: &'static str, visit: &mut dyn FnMut(Leaf<'a>)) {
        visit(leaf(self, key, doc));
    }

    fn outline(
        &self,
        key: &str,
        doc: &'static str,
        rule: Rule,
        generator: &mut SchemaGenerator,
        tell: &mut dyn FnMut(Told),
    ) {
        T::default().outline(&format!("{key}[]"), doc, rule, generator, tell);
    }

    fn settle(&mut self, folder: &Path) {
        self.iter_mut().for_each(|item| item.settle(folder));
    }
}
