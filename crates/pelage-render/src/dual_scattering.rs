//! Light that has met other fibres first.
//!
//! After Zinke et al., "Dual Scattering Approximation for Fast Multiple
//! Scattering in Hair" (SIGGRAPH 2008). A fibre behind `n` others (a mean, so the
//! number is Poisson) sees the light itself with probability e⁻ⁿ; else it sees it
//! through k fibres, each passing on the forward share `f` of its colour: together
//! e⁻ⁿ⁽¹⁻ᶠ⁾ − e⁻ⁿ, more spread the more fibres. And what goes on past the fibre
//! partly comes back from its neighbours (their equations 13 to 16).

use crate::azimuth::sloped;
use crate::color::{Rgb, exp};
use crate::longitudinal::longitudinal;
use crate::marschner::{Geometry, Marschner, Shares};

/// Share of neighbours in the way of forward scattering; their d_f.
const DENSE_FORWARD: f32 = 0.85;
/// Share of neighbours that send light back; their d_b.
const DENSE_BACK: f32 = 0.75;
/// Variance of the inclination that one more fibre adds.
const SPREAD: f32 = 0.02;
/// Variance of light sent back by neighbours.
const BACK_SPREAD: f32 = 0.35;

/// How much of a light of unit power is left behind `n` fibres of `shares`, with
/// what they pass on.
pub(crate) fn passed(shares: &Shares, n: f32) -> Rgb {
    exp((shares.forward * DENSE_FORWARD - Rgb::ONE) * n)
}

/// Light that neighbours send back, as a share of what reaches the fibre.
fn sent_back(shares: &Shares) -> Rgb {
    let (f, b) = (shares.forward.min(Rgb::splat(0.92)), shares.backward);
    let (f2, left) = (f * f, Rgb::ONE - f * f);
    // One turn back, and three.
    b * f2 / left + b * b * b * f2 / (left * left * left)
}

/// Radiance sent to the eye for unit irradiance from one direction, from a fibre
/// behind `n` others of its kind.
pub(crate) fn scatter(model: &Marschner, g: &Geometry, shares: &Shares, n: f32) -> Rgb {
    let straight = libm::expf(-n);
    let through = (passed(shares, n) - Rgb::splat(straight)).max(Rgb::ZERO);
    let spread = (SPREAD * n).min(0.4);
    let m = longitudinal(g.i, g.o, BACK_SPREAD + spread);
    let back = sent_back(shares) * (DENSE_BACK * m * sloped(g.cos_phi, 0.7));
    let direct = model.direct(g, shares);
    let wide = model.spread(g, shares, spread);
    (direct + back) * straight + (wide + back) * through
}

/// Radiance sent to the eye under even light from all around, of unit radiance
/// outside and behind `n` fibres.
///
/// Half or more of what a fibre in a coat sees is other fibres of its kind, so it
/// looks less like a lone one (whose share is `total`) than like the coat itself,
/// of `color`.
pub(crate) fn ambient(shares: &Shares, color: Rgb, n: f32) -> Rgb {
    const LONE: f32 = 0.25;
    color.lerp(shares.total, LONE) * passed(shares, n)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Fiber;
    use glam::Vec3;

    #[test]
    fn more_hair_before_the_light_never_makes_it_brighter() {
        let model = Marschner::new(&Fiber::default());
        let light = Vec3::new(0.5, 0.4, 0.3).normalize();
        for color in [Rgb::splat(0.1), Rgb::new(0.9, 0.6, 0.3), Rgb::ONE] {
            let shares = model.shares(color);
            let g = Geometry::new(Vec3::Z, light, Vec3::X);
            let mut before = f32::INFINITY;
            for k in 0..40 {
                let shown = scatter(&model, &g, &shares, k as f32 * 0.25).x;
                assert!(
                    shown >= 0.0 && shown < before,
                    "{color} behind {k}: {shown}"
                );
                before = shown;
            }
        }
    }

    #[test]
    fn light_hair_lets_more_light_in_than_dark_hair() {
        let model = Marschner::new(&Fiber::default());
        let light = passed(&model.shares(Rgb::splat(0.9)), 3.0).x;
        let dark = passed(&model.shares(Rgb::splat(0.05)), 3.0).x;
        assert!(light > 3.0 * dark, "{light} against {dark}");
    }
}
