//! `pelage import`: recipes from other programs.

use crate::groom::{Folder, fails, run};
use pelage::Recipe;

fn sample(name: &str) -> String {
    format!("{}/tests/import/{name}", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn an_imported_recipe_loads_and_what_is_not_in_it_is_told_by_line() {
    for (from, name, told) in [
        ("stubble", "stubble.ma", "stubble.ma:12: dtxt 1:"),
        ("stubble", "stubble.txt", "stubble.txt:6: Root_Opacity 7:"),
        ("shave", "shave.mel", "shave.mel:5: rootThickness 0.5:"),
    ] {
        let folder = Folder::new();
        let recipe = folder.path("groom.toml");
        let output = run(&["import", "--from", from, &sample(name), "-o", &recipe]);
        let errors = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success() && errors.contains(told), "{errors}");
        let loaded = Recipe::load(recipe.as_ref()).unwrap();
        assert_ne!(loaded.hair.count, Recipe::default().hair.count, "{name}");
    }
}

#[test]
fn an_import_that_fails_says_why_and_leaves_what_was_there() {
    let folder = Folder::new();
    folder.write("groom.toml", "old");
    let recipe = folder.path("groom.toml");
    let import = ["import", "--from", "shave"];
    let words = fails(&[&import[..], &[&sample("shave.mel"), "-o", &recipe]].concat());
    assert!(words.contains("--force"), "{words}");
    let arguments = [&sample("stubble.ma"), "-o", &recipe, "--force"];
    let words = fails(&[&import[..], &arguments].concat());
    assert!(words.contains("hairCount"), "{words}");
    let words = fails(&[&import[..], &["nowhere.ma", "-o", &recipe, "--force"]].concat());
    assert!(words.contains("nowhere.ma"), "{words}");
    assert_eq!(folder.bytes("groom.toml"), b"old");
}
