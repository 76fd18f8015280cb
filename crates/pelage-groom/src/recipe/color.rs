//! Colours: `[r, g, b]` in linear RGB, or `"#rrggbb"` in sRGB codes.

use serde_json::{Value, json};
use toml::Spanned;
use toml::de::DeValue;

use super::entry::Rule;
use super::limits::Limits;
use super::map::{Blend, Channel};
use super::number::{self, json_decimal};
use super::property::PropertyValue;
use super::reader::Reader;

/// What an error says a colour may be.
const EXPECTED: &str = "a colour, [r, g, b] each 0..1 (linear) or \"#rrggbb\" (sRGB)";

/// The three codes of `"#rrggbb"`.
pub(crate) fn hex_codes(text: &str) -> Option<[u8; 3]> {
    let digits = text.strip_prefix('#').filter(|digits| digits.len() == 6)?;
    if !digits.bytes().all(|digit| digit.is_ascii_hexdigit()) {
        return None;
    }
    let number = u32::from_str_radix(digits, 16).ok()?;
    let [_, r, g, b] = number.to_be_bytes();
    Some([r, g, b])
}

/// An sRGB code as linear light (IEC 61966-2-1).
fn linear(code: u8) -> f32 {
    let x = f64::from(code) / 255.0;
    let linear = if x <= 0.04045 {
        x / 12.92
    } else {
        libm::pow((x + 0.055) / 1.055, 2.4)
    };
    linear as f32
}

impl PropertyValue for [f32; 3] {
    const CHANNEL: Option<Channel> = None;
    const BLEND: Blend = Blend::Add;
    const KEYS: &'static [&'static str] = &["value", "map", "channel", "wrap", "space", "blend"];

    fn read_plain(
        value: &Spanned<DeValue<'_>>,
        key: &str,
        _: Rule,
        reader: &mut Reader<'_>,
    ) -> Option<Self> {
        if let Some(text) = value.get_ref().as_str() {
            let codes = hex_codes(text);
            if codes.is_none() {
                reader.out_of_range(key, value, EXPECTED.to_owned());
            }
            return codes.map(|codes| codes.map(linear));
        }
        let items = number::list::<3>(value, key, EXPECTED, reader)?;
        let mut color = [0.0; 3];
        for (i, item) in items.into_iter().enumerate() {
            let name = format!("{key}[{i}]");
            color[i] = number::number(item, &name, Limits::between(0.0, 1.0), reader)? as f32;
        }
        Some(color)
    }

    fn neutral(blend: Blend) -> Self {
        match blend {
            Blend::Add => [0.0; 3],
            Blend::Multiply => [1.0; 3],
        }
    }

    fn json(&self) -> Value {
        json!(self.map(json_decimal))
    }

    fn plain_schema(_: Rule) -> Value {
        json!({
            "anyOf": [
                {
                    "type": "array",
                    "items": Limits::between(0.0, 1.0).schema("number"),
                    "minItems": 3,
                    "maxItems": 3,
                },
                { "type": "string", "pattern": "^#[0-9a-fA-F]{6}$" },
            ],
        })
    }
}
