//! Files of other programs, as users have them and damaged.

use super::{Dialect, Imported, import, shave, stubble};
use pelage::Recipe;
use pelage::groom::recipe::outline;
use proptest::prelude::*;
use std::path::Path;

const SCENE: &str = include_str!("../../../tests/import/stubble.ma");
const SCRIPT: &str = include_str!("../../../tests/import/shave.mel");
const LIST: &str = include_str!("../../../tests/import/stubble.txt");

fn imported(text: &str, from: Dialect) -> (Imported, Recipe) {
    let imported = import(text, from, "file").unwrap();
    let recipe = Recipe::parse(&imported.toml, Path::new("groom.toml")).unwrap();
    (imported, recipe)
}

fn left_out(imported: &Imported) -> String {
    let lines: Vec<String> = imported
        .left_out
        .iter()
        .map(|left| left.to_string())
        .collect();
    lines.join("\n")
}

#[test]
fn a_scene_of_stubble_gives_the_keys_of_its_names() {
    let (imported, recipe) = imported(SCENE, Dialect::Stubble);
    assert_eq!(recipe.hair.count, 25_000);
    assert_eq!(recipe.interpolation.guides, 4);
    assert_eq!(recipe.color.root.value, [0.25, 0.125, 0.0625]);
    assert_eq!(recipe.width.root.value, 0.05);
    assert_eq!(recipe.strand.twist.value, 180.0);
    let axes = recipe.frizz.frequency.each_ref().map(|axis| axis.value);
    assert_eq!(axes, [0.5, 2.0, 0.5]);
    assert_eq!(
        recipe.groups.segments.map(|s| format!("{s:?}")),
        Some("All(6)".into())
    );
    assert!(!recipe.output.normals);
    // Nothing of the mesh before, nor of the hair after.
    assert_ne!(recipe.scale.amount.value, 9.0);
    let left = left_out(&imported);
    assert!(left.contains("another hair"), "{left}");
    assert!(left.contains("dtxt 1: a map is a file"), "{left}");
}

#[test]
fn a_script_of_shave_maps_what_is_certain_and_tells_the_rest() {
    let (imported, recipe) = imported(SCRIPT, Dialect::Shave);
    assert_eq!(recipe.hair.count, 4000);
    assert_eq!(recipe.color.tip.value, [0.5, 0.25, 0.125]);
    assert_eq!(recipe.width.root.value, Recipe::default().width.root.value);
    let left = left_out(&imported);
    for words in [
        "rootThickness 0.5: perhaps width.root",
        "specular 0.9",
        "spkr 2: not known as a name of Shave",
    ] {
        assert!(left.contains(words), "{words}: {left}");
        assert!(imported.toml.contains(words), "{words}: {}", imported.toml);
    }
}

#[test]
fn lists_of_names_and_values_are_read_with_the_lines_of_what_is_wrong() {
    let (imported, recipe) = imported(LIST, Dialect::Stubble);
    assert_eq!(recipe.hair.count, 200);
    assert_eq!(recipe.scale.random.value, 0.25);
    assert_eq!(recipe.width.tip.value, 0.01);
    let left = left_out(&imported);
    assert!(
        left.contains("6: Root_Opacity 7: opacity.root: expected"),
        "{left}"
    );
    assert!(left.contains("7: Wobble 3: not known"), "{left}");
}

#[test]
fn what_is_no_list_of_parameters_is_refused() {
    for text in ["", "\u{0}\u{1}", "hello world", "setAttr \".t\" 1 2 3;"] {
        let error = import(text, Dialect::Stubble, "file")
            .unwrap_err()
            .to_string();
        assert!(error.contains("interpolated_hair_count"), "{error}");
    }
    let endless = "Twist 1\n".repeat(10_001);
    assert!(import(&endless, Dialect::Stubble, "file").is_err());
}

#[test]
fn every_name_leads_to_a_key_that_is_there() {
    let sections = outline();
    let keys: Vec<&str> = sections
        .iter()
        .flat_map(|section| section.keys.iter().map(|key| key.key.as_str()))
        .collect();
    for key in shave::keys() {
        assert!(keys.contains(&key), "{key}");
    }
    for short in stubble::short_names() {
        assert!(stubble::meaning(short).is_some(), "{short}");
    }
    for name in sections
        .iter()
        .flat_map(|s| s.keys.iter().flat_map(|key| &key.ancestors))
    {
        assert!(stubble::meaning(name).is_some(), "{name}");
        assert!(stubble::meaning(&name.replace('_', "")).is_some(), "{name}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn no_damage_makes_the_importer_panic_or_write_what_cannot_be_read(
        which in 0..3_usize,
        changes in prop::collection::vec((any::<usize>(), 0..60_usize, ".{0,12}"), 1..8),
        from in prop::sample::select(vec![Dialect::Shave, Dialect::Stubble]),
    ) {
        let mut text = [SCENE, SCRIPT, LIST][which].to_owned();
        for (at, length, piece) in changes {
            let start = text.floor_char_boundary(at % (text.len() + 1));
            let end = text.floor_char_boundary((start + length).min(text.len()));
            text.replace_range(start..end, &piece);
        }
        if let Err(error) = import(&text, from, &text) {
            prop_assert!(!format!("{error:#}").contains("recipe that was made"), "{error:#}");
        }
    }
}
