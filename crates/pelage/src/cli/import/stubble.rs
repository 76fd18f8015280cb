//! The names of Stubble, the generator of document 004: those of the document, with and
//! without underscores, and the long and short names of its Maya node, which are public
//! with its source.

use super::dialect::{Meaning, Unit};
use pelage::groom::recipe::outline;
use std::collections::HashMap;
use std::sync::LazyLock;

/// Short names of the Maya node, and the names they stand for.
const SHORT: [(&str, &str); 44] = [
    ("gcnt", "interpolated_hair_count"),
    ("dhc", "displayed_hair_count"),
    ("vxsdim", "voxels_dimensions"),
    ("sgc", "segments_count"),
    ("ints", "interpolation_samples"),
    ("clcn", "calculate_normals"),
    ("scl", "scale"),
    ("rscl", "random_scale"),
    ("rthck", "root_thickness"),
    ("tthck", "tip_thickness"),
    ("dis", "displacement"),
    ("sktr", "skip_threshold"),
    ("rop", "root_opacity"),
    ("top", "tip_opacity"),
    ("rcol", "root_color"),
    ("tcol", "tip_color"),
    ("hue", "hue_variation"),
    ("value", "value_variation"),
    ("mcol", "mutant_hair_color"),
    ("pmh", "percent_mutant_hair"),
    ("rfzz", "root_frizz"),
    ("tfzz", "tip_frizz"),
    ("fzzXf", "frizz_X_frequency"),
    ("fzzYf", "frizz_Y_frequency"),
    ("fzzZf", "frizz_Z_frequency"),
    ("afzz", "frizz_anim"),
    ("asfzz", "frizz_anim_speed"),
    ("adfzz", "frizz_anim_direction"),
    ("rknk", "root_kink"),
    ("tknk", "tip_kink"),
    ("knkXf", "kink_X_frequency"),
    ("knkYf", "kink_Y_frequency"),
    ("knkZf", "kink_Z_frequency"),
    ("msc", "multi_strand_count"),
    ("rspl", "root_splay"),
    ("tspl", "tip_splay"),
    ("cspl", "center_splay"),
    ("twst", "twist"),
    ("off", "offset"),
    ("asp", "aspect"),
    ("rstr", "randomize_strand"),
    ("cnt", "guides_count"),
    ("digu", "display_guides"),
    ("diha", "display_hair"),
];

/// Names that document 004 has no property for, and their keys.
const MORE: [(&str, &str); 2] = [
    ("segmentscount", "groups.segments"),
    ("displacement", "roots.displacement"),
];

const MAP: &str = "a map is a file: give it as `map = \"…\"` to the key that it modulates";
const VIEWPORT: &str = "it is about the viewport";

/// What a name means, whatever its case and underscores.
pub fn meaning(name: &str) -> Option<Meaning> {
    let long = SHORT.iter().find(|(short, _)| *short == name);
    let plain = plain(long.map_or(name, |(_, long)| long));
    if let Some(why) = without(&plain) {
        return Some(Meaning::Without(why));
    }
    if plain == "skipthreshold" {
        return Some(Meaning::Unsure(
            "output.skip_threshold",
            "the document's criterion and the default of the node contradict each other",
        ));
    }
    // The program takes its sine and cosine as it is.
    let unit = match plain.as_str() {
        "twist" => Unit::Radians,
        _ => Unit::Same,
    };
    let key = KEYS.get(&plain)?;
    Some(Meaning::Key(key.clone(), unit))
}

fn without(plain: &str) -> Option<&'static str> {
    let is_map = |ending| plain.ends_with(ending);
    match plain {
        "guidescount" => Some("guides are curves of a file, or guides.grow"),
        "displayguides" | "displayhair" => Some(VIEWPORT),
        "interpolationgroups" => Some(MAP),
        _ if is_map("udimension") || is_map("vdimension") || plain == "texturedimension" => {
            Some("maps are read at the size they have")
        }
        _ if is_map("texture") || is_map("txt") || is_map("map") => Some(MAP),
        _ => None,
    }
}

/// Keys of ours by the names they have in document 004.
static KEYS: LazyLock<HashMap<String, String>> = LazyLock::new(|| {
    let more = MORE.map(|(name, key)| (name.to_owned(), key.to_owned()));
    let mut keys = HashMap::from(more);
    for key in outline().into_iter().flat_map(|section| section.keys) {
        let several = key.ancestors.len() > 1;
        for (axis, name) in key.ancestors.iter().enumerate() {
            let key = &key.key;
            let key = if several {
                format!("{key}[{axis}]")
            } else {
                key.clone()
            };
            keys.insert(plain(name), key);
        }
    }
    keys
});

fn plain(name: &str) -> String {
    name.replace('_', "").to_ascii_lowercase()
}

#[cfg(test)]
/// The short names.
pub fn short_names() -> impl Iterator<Item = &'static str> {
    SHORT.iter().map(|(short, _)| *short)
}
