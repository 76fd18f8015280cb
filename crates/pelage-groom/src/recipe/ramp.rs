//! Values along a strand: `{ ramp = [[0.0, 1.0], [1.0, 0.2]] }`.

use serde::{Serialize, Serializer};
use serde_json::{Value, json};
use toml::Spanned;
use toml::de::DeValue;

use super::entry::Rule;
use super::limits::Limits;
use super::number::{self, decimal};
use super::property::PropertyValue;
use super::reader::Reader;

/// Where along a strand a point of a ramp may lie.
const POSITION: Limits = Limits::between(0.0, 1.0);

/// Values at places along a strand, to be joined by straight lines. Before the
/// first and after the last point the value stays.
#[derive(Clone, Debug, PartialEq)]
pub struct Ramp<V> {
    /// `(t, value)`, t ascending from 0 at the root to 1 at the tip; at least one.
    pub points: Vec<(f32, V)>,
}

/// Reads a list of `[t, value]`; the key of a point is `key[i]`.
pub(crate) fn read<V: PropertyValue>(
    value: &Spanned<DeValue<'_>>,
    key: &str,
    rule: Rule,
    reader: &mut Reader<'_>,
) -> Option<Ramp<V>> {
    let items = value.get_ref().as_array().filter(|list| !list.is_empty());
    let Some(items) = items else {
        let expected = "a list of points [position, value]";
        reader.wrong_type(key, value, expected.to_owned());
        return None;
    };
    let mut points: Vec<(f32, V)> = Vec::with_capacity(items.len());
    for (i, item) in items.iter().enumerate() {
        let name = format!("{key}[{i}]");
        let [t, at] = number::list::<2>(item, &name, "a point [position, value]", reader)?;
        let position = number::number(t, &format!("{name}[0]"), POSITION, reader)? as f32;
        if let Some((last, _)) = points.last().filter(|(last, _)| position <= *last) {
            let expected = format!("a position above the one before, {}", decimal(*last));
            reader.out_of_range(&format!("{name}[0]"), t, expected);
            return None;
        }
        points.push((
            position,
            V::read_plain(at, &format!("{name}[1]"), rule, reader)?,
        ));
    }
    Some(Ramp { points })
}

impl<V: Serialize> Serialize for Ramp<V> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.points.serialize(serializer)
    }
}

/// Which keys along a strand are written: a ramp at the root leaves the others
/// out.
#[derive(Default)]
pub(crate) struct Along {
    ramp: bool,
}

impl Along {
    /// Whether the key `name`, the next of its section, is written.
    pub(crate) fn has(&mut self, name: &str, is_ramp: bool) -> bool {
        let told = self.ramp && matches!(name, "center" | "tip");
        self.ramp |= is_ramp;
        !told
    }
}

/// The schema of the list.
pub(crate) fn schema<V: PropertyValue>(rule: Rule) -> Value {
    json!({
        "description": "Points [position 0..1 from root to tip, value]; leave the tip out.",
        "type": "array",
        "minItems": 1,
        "items": {
            "type": "array",
            "prefixItems": [POSITION.schema("number"), V::plain_schema(rule)],
            "minItems": 2,
            "maxItems": 2,
        },
    })
}
