//! Texts that are not TOML: what the parser says, in words for people who do
//! not know its grammar.

use std::ops::Range;
use std::path::Path;

use toml::de::{DeTable, Error};

use super::error::{Problem, ProblemKind, RecipeError};
use super::reader::{placed, shortened};

/// Texts up to this many bytes are searched for quotes that are not closed; in
/// longer ones, which are no recipes, the first mistake met has to do.
const SEARCHED: usize = 1 << 20;

/// What is wrong with `text`, given the first mistake that the parser met.
/// Quotes that are not closed lead to others, which it may meet first.
pub(crate) fn syntax(text: &str, file: &Path, met: Error) -> RecipeError {
    let mut error = met;
    if text.len() <= SEARCHED {
        let (_, errors) = DeTable::parse_recoverable(text);
        error = errors.into_iter().find(is_open_text).unwrap_or(error);
    }
    let span = error.span().unwrap_or(0..0);
    let (message, suggestion) = explain(text, &span, error.message());
    RecipeError::from(Problem {
        suggestion,
        ..placed(text, file, ProblemKind::Syntax, "", span, message)
    })
}

/// What the parser calls quotes that are not closed.
const OPEN_TEXT: [&str; 2] = [
    "invalid basic string, expected `\"`",
    "invalid literal string, expected `'`",
];

fn is_open_text(error: &Error) -> bool {
    OPEN_TEXT.contains(&error.message())
}

/// The parser's message, or a plainer one with advice.
fn explain(text: &str, span: &Range<usize>, message: &str) -> (String, Option<String>) {
    let found = text.get(span.clone()).unwrap_or_default();
    if message == "duplicate key" {
        return (format!("{} is given twice", shortened(found)), None);
    }
    if message.contains("recur") {
        return ("nested too deeply".to_owned(), None);
    }
    if message.starts_with("missing escaped value") {
        let advice = r#"write \\ for a backslash, or put the text in single quotes: 'C:\hair'"#;
        return (
            "unknown escape in a text".to_owned(),
            Some(advice.to_owned()),
        );
    }
    if message.starts_with("missing comma") {
        let advice = "a bracket may not be closed before this place";
        return (message.to_owned(), Some(advice.to_owned()));
    }
    if OPEN_TEXT.contains(&message) {
        return ("the quotes of this text are not closed".to_owned(), None);
    }
    let no_value = [
        "string values must be quoted",
        "invalid float",
        "invalid boolean",
    ];
    if no_value.iter().any(|start| message.starts_with(start)) {
        return no_known_value(text, span, found);
    }
    (message.to_owned(), None)
}

/// A value that is no number, text, switch, list or table.
fn no_known_value(text: &str, span: &Range<usize>, found: &str) -> (String, Option<String>) {
    let rest = text.get(span.start..).unwrap_or_default();
    let code = rest
        .get(..7)
        .filter(|code| super::color::hex_codes(code).is_some());
    if found.is_empty() {
        let advice = code.map(|code| format!("a colour goes in quotes: \"{code}\""));
        return ("expected a value".to_owned(), advice);
    }
    let message = format!("expected a value, found {}", shortened(found));
    let lower = found.to_lowercase();
    let advice = match lower.as_str() {
        "true" | "false" => Some(format!("did you mean {lower}?")),
        "yes" | "on" => Some("did you mean true?".to_owned()),
        "no" | "off" => Some("did you mean false?".to_owned()),
        _ if found.starts_with(char::is_alphabetic) => {
            Some(format!("text goes in quotes: \"{}\"", shortened(found)))
        }
        _ => None,
    };
    (message, advice)
}
