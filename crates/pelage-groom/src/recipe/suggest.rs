//! The word that was probably meant.

/// The nearest of `known` to `found`, if it is near enough to be a slip.
pub(crate) fn nearest<'k>(found: &str, known: &[&'k str]) -> Option<&'k str> {
    let plain = |text: &str| text.to_lowercase().replace(['_', ' '], "-");
    let distance = |word: &str| strsim::damerau_levenshtein(&plain(found), &plain(word));
    // Long words get an edit for every third letter: "natural-neighbour",
    // "colour"; short ones one.
    let best = known.iter().min_by_key(|word| distance(word))?;
    let allowed = (best.len() / 3).max(1);
    (found.len() <= 64 && distance(best) <= allowed).then_some(best)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn a_slip_finds_its_word_and_nonsense_finds_none() {
        let words = ["frizz", "hair", "natural-neighbor", "color"];
        assert_eq!(nearest("friz", &words), Some("frizz"));
        assert_eq!(nearest("Hair", &words), Some("hair"));
        assert_eq!(
            nearest("natural_neighbour", &words),
            Some("natural-neighbor")
        );
        assert_eq!(nearest("colour", &words), Some("color"));
        assert_eq!(nearest("banana", &words), None);
        assert_eq!(nearest("x", &[]), None);
    }
}
