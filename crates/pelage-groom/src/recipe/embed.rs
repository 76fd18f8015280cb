//! Recipes by way of serde: embedded in another file, or in another format.
//!
//! What a deserialiser gives is written down as the text of a `groom.toml` and
//! read like one. So there is one reader, and serde reports every mistake with
//! its key; only lines and columns are lost, since serde does not tell them.

use std::fmt::{self, Display};
use std::ops::Range;
use std::path::Path;

use serde::Serialize;
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use toml::Spanned;
use toml::de::DeValue;

use super::entry::{Entry, Rule};
use super::error::{Problem, RecipeError};
use super::reader::{Reader, join};

/// Deepest nesting that is written down: recipes need five tables and lists.
const DEEPEST: usize = 32;

/// Keys by which deserialisers hand out numbers and dates as they were written.
const LITERALS: [&str; 2] = ["$__toml_private_datetime", "$serde_json::private::Number"];

/// `Deserialize` for a type that is an `Entry`, under the rule it has where
/// no section gives it one.
macro_rules! deserialize {
    ($type:ty, $rule:expr) => {
        impl<'de> serde::Deserialize<'de> for $type {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                $crate::recipe::embed::entry(deserializer, $rule)
            }
        }
    };
}
pub(crate) use deserialize;

/// A value as TOML writes it behind a key.
pub(crate) fn inline(value: &impl Serialize) -> String {
    let mut text = String::new();
    // What recipes are made of always prints.
    let written = value.serialize(toml::ser::ValueSerializer::new(&mut text));
    debug_assert!(written.is_ok(), "{written:?}");
    text
}

/// An entry that stands alone, outside a recipe.
pub(crate) fn entry<'de, D: Deserializer<'de>, T: Entry + Default>(
    deserializer: D,
    rule: Rule,
) -> Result<T, D::Error> {
    let mut found = T::default();
    let problems = read(deserializer, |value, reader| {
        found.read(value, "", rule, reader);
    })?;
    finish(found, problems)
}

/// Shows what the deserialiser gives to `take`; returns what is wrong with it.
pub(crate) fn read<'de, D: Deserializer<'de>>(
    deserializer: D,
    take: impl FnOnce(&Spanned<DeValue<'_>>, &mut Reader<'_>),
) -> Result<Vec<Problem>, D::Error> {
    let mut text = String::new();
    let writer = Writer {
        text: &mut text,
        key: "",
        depth: 0,
    };
    writer.deserialize(deserializer)?;
    let value = DeValue::parse(&text).map_err(|error| {
        let found = text.get(error.span().unwrap_or(0..0)).unwrap_or_default();
        D::Error::custom(format_args!("{}: {found}", error.message()))
    })?;
    let mut reader = Reader::new(&text, Path::new(""));
    take(&value, &mut reader);
    Ok(reader.finish().0)
}

/// What was read, unless something is wrong with it.
pub(crate) fn finish<T, E: Error>(found: T, problems: Vec<Problem>) -> Result<T, E> {
    let placeless = problems.into_iter().map(Problem::without_place).collect();
    match RecipeError::from_problems(placeless) {
        Some(error) => Err(E::custom(error)),
        None => Ok(found),
    }
}

/// Writes whatever a deserialiser gives as the TOML value of `key`.
struct Writer<'a> {
    text: &'a mut String,
    key: &'a str,
    depth: usize,
}

impl Writer<'_> {
    /// Adds a number or a switch.
    fn push<E>(self, value: impl Serialize) -> Result<(), E> {
        *self.text += &inline(&value);
        Ok(())
    }

    /// Adds what is inside a table or a list, at `key`.
    fn inside<'b>(&'b mut self, key: &'b str) -> Writer<'b> {
        Writer {
            text: self.text,
            key,
            depth: self.depth + 1,
        }
    }

    fn fail<E: Error>(&self, message: impl Display) -> E {
        match self.key {
            "" => E::custom(message),
            key => E::custom(format_args!("{key}: {message}")),
        }
    }

    fn check_depth<E: Error>(&self) -> Result<(), E> {
        if self.depth < DEEPEST {
            return Ok(());
        }
        Err(self.fail("nested too deeply"))
    }
}

impl<'de> DeserializeSeed<'de> for Writer<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Writer<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value of a groom.toml")?;
        match self.key {
            "" => Ok(()),
            key => write!(f, " for {key}"),
        }
    }

    fn visit_bool<E: Error>(self, value: bool) -> Result<(), E> {
        self.push(value)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<(), E> {
        self.push(value)
    }

    fn visit_i128<E: Error>(self, value: i128) -> Result<(), E> {
        self.push(value)
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<(), E> {
        self.push(value)
    }

    fn visit_u128<E: Error>(self, value: u128) -> Result<(), E> {
        self.push(value)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<(), E> {
        self.push(value)
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<(), E> {
        self.push(value)
    }

    fn visit_unit<E: Error>(self) -> Result<(), E> {
        Err(self.fail("null says nothing: leave the key out"))
    }

    fn visit_none<E: Error>(self) -> Result<(), E> {
        self.visit_unit()
    }

    fn visit_some<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        self.deserialize(deserializer)
    }

    fn visit_newtype_struct<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        self.deserialize(deserializer)
    }

    fn visit_seq<A: SeqAccess<'de>>(mut self, mut list: A) -> Result<(), A::Error> {
        self.check_depth()?;
        self.text.push('[');
        for i in 0.. {
            let key = format!("{}[{i}]", self.key);
            if list.next_element_seed(self.inside(&key))?.is_none() {
                break;
            }
            self.text.push_str(", ");
        }
        self.text.push(']');
        Ok(())
    }

    fn visit_map<A: MapAccess<'de>>(mut self, mut table: A) -> Result<(), A::Error> {
        self.check_depth()?;
        let start = self.text.len();
        self.text.push_str("{ ");
        let mut separator = "";
        while let Some(name) = table.next_key::<String>()? {
            *self.text += &format!("{separator}{} = ", join("", &name));
            let value = self.text.len();
            let key = join(self.key, &name);
            table.next_value_seed(self.inside(&key))?;
            if LITERALS.contains(&name.as_str()) && unquote(self.text, start, value) {
                return Ok(());
            }
            separator = ", ";
        }
        self.text.push_str(" }");
        Ok(())
    }
}

/// Puts the text between the quotes from `value` on to `start`, if it can be
/// nothing but a number or a date.
fn unquote(text: &mut String, start: usize, value: usize) -> bool {
    let quoted: Range<usize> = value + 1..text.len().saturating_sub(1);
    let plain = |c: char| c.is_ascii_alphanumeric() || "+-.:".contains(c);
    match text.get(quoted).map(str::to_owned) {
        Some(literal) if literal.chars().all(plain) => {
            text.truncate(start);
            *text += &literal;
            true
        }
        _ => false,
    }
}
