//! Recipes that are refused, each with the message beside it.

use std::path::Path;

use pelage_groom::recipe::{ProblemKind, Recipe};

use super::corpus::{is_checked_in, recipes};

#[test]
fn every_bad_recipe_is_refused_with_the_message_beside_it() {
    let cases = recipes("bad");
    assert!(cases.len() >= 25);
    for (path, text) in cases {
        let error = Recipe::parse(&text, Path::new("groom.toml")).unwrap_err();
        let message = format!("{error}\n");
        let expected = path.with_extension("txt");
        let shown = path.display();
        assert!(is_checked_in(&expected, &message), "{shown}\n{message}");
    }
}

#[test]
fn every_problem_lies_inside_the_text() {
    for (path, text) in recipes("bad") {
        let error = Recipe::parse(&text, Path::new("groom.toml")).unwrap_err();
        for problem in error.problems() {
            let line = text.lines().nth(problem.line - 1).unwrap_or("");
            let columns = line.chars().count() + 1;
            assert!(problem.column <= columns, "{}\n{problem}", path.display());
        }
    }
}

#[test]
fn a_text_over_sixteen_mebibytes_is_refused_unread() {
    let text = "#".repeat((16 << 20) + 1);
    let error = Recipe::parse(&text, Path::new("groom.toml")).unwrap_err();
    assert_eq!(error.first().kind, ProblemKind::File);
    let found = error.to_string();
    let expected =
        "groom.toml: 16777217 bytes are too much for a recipe, which has 16777216 at most";
    assert_eq!(found, expected);
}

#[test]
fn depth_is_bounded_however_it_is_written() {
    let deep = 1_000_000;
    let texts = [
        format!("hair = {}", "[".repeat(deep)),
        format!("hair = {}", "{a=".repeat(deep)),
        format!("{}b = 1", "a.".repeat(deep)),
        format!("[{}b]", "a.".repeat(deep)),
    ];
    for text in texts {
        let error = Recipe::parse(&text, Path::new("groom.toml")).unwrap_err();
        assert_eq!(error.first().kind, ProblemKind::Syntax);
        assert!(error.to_string().len() < 2000);
    }
}

#[test]
fn many_mistakes_are_counted_and_not_all_printed() {
    let mut text = "surface.mesh = 'a.obj'\nguides.curves = 'g.usda'\n".to_owned();
    for i in 0..100 {
        text += &format!("[unknown{i}]\n");
    }
    let error = Recipe::parse(&text, Path::new("groom.toml")).unwrap_err();
    assert_eq!(error.problems().len(), 100);
    assert!(error.to_string().ends_with("\n\nand 80 more"));
}

#[test]
fn mistakes_without_end_are_noted_up_to_a_limit() {
    let mut text = "surface.mesh = 'a.obj'\nguides.curves = 'g.usda'\n[hair]\n".to_owned();
    for i in 0..300_000 {
        text += &format!("k{i} = 1\n");
    }
    let error = Recipe::parse(&text, Path::new("groom.toml")).unwrap_err();
    assert_eq!(error.problems().len(), 200);
}

#[test]
fn a_recipe_that_is_not_there_is_named() {
    let error = Recipe::load(Path::new("no/such/groom.toml")).unwrap_err();
    let message = error.to_string();
    assert!(
        message.starts_with("no/such/groom.toml: cannot read the recipe: "),
        "{message}"
    );
}

#[test]
fn an_error_found_later_points_at_the_nearest_thing_written() {
    let text =
        "surface.mesh = 'a.obj'\nguides.curves = 'g.usda'\n[roots]\ndensity = { map = 'd.png' }\n";
    let recipe = Recipe::parse(text, Path::new("groom.toml")).unwrap();
    let place = |key: &str| {
        let error = recipe.error_at(key, "does not fit");
        (error.first().line, error.first().column)
    };
    assert_eq!(place("roots.density.map"), (4, 19));
    assert_eq!(place("roots.density.channel"), (4, 11));
    assert_eq!(place("hair.count"), (0, 0));
    let message = recipe.error_at("hair.count", "does not fit").to_string();
    assert_eq!(message, "groom.toml: hair.count: does not fit");
}
