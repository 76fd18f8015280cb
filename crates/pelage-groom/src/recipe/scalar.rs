//! The plain form of scalar properties.

use serde_json::Value;
use toml::Spanned;
use toml::de::DeValue;

use super::entry::Rule;
use super::map::{Blend, Channel};
use super::number::{self, json_decimal};
use super::property::PropertyValue;
use super::reader::Reader;

impl PropertyValue for f32 {
    const CHANNEL: Option<Channel> = Some(Channel::Red);
    const BLEND: Blend = Blend::Multiply;
    const KEYS: &'static [&'static str] = &["value", "map", "channel", "wrap", "space"];

    fn read_plain(
        value: &Spanned<DeValue<'_>>,
        key: &str,
        rule: Rule,
        reader: &mut Reader<'_>,
    ) -> Option<Self> {
        number::number(value, key, rule.limits, reader).map(|number| number as f32)
    }

    fn neutral(_: Blend) -> Self {
        1.0
    }

    fn json(&self) -> Value {
        json_decimal(*self)
    }

    fn plain_schema(rule: Rule) -> Value {
        Value::Object(rule.limits.schema("number"))
    }
}
