//! What every kind of value in a recipe can do: be read, be described, be listed.

use std::path::Path;

use schemars::{Schema, SchemaGenerator};
use serde::Serialize;
use toml::Spanned;
use toml::de::DeValue;

use super::embed::inline;
use super::limits::Limits;
use super::map::MapUse;
use super::outline::{KeyOutline, Told};
use super::reader::Reader;

/// What a key asks of its value.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Rule {
    /// The interval of its numbers.
    pub(crate) limits: Limits,
    /// Whether leaving it out is an error.
    pub(crate) required: bool,
    /// Whether it takes `{ ramp = … }`: the root of a root/tip pair.
    pub(crate) ramp: bool,
    /// The unit of its numbers, in words.
    pub(crate) unit: Option<&'static str>,
}

impl Rule {
    pub(crate) const ANY: Self = Self::within(Limits::ANY);

    pub(crate) const fn within(limits: Limits) -> Self {
        Self {
            limits,
            required: false,
            ramp: false,
            unit: None,
        }
    }

    pub(crate) const fn at_least(min: f64) -> Self {
        Self::within(Limits::at_least(min))
    }

    pub(crate) const fn above(min: f64) -> Self {
        Self::within(Limits::above(min))
    }

    pub(crate) const fn between(min: f64, max: f64) -> Self {
        Self::within(Limits::between(min, max))
    }

    pub(crate) const fn required(mut self) -> Self {
        self.required = true;
        self
    }

    pub(crate) const fn with_ramp(mut self) -> Self {
        self.ramp = true;
        self
    }

    pub(crate) const fn unit(mut self, unit: &'static str) -> Self {
        self.unit = Some(unit);
        self
    }

    /// A length over the surface or along a hair.
    pub(crate) const fn length(self) -> Self {
        self.unit("units of the mesh")
    }

    pub(crate) const fn degrees(self) -> Self {
        self.unit("degrees")
    }
}

/// One key and its value, as the listings see it.
pub(crate) struct Leaf<'a> {
    /// Dotted key from the top.
    pub(crate) key: String,
    /// The value as TOML; none where the key is absent and has no default.
    pub(crate) text: Option<String>,
    /// Maps used, each with its own dotted key.
    pub(crate) maps: Vec<(String, &'a MapUse)>,
    /// Whether the value is a ramp.
    pub(crate) ramp: bool,
    /// The documentation of the key.
    pub(crate) doc: &'static str,
}

impl<'a> Leaf<'a> {
    /// A value without maps.
    pub(crate) fn of(key: &str, value: &impl Serialize, doc: &'static str) -> Self {
        Self {
            text: Some(inline(value)),
            ..Self::absent(key, doc)
        }
    }

    /// A key that has no value.
    pub(crate) fn absent(key: &str, doc: &'static str) -> Self {
        Self {
            key: key.to_owned(),
            text: None,
            maps: Vec::new(),
            ramp: false,
            doc,
        }
    }
}

/// A value that a key of a recipe can have.
pub(crate) trait Entry {
    /// Takes over `value`, or reports what is wrong with it and stays as it was.
    fn read(
        &mut self,
        value: &Spanned<DeValue<'_>>,
        key: &str,
        rule: Rule,
        reader: &mut Reader<'_>,
    );

    /// Reports the keys that are required and not there; `span` is the table
    /// that should hold `key`.
    fn absent(
        &self,
        key: &str,
        rule: Rule,
        span: &std::ops::Range<usize>,
        reader: &mut Reader<'_>,
    ) {
        if rule.required {
            reader.missing(key, span.clone(), None);
        }
    }

    /// The JSON Schema of the allowed values; `self` holds the default.
    fn schema(&self, rule: Rule, generator: &mut SchemaGenerator) -> Schema;

    /// Shows every key below this one.
    fn walk<'a>(&'a self, key: &str, doc: &'static str, visit: &mut dyn FnMut(Leaf<'a>));

    /// Tells what is to be known of this key, or of every key below it.
    fn outline(
        &self,
        key: &str,
        doc: &'static str,
        rule: Rule,
        generator: &mut SchemaGenerator,
        tell: &mut dyn FnMut(Told),
    ) {
        let schema = self.schema(rule, generator).to_value();
        let mut outline = KeyOutline::new(key, doc, rule, &schema);
        self.walk(key, doc, &mut |leaf| outline.default = leaf.text);
        tell(Told::Key(outline));
    }

    /// Lets relative paths start at `folder`.
    fn settle(&mut self, _folder: &Path) {}

    /// Whether there is anything to write.
    fn is_written(&self) -> bool {
        true
    }

    /// Whether it tells the whole strand, from root to tip.
    fn is_ramp(&self) -> bool {
        false
    }
}

impl<T: Entry + Default> Entry for Option<T> {
    fn read(
        &mut self,
        value: &Spanned<DeValue<'_>>,
        key: &str,
        rule: Rule,
        reader: &mut Reader<'_>,
    ) {
        let mut inner = T::default();
        inner.read(value, key, rule, reader);
        *self = Some(inner);
    }

    fn schema(&self, rule: Rule, generator: &mut SchemaGenerator) -> Schema {
        let mut schema = T::default().schema(rule, generator);
        schema.remove("default");
        schema
    }

    fn walk<'a>(&'a self, key: &str, doc: &'static str, visit: &mut dyn FnMut(Leaf<'a>)) {
        match self {
            Some(inner) => inner.walk(key, doc, visit),
            None => visit(Leaf::absent(key, doc)),
        }
    }

    fn outline(
        &self,
        key: &str,
        doc: &'static str,
        rule: Rule,
        generator: &mut SchemaGenerator,
        tell: &mut dyn FnMut(Told),
    ) {
        let mut tell = |told| match told {
            // The default is that there is none.
            Told::Key(outline) if outline.key == key => tell(Told::Key(KeyOutline {
                default: None,
                ..outline
            })),
            told => tell(told),
        };
        T::default().outline(key, doc, rule, generator, &mut tell);
    }

    fn settle(&mut self, folder: &Path) {
        self.iter_mut().for_each(|inner| inner.settle(folder));
    }

    fn is_written(&self) -> bool {
        self.is_some()
    }
}
