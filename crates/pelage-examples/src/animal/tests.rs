use super::*;
use crate::laws;
use crate::model::Model;
use std::sync::OnceLock;

/// The full cub, made once for all tests.
fn cub() -> &'static (Solid<Part>, Model) {
    static CUB: OnceLock<(Solid<Part>, Model)> = OnceLock::new();
    CUB.get_or_init(|| {
        let body = shape::body();
        let model = pelt::model(&body, Detail::FULL.step);
        (body, model)
    })
}

/// A coarse cub for what does not depend on its size.
const SMALL: Detail = Detail {
    step: 0.02,
    texels: 256,
    guides: 150,
};

#[test]
fn the_cub_is_closed_manifold_and_well_shaped() {
    let mesh = &cub().1.mesh;
    laws::assert_closed_manifold(mesh);
    laws::assert_well_shaped(mesh, 0.1);
    let count = mesh.triangles.len();
    assert!((38_000..45_000).contains(&count), "{count} triangles");
}

#[test]
fn the_pelt_lies_flat_without_overlaps() {
    let model = &cub().1;
    laws::assert_atlas(model);
    let (_, mean) = laws::stretch(model);
    assert!(mean < 1.35, "mean stretch {mean}");
}

#[test]
fn guides_start_on_the_skin_and_stay_outside() {
    let (body, model) = cub();
    let guides = guides::guides(body, model, Detail::FULL.guides);
    assert!((1000..=1500).contains(&guides.len()), "{}", guides.len());
    laws::assert_guides(body, model, &guides, guides::SEGMENTS + 1);
}

#[test]
fn eyes_nose_and_soles_grow_nothing() {
    let (body, model) = cub();
    let maps = maps::maps(body, model, SMALL.texels);
    let density = &maps.iter().find(|m| m.0 == "density.png").unwrap().1;
    for (uv, &label) in model.uvs.iter().zip(&model.labels) {
        if label < pelt::label::SOLE {
            continue;
        }
        let middle = (uv[0] + uv[1] + uv[2]) / 3.0 * SMALL.texels as f64;
        let row = SMALL.texels as u32 - 1 - middle.y as u32;
        assert_eq!(density.texel(middle.x as u32, row, 0), 0.0);
    }
}

#[test]
fn two_runs_with_any_number_of_threads_give_the_same_bytes() {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let many = rayon::ThreadPoolBuilder::new().num_threads(3).build();
    let one = one.unwrap().install(|| example(&SMALL));
    let many = many.unwrap().install(|| example(&SMALL));
    assert_eq!(one.mesh, many.mesh);
    assert_eq!(one.maps, many.maps);
    assert_eq!(one.guides, many.guides);
}
