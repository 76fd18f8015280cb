//! Image maps as a recipe names them.

use pelage_surface::Wrap;
use schemars::{Schema, SchemaGenerator};
use serde::ser::SerializeMap;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::entry::{Entry, Leaf, Rule};
use super::path::FilePath;
use super::reader::{Reader, join};
use super::word::{self, words};

words! {
    /// Which number of a texel a scalar property reads.
    pub enum Channel {
        /// The first channel, the only one of a grey image.
        Red = "r",
        /// The second channel.
        Green = "g",
        /// The third channel.
        Blue = "b",
        /// The fourth channel.
        Alpha = "a",
        /// Rec. 709 luminance of the linear colour.
        Luminance = "luminance",
    }
}

words! {
    /// How the codes of an image are to be understood.
    pub enum MapSpace {
        /// The numbers as they are.
        Linear = "linear",
        /// sRGB codes, decoded to linear.
        Srgb = "srgb",
    }
}

words! {
    /// How a map acts on the value beside it.
    pub enum Blend {
        /// `value + map`: what document 004 does with colours (2.2.6).
        Add = "add",
        /// `value × map`: always so for numbers.
        Multiply = "multiply",
    }
}

/// A map and how it is read.
#[derive(Clone, Debug, PartialEq)]
pub struct MapUse {
    /// The image, or the images of a UDIM set ([`FilePath::is_tiled`]).
    pub path: FilePath,
    /// The channel read. `None` reads the whole colour (the default of colours
    /// and directions); numbers always have one, red unless the recipe says
    /// otherwise. A colour with a channel is grey of that channel.
    pub channel: Option<Channel>,
    /// What lies outside 0..1 of the UVs; repeats by default. A UDIM set has no wrap.
    pub wrap: Wrap,
    /// How codes are read. `None` leaves it to the image: 8-bit colour maps are
    /// sRGB, everything else is linear.
    pub space: Option<MapSpace>,
    /// How the map acts on the value: numbers multiply, colours add by default.
    pub blend: Blend,
}

impl MapUse {
    /// The map at `path`, read as properties read it by default: `channel` is
    /// red for numbers and `None` for colours.
    pub fn new(path: FilePath, channel: Option<Channel>, blend: Blend) -> Self {
        Self {
            path,
            channel,
            wrap: Wrap::default(),
            space: None,
            blend,
        }
    }

    /// Reads the keys of a table that goes with `map`, which must be there if
    /// any of them is.
    pub(crate) fn read(
        table: &DeTable<'_>,
        key: &str,
        standard: MapUse,
        keys: &[&str],
        reader: &mut Reader<'_>,
    ) -> Option<Self> {
        let mut using = standard;
        let map = join(key, "map");
        let path = reader.find(table, &map, "map");
        for name in ["channel", "wrap", "space", "blend"] {
            let inner = join(key, name);
            if !keys.contains(&name) {
                continue;
            }
            let Some(value) = reader.find(table, &inner, name) else {
                continue;
            };
            if path.is_none() {
                reader.lonely(&inner, value.span(), "map");
            }
            match name {
                "channel" => using.channel.read(value, &inner, Rule::ANY, reader),
                "wrap" => using.wrap.read(value, &inner, Rule::ANY, reader),
                "space" => using.space.read(value, &inner, Rule::ANY, reader),
                _ => using.blend.read(value, &inner, Rule::ANY, reader),
            }
        }
        using.path.read(path?, &map, Rule::ANY, reader);
        if let Some(wrap) = table.get("wrap").filter(|_| using.path.is_tiled()) {
            let message = "says nothing beside a map with <UDIM>, whose tiles \
                are where their numbers say: leave it out";
            reader.contradiction(&join(key, "wrap"), wrap.span(), message.to_owned());
        }
        Some(using)
    }

    /// Adds the keys `map`, `channel`, … to a table, where they are not what is
    /// taken without them.
    pub(crate) fn write<M: SerializeMap>(
        &self,
        standard_channel: Option<Channel>,
        standard_blend: Blend,
        table: &mut M,
    ) -> Result<(), M::Error> {
        table.serialize_entry("map", &self.path)?;
        if let Some(channel) = self.channel.filter(|_| self.channel != standard_channel) {
            table.serialize_entry("channel", &channel)?;
        }
        if self.wrap != Wrap::default() {
            table.serialize_entry("wrap", word_of(self.wrap))?;
        }
        if let Some(space) = self.space {
            table.serialize_entry("space", &space)?;
        }
        if self.blend != standard_blend {
            table.serialize_entry("blend", &self.blend)?;
        }
        Ok(())
    }
}

/// What each wrap is called, and what it does.
const WRAPS: [(Wrap, &str, &str); 3] = [
    (
        Wrap::Repeat,
        "repeat",
        "the image repeats outside 0..1 of the UVs",
    ),
    (Wrap::Clamp, "clamp", "the border texels go on"),
    (
        Wrap::Mirror,
        "mirror",
        "the image and its mirror image take turns, upright in 0..1",
    ),
];

fn word_of(wrap: Wrap) -> &'static str {
    let named = WRAPS.iter().find(|(named, ..)| *named == wrap);
    named.map_or("", |(_, word, _)| word)
}

impl Entry for Wrap {
    fn read(&mut self, value: &Spanned<DeValue<'_>>, key: &str, _: Rule, reader: &mut Reader<'_>) {
        if let Some(i) = word::position(value, key, &WRAPS.map(|(_, word, _)| word), reader) {
            *self = WRAPS[i].0;
        }
    }

    fn schema(&self, _: Rule, _: &mut SchemaGenerator) -> Schema {
        word::schema(word_of(*self), &WRAPS.map(|(_, word, does)| (word, does)))
    }

    fn walk<'a>(&'a self, key: &str, doc: &'static str, visit: &mut dyn FnMut(Leaf<'a>)) {
        visit(Leaf::of(key, &word_of(*self), doc));
    }
}
