//! Recipes damaged at random.

use std::path::Path;

use pelage_groom::recipe::Recipe;
use proptest::prelude::*;

use super::corpus::recipes;

/// Pieces that mean something in a recipe, to be put where they do not belong.
const PIECES: &[&str] = &[
    "[",
    "]",
    "{",
    "}",
    "=",
    ",",
    "\"",
    "'",
    "#",
    ".",
    "\n",
    "\r",
    "\t",
    "0",
    "-",
    "1e999",
    "nan",
    "\u{0}",
    "é",
    "日本",
    "\u{feff}",
    "[hair]",
    "[[hair]]",
    "frizz",
    "map = 3",
    "\"#ff0000\"",
    "{ ramp = [[0.0, 1.0]] }",
    "{ value = 1, map = \"m.png\" }",
    "99999999999999999999",
    "0x",
];

/// Text with one change: a cut, a piece put in, or two parts swapped.
fn damage(text: &str, kind: u8, at: usize, length: usize, piece: usize) -> String {
    let from = text.floor_char_boundary(at % (text.len() + 1));
    let to = text.floor_char_boundary((from + length).min(text.len()));
    let (before, middle, after) = (&text[..from], &text[from..to], &text[to..]);
    match kind % 3 {
        0 => format!("{before}{after}"),
        1 => format!("{before}{}{middle}{after}", PIECES[piece % PIECES.len()]),
        _ => format!("{middle}{before}{after}"),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn no_damage_makes_the_reader_panic(
        which in any::<prop::sample::Index>(),
        changes in prop::collection::vec((any::<u8>(), any::<usize>(), 0..40_usize, any::<usize>()), 1..6),
    ) {
        let originals = recipes("good");
        let mut text = which.get(&originals).1.clone();
        for (kind, at, length, piece) in changes {
            text = damage(&text, kind, at, length, piece);
        }
        match Recipe::parse(&text, Path::new("groom.toml")) {
            Ok(recipe) => {
                let again = Recipe::parse(&recipe.to_toml(), Path::new("groom.toml"));
                prop_assert_eq!(again.as_ref(), Ok(&recipe), "{}", text);
            }
            Err(error) => prop_assert!(!error.to_string().is_empty()),
        }
    }
}
