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
    if variance < 0.1 {
        // sinh is as good as half an exponential here.
        inverse * libm::expf(log_bessel(a) - b - inverse)
    } else {
        bessel(a) * libm::expf(-b) * inverse / (2.0 * libm::sinhf(inverse))
    }
}

/// Modified Bessel function of the first kind of order 0, for `x` up to 12.
fn bessel(x: f32) -> f32 {
    let (quarter, mut term, mut sum) = (0.25 * x * x, 1.0, 1.0);
    for k in 1..24 {
        term *= quarter / (k * k) as f32;
        sum += term;
        if term < sum * 1e-7 {
            break;
        }
    }
    sum
}

/// Logarithm of the same, for any `x` of at least 0.
pub(crate) fn log_bessel(x: f32) -> f32 {
    if x > 12.0 {
        let inverse = 1.0 / x;
        x + 0.5 * libm::logf(inverse * std::f32::consts::FRAC_1_PI * 0.5 * (1.0 + 0.25 * inverse))
    } else {
        libm::logf(bessel(x))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn longitudinal_scattering_integrates_to_one() {
        for variance in [0.002f32, 0.02, 0.09, 0.11, 0.4, 2.0] {
            for out in [-1.2f32, -0.4, 0.0, 0.7, 1.3] {
                let o = Inclination::new(out.sin());
                let steps = 4000;
                let sum: f32 = (0..steps)
                    .map(|k| {
                        let sine = (k as f32 + 0.5) / steps as f32 * 2.0 - 1.0;
                        longitudinal(Inclination::new(sine), o, variance)
                    })
                    .sum();
                // The sine's own differential brings the cosine.
                let integral = sum * 2.0 / steps as f32;
                assert!((integral - 1.0).abs() < 0.01, "{variance} {out}: {integral}");
            }
        }
    }

    #[test]
    fn the_two_bessel_forms_meet() {
        assert!((log_bessel(11.999) - log_bessel(12.001)).abs() < 3e-3);
    }
}
