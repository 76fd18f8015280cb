//! The JSON Schema that editors use.

use std::path::Path;
use std::process::Command;

use pelage_groom::recipe::{Recipe, STRIPS, properties_text, schema, schema_text};

use super::corpus::{examples, folder, is_checked_in, recipes};

#[test]
fn the_checked_in_schema_is_up_to_date() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let path = root.join("schema/groom.schema.json");
    let fresh = is_checked_in(&path, &schema_text());
    assert!(
        fresh,
        "{} is old: run the tests with PELAGE_BLESS=1",
        path.display()
    );
}

#[test]
fn the_checked_in_page_of_properties_is_up_to_date() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let path = root.join("docs/properties.md");
    let fresh = is_checked_in(&path, &properties_text());
    assert!(
        fresh,
        "{} is old: run the tests with PELAGE_BLESS=1",
        path.display()
    );
}

#[test]
fn the_strips_of_the_page_of_properties_are_checked_in_and_no_others() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/gallery");
    let files = std::fs::read_dir(folder).unwrap();
    let mut found: Vec<String> = files
        .map(|file| file.unwrap().file_name().into_string().unwrap())
        .collect();
    let mut expected: Vec<String> = STRIPS.iter().map(|strip| strip.file()).collect();
    found.sort();
    expected.sort();
    assert_eq!(found, expected, "run pelage gallery -o docs/gallery");
}

#[test]
fn the_schema_knows_ranges_defaults_and_words() {
    let schema = schema();
    let key = |path: &str| {
        let pointer = path.replace('.', "/properties/");
        schema.pointer(&format!("/properties/{pointer}")).unwrap()
    };
    assert_eq!(
        schema["$schema"],
        "https://json-schema.org/draft/2020-12/schema"
    );
    assert_eq!(schema["required"], serde_json::json!(["surface", "guides"]));
    assert_eq!(key("surface")["required"], serde_json::json!(["mesh"]));
    assert_eq!(key("width.root")["default"], 0.02);
    assert_eq!(key("interpolation.guides")["minimum"], 1);
    assert_eq!(key("color.variation.hue")["anyOf"][0]["maximum"], 180);
    assert_eq!(key("interpolation.method")["enum"][1], "nearest");
}

#[test]
fn every_key_of_the_schema_is_described() {
    fn check(path: &str, schema: &serde_json::Value) {
        let keys = schema["properties"].as_object();
        for (name, key) in keys.into_iter().flatten() {
            let path = format!("{path}.{name}");
            assert!(
                key["description"].as_str().is_some_and(|d| !d.is_empty()),
                "{path}"
            );
            check(&path, key);
        }
    }
    check("", &schema());
}

#[test]
fn the_schema_accepts_recipes_as_json() {
    let python = std::env::var("PELAGE_PYTHON").unwrap_or_else(|_| "python3".into());
    let run = |arguments: &[&std::ffi::OsStr]| Command::new(&python).args(arguments).output();
    let module = run(&["-c".as_ref(), "import jsonschema".as_ref()]);
    if !module.is_ok_and(|output| output.status.success()) {
        eprintln!("skipped: {python} has no module jsonschema (set PELAGE_PYTHON)");
        return;
    }
    let mut lines = String::new();
    for (path, text) in recipes("good").into_iter().chain(examples()) {
        let recipe = Recipe::parse(&text, &path).unwrap();
        lines += &(serde_json::to_string(&recipe).unwrap() + "\n");
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let (written, schema) = (folder.join("recipes.jsonl"), folder.join("schema.json"));
    std::fs::write(&written, lines).unwrap();
    std::fs::write(&schema, schema_text()).unwrap();
    let script = self::folder().join("recipe/validate.py");
    let output = run(&[script.as_ref(), schema.as_ref(), written.as_ref()]).unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
}
