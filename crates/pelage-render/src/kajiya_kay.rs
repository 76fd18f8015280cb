//! The model of Kajiya and Kay, "Rendering Fur with Three Dimensional Textures"
//! (SIGGRAPH 1989), equations 14 and 15: a diffuse term that goes with the sine
//! between tangent and light, and a highlight cone around the mirrored light.

use crate::color::Rgb;
use crate::marschner::Geometry;
use std::f32::consts::PI;

/// Radiance sent to the eye for unit irradiance, from a fibre of `color` behind
/// `n` others; `exponent` narrows the highlight, `gloss` strengthens it.
pub(crate) fn scatter(g: &Geometry, color: Rgb, n: f32, exponent: f32, gloss: f32) -> Rgb {
    // Fibres are lit and seen from one side only as far as they are opaque.
    let facing = 0.5 * (1.0 + g.cos_phi);
    let diffuse = color * (g.i.cosine / PI) * (0.35 + 0.65 * facing);
    let mirror = (g.i.cosine * g.o.cosine - g.i.sine * g.o.sine).max(0.0);
    // The power's mean over the cone, so that narrow highlights are brighter.
    let shine = gloss * 0.01 * (exponent + 2.0) * libm::powf(mirror, exponent) * facing;
    (diffuse + Rgb::splat(shine)) * libm::expf(-0.7 * n)
}

/// The exponent whose highlight is about as wide as that of `roughness`.
pub(crate) fn exponent(roughness: f32) -> f32 {
    (2.2 / (roughness * roughness)).clamp(4.0, 400.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn the_highlight_is_where_the_light_is_mirrored() {
        let light = Vec3::new(0.8, 0.0, 0.6);
        let shown = |eye: Vec3| {
            let g = Geometry::new(Vec3::Z, light, eye.normalize());
            scatter(&g, Rgb::ZERO, 0.0, 60.0, 1.0).x
        };
        let mirrored = shown(Vec3::new(0.8, 0.0, -0.6));
        assert!(mirrored > 2.0 * shown(Vec3::new(0.8, 0.0, -0.2)));
        assert!(mirrored > 2.0 * shown(Vec3::new(0.8, 0.0, -1.4)));
    }
}
