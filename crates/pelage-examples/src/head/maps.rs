//! The head's maps: the hairline, the parting and the skin.

use super::unwrap::label;
use crate::hash::{fractal, mix_between, smoothstep};
use crate::model::Model;
use crate::raster::canvas;
use glam::DVec3;
use pelage_surface::ImageMap;

/// All maps with their file names.
pub fn maps(model: &Model, texels: usize) -> Vec<(&'static str, ImageMap)> {
    let canvas = canvas(&model.uvs, texels);
    let looks = canvas.each(|texel| {
        let (p, _) = model.place(texel);
        (p, model.labels[texel.triangle as usize])
    });
    let groups = |&(p, _): &(DVec3, u8)| {
        if is_left(p) {
            [1.0, 0.0, 0.0]
        } else {
            [0.0, 0.0, 1.0]
        }
    };
    vec![
        (
            "density.png",
            canvas.paint([0.0], &looks, |&(p, l)| [density(p, l)]),
        ),
        ("groups.png", canvas.flood([1.0, 0.0, 0.0], &looks, groups)),
        (
            "skin.png",
            canvas.paint([0.0; 3], &looks, |&(p, l)| skin(p, l).to_array()),
        ),
    ]
}

/// Whether hair at `p` is combed to the left (x > 0): the parting is a little to
/// the right of the middle and fades into it at the crown.
pub fn is_left(p: DVec3) -> bool {
    p.x > -0.018 * smoothstep(-0.06, 0.03, p.z)
}

/// Height of the hairline around the head: heights at angles from the front.
const HAIRLINE: [(f64, f64); 7] = [
    (0.00, 0.307),
    (0.55, 0.304),
    (0.95, 0.282),
    (1.30, 0.222),
    (1.75, 0.198),
    (2.20, 0.160),
    (3.20, 0.148),
];

/// How far above the hairline a place is, metres.
pub fn above_hairline(p: DVec3) -> f64 {
    let angle = libm::atan2(p.x.abs(), p.z + 0.02);
    let mut height = HAIRLINE[HAIRLINE.len() - 1].1;
    for pair in HAIRLINE.windows(2) {
        let [(a, ha), (b, hb)] = [pair[0], pair[1]];
        if angle < b {
            height = mix_between(ha, hb, smoothstep(a, b, angle));
            break;
        }
    }
    p.y - height
}

/// Hairs for each area: soft at the hairline.
pub fn density(p: DVec3, label: u8) -> f64 {
    if label != label::SCALP {
        return 0.0;
    }
    let ragged = 0.004 * fractal(81, p * 120.0);
    smoothstep(-0.004, 0.014, above_hairline(p) + ragged)
}

/// Skin with lips, brows, lashes and a shadow where hair grows; sRGB.
fn skin(p: DVec3, label: u8) -> DVec3 {
    let hex = |r: u32, g: u32, b: u32| DVec3::new(r as f64, g as f64, b as f64) / 255.0;
    let beside = DVec3::new(p.x.abs(), p.y, p.z);
    let base = hex(222, 178, 150).lerp(hex(205, 152, 124), 0.5 + 0.5 * fractal(82, p * 30.0));
    let cheek = 1.0
        - smoothstep(
            0.010,
            0.035,
            beside.distance(DVec3::new(0.043, 0.203, 0.072)),
        );
    let from_lips = (((p.x / 0.0215) * (p.x / 0.0215))
        + ((p.y - 0.1695) / 0.0108) * ((p.y - 0.1695) / 0.0108))
        .sqrt();
    let lips = (1.0 - smoothstep(0.75, 1.05, from_lips)) * smoothstep(0.06, 0.075, p.z);
    let brow_line =
        0.2530 + 0.14 * (beside.x - 0.012) - 8.0 * (beside.x - 0.030) * (beside.x - 0.030);
    let brow = (1.0 - smoothstep(0.0018, 0.0042, (p.y - brow_line).abs()))
        * smoothstep(0.008, 0.014, beside.x)
        * smoothstep(0.054, 0.046, beside.x)
        * smoothstep(0.03, 0.05, p.z);
    let lash_line = 0.2225 + 9.0 * (beside.x - 0.0305) * (beside.x - 0.0305);
    let lash = (1.0 - smoothstep(0.0006, 0.0022, (p.y - lash_line).abs()))
        * smoothstep(0.0165, 0.0145, (beside.x - 0.0305).abs())
        * smoothstep(0.05, 0.07, p.z);
    base.lerp(hex(208, 128, 110), 0.45 * cheek)
        .lerp(hex(176, 84, 80), 0.8 * lips)
        .lerp(hex(78, 50, 36), 0.8 * brow.max(lash))
        .lerp(hex(70, 46, 34), 0.85 * density(p, label))
}
