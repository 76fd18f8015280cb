use super::*;
use crate::laws;
use crate::model::Model;
use crate::sdf::Solid;
use shape::Part;
use std::sync::OnceLock;

/// The full bust, made once for all tests.
fn head() -> &'static (Solid<Part>, Model) {
    static HEAD: OnceLock<(Solid<Part>, Model)> = OnceLock::new();
    HEAD.get_or_init(|| {
        let bust = shape::bust();
        let model = unwrap::model(&bust, Detail::FULL.step);
        (bust, model)
    })
}

#[test]
fn the_bust_is_closed_manifold_and_well_shaped() {
    let mesh = &head().1.mesh;
    laws::assert_closed_manifold(mesh);
    laws::assert_well_shaped(mesh, 0.1);
    let count = mesh.triangles.len();
    assert!((15_000..26_000).contains(&count), "{count} triangles");
}

#[test]
fn the_atlas_has_no_overlaps() {
    let model = &head().1;
    laws::assert_atlas(model);
    let (_, mean) = laws::stretch(model);
    assert!(mean < 1.35, "mean stretch {mean}");
}

#[test]
fn hair_falls_around_the_skull_and_never_into_it() {
    let (bust, model) = head();
    let guides = guides::guides(bust, model, Detail::FULL.guides);
    assert!((250..=350).contains(&guides.len()), "{}", guides.len());
    laws::assert_guides(bust, model, &guides, guides::SEGMENTS + 1);
}

#[test]
fn the_parting_has_two_flat_colours() {
    let maps = maps::maps(&head().1, 256);
    let groups = &maps.iter().find(|m| m.0 == "groups.png").unwrap().1;
    let mut seen = [0, 0];
    let texels: Vec<f32> = groups.texels().iter().collect();
    for texel in texels.chunks(3) {
        match texel {
            [1.0, 0.0, 0.0] => seen[0] += 1,
            [0.0, 0.0, 1.0] => seen[1] += 1,
            other => panic!("{other:?}"),
        }
    }
    assert!(seen.iter().all(|&n| n > 1000), "{seen:?}");
}
