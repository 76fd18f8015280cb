//! What only the recipe as a whole can tell.

use std::ops::Range;

use super::Recipe;
use super::reader::Reader;
use super::segments::Segments;

/// Reports what is wrong between the keys of a recipe.
pub(crate) fn check(recipe: &Recipe, reader: &mut Reader<'_>) {
    check_guides(recipe, reader);
    check_groups(recipe, reader);
    check_ramps(recipe, reader);
}

/// Guides have one source, and the keys that go with it.
fn check_guides(recipe: &Recipe, reader: &mut Reader<'_>) {
    let guides = &recipe.guides;
    match (&guides.curves, &guides.grow) {
        (Some(_), Some(_)) => {
            let span = span(reader, "guides.grow");
            reader.exclusive("guides.grow", span, "guides.curves");
        }
        (None, None) if !reader.refused("guides") => {
            let span = span(reader, "guides");
            let what = "guides: [guides] with curves = \"file\", or [guides.grow] with a length";
            reader.missing("guides", span, Some(what));
        }
        _ => {}
    }
    if guides.grow.is_some() && guides.curves.is_none() && guides.tolerance.is_some() {
        let span = span(reader, "guides.tolerance");
        reader.lonely("guides.tolerance", span, "guides.curves");
    }
}

/// Segments by colour need the map with the colours.
fn check_groups(recipe: &Recipe, reader: &mut Reader<'_>) {
    let by_color = matches!(recipe.groups.segments, Some(Segments::ByColor(_)));
    if by_color && recipe.groups.map.is_none() {
        let span = span(reader, "groups.segments");
        reader.lonely("groups.segments", span, "groups.map");
    }
}

/// A ramp tells the whole strand, so nothing else may.
fn check_ramps(recipe: &Recipe, reader: &mut Reader<'_>) {
    let pairs: [(&str, bool, &[&str]); 6] = [
        ("frizz", recipe.frizz.root.ramp.is_some(), &["tip"]),
        ("kink", recipe.kink.root.ramp.is_some(), &["tip"]),
        ("color", recipe.color.root.ramp.is_some(), &["tip"]),
        ("opacity", recipe.opacity.root.ramp.is_some(), &["tip"]),
        ("width", recipe.width.root.ramp.is_some(), &["tip"]),
        (
            "strand.splay",
            recipe.strand.splay.root.ramp.is_some(),
            &["center", "tip"],
        ),
    ];
    for (section, _, others) in pairs.into_iter().filter(|(_, ramp, _)| *ramp) {
        for other in others.iter().map(|other| format!("{section}.{other}")) {
            if reader.spans.contains_key(&other) {
                let span = span(reader, &other);
                reader.exclusive(&other, span, &format!("the ramp of {section}.root"));
            }
        }
    }
}

/// Where the value of `key` is; the start of the text if it has none.
fn span(reader: &Reader<'_>, key: &str) -> Range<usize> {
    reader.spans.get(key).cloned().unwrap_or(0..0)
}
