//! Reading with reports: the values that are right are taken over, and every
//! mistake is noted with its place.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::embed::inline;
use super::error::{Problem, ProblemKind};
use super::excerpt::{Excerpt, Place};
use super::suggest::nearest;

/// How many problems are noted at most.
const NOTED: usize = 200;

/// The text of a recipe and what was found in it so far.
pub(crate) struct Reader<'s> {
    source: &'s str,
    file: &'s Path,
    folder: PathBuf,
    /// Mistakes, in the order they were met.
    problems: Vec<Problem>,
    /// Keys that unknown ones were probably meant to be.
    meant: Vec<String>,
    /// Bytes of the value of every key met, by dotted key.
    pub(crate) spans: BTreeMap<String, Range<usize>>,
}

/// `name` below `key`, quoted where TOML would need it.
pub(crate) fn join(key: &str, name: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    let name = if !name.is_empty() && name.chars().all(bare) {
        name.to_owned()
    } else {
        inline(&name)
    };
    if key.is_empty() {
        name
    } else {
        format!("{key}.{name}")
    }
}

/// Whether `key` is `above` or below it.
fn is_below(key: &str, above: &str) -> bool {
    let rest = key.strip_prefix(above);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
}

impl<'s> Reader<'s> {
    /// A reader of `source`, the text of `file`.
    pub(crate) fn new(source: &'s str, file: &'s Path) -> Self {
        Self {
            source,
            file,
            folder: file.parent().unwrap_or(Path::new("")).to_owned(),
            problems: Vec::new(),
            meant: Vec::new(),
            spans: BTreeMap::new(),
        }
    }

    /// The mistakes and the places of values. A key that is missing because it
    /// is misspelt is reported once, where it is misspelt.
    pub(crate) fn finish(mut self) -> (Vec<Problem>, BTreeMap<String, Range<usize>>) {
        let meant = self.meant;
        let misspelt = |key: &str| meant.iter().any(|m| is_below(m, key) || is_below(key, m));
        self.problems
            .retain(|p| p.kind != ProblemKind::Missing || !misspelt(&p.key));
        (self.problems, self.spans)
    }

    /// Whether the value of exactly `key` has been refused.
    pub(crate) fn refused(&self, key: &str) -> bool {
        self.problems.iter().any(|problem| problem.key == key)
    }

    /// The folder where relative paths start.
    pub(crate) fn folder(&self) -> &Path {
        &self.folder
    }

    /// The value as a table, or a report.
    pub(crate) fn table<'v, 'd>(
        &mut self,
        value: &'v Spanned<DeValue<'d>>,
        key: &str,
    ) -> Option<&'v DeTable<'d>> {
        let table = value.get_ref().as_table();
        if table.is_none() {
            self.wrong_type(key, value, "a table".to_owned());
        }
        table
    }

    /// The value of `name` in `table`, whose place is remembered as `key`.
    pub(crate) fn find<'v, 'd>(
        &mut self,
        table: &'v DeTable<'d>,
        key: &str,
        name: &str,
    ) -> Option<&'v Spanned<DeValue<'d>>> {
        let value = table.get(name)?;
        self.remember(key, value);
        Some(value)
    }

    /// Remembers the place of `value` as that of `key`.
    pub(crate) fn remember(&mut self, key: &str, value: &Spanned<DeValue<'_>>) {
        self.spans.insert(key.to_owned(), value.span());
    }

    /// Reports every key of `table` that is not among `allowed`; false if none.
    pub(crate) fn refuse_others(
        &mut self,
        table: &DeTable<'_>,
        key: &str,
        allowed: &[&str],
    ) -> bool {
        let before = self.problems.len();
        for name in table
            .keys()
            .filter(|name| !allowed.contains(&name.get_ref().as_ref()))
        {
            if self.problems.len() >= NOTED {
                break;
            }
            let found = name.get_ref().as_ref();
            let list = allowed.join(", ");
            let meant = nearest(found, allowed);
            self.meant.extend(meant.map(|word| join(key, word)));
            let holder = if key.is_empty() { "a recipe" } else { key };
            self.push(Problem {
                found: Some(shortened(found)),
                allowed: Some(list.clone()),
                suggestion: meant.map(|word| format!("did you mean {word:?}?")),
                ..self.problem(
                    ProblemKind::UnknownKey,
                    &join(key, &shortened(found)),
                    name.span(),
                    format!("unknown key; {holder} has {list}"),
                )
            });
        }
        self.problems.len() > before
    }

    /// Reports a value of another type than `expected`.
    pub(crate) fn wrong_type(&mut self, key: &str, value: &Spanned<DeValue<'_>>, expected: String) {
        self.wrong_type_with(key, value, expected, None);
    }

    /// The same, with what was probably meant.
    pub(crate) fn wrong_type_with(
        &mut self,
        key: &str,
        value: &Spanned<DeValue<'_>>,
        expected: String,
        suggestion: Option<String>,
    ) {
        self.unexpected(ProblemKind::WrongType, key, value, expected, suggestion);
    }

    /// Reports a word that is none of `words`.
    pub(crate) fn wrong_word(&mut self, key: &str, value: &Spanned<DeValue<'_>>, words: &[&str]) {
        let quoted: Vec<_> = words.iter().map(|word| format!("{word:?}")).collect();
        let meant = value
            .get_ref()
            .as_str()
            .and_then(|text| nearest(text, words));
        let suggestion = meant.map(|word| format!("did you mean {word:?}?"));
        let expected = match quoted.split_last() {
            Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
            _ => quoted.concat(),
        };
        self.unexpected(ProblemKind::WrongType, key, value, expected, suggestion);
    }

    /// Reports a value of the right type that is not allowed.
    pub(crate) fn out_of_range(
        &mut self,
        key: &str,
        value: &Spanned<DeValue<'_>>,
        expected: String,
    ) {
        self.unexpected(ProblemKind::OutOfRange, key, value, expected, None);
    }

    fn unexpected(
        &mut self,
        kind: ProblemKind,
        key: &str,
        value: &Spanned<DeValue<'_>>,
        expected: String,
        suggestion: Option<String>,
    ) {
        let found = self.found(value);
        let message = format!("expected {expected}, found {found}");
        self.push(Problem {
            found: Some(found),
            allowed: Some(expected),
            suggestion,
            ..self.problem(kind, key, value.span(), message)
        });
    }

    /// Reports that `key` is not in the table at `span`.
    pub(crate) fn missing(&mut self, key: &str, span: Range<usize>, what: Option<&str>) {
        let message = match what {
            Some(what) => format!("missing: the recipe must give {what}"),
            None => "missing: the recipe must give it".to_owned(),
        };
        let mut problem = self.problem(ProblemKind::Missing, key, span.clone(), message);
        problem.allowed = what.map(str::to_owned);
        // Nothing is written of a section that is missing as a whole.
        problem.excerpt = problem.excerpt.filter(|_| !span.is_empty());
        self.push(problem);
    }

    /// Reports that `key`, at `span`, says nothing without `other` beside it.
    pub(crate) fn lonely(&mut self, key: &str, span: Range<usize>, other: &str) {
        let message = format!("says nothing without {other} beside it");
        let problem = self.problem(ProblemKind::Missing, key, span, message);
        self.push(problem);
    }

    /// Reports a key, such as a colour, that is not `expected`.
    pub(crate) fn wrong_key(&mut self, key: &str, name: &Spanned<Cow<'_, str>>, expected: &str) {
        let found = shortened(name.get_ref());
        let message = format!("expected {expected}, found {found:?}");
        self.push(Problem {
            found: Some(found),
            allowed: Some(expected.to_owned()),
            ..self.problem(ProblemKind::OutOfRange, key, name.span(), message)
        });
    }

    /// Reports that `key`, at `span`, and `other` cannot both be given.
    pub(crate) fn exclusive(&mut self, key: &str, span: Range<usize>, other: &str) {
        self.contradiction(key, span, format!("excludes {other}: give one of them"));
    }

    /// Reports that `key`, at `span`, cannot be given beside what else is.
    pub(crate) fn contradiction(&mut self, key: &str, span: Range<usize>, message: String) {
        let problem = self.problem(ProblemKind::Exclusive, key, span, message);
        self.push(problem);
    }

    /// Notes a problem, up to a number that nobody reads through: each costs a
    /// search for its line.
    fn push(&mut self, problem: Problem) {
        if self.problems.len() < NOTED {
            self.problems.push(problem);
        }
    }

    /// A problem at `span` with nothing but a message.
    pub(crate) fn problem(
        &self,
        kind: ProblemKind,
        key: &str,
        span: Range<usize>,
        message: String,
    ) -> Problem {
        placed(self.source, self.file, kind, key, span, message)
    }

    /// What a value looks like in a message.
    fn found(&self, value: &Spanned<DeValue<'_>>) -> String {
        match value.get_ref() {
            DeValue::Table(_) => "a table".to_owned(),
            _ => shortened(self.source.get(value.span()).unwrap_or("")),
        }
    }
}

/// A problem with the bytes `span` of `source`.
pub(crate) fn placed(
    source: &str,
    file: &Path,
    kind: ProblemKind,
    key: &str,
    span: Range<usize>,
    message: String,
) -> Problem {
    let place = Place::of(source, span.start);
    Problem {
        kind,
        file: file.to_owned(),
        line: place.line,
        column: place.column,
        key: key.to_owned(),
        message,
        found: None,
        allowed: None,
        suggestion: None,
        excerpt: Excerpt::of(source, &span),
    }
}

/// The first line of `text`, shortened for a message, without control characters.
pub(crate) fn shortened(text: &str) -> String {
    const LONGEST: usize = 40;
    let line = text.lines().next().unwrap_or("");
    let mut short: String = line.chars().take(LONGEST).collect();
    if short.len() < text.len() {
        short.push('…');
    }
    short.replace(|c: char| c.is_control(), "·")
}
