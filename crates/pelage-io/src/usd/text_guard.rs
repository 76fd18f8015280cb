//! Checks a `.usda` file before `openusd` parses it.
//!
//! Its parser ends: every turn of every loop takes a token or fails, and what the lexer
//! cannot cut is refused by [`Tokens`]. What is left is work and memory out of all
//! proportion to the file, and names that its paths cannot hold:
//!
//! - it calls itself for every level of brackets;
//! - it writes lists within lists as text within text, which doubles their escapes with
//!   every level;
//! - every property holds the path of its prim, which may be most of the file;
//! - it looks for properties, metadata and items of lists one by one;
//! - names of prims become parts of paths unseen: one of `.` is its own child;
//! - tuples that are too short leave numbers that were never written.

use super::MAX_ITEMS;
use super::cursor::Broken;
use super::names;
use super::text_tokens::{Token, Tokens};
use super::text_tuples::Tuples;

/// Levels of brackets; a prim is one level, its arrays one or two more.
const MAX_DEPTH: usize = 128;

/// Lists that are open at once: those of the format need two.
const MAX_LISTS: usize = 4;

/// Words in one prim, those of its children left out, and in one block of metadata.
/// A property has two or more.
const MAX_WORDS: u32 = 8_000;

/// Bytes of paths that any file may spell, however small it is, and those allowed for
/// each of its bytes.
const BASE_PATHS: u64 = 256 << 20;
const PATHS_PER_BYTE: u64 = 64;

/// What a bracket holds.
#[derive(Clone, Copy, PartialEq)]
enum Holds {
    /// Properties and prims, of a prim or a variant.
    Body,
    /// Variants of a set.
    Variants,
    /// Metadata of a prim or a variant, whose body follows.
    Metadata,
    /// Items of metadata, or the order of properties or prims.
    Items,
    Else,
}

/// An open bracket.
struct Open {
    bracket: u8,
    start: usize,
    holds: Holds,
    /// Bytes of the path of the prim that it belongs to.
    path: u64,
    words: u32,
    items: u32,
}

/// A name that is about to be declared.
#[derive(Clone, Copy, PartialEq)]
enum Declares {
    Nothing,
    /// After `def`, `over` or `class`, and a type perhaps.
    Prim {
        words: u32,
    },
    /// After `variantSet`.
    Set,
    /// After `reorder`.
    Order,
}

/// Fails where parsing `bytes` would take memory or time out of proportion, or give
/// paths that mean something else.
pub(super) fn check(bytes: &[u8]) -> Result<(), Broken> {
    let mut tokens = Tokens::new(bytes);
    let mut tuples = Tuples::default();
    let mut structure = Structure {
        open: vec![Open {
            bracket: 0,
            start: 0,
            holds: Holds::Body,
            path: 0,
            words: 0,
            items: 0,
        }],
        declares: Declares::Nothing,
        follows: None,
        paths: 0,
        most: BASE_PATHS + PATHS_PER_BYTE * bytes.len() as u64,
    };
    while let Some((start, token)) = tokens.next()? {
        let outcome = structure.see(start, token);
        let outcome = outcome.and_then(|()| tuples.see(token));
        outcome.map_err(|what| tokens.error(start, &what))?;
    }
    match structure.open.last() {
        Some(open) if open.bracket != 0 => {
            let bracket = open.bracket as char;
            Err(tokens.error(open.start, &format!("it ends within the {bracket}")))
        }
        _ => Ok(()),
    }
}

struct Structure {
    /// Brackets that are open, below them the file itself.
    open: Vec<Open>,
    declares: Declares,
    /// What the next `{` holds, and the length of its path.
    follows: Option<(Holds, u64)>,
    paths: u64,
    most: u64,
}

impl Structure {
    fn see(&mut self, start: usize, token: Token) -> Result<(), String> {
        let declares = std::mem::replace(&mut self.declares, Declares::Nothing);
        let follows = self.follows.take();
        match token {
            Token::Open(bracket) => self.opens(start, bracket, declares, follows),
            Token::Close(bracket) => self.closes(bracket),
            Token::Word(word) => self.word(word, declares),
            Token::String(string) => self.string(string, declares),
            Token::Target => self.item(),
            Token::Mark(b'=') => {
                if declares == Declares::Order {
                    self.declares = declares;
                }
                self.follows = follows.filter(|(holds, _)| *holds == Holds::Variants);
                Ok(())
            }
            Token::Number | Token::Mark(_) => Ok(()),
        }
    }

    fn opens(
        &mut self,
        start: usize,
        bracket: u8,
        declares: Declares,
        follows: Option<(Holds, u64)>,
    ) -> Result<(), String> {
        if self.open.len() > MAX_DEPTH {
            return Err(format!("its brackets nest deeper than {MAX_DEPTH}"));
        }
        let lists = self.open.iter().filter(|open| open.bracket == b'[').count();
        if bracket == b'[' && lists == MAX_LISTS {
            return Err(format!("its lists nest deeper than {MAX_LISTS}"));
        }
        let (holds, path) = match (bracket, follows) {
            (b'{', Some((holds, path))) => (holds, path),
            (b'(', Some((Holds::Body, path))) => (Holds::Metadata, path),
            (b'[', _) if declares == Declares::Order => (Holds::Items, self.path()),
            (b'[', _) if self.open.last().is_some_and(|o| o.bracket == b'(') => {
                (Holds::Items, self.path())
            }
            _ => (Holds::Else, self.path()),
        };
        self.open.push(Open {
            bracket,
            start,
            holds,
            path,
            words: 0,
            items: 0,
        });
        Ok(())
    }

    fn closes(&mut self, bracket: u8) -> Result<(), String> {
        let opening = match bracket {
            b'}' => b'{',
            b')' => b'(',
            _ => b'[',
        };
        let open = self.open.pop_if(|open| open.bracket == opening);
        let Some(open) = open else {
            return Err(format!("a {} closes what is not open", bracket as char));
        };
        if open.holds == Holds::Metadata {
            self.follows = Some((Holds::Body, open.path));
        }
        Ok(())
    }

    fn word(&mut self, word: &[u8], declares: Declares) -> Result<(), String> {
        let Some(top) = self.open.last_mut() else {
            return Ok(());
        };
        if top.holds == Holds::Body || top.bracket == b'(' {
            top.words += 1;
            if top.words > MAX_WORDS {
                return Err(format!(
                    "a prim or its metadata has more than {MAX_WORDS} words"
                ));
            }
        }
        if top.holds != Holds::Body {
            return Ok(());
        }
        self.declares = match (word, declares) {
            (b"def" | b"over" | b"class", _) => Declares::Prim { words: 1 },
            (b"variantSet", _) => Declares::Set,
            (b"reorder", _) | (_, Declares::Order) => Declares::Order,
            (_, Declares::Prim { words: 1 }) => Declares::Prim { words: 2 },
            _ => Declares::Nothing,
        };
        self.spell(word.len()).map(drop)
    }

    fn string(&mut self, string: &[u8], declares: Declares) -> Result<(), String> {
        let in_set = self
            .open
            .last()
            .is_some_and(|open| open.holds == Holds::Variants);
        match declares {
            Declares::Prim { words } => {
                check_name(string, "a prim", names::is_prim)?;
                self.follows = Some((Holds::Body, self.spell(string.len())?));
                if let Some(top) = self.open.last_mut() {
                    top.words -= words;
                }
            }
            Declares::Set => {
                check_name(string, "a variant set", names::is_variant)?;
                self.follows = Some((Holds::Variants, self.spell(string.len())?));
            }
            Declares::Nothing if in_set => {
                check_name(string, "a variant", names::is_variant)?;
                self.follows = Some((Holds::Body, self.spell(string.len())?));
            }
            Declares::Nothing | Declares::Order => self.item()?,
        }
        Ok(())
    }

    /// Counts a string, path or file where it is one of a list of metadata.
    fn item(&mut self) -> Result<(), String> {
        if let Some(list) = self.open.last_mut()
            && list.holds == Holds::Items
        {
            list.items += 1;
            if list.items > MAX_ITEMS {
                return Err(format!(
                    "a list of metadata has more than {MAX_ITEMS} items"
                ));
            }
        }
        Ok(())
    }

    fn path(&self) -> u64 {
        self.open.last().map_or(0, |open| open.path)
    }

    /// Adds up the path that a name makes here; gives its length.
    fn spell(&mut self, name: usize) -> Result<u64, String> {
        let path = self.path() + name as u64 + 1;
        self.paths += path;
        match self.paths <= self.most {
            true => Ok(path),
            false => Err("its names are far too long for its many properties".into()),
        }
    }
}

fn check_name(name: &[u8], of: &str, is_sound: fn(&str) -> bool) -> Result<(), String> {
    let name = String::from_utf8_lossy(name);
    match is_sound(&name) {
        true => Ok(()),
        false => {
            let start: String = name.chars().take(40).collect();
            Err(format!("the name of {of} cannot be {start:?}"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(text: &str) -> String {
        check(text.as_bytes()).unwrap_err().0
    }

    #[test]
    fn brackets_in_strings_and_comments_do_not_count() {
        let text = format!(
            "# {0}\n\"{0}\" '{0}' \"\"\"{0}\n{0}\"\"\" {{}}",
            "(".repeat(200)
        );
        assert_eq!(check(text.as_bytes()), Ok(()));
    }

    #[test]
    fn brackets_must_match() {
        let error = refused("\ndef \"a\"\n{ int[] x = [1, 2\n");
        assert_eq!(error, "it ends within the [ in line 3");
        assert_eq!(refused("\n{)"), "a ) closes what is not open in line 2");
        assert_eq!(refused("}"), "a } closes what is not open in line 1");
    }

    #[test]
    fn too_many_levels_are_refused_with_their_line() {
        let error = refused(&format!("\n\n{}", "{".repeat(200)));
        assert_eq!(error, "its brackets nest deeper than 128 in line 3");
        let lists = "(x = [[[{a = [1]}]]])";
        assert_eq!(check(lists.as_bytes()), Ok(()));
        let error = refused(&lists.replace('1', "[1]"));
        assert_eq!(error, "its lists nest deeper than 4 in line 1");
    }

    #[test]
    fn names_that_paths_cannot_hold_are_refused() {
        for name in ["", ".", "..", "a/b", "a.b", "{a=b}", "a b"] {
            for text in [
                format!("def \"{name}\" {{}}"),
                format!("def \"a\" {{ over Mesh '{name}' () {{}} }}"),
                format!(
                    "def \"a\" (kind = \"b\") {{ variantSet \"v\" = {{ \"x\" (doc = \"\") {{ class \"{name}\"{{}}}}}}}}"
                ),
            ] {
                let error = refused(&text);
                assert!(error.starts_with("the name of a prim cannot be"), "{error}");
            }
        }
        let error = refused("def \"a\" { variantSet \"v}\" = {} }");
        assert!(
            error.starts_with("the name of a variant set cannot be"),
            "{error}"
        );
        let error = refused("def \"a\" { variantSet \"v\" = { \"x\" {} \"y/\" {} } }");
        assert!(
            error.starts_with("the name of a variant cannot be"),
            "{error}"
        );
        let sound = "def \"a\" { string class = \"..\" variantSet \"v\" = { \"1.5\" { string x = \".\" } } }";
        assert_eq!(check(sound.as_bytes()), Ok(()));
    }

    #[test]
    fn what_is_searched_one_by_one_is_counted() {
        let many = |text: &str, count: usize| text.repeat(count);
        let error = refused(&format!("def \"a\" {{ {} }}", many("int x ", 4_001)));
        assert!(error.contains("more than 8000 words"), "{error}");
        let error = refused(&format!("({})", many("x = 1 ", 8_001)));
        assert!(error.contains("more than 8000 words"), "{error}");
        let error = refused(&format!("def \"a\" ( x = [{}]) {{}}", many("\"x\" ", 4097)));
        assert!(error.contains("more than 4096 items"), "{error}");
        let order = format!(
            "def \"a\" {{ reorder properties = [{}] }}",
            many("\"x\" ", 4097)
        );
        assert!(refused(&order).contains("more than 4096 items"));
        let prims = format!(
            "def \"a\" {{ token[] x = [{}] {} }}",
            many("\"x\" ", 5000),
            many("def Mesh \"x\" {} ", 30_000)
        );
        assert_eq!(check(prims.as_bytes()), Ok(()));
    }

    #[test]
    fn long_paths_are_not_spelled_too_often() {
        let prims = |name: usize| {
            format!(
                "def \"{}\" {{ {} }}",
                "a".repeat(name),
                "def \"b\" {} ".repeat(10_000)
            )
        };
        assert_eq!(check(prims(1000).as_bytes()), Ok(()));
        let error = refused(&prims(100_000));
        assert!(error.contains("far too long"), "{error}");
    }
}
