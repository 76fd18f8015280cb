//! Recipes by way of serde: what it reads and writes is what a `groom.toml` says.

use std::path::Path;

use pelage_groom::recipe::{
    ColorProperty, Comb, Facing, Grow, MapUse, Method, Recipe, ScalarProperty, Segments, Width,
};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::corpus::{examples, recipes};

/// What serde says of `text` as TOML and, where JSON can say the same, as JSON.
fn by_serde(text: &str) -> Vec<Result<Recipe, String>> {
    let mut found = vec![toml::from_str::<Recipe>(text).map_err(|error| error.to_string())];
    if let Ok(json) = toml::from_str::<serde_json::Value>(text) {
        let read = serde_json::from_str::<Recipe>(&json.to_string());
        found.push(read.map_err(|error| error.to_string()));
    }
    found
}

#[test]
fn serde_reads_what_the_reader_reads() {
    for (path, text) in recipes("good").into_iter().chain(examples()) {
        let recipe = Recipe::parse(&text, &path).unwrap_or_else(|error| panic!("{error}"));
        for found in by_serde(&text) {
            let found = found.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            assert_eq!(found.in_folder(path.parent().unwrap()), recipe);
        }
    }
}

#[test]
fn serde_refuses_what_the_reader_refuses_and_names_every_key() {
    for (path, text) in recipes("bad") {
        let refused = Recipe::parse(&text, Path::new("groom.toml")).unwrap_err();
        for found in by_serde(&text) {
            let error = found.expect_err(&path.display().to_string());
            for problem in refused.problems().iter().take(20) {
                let named = error.contains(&problem.key);
                assert!(named, "{}\n{error}\n{}", path.display(), problem.key);
            }
        }
    }
}

#[test]
fn every_recipe_survives_toml_and_json() {
    for (path, text) in recipes("good").into_iter().chain(examples()) {
        let folder = path.parent().unwrap();
        let recipe = Recipe::parse(&text, &path).unwrap();
        let in_toml = toml::to_string(&recipe).unwrap();
        let pretty = toml::to_string_pretty(&recipe).unwrap();
        let in_json = serde_json::to_string(&recipe).unwrap();
        for written in [in_toml, pretty, recipe.to_toml()] {
            let again = toml::from_str::<Recipe>(&written);
            let again = again.unwrap_or_else(|error| panic!("{written}\n{error}"));
            assert_eq!(again.in_folder(folder), recipe);
            assert_eq!(Recipe::parse(&written, &path).unwrap(), recipe);
        }
        let again: Recipe = serde_json::from_str(&in_json).unwrap();
        assert_eq!(again.in_folder(folder), recipe);
        let value = serde_json::to_value(&recipe).unwrap();
        let again: Recipe = serde_json::from_value(value).unwrap();
        assert_eq!(again.in_folder(folder), recipe);
    }
}

#[test]
fn the_written_recipe_and_serde_say_the_same() {
    for (path, text) in recipes("good").into_iter().chain(examples()) {
        let recipe = Recipe::parse(&text, &path).unwrap();
        let ours: serde_json::Value = toml::from_str(&recipe.to_toml()).unwrap();
        let theirs: serde_json::Value = toml::from_str(&toml::to_string(&recipe).unwrap()).unwrap();
        // Sections without a value are tables in one and left out of the other.
        assert_eq!(without_empty(ours), without_empty(theirs));
    }
}

fn without_empty(value: serde_json::Value) -> serde_json::Value {
    let serde_json::Value::Object(table) = value else {
        return value;
    };
    let kept = table
        .into_iter()
        .map(|(key, value)| (key, without_empty(value)));
    kept.filter(|(_, value)| value != &serde_json::json!({}))
        .collect()
}

/// The value from JSON and back.
fn through_json<T: Serialize + DeserializeOwned>(json: &str) -> (T, String) {
    let value = serde_json::from_str(json).unwrap_or_else(|error| panic!("{json}\n{error}"));
    let text = serde_json::to_string(&value).unwrap();
    (value, text)
}

#[test]
fn the_parts_of_a_recipe_can_be_embedded_one_by_one() {
    let (width, text) = through_json::<Width>(r#"{"root":0.02,"tip":{"value":0.5,"map":"w.png"}}"#);
    assert_eq!(width.tip.map.as_ref().unwrap().path.written, "w.png");
    assert_eq!(text, r#"{"root":0.02,"tip":{"value":0.5,"map":"w.png"}}"#);
    let (ramp, text) = through_json::<ScalarProperty>(r#"{"ramp":[[0.0,1.0],[1.0,0.25]]}"#);
    assert_eq!(ramp.ramp.unwrap().points[1], (1.0, 0.25));
    assert_eq!(text, r#"{"ramp":[[0.0,1.0],[1.0,0.25]]}"#);
    let (color, _) = through_json::<ColorProperty>(r##""#00ff00""##);
    assert_eq!(color.value, [0.0, 1.0, 0.0]);
    let (segments, text) = through_json::<Segments>(r##"{"#FF0000":12,"#0000ff":6}"##);
    assert!(matches!(segments, Segments::ByColor(colors) if colors.len() == 2));
    assert_eq!(text, r##"{"#0000ff":6,"#ff0000":12}"##);
    let (facing, text) = through_json::<Facing>("true");
    assert_eq!(facing, Facing::On { exponent: 2.0 });
    assert_eq!(text, r#"{"exponent":2.0}"#);
    let (method, text) = through_json::<Method>("\"nearest\"");
    assert_eq!((method, text.as_str()), (Method::Nearest, "\"nearest\""));
    let (grow, _) = through_json::<Grow>(
        r#"{"length":1,"seed":18446744073709551615,"comb":{"map":"c.png","wrap":"clamp"}}"#,
    );
    assert_eq!(grow.seed, u64::MAX);
    assert!(matches!(
        grow.comb,
        Some(Comb::Map(MapUse { channel: None, .. }))
    ));
}

#[test]
fn a_ramp_of_the_root_leaves_the_tip_out() {
    let (width, text) = through_json::<Width>(r#"{"root":{"ramp":[[0.0,1.0]]}}"#);
    assert_eq!(text, r#"{"root":{"ramp":[[0.0,1.0]]}}"#);
    assert_eq!(width.tip, Width::default().tip);
}

#[test]
fn a_recipe_put_together_in_code_can_be_written_and_read() {
    let mut recipe = Recipe::default();
    recipe.surface.mesh.written = "body.obj".into();
    recipe.guides.grow = Some(Grow::default());
    recipe.hair.seed = u64::MAX;
    let recipe = recipe.in_folder(Path::new("hero"));
    let json = serde_json::to_string(&recipe).unwrap();
    let again: Recipe = serde_json::from_str(&json).unwrap();
    assert_eq!(again.in_folder(Path::new("hero")), recipe);
}

#[derive(Debug, Deserialize)]
struct Shot {
    #[serde(rename = "frames")]
    _frames: [u32; 2],
    #[serde(rename = "groom")]
    _groom: Recipe,
}

/// What is wrong with a shot of this groom.
fn embedded(groom: &str) -> String {
    let json = format!(r#"{{"frames":[1,2],"groom":{groom}}}"#);
    serde_json::from_str::<Shot>(&json).unwrap_err().to_string()
}

#[test]
fn an_embedded_recipe_lists_all_its_mistakes_with_their_keys() {
    let error = embedded(
        r#"{"surface":{"mesh":"a.obj"},"guides":{"curves":"g.usda"},
            "hair":{"count":"many","sed":3},"width":{"tip":-1}}"#,
    );
    let lines = error.lines().filter(|line| line.contains(": "));
    // serde_json adds the end of the recipe.
    let lines: Vec<_> = lines.map(|line| line.split(" at line").next()).collect();
    assert_eq!(
        lines,
        [
            Some("hair.count: expected a whole number 0.., found \"many\""),
            Some("hair.sed: unknown key; hair has count, seed"),
            Some("width.tip: expected a number 0.., found -1"),
        ]
    );
    assert!(error.contains("did you mean \"seed\"?"), "{error}");
}

#[test]
fn what_toml_cannot_say_is_refused_by_name() {
    let null = embedded(r#"{"surface":{"mesh":null}}"#);
    assert!(
        null.starts_with("surface.mesh: null says nothing"),
        "{null}"
    );
    let twice = embedded(r#"{"hair":{"count":1,"count":2}}"#);
    assert!(twice.starts_with("duplicate key: count"), "{twice}");
    let deep = embedded(&format!("{}1{}", "{\"hair\":".repeat(60), "}".repeat(60)));
    assert!(deep.contains("nested too deeply"), "{deep}");
    let text = "surface.mesh = 'a.obj'\nguides.curves = 'g.usda'\nhair.count = 2026-01-01";
    let date = toml::from_str::<Recipe>(text).unwrap_err().to_string();
    let expected = "hair.count: expected a whole number 0.., found 2026-01-01";
    assert!(date.contains(expected), "{date}");
}

#[test]
fn a_text_that_pretends_to_be_a_literal_stays_a_text() {
    let json = r#"{"count":{"$serde_json::private::Number":"1, seed = 7"}}"#;
    let error = serde_json::from_str::<pelage_groom::recipe::Hair>(json).unwrap_err();
    assert!(error.to_string().starts_with("count: expected"), "{error}");
}
