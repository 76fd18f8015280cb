//! How light spreads around a fibre.
//!
//! Far-field shapes, each of integral 1 over the circle: reflection is the exact
//! cos(φ/2)/4 of a smooth cylinder; the two refracted lobes are von Mises
//! distributions, as Karis fitted them ("Physically Based Hair Shading in Unreal",
//! SIGGRAPH 2016, slides 30 to 37), with the concentration set by roughness.

use crate::longitudinal::scaled_bessel;
use std::f32::consts::TAU;

/// Density of reflected light at the azimuth whose cosine is `cos_phi`.
pub(crate) fn reflected(cos_phi: f32) -> f32 {
    0.25 * (0.5 * (1.0 + cos_phi)).max(0.0).sqrt()
}

/// Density of light spread evenly but for a slope: more on the side the light
/// comes from where `slope` is positive, at most 1 either way.
pub(crate) fn sloped(cos_phi: f32, slope: f32) -> f32 {
    (1.0 + slope * cos_phi) / TAU
}

/// A von Mises distribution around azimuth 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VonMises {
    concentration: f32,
    norm: f32,
}

impl VonMises {
    /// Of a concentration of at least 0.
    pub fn new(concentration: f32) -> Self {
        Self {
            concentration,
            norm: 1.0 / (TAU * scaled_bessel(concentration)),
        }
    }

    /// Density at the azimuth whose cosine is `cos_phi`.
    pub fn density(&self, cos_phi: f32) -> f32 {
        self.norm * libm::expf(self.concentration * (cos_phi - 1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shape_integrates_to_one() {
        let narrow = VonMises::new(17.0);
        let wide = VonMises::new(3.65);
        let shapes: [&dyn Fn(f32) -> f32; 4] = [
            &reflected,
            &|c| sloped(c, -0.8),
            &|c| narrow.density(c),
            &|c| wide.density(-c),
        ];
        for (k, shape) in shapes.iter().enumerate() {
            let n = 2000;
            let sum: f32 = (0..n)
                .map(|i| shape(libm::cosf(i as f32 / n as f32 * TAU)))
                .sum();
            let integral = sum * TAU / n as f32;
            assert!((integral - 1.0).abs() < 2e-3, "shape {k}: {integral}");
        }
    }
}
