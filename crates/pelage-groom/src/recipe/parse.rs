//! From the text of a `groom.toml` to a recipe.

use std::path::Path;

use serde::{Deserialize, Deserializer};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::Recipe;
use super::check::check;
use super::embed;
use super::entry::{Entry, Rule};
use super::error::{Problem, RecipeError};
use super::map::MapUse;
use super::origin::Origin;
use super::reader::Reader;
use super::syntax::syntax;

/// Largest recipe in bytes. Real ones are a few kilobytes; the limit is against
/// a mesh or an image passed by mistake.
const LARGEST: usize = 16 << 20;

impl Recipe {
    /// Reads the text of `file`, which names the recipe in errors and whose
    /// folder is where relative paths start. The file itself is not opened.
    ///
    /// The error lists every mistake, each with its place.
    pub fn parse(text: &str, file: &Path) -> Result<Self, RecipeError> {
        let (recipe, problems) = read(text, file)?;
        finish(recipe, problems)
    }

    /// Opens and reads a `groom.toml`.
    pub fn load(file: &Path) -> Result<Self, RecipeError> {
        let failed = |error| RecipeError::of_file(file, format!("cannot read the recipe: {error}"));
        let size = std::fs::metadata(file).map_err(failed)?.len();
        if size > LARGEST as u64 {
            return Err(too_large(file, size));
        }
        let bytes = std::fs::read(file).map_err(failed)?;
        let text = String::from_utf8(bytes).map_err(|error| {
            let at = error.utf8_error().valid_up_to();
            RecipeError::of_file(file, format!("not UTF-8 text: byte {at} is wrong"))
        })?;
        Self::parse(&text, file)
    }

    /// Every map the recipe uses, with its dotted key.
    pub fn maps(&self) -> Vec<(String, &MapUse)> {
        let mut maps = Vec::new();
        self.walk("", "", &mut |leaf| maps.extend(leaf.maps));
        maps
    }

    /// The same recipe with its relative paths starting at `folder`, for recipes
    /// that were not read from a file of their own.
    ///
    /// ```
    /// use pelage_groom::recipe::Recipe;
    /// use std::path::Path;
    ///
    /// #[derive(serde::Deserialize)]
    /// struct Shot {
    ///     frames: [u32; 2],
    ///     groom: Recipe,
    /// }
    ///
    /// let text = r#"
    /// frames = [1, 48]
    /// groom.surface.mesh = "body.obj"
    /// groom.guides.grow = { length = 0.3 }
    /// "#;
    /// let shot: Shot = toml::from_str(text)?;
    /// let groom = shot.groom.in_folder(Path::new("hero"));
    /// assert_eq!(groom.surface.mesh.resolved, Path::new("hero/body.obj"));
    /// # Ok::<(), toml::de::Error>(())
    /// ```
    #[must_use]
    pub fn in_folder(mut self, folder: &Path) -> Self {
        self.settle(folder);
        self
    }
}

/// Accepts and refuses what [`Recipe::parse`] does; errors list every mistake
/// with its key. Relative paths start at the current folder until
/// [`Recipe::in_folder`] says otherwise. Needs a format that describes itself,
/// as TOML, JSON and YAML do.
impl<'de> Deserialize<'de> for Recipe {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let mut recipe = Self::default();
        let problems = embed::read(deserializer, |value, reader| recipe.take(value, reader))?;
        embed::finish(recipe, problems)
    }
}

impl Recipe {
    /// Takes over what a table says, and checks it as a whole.
    fn take(&mut self, table: &Spanned<DeValue<'_>>, reader: &mut Reader<'_>) {
        self.read(table, "", Rule::ANY, reader);
        check(self, reader);
    }
}

/// What can be read, and what is wrong with the rest.
fn read(text: &str, file: &Path) -> Result<(Recipe, Vec<Problem>), RecipeError> {
    if text.len() > LARGEST {
        return Err(too_large(file, text.len() as u64));
    }
    // The parser bounds the depth of tables and lists itself (80).
    let table = DeTable::parse(text).map_err(|error| syntax(text, file, error))?;
    let table = Spanned::new(table.span(), DeValue::Table(table.into_inner()));
    let mut reader = Reader::new(text, file);
    let mut recipe = Recipe::default();
    recipe.take(&table, &mut reader);
    let (problems, spans) = reader.finish();
    recipe.origin = Origin::new(file, text, spans);
    Ok((recipe, problems))
}

/// The recipe, if nothing is wrong.
fn finish(recipe: Recipe, problems: Vec<Problem>) -> Result<Recipe, RecipeError> {
    match RecipeError::from_problems(problems) {
        Some(error) => Err(error),
        None => Ok(recipe),
    }
}

fn too_large(file: &Path, size: u64) -> RecipeError {
    let message = format!("{size} bytes are too much for a recipe, which has {LARGEST} at most");
    RecipeError::of_file(file, message)
}
