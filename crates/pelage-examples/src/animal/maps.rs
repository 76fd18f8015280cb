//! The cub's maps, painted through its atlas.

use super::pattern::Spot;
use super::shape::Part;
use crate::model::Model;
use crate::raster::{Texel, canvas};
use crate::sdf::Solid;
use pelage_surface::ImageMap;

/// All maps with their file names.
pub fn maps(body: &Solid<Part>, model: &Model, texels: usize) -> Vec<(&'static str, ImageMap)> {
    let canvas = canvas(&model.uvs, texels);
    let spot = |texel: &Texel| {
        let (p, normal) = model.place(texel);
        Spot::new(body, p, normal, model.labels[texel.triangle as usize])
    };
    // One pass over the places; the seven numbers and more are split below.
    let look = |texel: &Texel| {
        let s = spot(texel);
        (
            s.density(),
            s.length(),
            s.root_color(),
            s.tip_color(),
            s.skin_color(),
        )
    };
    let looks = canvas.each(look);
    vec![
        ("density.png", canvas.paint([0.0], &looks, |l| [l.0])),
        ("length.png", canvas.paint([0.0], &looks, |l| [l.1])),
        (
            "root_color.png",
            canvas.paint([0.0; 3], &looks, |l| l.2.to_array()),
        ),
        (
            "tip_color.png",
            canvas.paint([0.0; 3], &looks, |l| l.3.to_array()),
        ),
        (
            "skin.png",
            canvas.paint([0.0; 3], &looks, |l| l.4.to_array()),
        ),
    ]
}
