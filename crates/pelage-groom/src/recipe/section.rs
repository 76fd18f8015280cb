//! `section!`: a table of a recipe, written once.
//!
//! A section's keys, ranges, defaults and descriptions are needed by whoever
//! reads a recipe, checks it, explains what is wrong, offers completion in an
//! editor or prints a template. The macro makes the struct and all of these
//! from one list, so they cannot disagree; `Serialize` and `Deserialize` too, the
//! latter by way of the same reader. serde's derive would read as well, but stops
//! at the first error and knows neither ranges nor, behind an untagged enum such
//! as "a number or a table", the column of the value.

/// Declares a section: `/// doc`, `pub key: Type = default => rule,` for each key.
macro_rules! section {
    ($(#[$($doc:tt)*])* pub struct $name:ident { $($keys:tt)* }) => {
        $crate::recipe::section::table! {
            $(#[$($doc)*])*
            pub struct $name { $($keys)* }
        }
        $crate::recipe::embed::deserialize!($name, $crate::recipe::entry::Rule::ANY);
    };
}
pub(crate) use section;

/// `section!` but for `Deserialize`: the recipe itself is more than its keys.
/// A trailing `; name: Type` adds a field that is no key.
macro_rules! table {
    (
        $(#[doc = $doc:literal])*
        pub struct $name:ident {
            $(
                $(#[doc = $field_doc:literal])*
                pub $field:ident: $type:ty = $default:expr => $rule:expr,
            )+
            $(; $(#[doc = $extra_doc:literal])* $extra:ident: $extra_type:ty)?
        }
    ) => {
        $(#[doc = $doc])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $name {
            $($(#[doc = $field_doc])* pub $field: $type,)+
            $($(#[doc = $extra_doc])* pub(crate) $extra: $extra_type,)?
        }

        impl Default for $name {
            fn default() -> Self {
                Self {
                    $($field: $default,)+
                    $($extra: <$extra_type>::default(),)?
                }
            }
        }

        impl $crate::recipe::entry::Entry for $name {
            fn read(
                &mut self,
                value: &toml::Spanned<toml::de::DeValue<'_>>,
                key: &str,
                rule: $crate::recipe::entry::Rule,
                reader: &mut $crate::recipe::reader::Reader<'_>,
            ) {
                let _ = rule;
                let Some(table) = reader.table(value, key) else { return };
                $(
                    let name = $crate::recipe::reader::join(key, stringify!($field));
                    match reader.find(table, &name, stringify!($field)) {
                        Some(found) => self.$field.read(found, &name, $rule, reader),
                        None => self.$field.absent(&name, $rule, &value.span(), reader),
                    }
                )+
                reader.refuse_others(table, key, &[$(stringify!($field)),+]);
            }

            fn absent(
                &self,
                key: &str,
                rule: $crate::recipe::entry::Rule,
                span: &std::ops::Range<usize>,
                reader: &mut $crate::recipe::reader::Reader<'_>,
            ) {
                let _ = rule;
                $(
                    let name = $crate::recipe::reader::join(key, stringify!($field));
                    self.$field.absent(&name, $rule, span, reader);
                )+
            }

            fn schema(
                &self,
                rule: $crate::recipe::entry::Rule,
                generator: &mut schemars::SchemaGenerator,
            ) -> schemars::Schema {
                let _ = rule;
                let mut table = $crate::recipe::schema::Table::new(concat!($($doc, "\n"),*));
                $(
                    table.key(
                        stringify!($field),
                        concat!($($field_doc, "\n"),*),
                        $rule,
                        &self.$field,
                        generator,
                    );
                )+
                table.finish()
            }

            fn walk<'a>(
                &'a self,
                key: &str,
                doc: &'static str,
                visit: &mut dyn FnMut($crate::recipe::entry::Leaf<'a>),
            ) {
                let _ = doc;
                $(
                    let name = $crate::recipe::reader::join(key, stringify!($field));
                    self.$field.walk(&name, concat!($($field_doc, "\n"),*), visit);
                )+
            }

            fn outline(
                &self,
                key: &str,
                doc: &'static str,
                rule: $crate::recipe::entry::Rule,
                generator: &mut schemars::SchemaGenerator,
                tell: &mut dyn FnMut($crate::recipe::outline::Told),
            ) {
                let _ = (rule, doc);
                let doc = concat!($($doc, "\n"),*);
                tell($crate::recipe::outline::Told::Section { key: key.to_owned(), doc });
                $(
                    let name = $crate::recipe::reader::join(key, stringify!($field));
                    let doc = concat!($($field_doc, "\n"),*);
                    self.$field.outline(&name, doc, $rule, generator, tell);
                )+
            }

            fn settle(&mut self, folder: &std::path::Path) {
                $(self.$field.settle(folder);)+
            }
        }

        impl serde::Serialize for $name {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                use serde::ser::SerializeStruct;

                use $crate::recipe::entry::Entry;

                let mut along = $crate::recipe::ramp::Along::default();
                let written = [$(self.$field.is_written() && along.has(
                    stringify!($field),
                    self.$field.is_ramp(),
                )),+];
                let count = written.iter().filter(|written| **written).count();
                let mut keys = serializer.serialize_struct(stringify!($name), count)?;
                let mut written = written.into_iter();
                $(
                    match written.next() {
                        Some(true) => keys.serialize_field(stringify!($field), &self.$field)?,
                        _ => keys.skip_field(stringify!($field))?,
                    }
                )+
                keys.end()
            }
        }
    };
}
pub(crate) use table;
