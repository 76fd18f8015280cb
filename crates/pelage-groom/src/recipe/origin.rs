//! The text a recipe was read from, for errors that are found later.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::Recipe;
use super::error::{Problem, ProblemKind, RecipeError};
use super::excerpt::Place;
use super::reader::placed;

/// The text, its file and the places of its values. Two recipes that say the
/// same are equal wherever they were written, so origins always are.
#[derive(Clone, Debug, Default)]
pub(crate) struct Origin(Arc<Text>);

#[derive(Debug, Default)]
struct Text {
    file: PathBuf,
    source: String,
    spans: BTreeMap<String, Range<usize>>,
}

impl PartialEq for Origin {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Origin {
    pub(crate) fn new(file: &Path, source: &str, spans: BTreeMap<String, Range<usize>>) -> Self {
        Self(Arc::new(Text {
            file: file.to_owned(),
            source: source.to_owned(),
            spans,
        }))
    }

    /// A problem with the value of `key`, or of the nearest table above it that
    /// is written.
    fn problem(&self, kind: ProblemKind, key: &str, message: String) -> Problem {
        let Text {
            file,
            source,
            spans,
        } = &*self.0;
        let mut nearest = key;
        let span = loop {
            match (spans.get(nearest), nearest.rfind(['.', '['])) {
                (Some(span), _) => break Some(span.clone()),
                (None, Some(end)) => nearest = &nearest[..end],
                (None, None) => break None,
            }
        };
        let problem = placed(
            source,
            file,
            kind,
            key,
            span.clone().unwrap_or(0..0),
            message,
        );
        match span {
            Some(_) => problem,
            None => Problem {
                file: file.clone(),
                ..problem.without_place()
            },
        }
    }
}

impl Recipe {
    /// The file the recipe was read from; empty if it was put together.
    pub fn file(&self) -> &Path {
        &self.origin.0.file
    }

    /// Where the recipe writes the value of `key`, if it does.
    ///
    /// ```
    /// use pelage_groom::recipe::{Place, Recipe};
    /// use std::path::Path;
    ///
    /// let text = "surface.mesh = 'body.obj'\nguides.curves = 'guides.usda'";
    /// let recipe = Recipe::parse(text, Path::new("groom.toml"))?;
    /// assert_eq!(recipe.place("guides.curves"), Some(Place { line: 2, column: 17 }));
    /// assert_eq!(recipe.place("hair.count"), None);
    /// # Ok::<(), pelage_groom::recipe::RecipeError>(())
    /// ```
    pub fn place(&self, key: &str) -> Option<Place> {
        let Text { source, spans, .. } = &*self.origin.0;
        spans.get(key).map(|span| Place::of(source, span.start))
    }

    /// An error at the value of `key`, for whoever finds out later that it does
    /// not fit: a map that cannot be opened, a mesh without UVs.
    ///
    /// ```
    /// use pelage_groom::recipe::Recipe;
    /// use std::path::Path;
    ///
    /// let text = "surface.mesh = 'body.obj'\nguides.curves = 'guides.usda'";
    /// let recipe = Recipe::parse(text, Path::new("groom.toml"))?;
    /// let error = recipe.error_at("guides.curves", "there is no such file");
    /// assert_eq!(error.first().line, 2);
    /// # Ok::<(), pelage_groom::recipe::RecipeError>(())
    /// ```
    pub fn error_at(&self, key: &str, message: impl Into<String>) -> RecipeError {
        let problem = self
            .origin
            .problem(ProblemKind::Content, key, message.into());
        RecipeError::from(problem)
    }
}
