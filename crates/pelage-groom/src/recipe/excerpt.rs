//! A line of the recipe with the mistake underlined.

use std::fmt;
use std::ops::Range;

/// Characters of a line that are shown; longer lines are cut around the mistake.
const SHOWN: usize = 100;

/// Characters shown before the mistake in a line that is cut.
const BEFORE: usize = 30;

/// A place in a text: line and column from 1, columns in characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Place {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
}

impl Place {
    /// The place of byte `offset` of `source`.
    pub(crate) fn of(source: &str, offset: usize) -> Self {
        let (start, _) = line_around(source, offset);
        Self {
            line: source[..start].matches('\n').count() + 1,
            column: source[start..floor(source, offset)].chars().count() + 1,
        }
    }
}

/// The largest character boundary of `source` up to `offset`.
fn floor(source: &str, offset: usize) -> usize {
    source.floor_char_boundary(offset)
}

/// Bytes from and to of the line with byte `offset`, without its line feed.
fn line_around(source: &str, offset: usize) -> (usize, usize) {
    let offset = floor(source, offset);
    let start = source[..offset].rfind('\n').map_or(0, |i| i + 1);
    let end = source[offset..]
        .find('\n')
        .map_or(source.len(), |i| offset + i);
    (start, end)
}

/// A line and what to underline in it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Excerpt {
    /// Number of the line, from 1.
    line: usize,
    /// What is shown of it.
    text: String,
    /// Characters before the underline.
    before: usize,
    /// Characters underlined, at least one.
    width: usize,
}

impl Excerpt {
    /// The line where `span` starts; none if that line is blank.
    pub(crate) fn of(source: &str, span: &Range<usize>) -> Option<Self> {
        let (start, end) = line_around(source, span.start);
        let line = source[start..end].trim_end();
        if line.is_empty() {
            return None;
        }
        let at = floor(source, span.start);
        let place = Place::of(source, at);
        let column = place.column - 1;
        let stop = floor(source, span.end).clamp(at, end);
        let width = source[at..stop].trim_end().chars().count().max(1);
        let cut = line.chars().count() > SHOWN;
        let skipped = if cut {
            column.saturating_sub(BEFORE)
        } else {
            0
        };
        let mut text: String = line.chars().skip(skipped).take(SHOWN).collect();
        let mut before = column - skipped;
        if skipped > 0 {
            text.insert(0, '…');
            before += 1;
        }
        if line.chars().count() > skipped + SHOWN {
            text.push('…');
        }
        Some(Self {
            line: place.line,
            width: width.min(text.chars().count().saturating_sub(before).max(1)),
            text,
            before,
        })
    }

    /// Columns that the line number takes.
    pub(crate) fn margin(&self) -> usize {
        self.line.to_string().len()
    }
}

impl fmt::Display for Excerpt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let margin = self.margin();
        // Tabs stay tabs below the line, so that the underline keeps its place;
        // other control characters must not reach a terminal.
        let clean = |c: char| if c.is_control() && c != '\t' { '·' } else { c };
        let line: String = self.text.chars().map(clean).collect();
        let pad = self.text.chars().take(self.before);
        let pad: String = pad.map(|c| if c == '\t' { '\t' } else { ' ' }).collect();
        writeln!(f, "{:margin$} |", "")?;
        writeln!(f, "{} | {line}", self.line)?;
        write!(f, "{:margin$} | {pad}{:^<2$}", "", "", self.width)
    }
}
