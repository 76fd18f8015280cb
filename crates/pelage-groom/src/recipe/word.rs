//! `words!`: a value that is one of a few words.

use schemars::Schema;
use serde_json::json;
use toml::Spanned;
use toml::de::DeValue;

use super::reader::Reader;

/// Declares an enum whose variants are words of a recipe:
/// `/// doc`, `Variant = "word",`. The first is the default.
macro_rules! words {
    (
        $(#[doc = $doc:literal])*
        pub enum $name:ident {
            $(#[doc = $first_doc:literal])*
            $first:ident = $first_word:literal,
            $($(#[doc = $word_doc:literal])* $variant:ident = $word:literal,)*
        }
    ) => {
        $(#[doc = $doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        pub enum $name {
            $(#[doc = $first_doc])*
            #[default]
            $first,
            $($(#[doc = $word_doc])* $variant,)*
        }

        impl $name {
            /// Every variant, in the order of the documentation.
            pub const ALL: &'static [Self] = &[Self::$first $(, Self::$variant)*];

            /// The word that stands for it in a `groom.toml`.
            pub const fn word(self) -> &'static str {
                match self {
                    Self::$first => $first_word,
                    $(Self::$variant => $word,)*
                }
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(self.word())
            }
        }

        impl $crate::recipe::entry::Entry for $name {
            fn read(
                &mut self,
                value: &toml::Spanned<toml::de::DeValue<'_>>,
                key: &str,
                _: $crate::recipe::entry::Rule,
                reader: &mut $crate::recipe::reader::Reader<'_>,
            ) {
                let words = [$first_word $(, $word)*];
                if let Some(i) = $crate::recipe::word::position(value, key, &words, reader) {
                    *self = Self::ALL[i];
                }
            }

            fn schema(
                &self,
                _: $crate::recipe::entry::Rule,
                _: &mut schemars::SchemaGenerator,
            ) -> schemars::Schema {
                $crate::recipe::word::schema(
                    self.word(),
                    &[
                        ($first_word, concat!($($first_doc),*)),
                        $(($word, concat!($($word_doc),*)),)*
                    ],
                )
            }

            fn walk<'a>(
                &'a self,
                key: &str,
                doc: &'static str,
                visit: &mut dyn FnMut($crate::recipe::entry::Leaf<'a>),
            ) {
                visit($crate::recipe::entry::Leaf::of(key, self, doc));
            }
        }

        impl serde::Serialize for $name {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.serialize_str(self.word())
            }
        }

        $crate::recipe::embed::deserialize!($name, $crate::recipe::entry::Rule::ANY);
    };
}
pub(crate) use words;

/// Which of `words` the value is.
pub(crate) fn position(
    value: &Spanned<DeValue<'_>>,
    key: &str,
    words: &[&str],
    reader: &mut Reader<'_>,
) -> Option<usize> {
    let text = value.get_ref().as_str();
    let found = text.and_then(|text| words.iter().position(|word| *word == text));
    if found.is_none() {
        reader.wrong_word(key, value, words);
    }
    found
}

/// An `enum` schema; the meaning of each word goes into the description, where
/// every editor shows it.
pub(crate) fn schema(default: &str, words: &[(&str, &str)]) -> Schema {
    let mut schema = Schema::default();
    let names: Vec<_> = words.iter().map(|(word, _)| *word).collect();
    let meanings: Vec<_> = words
        .iter()
        .map(|(word, doc)| format!("`{word}`: {}", doc.trim()))
        .collect();
    schema.insert("type".into(), json!("string"));
    schema.insert("enum".into(), json!(names));
    schema.insert("default".into(), json!(default));
    schema.insert("description".into(), json!(meanings.join("\n")));
    schema
}
