//! Cuts `.usda` text into tokens as the lexer of `openusd` does.
//!
//! The guard sees what the parser will see only where both agree on every string and
//! comment, so what the lexer would refuse is refused here, with its line.

use super::cursor::Broken;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Token<'a> {
    /// `{`, `(` or `[`.
    Open(u8),
    /// `}`, `)` or `]`.
    Close(u8),
    /// A name, with its namespaces, or a keyword.
    Word(&'a [u8]),
    Number,
    /// What stands between the quotes, escapes as they are.
    String(&'a [u8]),
    /// An asset (`@…@`) or a path (`<…>`).
    Target,
    Mark(u8),
}

/// The tokens of a text, with the place where each starts.
pub(super) struct Tokens<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Tokens<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    /// The next token, or none at the end of the text.
    pub(super) fn next(&mut self) -> Result<Option<(usize, Token<'a>)>, Broken> {
        self.skip()?;
        let start = self.at;
        let Some(&first) = self.bytes.get(start) else {
            return Ok(None);
        };
        let token = match first {
            b'{' | b'(' | b'[' => self.mark(Token::Open(first)),
            b'}' | b')' | b']' => self.mark(Token::Close(first)),
            b'=' | b',' | b':' | b';' | b'&' | b'.' | b'+' | b'-' => self.mark(Token::Mark(first)),
            b'"' | b'\'' => Token::String(self.string(first)?),
            b'@' => self.asset()?,
            b'<' => {
                self.at = self.after(start + 1, b">", "a path")?;
                Token::Target
            }
            b'0'..=b'9' => self.number(),
            b'a'..=b'z' | b'A'..=b'Z' | b'_' => {
                self.run(|c| c.is_ascii_alphanumeric() || c == b'_' || c == b':');
                Token::Word(&self.bytes[start..self.at])
            }
            _ => return Err(self.error(start, "no token starts with this character")),
        };
        Ok(Some((start, token)))
    }

    /// An error at byte `at`, which it tells the line of.
    pub(super) fn error(&self, at: usize, what: &str) -> Broken {
        let line = 1 + self.bytes[..at].iter().filter(|&&c| c == b'\n').count();
        Broken(format!("{what} in line {line}"))
    }

    /// Goes past white space and comments.
    fn skip(&mut self) -> Result<(), Broken> {
        loop {
            self.run(|c| matches!(c, b' ' | b'\t' | b'\r' | b'\n' | b'\x0c'));
            let rest = self.bytes.get(self.at..).unwrap_or_default();
            if rest.starts_with(b"#") {
                self.run(|c| c != b'\r' && c != b'\n');
            } else if rest.starts_with(b"/*") {
                self.at = self.after(self.at + 2, b"*/", "a comment")?;
            } else {
                return Ok(());
            }
        }
    }

    fn mark(&mut self, token: Token<'a>) -> Token<'a> {
        self.at += 1;
        token
    }

    fn run(&mut self, belongs: impl Fn(u8) -> bool) {
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        let length = rest.iter().position(|&c| !belongs(c));
        self.at += length.unwrap_or(rest.len());
    }

    /// The place after the next `end`; what started just before `from` must have one.
    fn after(&self, from: usize, end: &[u8], what: &str) -> Result<usize, Broken> {
        let rest = self.bytes.get(from..).unwrap_or_default();
        let found = rest.windows(end.len()).position(|w| w == end);
        let found = found.ok_or_else(|| {
            let start = from.min(self.bytes.len());
            self.error(start, &format!("{what} is not closed, which starts"))
        })?;
        Ok(from + found + end.len())
    }

    /// Strings of one quote end on their line, as the format has it; the lexer would
    /// let them run on. Escapes count in those only.
    fn string(&mut self, quote: u8) -> Result<&'a [u8], Broken> {
        let start = self.at;
        if self.bytes[start..].starts_with(&[quote; 3]) {
            self.at = self.after(start + 3, &[quote; 3], "a string")?;
            return Ok(&self.bytes[start + 3..self.at - 3]);
        }
        let mut at = start + 1;
        loop {
            match (self.bytes.get(at), self.bytes.get(at + 1)) {
                (None | Some(b'\n'), _) | (Some(b'\\'), None | Some(b'\n')) => {
                    return Err(self.error(start, "a string is not closed"));
                }
                (Some(b'\\'), _) => at += 2,
                (Some(&c), _) if c == quote => break,
                _ => at += 1,
            }
        }
        self.at = at + 1;
        Ok(&self.bytes[start + 1..at])
    }

    fn asset(&mut self) -> Result<Token<'a>, Broken> {
        let quotes: &[u8] = match self.bytes[self.at..].starts_with(b"@@@") {
            true => b"@@@",
            false => b"@",
        };
        self.at = self.after(self.at + quotes.len(), quotes, "the name of a file")?;
        Ok(Token::Target)
    }

    /// Digits, a fraction and an exponent; each only where digits follow, as words may
    /// stand right behind a number.
    fn number(&mut self) -> Token<'a> {
        let digit = |c: u8| c.is_ascii_digit();
        let is_digit = |at: usize| self.bytes.get(at).is_some_and(|c| digit(*c));
        let mut at = self.at;
        while is_digit(at) {
            at += 1;
        }
        if self.bytes.get(at) == Some(&b'.') && is_digit(at + 1) {
            at += 1;
            while is_digit(at) {
                at += 1;
            }
        }
        if matches!(self.bytes.get(at), Some(b'e' | b'E')) {
            let sign = matches!(self.bytes.get(at + 1), Some(b'+' | b'-')) as usize;
            if is_digit(at + 1 + sign) {
                at += 1 + sign;
                while is_digit(at) {
                    at += 1;
                }
            }
        }
        self.at = at;
        Token::Number
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tokens(text: &str) -> Result<Vec<Token<'_>>, Broken> {
        let mut tokens = Tokens::new(text.as_bytes());
        let mut all = Vec::new();
        while let Some((_, token)) = tokens.next()? {
            all.push(token);
        }
        Ok(all)
    }

    #[test]
    fn words_may_stand_right_behind_numbers() {
        let def = Token::Word(b"def");
        for text in ["1def", "1.5def", "1e5def", "2.5E-3def"] {
            assert_eq!(tokens(text).unwrap(), [Token::Number, def]);
        }
        let split = [Token::Number, Token::Mark(b'.'), Token::Word(b"e5")];
        assert_eq!(tokens("1.e5").unwrap(), split);
        assert_eq!(tokens("1e").unwrap(), [Token::Number, Token::Word(b"e")]);
    }

    #[test]
    fn strings_end_where_the_lexer_ends_them() {
        let string = |s: &'static str| Token::String(s.as_bytes());
        assert_eq!(
            tokens(r#""a\"b" ''"#).unwrap(),
            [string(r#"a\"b"#), string("")]
        );
        assert_eq!(tokens("\"\"\"a\"\n'\"\"\"").unwrap(), [string("a\"\n'")]);
        assert_eq!(
            tokens("@it's@ @@@a@@b@@@ </a>").unwrap(),
            [Token::Target; 3]
        );
        assert_eq!(
            tokens("# \"\r{ /* ( * */ }").unwrap(),
            [Token::Open(b'{'), Token::Close(b'}')]
        );
    }

    #[test]
    fn what_is_not_closed_is_refused_with_its_line() {
        for text in ["\n\"a", "\n'a\\", "\n\"a\\\n\"", "\n\"\"\"a\"\"", "\n'a\n'"] {
            let error = tokens(text).unwrap_err().0;
            assert!(
                error.starts_with("a string is not closed") && error.ends_with("line 2"),
                "{error}"
            );
        }
        for text in ["\n<a", "\n@a", "\n@@@a@@", "\n/* a *", "\n/", "\n\u{e9}"] {
            let error = tokens(text).unwrap_err().0;
            assert!(error.ends_with("in line 2"), "{error}");
        }
    }
}
