//! Counts the numbers of tuples in `.usda` text.
//!
//! The parser of `openusd` refuses tuples that are too long for their type, but gives
//! those that are too short numbers which were never written.

use super::text_tokens::Token;

/// Follows the tokens of a file.
#[derive(Default)]
pub(super) struct Tuples {
    /// Numbers that a tuple of the last type has, where it has tuples.
    arity: Option<u32>,
    declares: Declares,
    /// Brackets that are open.
    open: Vec<Open>,
    /// Whether a value comes next.
    at_value: bool,
}

/// Which part of `TYPE[] NAME` comes next.
#[derive(Default, PartialEq)]
enum Declares {
    #[default]
    Type,
    Name,
}

struct Open {
    bracket: u8,
    is_value: bool,
    /// Numbers, or strings and words that stand for them.
    entries: u32,
    /// Whether it is metadata, or has tuples within.
    is_other: bool,
}

impl Tuples {
    pub(super) fn see(&mut self, token: Token) -> Result<(), String> {
        let at_value = std::mem::take(&mut self.at_value);
        match token {
            Token::Open(bracket) => self.opens(bracket, at_value),
            Token::Close(_) => self.closes()?,
            Token::Word(word) => self.word(word, at_value),
            Token::Number => self.entry(),
            Token::String(_) => {
                self.declares = Declares::Type;
                self.entry();
            }
            Token::Mark(mark) => {
                let is_signed = at_value && matches!(mark, b'+' | b'-');
                self.at_value = is_signed || matches!(mark, b'=' | b':' | b'.');
                if let (b'=', Some(open)) = (mark, self.open.last_mut()) {
                    open.is_other = true;
                }
                self.declares = Declares::Type;
            }
            Token::Target => {}
        }
        Ok(())
    }

    fn opens(&mut self, bracket: u8, at_value: bool) {
        let above = self.open.last_mut();
        let is_value = at_value
            || above
                .as_ref()
                .is_some_and(|o| o.is_value && o.bracket != b'{');
        if let Some(above) = above {
            above.is_other = true;
        }
        if bracket == b'{' {
            self.declares = Declares::Type;
        }
        self.open.push(Open {
            bracket,
            is_value,
            entries: 0,
            is_other: false,
        });
    }

    fn closes(&mut self) -> Result<(), String> {
        let Some(open) = self.open.pop() else {
            return Ok(());
        };
        if open.bracket == b'{' {
            self.declares = Declares::Type;
        }
        let is_tuple = open.bracket == b'(' && open.is_value && !open.is_other;
        match self.arity {
            Some(arity) if is_tuple && open.entries != arity => Err(format!(
                "a tuple has {} entries where its type has {arity}",
                open.entries
            )),
            _ => Ok(()),
        }
    }

    fn word(&mut self, word: &[u8], at_value: bool) {
        self.entry();
        let declares = self.open.last().is_none_or(|open| open.bracket == b'{');
        if !declares || at_value {
            return;
        }
        self.declares = match self.declares {
            Declares::Type if is_modifier(word) => Declares::Type,
            Declares::Type => {
                self.arity = arity(word);
                Declares::Name
            }
            Declares::Name => Declares::Type,
        };
    }

    fn entry(&mut self) {
        if let Some(open) = self.open.last_mut() {
            open.entries += 1;
        }
    }
}

/// Words before the type of a property.
fn is_modifier(word: &[u8]) -> bool {
    let words: [&[u8]; 9] = [
        b"custom", b"uniform", b"varying", b"config", b"add", b"append", b"prepend", b"delete",
        b"reorder",
    ];
    words.contains(&word)
}

/// Numbers in a tuple of the type `name`: `float3`, `point3f`, `matrix4d`, `quatf`.
fn arity(name: &[u8]) -> Option<u32> {
    if let [b'q', b'u', b'a', b't', _] = name {
        return Some(4);
    }
    let stem = match name {
        [stem @ .., b'h' | b'f' | b'd'] => stem,
        whole => whole,
    };
    match stem {
        [.., digit @ b'2'..=b'4'] => Some((digit - b'0') as u32),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::text_guard::check;

    #[test]
    fn tuples_that_fit_their_type_are_taken() {
        let text = r#"def "a" (doc = "") {
            bool doubleSided = true
            uniform float3[] x = [(1, 2, -inf), (nan, "2", 3)] ("comment")
            double last = -inf
            custom color3f x.timeSamples = { 0: (1, 2, 3), 1: None, 2: [(1, 2, 3)] }
            matrix2d m = ((1, 0), (0, 1)) (doc = "")
            quatf q = (1, 0, 0, 0)
            double2 bare
            dictionary d = { double3 "key" = (1, 2, 3) int2 other = (1, 2) }
            over "b" (references = [@a@ (offset = 1)]) { float2 uv = (0, 1) }
            double x.spline = { bezier, 1: 5; pre (1, 2) }
        }"#;
        assert_eq!(check(text.as_bytes()), Ok(()));
    }

    #[test]
    fn tuples_that_are_too_short_are_refused_with_their_line() {
        for value in [
            "point3f[] x = [(1, 2, 3), (1, 2)]",
            "bool b = true float3 x = (1, 2)",
            "float b = -inf float3 x = ()",
            "int3 x.timeSamples = { 0: (1, 2, 3), 1: (1, 2) }",
            "vector3f[] x.timeSamples = { 0: [(1, 2)] }",
            "matrix3d x = ((1, 2, 3), (1, 2), (1, 2, 3))",
            "quath x = (1, 2, 3)",
            "over \"b\" { half3 x = (1, 2) }",
            "dictionary d = { float3 x = (1, 2) }",
            "int a int3 x = (1, 2)",
        ] {
            let error = check(format!("\ndef \"a\" {{ {value} }}").as_bytes());
            let error = error.unwrap_err().0;
            assert!(error.starts_with("a tuple has"), "{error}");
            assert!(error.ends_with("in line 2"), "{error}");
        }
    }
}
