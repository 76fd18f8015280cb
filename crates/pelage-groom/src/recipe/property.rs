//! Properties that an image map can modulate: the **T** of the documentation.
//!
//! A property is a plain value or a table `{ value, map, channel, wrap, space,
//! blend }`. Where the documentation leaves a choice, a recipe means:
//!
//! - a table with a `map` and no `value` has the value that leaves the map as it
//!   is: 1 where they are multiplied, black where they are added;
//! - `channel`, `wrap`, `space` and `blend` without a `map` are an error;
//! - `blend` is for colours only: numbers are always multiplied;
//! - `{ ramp = [[t, value], …] }` is taken by the `root` of a root/tip pair (and
//!   by `strand.splay.root`). It then tells the whole strand, from t = 0 at the
//!   root to t = 1 at the tip, so `tip` (and `center`) must be left out. A ramp
//!   takes the place of `value`; a map beside it acts on every value of it.

use std::fmt::Debug;
use std::path::Path;

use schemars::{Schema, SchemaGenerator};
use serde::ser::{Serialize, SerializeMap, Serializer};
use serde_json::{Value, json};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::embed::deserialize;
use super::entry::{Entry, Leaf, Rule};
use super::map::{Blend, Channel, MapSpace, MapUse};
use super::ramp::{self, Ramp};
use super::reader::{Reader, join};
use super::schema::shared;

/// A number that a map can multiply.
pub type ScalarProperty = Property<f32>;

/// A linear RGB colour that a map can be added to, or multiply.
pub type ColorProperty = Property<[f32; 3]>;

/// A value that a map can modulate at the root of each hair.
#[derive(Clone, Debug, PartialEq)]
pub struct Property<V> {
    /// The value everywhere, or what the map acts on. With a ramp, its first
    /// value.
    pub value: V,
    /// The map, if any.
    pub map: Option<MapUse>,
    /// Values from root to tip, if they are not `value` alone.
    pub ramp: Option<Ramp<V>>,
}

impl<V> Property<V> {
    /// `value` everywhere.
    ///
    /// ```
    /// use pelage_groom::recipe::Property;
    ///
    /// assert_eq!(Property::new(0.5).map, None);
    /// ```
    pub const fn new(value: V) -> Self {
        Self {
            value,
            map: None,
            ramp: None,
        }
    }
}

impl Default for Property<f32> {
    fn default() -> Self {
        Self::new(0.0)
    }
}

impl Default for Property<[f32; 3]> {
    fn default() -> Self {
        Self::new([0.0; 3])
    }
}

/// What the values of properties, numbers and colours, have in common.
pub(crate) trait PropertyValue: Copy + Debug + PartialEq + Serialize {
    /// The channel read by default.
    const CHANNEL: Option<Channel>;
    /// How maps act by default.
    const BLEND: Blend;
    /// The keys of the table form, without `ramp`.
    const KEYS: &'static [&'static str];

    /// The plain form.
    fn read_plain(
        value: &Spanned<DeValue<'_>>,
        key: &str,
        rule: Rule,
        reader: &mut Reader<'_>,
    ) -> Option<Self>;

    /// The value that leaves a map as it is.
    fn neutral(blend: Blend) -> Self;

    /// The plain form as JSON.
    fn json(&self) -> Value;

    /// The schema of the plain form.
    fn plain_schema(rule: Rule) -> Value;
}

impl<V: PropertyValue> Entry for Property<V> {
    fn read(
        &mut self,
        value: &Spanned<DeValue<'_>>,
        key: &str,
        rule: Rule,
        reader: &mut Reader<'_>,
    ) {
        if let Some(table) = value.get_ref().as_table() {
            read_table(self, table, value, key, rule, reader);
        } else if let Some(found) = V::read_plain(value, key, rule, reader) {
            *self = Self::new(found);
        }
    }

    fn schema(&self, rule: Rule, generator: &mut SchemaGenerator) -> Schema {
        let mut schema = schemars::json_schema!({
            "anyOf": [V::plain_schema(rule), table_schema::<V>(rule, generator)],
        });
        if !rule.required {
            schema.insert("default".into(), self.value.json());
        }
        schema
    }

    fn walk<'a>(&'a self, key: &str, doc: &'static str, visit: &mut dyn FnMut(Leaf<'a>)) {
        visit(Leaf {
            maps: self.map.iter().map(|map| (key.to_owned(), map)).collect(),
            ramp: self.ramp.is_some(),
            ..Leaf::of(key, self, doc)
        });
    }

    fn settle(&mut self, folder: &Path) {
        if let Some(map) = &mut self.map {
            map.path.settle(folder);
        }
    }

    fn is_ramp(&self) -> bool {
        self.ramp.is_some()
    }
}

/// Takes over the table form.
fn read_table<V: PropertyValue>(
    property: &mut Property<V>,
    table: &DeTable<'_>,
    value: &Spanned<DeValue<'_>>,
    key: &str,
    rule: Rule,
    reader: &mut Reader<'_>,
) {
    let mut keys = V::KEYS.to_vec();
    if rule.ramp {
        keys.push("ramp");
    }
    let standard = MapUse::new(Default::default(), V::CHANNEL, V::BLEND);
    property.map = MapUse::read(table, key, standard, &keys, reader);
    property.ramp = None;
    let unknown = reader.refuse_others(table, key, &keys);

    let plain_key = join(key, "value");
    let plain = reader.find(table, &plain_key, "value");
    let ramp_key = join(key, "ramp");
    let ramp = if rule.ramp {
        reader.find(table, &ramp_key, "ramp")
    } else {
        None
    };
    if let (Some(_), Some(ramp)) = (plain, ramp) {
        reader.exclusive(&ramp_key, ramp.span(), &plain_key);
    } else if let Some(plain) = plain {
        if let Some(found) = V::read_plain(plain, &plain_key, rule, reader) {
            property.value = found;
        }
    } else if let Some(ramp) = ramp {
        property.ramp = ramp::read(ramp, &ramp_key, rule, reader);
        if let Some(ramp) = &property.ramp {
            property.value = ramp.points[0].1;
        }
    } else if let Some(map) = &property.map {
        property.value = V::neutral(map.blend);
    } else if !table.contains_key("map") && !unknown {
        reader.missing(&plain_key, value.span(), Some("a value, a map or both"));
    }
}

/// The plain form where that says it all, else the table.
impl<V: PropertyValue> Serialize for Property<V> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.map.is_none() && self.ramp.is_none() {
            return self.value.serialize(serializer);
        }
        let mut table = serializer.serialize_map(None)?;
        match &self.ramp {
            Some(ramp) => table.serialize_entry("ramp", ramp)?,
            None => table.serialize_entry("value", &self.value)?,
        }
        if let Some(map) = &self.map {
            map.write(V::CHANNEL, V::BLEND, &mut table)?;
        }
        table.end()
    }
}

deserialize!(ScalarProperty, Rule::ANY.with_ramp());
deserialize!(ColorProperty, Rule::ANY.with_ramp());

/// The schema of the table form.
fn table_schema<V: PropertyValue>(rule: Rule, generator: &mut SchemaGenerator) -> Value {
    let mut keys = json!({
        "value": V::plain_schema(rule),
        "map": shared(generator, "image", "An image file, PNG, TIFF, EXR or HDR, relative to \
            the folder of the recipe. `<UDIM>` in its name stands for the numbers of a set of \
            tiles, 1001 to 9999.", json!({ "type": "string", "minLength": 1 })),
    });
    for name in &V::KEYS[2..] {
        let of = match *name {
            "channel" => Channel::default().schema(Rule::ANY, generator),
            "wrap" => pelage_surface::Wrap::default().schema(Rule::ANY, generator),
            "space" => Option::<MapSpace>::None.schema(Rule::ANY, generator),
            _ => V::BLEND.schema(Rule::ANY, generator),
        };
        keys[name] = shared(generator, name, "", of.to_value());
    }
    if rule.ramp {
        keys["ramp"] = ramp::schema::<V>(rule);
    }
    json!({
        "type": "object",
        "properties": keys,
        "minProperties": 1,
        "additionalProperties": false,
    })
}
