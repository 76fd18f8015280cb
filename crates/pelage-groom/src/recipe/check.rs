//! What only the recipe as a whole can tell.

use std::ops::Range;

use super::Recipe;
use super::clump::ClumpAround;
use super::property::ScalarProperty;
use super::reader::Reader;
use super::segments::Segments;

/// Reports what is wrong between the keys of a recipe.
pub(crate) fn check(recipe: &Recipe, reader: &mut Reader<'_>) {
    check_guides(recipe, reader);
    check_groups(recipe, reader);
    check_clumps(recipe, reader);
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
    if let Some(grow) = &guides.grow {
        let acts = |property: &ScalarProperty| {
            let ramp = property.ramp.as_ref();
            ramp.map_or(property.value != 0.0, |ramp| !ramp.points.is_empty())
        };
        if acts(&grow.curl.radius) && acts(&grow.bend.curvature) {
            let span = span(reader, "guides.grow.bend");
            reader.exclusive("guides.grow.bend", span, "guides.grow.curl");
        }
    }
    let of_curves = [
        ("guides.tolerance", guides.tolerance.is_some()),
        ("guides.posed", guides.posed.is_some()),
    ];
    for (key, _) in of_curves.into_iter().filter(|(_, is_there)| *is_there) {
        if guides.grow.is_some() && guides.curves.is_none() {
            let span = span(reader, key);
            reader.lonely(key, span, "guides.curves");
        }
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

/// A level of clumps says where they are, once.
fn check_clumps(recipe: &Recipe, reader: &mut Reader<'_>) {
    for (i, level) in recipe.clump.levels.iter().enumerate() {
        let table = format!("clump.levels[{i}]");
        let needed = match level.around {
            ClumpAround::Points => Some(("size", "how far clumps are apart")),
            ClumpAround::Map => Some(("map", "the image whose colours are clumps")),
            ClumpAround::Guides => None,
        };
        for (name, is_there) in [("size", level.size.is_some()), ("map", level.map.is_some())] {
            let key = format!("{table}.{name}");
            match needed.filter(|(needed, _)| *needed == name) {
                Some((_, what)) if !is_there && !reader.refused(&key) => {
                    reader.missing(&key, span(reader, &table), Some(what));
                }
                None if is_there => {
                    let message = format!("says nothing of clumps around {}", level.around);
                    reader.contradiction(&key, span(reader, &key), message);
                }
                _ => {}
            }
        }
    }
}

/// A ramp tells the whole strand, so nothing else may.
fn check_ramps(recipe: &Recipe, reader: &mut Reader<'_>) {
    let mut ramps = vec![
        ("frizz".to_owned(), recipe.frizz.root.ramp.is_some()),
        ("kink".to_owned(), recipe.kink.root.ramp.is_some()),
        ("color".to_owned(), recipe.color.root.ramp.is_some()),
        ("opacity".to_owned(), recipe.opacity.root.ramp.is_some()),
        ("width".to_owned(), recipe.width.root.ramp.is_some()),
        (
            "strand.splay".to_owned(),
            recipe.strand.splay.root.ramp.is_some(),
        ),
    ];
    for (i, level) in recipe.clump.levels.iter().enumerate() {
        ramps.push((format!("clump.levels[{i}]"), level.root.ramp.is_some()));
    }
    for (section, _) in ramps.into_iter().filter(|(_, ramp)| *ramp) {
        let others = ["center", "tip"];
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
