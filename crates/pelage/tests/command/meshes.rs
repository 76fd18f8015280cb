//! Surfaces that no program should write, but some do.

use crate::groom::{Folder, fails, pelage};

/// What `pelage generate` says of the failure.
fn refusal(folder: &Folder) -> String {
    fails(&["generate", &folder.path("groom.toml"), "-o", "null"])
}

#[test]
fn meshes_that_no_program_should_write_grow_hair_or_are_refused_in_words() {
    let folder = Folder::new();
    folder.write(
        "groom.toml",
        "surface.mesh = 'm.obj'\nguides.grow = { count = 20, length = 1 }\n",
    );
    let grow = |mesh: &str| {
        folder.write("m.obj", mesh);
        let hair = folder.arrays("hair.npz", &["--count", "500"]);
        assert!(hair.points.as_flattened().iter().all(|c| c.is_finite()));
        assert_eq!(hair.len(), 500);
    };
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    grow(triangle);
    // Three triangles on an edge; two that share a corner only; one of them twice.
    grow(&format!("{triangle}v 0 -1 0\nv 0 0 1\nf 1 2 4\nf 1 2 5\n"));
    grow(&format!("{triangle}v 0 -1 0\nv -1 0 0\nf 1 4 5\n"));
    grow(&format!("{triangle}f 1 2 3\nf 3 2 1\n"));
    grow("v 1e-30 0 0\nv 1 0 0\nv 0 1 0\nv 1e-20 1e-20 1e-20\nf 1 2 3\nf 1 2 4\n");
    let refuse = |mesh: &str, said: &str| {
        folder.write("m.obj", mesh);
        let words = refusal(&folder);
        assert!(
            words.contains("surface.mesh: ") && words.contains(said),
            "{words}"
        );
    };
    refuse("", "there is no face");
    refuse("v 0 0 0\nv 1 0 0\nv 0 1 0\n", "there is no face");
    refuse(
        "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n",
        "every triangle is degenerate",
    );
    refuse(
        "v 0 0 0\nv 1e60 0 0\nv 0 1 0\nf 1 2 3\n",
        "line 2: \"1e60\" is not a finite 32-bit number",
    );
}

#[test]
fn what_lies_too_far_away_is_refused_in_words() {
    let folder = Folder::new();
    folder.write(
        "groom.toml",
        "surface.mesh = 'm.obj'\nguides.curves = 'g.obj'\n",
    );
    folder.write("g.obj", "v 0 0 0\nv 0 0 1e30\nl 1 2\n");
    for far in ["1e19", "1e30", "3e38"] {
        folder.write(
            "m.obj",
            &format!("v 0 0 0\nv {far} 0 0\nv 0 -{far} {far}\nf 1 2 3\n"),
        );
        let words = refusal(&folder);
        assert!(
            words.contains(&format!("surface.mesh: vertex 1 is at ({far}, ")),
            "{words}"
        );
    }
    folder.write("m.obj", "v 0 0 0\nv 1e18 0 0\nv 0 1e18 0\nf 1 2 3\n");
    let words = refusal(&folder);
    assert!(
        words.contains("guides: vertex 1 of guide 0 is not finite or"),
        "{words}"
    );
    folder.write("g.obj", "v 0 0 0\nv 0 0 1e18\nl 1 2\n");
    let hair = folder.arrays("hair.npz", &["--count", "100"]);
    assert!(hair.points.as_flattened().iter().all(|c| c.is_finite()));
}

#[test]
fn a_million_slivers_grow_hair() {
    let folder = Folder::new();
    folder.write(
        "groom.toml",
        "surface.mesh = 'm.obj'\nguides.grow = { count = 20, length = 1 }\n",
    );
    let slivers = 1_000_000;
    let mut text = "v 0 0 0\n".to_owned();
    for i in 0..=slivers {
        text += &format!("v 1 {} 0\n", i as f64 / slivers as f64);
    }
    for i in 0..slivers {
        text += &format!("f 1 {} {}\n", i + 2, i + 3);
    }
    folder.write("m.obj", &text);
    let said = pelage(&[
        "generate",
        &folder.path("groom.toml"),
        "-o",
        "null",
        "--count",
        "2000",
    ]);
    assert!(said.starts_with("2,000 hairs"), "{said}");
}
