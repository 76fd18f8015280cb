//! `[guides]`: the curves that shape the hair, from a file or grown.

use super::entry::Rule;
use super::grow::Grow;
use super::path::FilePath;
use super::section::section;

section! {
    /// The curves that shape their neighbours: either `curves`, a file, or `grow`.
    pub struct Guides {
        /// The file with the guide curves, each starting on the rest mesh.
        /// Excludes `grow`.
        pub curves: Option<FilePath> = None => Rule::ANY,
        /// The guides in the pose to be dressed: as many as in `curves` and in the same
        /// order, in one file, a file with time samples, or one file a frame
        /// (`guides.####.usda`). Left out, guides move with the skin. Goes with `curves`.
        pub posed: Option<FilePath> = None => Rule::ANY,
        /// How far from the rest mesh a guide may start, in units of the mesh; its
        /// root is the closest point. Left out, a hundredth of the diagonal of the
        /// mesh's box. Goes with `curves`.
        pub tolerance: Option<f32> = None => Rule::at_least(0.0).length(),
        /// Guides grown by rule instead of read from a file. Excludes `curves`.
        pub grow: Option<Grow> = None => Rule::ANY,
    }
}

/// Where guides come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GuideSource<'a> {
    /// Curves in a file.
    Curves(&'a FilePath),
    /// Curves grown by rule.
    Grow(&'a Grow),
}

impl Guides {
    /// Where the guides come from: a recipe read from text has exactly one
    /// source; `None` only where a `Guides` was put together with none.
    ///
    /// ```
    /// use pelage_groom::recipe::{GuideSource, Recipe};
    /// use std::path::Path;
    ///
    /// let text = "surface.mesh = 'body.obj'\nguides.grow = { length = 0.3 }";
    /// let recipe = Recipe::parse(text, Path::new("groom.toml"))?;
    /// assert!(matches!(recipe.guides.source(), Some(GuideSource::Grow(_))));
    /// # Ok::<(), pelage_groom::recipe::RecipeError>(())
    /// ```
    pub fn source(&self) -> Option<GuideSource<'_>> {
        let curves = self.curves.as_ref().map(GuideSource::Curves);
        curves.or(self.grow.as_ref().map(GuideSource::Grow))
    }
}
