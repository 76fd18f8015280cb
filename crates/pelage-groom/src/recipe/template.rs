//! A recipe as text: as it is, or with every key explained.

use super::Recipe;
use super::entry::{Entry, Leaf};
use super::ramp::Along;
use super::schema::description;

/// Width of the comments in a template.
const COLUMNS: usize = 78;

impl Recipe {
    /// The recipe as a `groom.toml` with every key that has a value. Reading it
    /// back gives an equal recipe.
    ///
    /// ```
    /// use pelage_groom::recipe::Recipe;
    /// use std::path::Path;
    ///
    /// let text = "surface.mesh = 'body.obj'\nguides.curves = 'guides.usda'";
    /// let recipe = Recipe::parse(text, Path::new("groom.toml"))?;
    /// let again = Recipe::parse(&recipe.to_toml(), Path::new("groom.toml"))?;
    /// assert_eq!(again, recipe);
    /// # Ok::<(), pelage_groom::recipe::RecipeError>(())
    /// ```
    pub fn to_toml(&self) -> String {
        let mut text = Writer::default();
        self.walk("", "", &mut |leaf| text.key(&leaf, false));
        text.text
    }

    /// [`Recipe::to_toml`] with the documentation of each key above it, and keys
    /// without a value as comments.
    pub fn to_documented_toml(&self) -> String {
        let mut text = Writer::default();
        self.walk("", "", &mut |leaf| text.key(&leaf, true));
        text.text
    }
}

/// Text in the making.
#[derive(Default)]
struct Writer {
    text: String,
    /// The section it is in.
    section: String,
    /// Which keys of that section a ramp leaves out.
    along: Along,
}

impl Writer {
    /// Adds a key, after the header of its section if that is another.
    fn key(&mut self, leaf: &Leaf<'_>, documented: bool) {
        if leaf.text.is_none() && !documented {
            return;
        }
        let (section, name) = leaf.key.rsplit_once('.').unwrap_or(("", &leaf.key));
        if section != self.section {
            let gap = if self.text.is_empty() { "" } else { "\n" };
            self.text += &format!("{gap}[{section}]\n");
            self.section = section.to_owned();
            self.along = Along::default();
        }
        if !self.along.has(name, leaf.ramp) {
            return;
        }
        if documented {
            self.comment(leaf.doc);
        }
        match &leaf.text {
            Some(text) => self.text += &format!("{name} = {text}\n"),
            None => self.text += &format!("# {name} =\n"),
        }
    }

    /// Adds `doc` as comment lines.
    fn comment(&mut self, doc: &str) {
        let mut line = "#".to_owned();
        for word in description(doc).split_whitespace() {
            if line.len() + 1 + word.len() > COLUMNS {
                self.text += &format!("{line}\n");
                line = "#".to_owned();
            }
            line += &format!(" {word}");
        }
        self.text += &format!("{line}\n");
    }
}
