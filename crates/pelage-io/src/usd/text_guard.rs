//! Checks a `.usda` file before `openusd` parses it: its parser calls itself for
//! every level of prims and dictionaries, so the levels are counted first. It also never
//! ends on some files whose strings are not closed, so those are refused.

use super::cursor::Broken;

/// Levels of `{`, `(` and `[`; a prim is one level, its arrays one or two more.
const MAX_DEPTH: u32 = 128;

/// Fails where brackets nest too deeply for the parser's stack, and where a string is
/// not closed on its line.
pub(super) fn check(bytes: &[u8]) -> Result<(), Broken> {
    let mut depth = 0u32;
    let mut i = 0;
    while i < bytes.len() {
        match bytes[i] {
            b'{' | b'(' | b'[' => {
                depth += 1;
                if depth > MAX_DEPTH {
                    let line = line_of(bytes, i);
                    return Err(Broken(format!(
                        "its brackets nest deeper than {MAX_DEPTH} in line {line}"
                    )));
                }
                i += 1;
            }
            b'}' | b')' | b']' => {
                depth = depth.saturating_sub(1);
                i += 1;
            }
            b'#' => i = after(bytes, i, b"\n"),
            // Names of files may hold quotes.
            b'@' => i = after_string(bytes, i + 1, b'@').unwrap_or(i + 1),
            quote @ (b'"' | b'\'') => {
                let three = [quote; 3];
                i = match bytes[i..].starts_with(&three) {
                    true => after(bytes, i + 3, &three),
                    false => after_string(bytes, i + 1, quote).ok_or_else(|| {
                        Broken(format!(
                            "a string is not closed in line {}",
                            line_of(bytes, i)
                        ))
                    })?,
                };
            }
            _ => i += 1,
        }
    }
    Ok(())
}

/// The place after the next `end`, or the end of the file.
fn after(bytes: &[u8], from: usize, end: &[u8]) -> usize {
    let rest = bytes.get(from..).unwrap_or(&[]);
    let found = rest.windows(end.len()).position(|w| w == end);
    found.map_or(bytes.len(), |at| from + at + end.len())
}

/// The place after a string on one line; `None` where the line ends first.
fn after_string(bytes: &[u8], mut i: usize, quote: u8) -> Option<usize> {
    while let Some(&c) = bytes.get(i) {
        match c {
            b'\\' => i += 2,
            b'\n' => return None,
            c if c == quote => return Some(i + 1),
            _ => i += 1,
        }
    }
    None
}

fn line_of(bytes: &[u8], i: usize) -> usize {
    1 + bytes[..i].iter().filter(|&&c| c == b'\n').count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brackets_in_strings_and_comments_do_not_count() {
        let text = format!(
            "# {0}\n\"{0}\" '{0}' \"\"\"{0}\n{0}\"\"\" {{}}",
            "(".repeat(200)
        );
        assert_eq!(check(text.as_bytes()), Ok(()));
    }

    #[test]
    fn a_string_that_is_not_closed_is_refused_with_its_line() {
        let error = check(b"\n[\"a\", \"b]\n").unwrap_err();
        assert_eq!(error.0, "a string is not closed in line 2");
        assert_eq!(check(b"@it's.usd@"), Ok(()));
    }

    #[test]
    fn too_many_levels_are_refused_with_their_line() {
        let error = check(format!("\n\n{}", "{".repeat(200)).as_bytes()).unwrap_err();
        assert_eq!(error.0, "its brackets nest deeper than 128 in line 3");
    }
}
