//! What is wrong with a recipe, where, and what would be right.

use std::fmt;
use std::path::{Path, PathBuf};

use super::excerpt::Excerpt;

/// What sort of mistake a [`Problem`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ProblemKind {
    /// The file cannot be read, is not UTF-8 or is too large.
    File,
    /// The text is not TOML; a key given twice counts as that.
    Syntax,
    /// A key that recipes do not have.
    UnknownKey,
    /// A value of another type than the key takes, or a word it does not know.
    WrongType,
    /// A value of the right type that is not allowed.
    OutOfRange,
    /// A key that has to be there.
    Missing,
    /// Two keys that exclude each other.
    Exclusive,
    /// Something the recipe names (a map, a mesh) does not fit it.
    Content,
}

/// One mistake in a recipe.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// What sort of mistake it is.
    pub kind: ProblemKind,
    /// The recipe, as it was named to the reader; empty if it is no file.
    pub file: PathBuf,
    /// Line of the value or key that is wrong, from 1; 0 where it has no place.
    pub line: usize,
    /// Column in characters, from 1; 0 where it has no place.
    pub column: usize,
    /// Dotted path of the key, such as `hair.count` or `frizz.frequency[1]`;
    /// empty for the text as a whole.
    pub key: String,
    /// What is wrong, in one sentence.
    pub message: String,
    /// What was found, as the recipe writes it.
    pub found: Option<String>,
    /// What is allowed there.
    pub allowed: Option<String>,
    /// What was probably meant, as a sentence.
    pub suggestion: Option<String>,
    /// The line of the recipe and what to underline in it.
    pub(crate) excerpt: Option<Excerpt>,
}

impl Problem {
    /// The same mistake where its place means nothing to the reader.
    pub(crate) fn without_place(self) -> Self {
        Self {
            file: PathBuf::new(),
            line: 0,
            column: 0,
            excerpt: None,
            ..self
        }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.file.as_os_str().is_empty() {
            write!(f, "{}:", self.file.display())?;
            if self.line > 0 {
                write!(f, "{}:{}:", self.line, self.column)?;
            }
            write!(f, " ")?;
        }
        if !self.key.is_empty() {
            write!(f, "{}: ", self.key)?;
        }
        write!(f, "{}", self.message)?;
        if let Some(excerpt) = &self.excerpt {
            write!(f, "\n{excerpt}")?;
        }
        if let Some(suggestion) = &self.suggestion {
            let margin = self.excerpt.as_ref().map_or(2, Excerpt::margin);
            write!(f, "\n{:margin$} = {suggestion}", "")?;
        }
        Ok(())
    }
}

/// Why a text is no recipe: one problem or several, in the order of the text.
///
/// ```
/// use pelage_groom::recipe::Recipe;
/// use std::path::Path;
///
/// let text = "surface.mesh = \"body.obj\"\nguides.curves = \"g.usda\"\nhair.count = \"many\"\n";
/// let error = Recipe::parse(text, Path::new("groom.toml")).unwrap_err();
/// assert_eq!(
///     error.to_string(),
///     r#"groom.toml:3:14: hair.count: expected a whole number 0.., found "many"
///   |
/// 3 | hair.count = "many"
///   |              ^^^^^^"#,
/// );
/// assert_eq!(error.first().key, "hair.count");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RecipeError {
    /// At least one.
    problems: Vec<Problem>,
}

/// How many problems are printed; the rest are counted.
const PRINTED: usize = 20;

impl RecipeError {
    /// The problems in the order of the text, or none if there are none.
    pub(crate) fn from_problems(mut problems: Vec<Problem>) -> Option<Self> {
        problems.sort_by_key(|problem| (problem.line, problem.column));
        (!problems.is_empty()).then_some(Self { problems })
    }

    /// One problem with the file as a whole.
    pub(crate) fn of_file(file: &Path, message: String) -> Self {
        Self::from(Problem {
            kind: ProblemKind::File,
            file: file.to_owned(),
            line: 0,
            column: 0,
            key: String::new(),
            message,
            found: None,
            allowed: None,
            suggestion: None,
            excerpt: None,
        })
    }

    /// The first problem.
    pub fn first(&self) -> &Problem {
        &self.problems[0]
    }

    /// All problems, in the order of the text.
    pub fn problems(&self) -> &[Problem] {
        &self.problems
    }
}

impl From<Problem> for RecipeError {
    fn from(problem: Problem) -> Self {
        Self {
            problems: vec![problem],
        }
    }
}

impl fmt::Display for RecipeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, problem) in self.problems.iter().take(PRINTED).enumerate() {
            let gap = if i > 0 { "\n\n" } else { "" };
            write!(f, "{gap}{problem}")?;
        }
        match self.problems.len().saturating_sub(PRINTED) {
            0 => Ok(()),
            more => write!(f, "\n\nand {more} more"),
        }
    }
}

impl std::error::Error for RecipeError {}
