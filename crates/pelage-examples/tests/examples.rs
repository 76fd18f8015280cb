//! What users of the crate rely on.

use pelage_examples::{Example, example, names, write};
use std::collections::HashSet;
use std::sync::OnceLock;

/// All but the cub, which has tests of its own and is by far the largest.
fn all() -> &'static [Example] {
    static ALL: OnceLock<Vec<Example>> = OnceLock::new();
    ALL.get_or_init(|| {
        let small = names().iter().filter(|n| **n != "animal");
        small.filter_map(|n| example(n)).collect()
    })
}

#[test]
fn every_name_makes_an_example_of_that_name() {
    assert_eq!(all().len() + 1, names().len());
    for e in all() {
        assert!(names().contains(&e.name));
        assert!(e.summary.len() > 20);
    }
    assert!(example("").is_none());
}

#[test]
fn recipes_are_toml_and_refer_to_files_that_exist() {
    for e in all() {
        let recipe: toml::Table = e.recipe.parse().unwrap();
        let mut files: HashSet<&str> = e.maps.iter().map(|m| m.0).collect();
        files.insert(e.mesh_file);
        files.extend(e.guides.iter().map(|g| g.0));
        let quoted = e
            .recipe
            .lines()
            .filter(|l| !l.trim_start().starts_with('#'));
        for name in quoted
            .flat_map(|l| l.split('"'))
            .filter(|w| w.contains('.'))
        {
            if name.ends_with("png") || name.ends_with("obj") {
                assert!(files.contains(name), "{}: {name}", e.name);
            }
        }
        assert!(recipe.contains_key("hair"));
    }
}

#[test]
fn examples_are_the_same_every_time() {
    for one in all() {
        let other = example(one.name).unwrap();
        assert_eq!(one.mesh, other.mesh);
        assert_eq!(one.maps, other.maps);
        assert_eq!(one.guides, other.guides);
        assert_eq!(one.curves, other.curves);
    }
}

#[test]
fn meshes_have_a_texture_coordinate_and_a_normal_a_corner() {
    for e in all() {
        let corners = e.mesh.face_sizes.iter().sum::<u32>() as usize;
        assert_eq!(e.mesh.corner_vertices.len(), corners);
        assert_eq!(e.mesh.corner_uvs.len(), corners);
        assert_eq!(e.mesh.corner_normals.len(), corners);
        let inside = |x: &f32| (0.0..=1.0).contains(x);
        assert!(e.mesh.corner_uvs.iter().flatten().all(inside));
    }
}

#[test]
fn a_written_example_is_whole_and_can_be_written_again() {
    let folder = tempfile::tempdir().unwrap();
    let ball = example("ball").unwrap();
    for _ in 0..2 {
        let written = write(&ball, folder.path()).unwrap();
        assert_eq!(written.len(), 2 + ball.maps.len());
        assert!(written[0].ends_with("groom.toml"));
        assert!(written.iter().all(|p| p.is_file()));
        let inside = std::fs::read_dir(folder.path()).unwrap().count();
        assert_eq!(inside, written.len());
    }
}

#[test]
fn a_folder_that_cannot_be_made_is_named_in_the_error() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("taken");
    std::fs::write(&file, "x").unwrap();
    let error = write(&example("ball").unwrap(), &file).unwrap_err();
    assert!(error.to_string().contains("taken"), "{error}");
}
