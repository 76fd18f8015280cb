//! Paths, relative to the folder of the recipe.

use std::path::{Path, PathBuf};

use schemars::{Schema, SchemaGenerator};
use serde::{Serialize, Serializer};
use toml::Spanned;
use toml::de::DeValue;

use super::embed::deserialize;
use super::entry::{Entry, Leaf, Rule};
use super::reader::Reader;

/// A file that a recipe names.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct FilePath {
    /// The path as the recipe writes it.
    pub written: String,
    /// The path to open: relative ones start at the folder of the recipe.
    pub resolved: PathBuf,
}

impl FilePath {
    /// `written`, starting at `folder` unless it is absolute.
    ///
    /// ```
    /// use pelage_groom::recipe::FilePath;
    /// use std::path::Path;
    ///
    /// let map = FilePath::new("maps/density.png", Path::new("hero"));
    /// assert_eq!(map.resolved, Path::new("hero/maps/density.png"));
    /// ```
    pub fn new(written: impl Into<String>, folder: &Path) -> Self {
        let written = written.into();
        let resolved = folder.join(&written);
        Self { written, resolved }
    }
}

/// What stands for the number of a tile in the name of a UDIM set.
const UDIM: &str = "<UDIM>";

/// A UDIM set is named as one file with `<UDIM>` in place of a tile's number.
///
/// ```
/// use pelage_groom::recipe::FilePath;
/// use std::path::Path;
///
/// let maps = FilePath::new("maps/fur.<UDIM>.png", Path::new("hero"));
/// assert!(maps.is_tiled());
/// assert_eq!(maps.tile(1013), Path::new("hero/maps/fur.1013.png"));
/// assert_eq!(maps.tile_number(Path::new("hero/maps/fur.1013.png")), Some(1013));
/// assert_eq!(maps.tile_number(Path::new("hero/maps/fur.13.png")), None);
/// ```
impl FilePath {
    /// Whether this names a UDIM set.
    pub fn is_tiled(&self) -> bool {
        self.around_number().is_some()
    }

    /// The file of tile `number`; the path itself if it names no set.
    pub fn tile(&self, number: u32) -> PathBuf {
        match self.around_number() {
            Some((before, after)) => self
                .resolved
                .with_file_name(format!("{before}{number}{after}")),
            None => self.resolved.clone(),
        }
    }

    /// The number of the tile whose file is `path`: four digits, 1001 to 9999.
    pub fn tile_number(&self, path: &Path) -> Option<u32> {
        let (before, after) = self.around_number()?;
        let name = path.file_name()?.to_str()?;
        let digits = name.strip_prefix(before)?.strip_suffix(after)?;
        let four = digits.len() == 4 && digits.bytes().all(|b| b.is_ascii_digit());
        let number = digits.parse().ok().filter(|_| four)?;
        let same_folder = path.parent() == self.resolved.parent();
        (number > 1000 && same_folder).then_some(number)
    }

    /// The file's name before and after the number.
    fn around_number(&self) -> Option<(&str, &str)> {
        self.resolved.file_name()?.to_str()?.split_once(UDIM)
    }
}

impl std::fmt::Display for FilePath {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.written)
    }
}

impl Entry for FilePath {
    fn read(&mut self, value: &Spanned<DeValue<'_>>, key: &str, _: Rule, reader: &mut Reader<'_>) {
        match value.get_ref().as_str() {
            Some(text) if !text.trim().is_empty() => *self = Self::new(text, reader.folder()),
            _ => reader.wrong_type(key, value, "the path of a file".to_owned()),
        }
    }

    fn absent(
        &self,
        key: &str,
        rule: Rule,
        span: &std::ops::Range<usize>,
        reader: &mut Reader<'_>,
    ) {
        if rule.required {
            reader.missing(key, span.clone(), Some("the path of a file"));
        }
    }

    fn schema(&self, _: Rule, _: &mut SchemaGenerator) -> Schema {
        schemars::json_schema!({ "type": "string", "minLength": 1 })
    }

    fn walk<'a>(&'a self, key: &str, doc: &'static str, visit: &mut dyn FnMut(Leaf<'a>)) {
        visit(Leaf::of(key, self, doc));
    }

    fn settle(&mut self, folder: &Path) {
        self.resolved = folder.join(&self.written);
    }
}

impl Serialize for FilePath {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.written)
    }
}

deserialize!(FilePath, Rule::ANY);
