//! Recipes that are accepted, and what they say.

use std::path::Path;

use pelage_groom::recipe::{
    Blend, Channel, Comb, GuideSource, MapSpace, Method, Ramp, Recipe, Segments, Wrap,
};

use super::corpus::{folder, is_checked_in, recipes};

fn parse(text: &str) -> Recipe {
    Recipe::parse(text, Path::new("hero/groom.toml")).unwrap_or_else(|error| panic!("{error}"))
}

fn good(name: &str) -> Recipe {
    let path = folder().join("good").join(name);
    parse(&std::fs::read_to_string(path).unwrap())
}

#[test]
fn every_good_recipe_is_accepted_and_survives_being_written() {
    for (path, text) in recipes("good") {
        let shown = path.display();
        let recipe = Recipe::parse(&text, &path).unwrap_or_else(|error| panic!("{error}"));
        for written in [recipe.to_toml(), recipe.to_documented_toml()] {
            let again = Recipe::parse(&written, &path);
            let again = again.unwrap_or_else(|error| panic!("{shown}\n{written}\n{error}"));
            assert_eq!(again, recipe, "{shown}");
        }
    }
}

#[test]
fn the_layout_of_the_documentation_is_accepted() {
    let text = std::fs::read_to_string(folder().join("layout.toml")).unwrap();
    let recipe = parse(&text);
    assert_eq!(recipe.frizz.tip.value, 0.4);
    assert_eq!(recipe.frizz.frequency[2].value, 2.0);
    assert_eq!(recipe.width.tip.value, 0.002);
}

#[test]
fn what_a_recipe_leaves_out_has_its_default() {
    let recipe = good("minimal.toml");
    assert_eq!((recipe.hair.count, recipe.hair.seed), (10_000, 0));
    assert_eq!(recipe.interpolation.guides, 3);
    assert_eq!(recipe.interpolation.method, Method::InverseDistance);
    assert_eq!(
        (recipe.width.root.value, recipe.width.tip.value),
        (0.02, 0.0)
    );
    assert_eq!(recipe.cut.length.value, 1.0);
    assert_eq!(recipe.voxels.resolution, [1, 1, 1]);
    assert!(recipe.maps().is_empty());
}

#[test]
fn the_documented_defaults_are_checked_in() {
    let path = folder().join("defaults.toml");
    let fresh = is_checked_in(&path, &Recipe::default().to_documented_toml());
    assert!(
        fresh,
        "{} is old: run the tests with PELAGE_BLESS=1",
        path.display()
    );
}

#[test]
fn maps_are_listed_with_their_keys() {
    let recipe = good("everything-there-is.toml");
    let maps = recipe.maps();
    let keys: Vec<_> = maps.iter().map(|(key, _)| key.as_str()).collect();
    let expected = [
        "roots.density",
        "groups.map",
        "scale.amount",
        "color.tip",
        "color.mutant.percent",
        "color.mutant.color",
        "color.variation.hue",
        "opacity.tip",
        "width.tip",
    ];
    assert_eq!(keys, expected);
    assert_eq!(maps[0].1.path.written, "density.png");
    assert_eq!(maps[0].1.path.resolved, Path::new("hero/density.png"));
}

#[test]
fn a_map_says_how_it_is_read() {
    let recipe = good("everything-there-is.toml");
    let density = recipe.roots.density.map.unwrap();
    assert_eq!(density.channel, Some(Channel::Alpha));
    assert_eq!(
        (density.wrap, density.blend),
        (Wrap::Clamp, Blend::Multiply)
    );
    assert_eq!(density.space, None);
    let tip = recipe.color.tip.map.unwrap();
    assert_eq!((tip.channel, tip.blend), (None, Blend::Multiply));
    assert_eq!(tip.space, Some(MapSpace::Srgb));
}

#[test]
fn every_wrap_is_read_and_written() {
    for (word, wrap) in [
        ("repeat", Wrap::Repeat),
        ("clamp", Wrap::Clamp),
        ("mirror", Wrap::Mirror),
    ] {
        let recipe = parse(&format!(
            "surface.mesh = 'a.obj'\nguides.curves = 'g.usda'\n\
             width.root = {{ map = 'w.png', wrap = '{word}' }}\n"
        ));
        assert_eq!(recipe.width.root.map.as_ref().unwrap().wrap, wrap);
        assert_eq!(parse(&recipe.to_toml()), recipe);
    }
}

#[test]
fn a_map_without_a_value_is_taken_as_it_is() {
    let text = "surface.mesh = 'a.obj'\nguides.curves = 'g.usda'\n\
                width.root = { map = 'w.png' }\n\
                color.root = { map = 'c.png' }\n\
                color.tip = { map = 'c.png', blend = 'multiply' }\n";
    let recipe = parse(text);
    assert_eq!(recipe.width.root.value, 1.0);
    assert_eq!(recipe.width.root.map.unwrap().channel, Some(Channel::Red));
    assert_eq!(recipe.color.root.value, [0.0; 3]);
    assert_eq!(recipe.color.tip.value, [1.0; 3]);
}

#[test]
fn codes_are_decoded_from_srgb_and_lists_are_linear() {
    let text = "surface.mesh = 'a.obj'\nguides.curves = 'g.usda'\n\
                color.root = '#00ff80'\ncolor.tip = [0, 1, 0.5]\n";
    let recipe = parse(text);
    let [r, g, b] = recipe.color.root.value;
    assert_eq!((r, g), (0.0, 1.0));
    assert!((b - 0.215_860_5).abs() < 1e-6);
    assert_eq!(recipe.color.tip.value, [0.0, 1.0, 0.5]);
}

#[test]
fn groups_have_segments_by_the_codes_of_their_colors() {
    let recipe = good("layout.toml");
    let Some(Segments::ByColor(segments)) = &recipe.groups.segments else {
        panic!("{:?}", recipe.groups.segments);
    };
    assert_eq!(segments[&[255, 0, 0]], 12);
    assert_eq!(segments[&[0, 0, 255]], 6);
    assert_eq!(recipe.groups.map.unwrap().path.written, "groups.png");
}

#[test]
fn guides_can_be_grown() {
    let recipe = good("grown.toml");
    let Some(GuideSource::Grow(grow)) = recipe.guides.source() else {
        panic!("{:?}", recipe.guides);
    };
    assert_eq!(grow.seed, u64::MAX);
    assert_eq!(grow.curl.turns.value, -3.0);
    assert!(matches!(&grow.comb, Some(Comb::Map(map)) if map.wrap == Wrap::Clamp));
    let keys: Vec<_> = recipe.maps().into_iter().map(|(key, _)| key).collect();
    assert_eq!(
        keys,
        ["guides.grow.length", "guides.grow.lean", "guides.grow.comb"]
    );
}

#[test]
fn a_ramp_tells_the_whole_strand() {
    let text = "surface.mesh = 'a.obj'\nguides.curves = 'g.usda'\n\
                [width]\nroot = { ramp = [[0.0, 1.0], [1.0, 0.2]], map = 'w.png' }\n\
                [color]\nroot = { ramp = [[0, '#000000'], [0.5, [0, 1, 0]]] }\n";
    let recipe = Recipe::parse(text, Path::new("groom.toml")).unwrap();
    let points = vec![(0.0, 1.0), (1.0, 0.2)];
    assert_eq!(recipe.width.root.ramp, Some(Ramp { points }));
    assert!(recipe.width.root.map.is_some());
    let color = recipe.color.root.ramp.as_ref().unwrap();
    assert_eq!(color.points[1], (0.5, [0.0, 1.0, 0.0]));
    let again = Recipe::parse(&recipe.to_toml(), Path::new("groom.toml"));
    // Written in full, the tip stands beside the ramp of the root.
    assert!(again.is_ok(), "{again:?}");
}
