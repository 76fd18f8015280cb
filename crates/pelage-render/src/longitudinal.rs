//! How light spreads along a fibre.
//!
//! Source: d'Eon et al., "An Energy-Conserving Hair Reflectance Model" (EGSR 2011),
//! equation 7; the numerically safe form for small variances is Jakob's, as in
//! pbrt-v4 `hair.cpp`.

/// Sines and cosines of the inclinations of a ray to the fibre's normal plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Inclination {
    pub sine: f32,
    pub cosine: f32,
}

impl Inclination {
    /// Of a unit direction whose cosine to the tangent is `sine`.
    pub fn new(sine: f32) -> Self {
        let sine = sine.clamp(-1.0, 1.0);
        Self {
            sine,
            cosine: (1.0 - sine * sine).max(0.0).sqrt(),
        }
    }

    /// Turned by the angle whose sine and cosine are `tilt`.
    pub fn turned(self, tilt: Self) -> Self {
        Self {
            sine: self.sine * tilt.cosine + self.cosine * tilt.sine,
            cosine: (self.cosine * tilt.cosine - self.sine * tilt.sine).abs(),
        }
    }
}

/// Scattering from `i` to `o`, both pointing away from the fibre, with `variance`
/// of the inclination. Times the cosine of `i`, it integrates to 1 over it.
pub(crate) fn longitudinal(i: Inclination, o: Inclination, variance: f32) -> f32 {
    let a = i.cosine * o.cosine / variance;
    let b = i.sine * o.sine / variance;
    let inverse = 1.0 / variance;
    // 2 sinh(1/v) = e^(1/v) (1 - e^(-2/v)), whose last term vanishes for small v.
    let tail = if variance < 0.12 {
        1.0
    } else {
        1.0 - libm::expf(-2.0 * inverse)
    };
    scaled_bessel(a) * libm::expf(a - b - inverse) * inverse / tail
}

/// Modified Bessel function of the first kind of order 0 at `x`, times e⁻ˣ.
///
/// Abramowitz and Stegun, "Handbook of Mathematical Functions", 9.8.1 and 9.8.2;
/// within 2e-7.
pub(crate) fn scaled_bessel(x: f32) -> f32 {
    if x < 3.75 {
        let t = x / 3.75;
        let terms = [
            1.0,
            3.515_623,
            3.089_942_4,
            1.206_749_2,
            0.265_973_2,
            0.036_076_8,
            0.004_581_3,
        ];
        polynomial(&terms, t * t) * libm::expf(-x)
    } else {
        let terms = [
            0.398_942_3,
            0.013_285_92,
            0.002_253_19,
            -0.001_575_65,
            0.009_162_81,
            -0.020_577_06,
            0.026_355_37,
            -0.016_476_33,
            0.003_923_77,
        ];
        polynomial(&terms, 3.75 / x) / x.sqrt()
    }
}

fn polynomial(terms: &[f32], x: f32) -> f32 {
    terms.iter().rev().fold(0.0, |sum, term| sum * x + term)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn longitudinal_scattering_integrates_to_one() {
        for variance in [0.002f32, 0.02, 0.09, 0.11, 0.4, 2.0] {
            for out in [-1.2f32, -0.4, 0.0, 0.7, 1.3] {
                let o = Inclination::new(libm::sinf(out));
                let steps = 4000;
                let sum: f32 = (0..steps)
                    .map(|k| {
                        let sine = (k as f32 + 0.5) / steps as f32 * 2.0 - 1.0;
                        longitudinal(Inclination::new(sine), o, variance)
                    })
                    .sum();
                // The sine's own differential brings the cosine.
                let integral = sum * 2.0 / steps as f32;
                assert!(
                    (integral - 1.0).abs() < 0.01,
                    "{variance} {out}: {integral}"
                );
            }
        }
    }

    #[test]
    fn the_bessel_function_has_the_values_of_its_series() {
        for k in 0..100 {
            let x = k as f64 * 0.3;
            let (mut term, mut sum) = (1.0, 1.0);
            for n in 1..200 {
                term *= x * x / 4.0 / (n * n) as f64;
                sum += term;
            }
            let expected = sum * libm::exp(-x);
            let found = f64::from(scaled_bessel(x as f32));
            assert!(
                (found / expected - 1.0).abs() < 2e-6,
                "{x}: {found} for {expected}"
            );
        }
    }
}
