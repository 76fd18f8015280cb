//! Numbers, switches and lists of numbers.

use std::path::Path;

use schemars::{Schema, SchemaGenerator};
use serde::Serialize;
use serde_json::{Value, json};
use toml::Spanned;
use toml::de::DeValue;

use super::entry::{Entry, Leaf, Rule};
use super::limits::Limits;
use super::list;
use super::reader::Reader;

/// The shortest decimal that reads back as `number`, as TOML wants it.
pub(crate) fn decimal(number: f32) -> String {
    format!("{number:?}")
}

/// The same as a JSON number: 0.02 and not 0.019999999552965164.
pub(crate) fn json_decimal(number: f32) -> Value {
    json!(decimal(number).parse::<f64>().unwrap_or(f64::from(number)))
}

/// The number a value holds, whole or not; none for other kinds.
fn as_f64(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Integer(whole) => i128::from_str_radix(whole.as_str(), whole.radix())
            .ok()
            .map(|n| n as f64),
        DeValue::Float(float) => float.as_str().parse().ok(),
        _ => None,
    }
}

/// A finite number within `limits` that f32 can hold, or a report.
pub(crate) fn number(
    value: &Spanned<DeValue<'_>>,
    key: &str,
    limits: Limits,
    reader: &mut Reader<'_>,
) -> Option<f64> {
    let Some(number) = as_f64(value.get_ref()) else {
        reader.wrong_type(key, value, limits.describe("a number"));
        return None;
    };
    if limits.allow(number) && (number as f32).is_finite() {
        return Some(number);
    }
    let mut expected = limits.describe("a number");
    if !(number as f32).is_finite() {
        expected = limits.describe("a finite number");
    }
    reader.out_of_range(key, value, expected);
    None
}

/// A whole number within `limits` and `0..=max`, or a report.
fn whole(
    value: &Spanned<DeValue<'_>>,
    key: &str,
    limits: Limits,
    max: u64,
    reader: &mut Reader<'_>,
) -> Option<u64> {
    let expected = limits.describe("a whole number");
    let DeValue::Integer(found) = value.get_ref() else {
        let whole = as_f64(value.get_ref()).filter(|n| limits.allow(*n) && n.fract() == 0.0);
        let meant = whole.map(|n| format!("did you mean {n}?"));
        reader.wrong_type_with(key, value, expected, meant);
        return None;
    };
    let number = i128::from_str_radix(found.as_str(), found.radix()).unwrap_or(i128::MAX);
    if !limits.allow(number as f64) || number < 0 {
        reader.out_of_range(key, value, expected);
        return None;
    }
    match u64::try_from(number) {
        Ok(number) if number <= max => Some(number),
        _ => {
            reader.out_of_range(key, value, format!("{expected}, at most {max}"));
            None
        }
    }
}

/// The `N` values of a list, or a report that `what` was expected.
pub(crate) fn list<'v, 'd, const N: usize>(
    value: &'v Spanned<DeValue<'d>>,
    key: &str,
    what: &str,
    reader: &mut Reader<'_>,
) -> Option<[&'v Spanned<DeValue<'d>>; N]> {
    let items = value
        .get_ref()
        .as_array()
        .map(|a| a.iter().collect::<Vec<_>>());
    let list = items.and_then(|items| <[_; N]>::try_from(items).ok());
    if list.is_none() {
        reader.wrong_type(key, value, what.to_owned());
    }
    list
}

macro_rules! whole_entry {
    ($type:ty) => {
        impl Entry for $type {
            fn read(
                &mut self,
                value: &Spanned<DeValue<'_>>,
                key: &str,
                rule: Rule,
                reader: &mut Reader<'_>,
            ) {
                let max = u64::from(<$type>::MAX);
                if let Some(number) = whole(value, key, rule.limits, max, reader) {
                    *self = number as $type;
                }
            }

            fn schema(&self, rule: Rule, _: &mut SchemaGenerator) -> Schema {
                let mut schema = rule.limits.schema("integer");
                schema.entry("maximum").or_insert(json!(<$type>::MAX));
                schema.insert("default".into(), json!(self));
                schema.into()
            }

            fn walk<'a>(&'a self, key: &str, doc: &'static str, visit: &mut dyn FnMut(Leaf<'a>)) {
                visit(Leaf::of(key, self, doc));
            }
        }
    };
}
whole_entry!(u32);
whole_entry!(u64);

impl Entry for f32 {
    fn read(
        &mut self,
        value: &Spanned<DeValue<'_>>,
        key: &str,
        rule: Rule,
        reader: &mut Reader<'_>,
    ) {
        if let Some(number) = number(value, key, rule.limits, reader) {
            *self = number as f32;
        }
    }

    fn schema(&self, rule: Rule, _: &mut SchemaGenerator) -> Schema {
        let mut schema = rule.limits.schema("number");
        schema.insert("default".into(), json_decimal(*self));
        schema.into()
    }

    fn walk<'a>(&'a self, key: &str, doc: &'static str, visit: &mut dyn FnMut(Leaf<'a>)) {
        visit(Leaf::of(key, self, doc));
    }
}

impl Entry for f64 {
    fn read(
        &mut self,
        value: &Spanned<DeValue<'_>>,
        key: &str,
        rule: Rule,
        reader: &mut Reader<'_>,
    ) {
        if let Some(number) = number(value, key, rule.limits, reader) {
            *self = number;
        }
    }

    fn schema(&self, rule: Rule, _: &mut SchemaGenerator) -> Schema {
        let mut schema = rule.limits.schema("number");
        schema.insert("default".into(), json!(self));
        schema.into()
    }

    fn walk<'a>(&'a self, key: &str, doc: &'static str, visit: &mut dyn FnMut(Leaf<'a>)) {
        visit(Leaf::of(key, self, doc));
    }
}

impl Entry for bool {
    fn read(&mut self, value: &Spanned<DeValue<'_>>, key: &str, _: Rule, reader: &mut Reader<'_>) {
        match value.get_ref().as_bool() {
            Some(on) => *self = on,
            None => reader.wrong_type(key, value, "true or false".to_owned()),
        }
    }

    fn schema(&self, _: Rule, _: &mut SchemaGenerator) -> Schema {
        schemars::json_schema!({ "type": "boolean", "default": *self })
    }

    fn walk<'a>(&'a self, key: &str, doc: &'static str, visit: &mut dyn FnMut(Leaf<'a>)) {
        visit(Leaf::of(key, self, doc));
    }
}

/// Lists of three, each entry under the rule of the list and named `key[i]`.
impl<T: Entry + Serialize> Entry for [T; 3] {
    fn read(
        &mut self,
        value: &Spanned<DeValue<'_>>,
        key: &str,
        rule: Rule,
        reader: &mut Reader<'_>,
    ) {
        let what = rule.limits.describe("[x, y, z], each");
        let Some(items) = list::<3>(value, key, &what, reader) else {
            return;
        };
        for (i, (slot, item)) in self.iter_mut().zip(items).enumerate() {
            slot.read(item, &format!("{key}[{i}]"), rule, reader);
        }
    }

    fn schema(&self, rule: Rule, generator: &mut SchemaGenerator) -> Schema {
        let items: Vec<Schema> = self.iter().map(|x| x.schema(rule, generator)).collect();
        let default: Option<Vec<_>> = items.iter().map(|s| s.get("default").cloned()).collect();
        let mut schema = schemars::json_schema!({
            "type": "array",
            "items": items[0],
            "minItems": 3,
            "maxItems": 3,
        });
        if let Some(default) = default {
            schema.insert("default".into(), json!(default));
        }
        schema
    }

    fn walk<'a>(&'a self, key: &str, doc: &'static str, visit: &mut dyn FnMut(Leaf<'a>)) {
        visit(list::leaf(self, key, doc));
    }

    fn settle(&mut self, folder: &Path) {
        self.iter_mut().for_each(|item| item.settle(folder));
    }
}
