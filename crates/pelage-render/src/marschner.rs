//! Light scattered by one fibre: the lobes R, TT and TRT.
//!
//! Marschner et al., "Light Scattering from Human Hair Fibers" (SIGGRAPH 2003),
//! with the energy-conserving longitudinal term of d'Eon et al. (2011), the
//! far-field azimuthal shapes of [`crate::azimuth`], roughness and absorption from
//! colour after Chiang et al., "A Practical and Controllable Hair and Fur Model
//! for Production Path Tracing" (EGSR 2016), and a last lobe for all light that
//! bounces inside more than once.

use crate::Fiber;
use crate::azimuth::{VonMises, reflected, sloped};
use crate::color::Rgb;
use crate::longitudinal::{Inclination, longitudinal};
use glam::Vec3;

/// Index of refraction of keratin.
const REFRACTION: f32 = 1.55;
/// Length of a path through a section of unit radius. The mean is 1.8; more is
/// taken since dual scattering counts too few of the bounces that saturate a coat.
const PATH: f32 = 3.0;
/// Entries of the tables.
const ENTRIES: usize = 64;

/// Where light comes from and goes to, in the frame of the fibre.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Geometry {
    pub i: Inclination,
    pub o: Inclination,
    pub cos_phi: f32,
    /// Cosine of half the difference of the inclinations.
    pub cos_half: f32,
}

impl Geometry {
    /// Of unit vectors, all but `tangent` pointing away from the fibre.
    pub fn new(tangent: Vec3, to_light: Vec3, to_eye: Vec3) -> Self {
        let i = Inclination::new(to_light.dot(tangent));
        let o = Inclination::new(to_eye.dot(tangent));
        let across = (to_light - tangent * i.sine).dot(to_eye - tangent * o.sine);
        let scale = i.cosine * o.cosine;
        let between = scale + i.sine * o.sine;
        Self {
            i,
            o,
            cos_phi: if scale > 1e-6 {
                (across / scale).clamp(-1.0, 1.0)
            } else {
                0.0
            },
            cos_half: (0.5 * (1.0 + between)).clamp(0.0, 1.0).sqrt(),
        }
    }
}

/// Shares of the light that a fibre of some colour sends each way.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Shares {
    /// Through the fibre.
    pub tt: Rgb,
    /// Reflected once inside.
    pub trt: Rgb,
    /// All the rest.
    pub rest: Rgb,
    /// All together, with the surface reflection.
    pub total: Rgb,
    /// Onwards, away from the light.
    pub forward: Rgb,
    /// Back to the side of the light.
    pub backward: Rgb,
}

/// The lobes for one kind of fibre.
#[derive(Clone, Debug)]
pub(crate) struct Marschner {
    /// Variance of the inclination of R, TT, TRT.
    pub variance: [f32; 3],
    tilt: [Inclination; 3],
    through: VonMises,
    back: VonMises,
    gloss: f32,
    /// Mean Fresnel reflectance over the section, by cosine of the inclination.
    fresnel: Vec<f32>,
    /// Per colour in 0..=1: shares of TT, TRT, the rest.
    shares: Vec<[f32; 3]>,
    mean_fresnel: f32,
}

impl Marschner {
    /// The lobes of `fiber`.
    pub fn new(fiber: &Fiber) -> Self {
        let beta = fiber.roughness;
        let longest = power(beta, 20);
        let root = 0.726 * beta + 0.812 * beta * beta + 3.7 * longest;
        let variance = root * root;
        let tilt = fiber.scale_tilt.to_radians();
        // R leans to the root by 2α; TT and TRT to the tip by α and 4α.
        let tilts = [-2.0 * tilt, tilt, 4.0 * tilt];
        // Karis' concentrations at the default roughness, narrower below it.
        let sharper = 0.35 / fiber.azimuthal_roughness;
        let sharper = sharper * sharper;
        let fresnel: Vec<f32> = (0..ENTRIES)
            .map(|k| fresnel_over_section(entry(k)))
            .collect();
        let mean_fresnel = fresnel[(ENTRIES - 1) * 9 / 10];
        let around = fiber.azimuthal_roughness;
        let shares = |k| inner_shares(entry(k), around, mean_fresnel);
        Self {
            variance: [0.5 * variance, 0.5 * variance, 1.6 * variance],
            tilt: tilts.map(|a| Inclination::new(libm::sinf(a))),
            through: VonMises::new((3.65 * sharper).min(80.0)),
            back: VonMises::new((9.0 * sharper).min(80.0)),
            gloss: fiber.gloss,
            shares: (0..ENTRIES).map(shares).collect(),
            fresnel,
            mean_fresnel,
        }
    }

    /// Where light goes in a fibre of `color`.
    pub fn shares(&self, color: Rgb) -> Shares {
        let inner = color.to_array().map(|c| {
            let x = c.clamp(0.0, 1.0) * (ENTRIES - 1) as f32;
            let k = (x as usize).min(ENTRIES - 2);
            let f = x - k as f32;
            let (low, high) = (self.shares[k], self.shares[k + 1]);
            [0, 1, 2].map(|j: usize| low[j] + (high[j] - low[j]) * f)
        });
        let lobe = |j: usize| Rgb::from(inner.map(|channel| channel[j]));
        let (tt, trt, rest) = (lobe(0), lobe(1), lobe(2));
        // Of reflected light, 1 − sin(45°) goes on forwards.
        let r = Rgb::splat(self.mean_fresnel);
        Shares {
            tt,
            trt,
            rest,
            total: r + tt + trt + rest,
            forward: r * 0.293 + tt + rest * 0.5,
            backward: r * 0.707 + trt + rest * 0.5,
        }
    }

    fn reflectance(&self, cos_half: f32) -> f32 {
        self.fresnel[((cos_half * (ENTRIES - 1) as f32) as usize).min(ENTRIES - 1)]
    }

    /// Radiance sent to the eye for unit irradiance from one direction.
    pub fn direct(&self, g: &Geometry, shares: &Shares) -> Rgb {
        let m = self.along(g, 0.0);
        let surface = self.reflectance(g.cos_half);
        let inner = self.inner_scale(surface);
        let r = Rgb::splat(self.gloss * surface * m[0] * reflected(g.cos_phi));
        let tt = shares.tt * (m[1] * self.through.density(-g.cos_phi));
        let trt = shares.trt * (m[2] * self.back.density(g.cos_phi));
        let rest = shares.rest * (m[2] * sloped(g.cos_phi, 0.0));
        r + (tt + trt + rest) * inner
    }

    /// The same for light that other fibres have spread by `spread` along the fibre
    /// and over the half circle around it: the lobes averaged over it.
    pub fn spread(&self, g: &Geometry, shares: &Shares, spread: f32) -> Rgb {
        let m = self.along(g, spread);
        let surface = self.reflectance(g.cos_half);
        let inner = self.inner_scale(surface);
        let r = Rgb::splat(self.gloss * surface * m[0] * sloped(g.cos_phi, 0.5));
        let tt = shares.tt * (m[1] * sloped(g.cos_phi, -0.6));
        let trt = shares.trt * (m[2] * sloped(g.cos_phi, 0.6));
        let rest = shares.rest * (m[2] * sloped(g.cos_phi, 0.0));
        r + (tt + trt + rest) * inner
    }

    /// What the surface reflects more than on average does not enter.
    fn inner_scale(&self, surface: f32) -> f32 {
        ((1.0 - surface) / (1.0 - self.mean_fresnel)).min(1.05)
    }

    fn along(&self, g: &Geometry, spread: f32) -> [f32; 3] {
        let lobe = |k: usize| {
            let o = g.o.turned(self.tilt[k]);
            longitudinal(g.i, o, self.variance[k] + spread)
        };
        [lobe(0), lobe(1), lobe(2)]
    }
}

fn entry(k: usize) -> f32 {
    k as f32 / (ENTRIES - 1) as f32
}

/// `x` to a whole power, multiplied out so that every machine rounds alike.
fn power(x: f32, n: u32) -> f32 {
    (0..n).fold(1.0, |p, _| p * x)
}

/// Unpolarised Fresnel reflectance from air, mean over the width of the fibre, for
/// light inclined by the angle whose cosine is `cos_inclination`.
fn fresnel_over_section(cos_inclination: f32) -> f32 {
    let steps = 64;
    let sum: f32 = (0..steps)
        .map(|k| {
            let h = (k as f32 + 0.5) / steps as f32;
            fresnel(cos_inclination * (1.0 - h * h).sqrt())
        })
        .sum();
    sum / steps as f32
}

fn fresnel(cos_i: f32) -> f32 {
    let sin2_t = (1.0 - cos_i * cos_i) / (REFRACTION * REFRACTION);
    let cos_t = (1.0 - sin2_t).max(0.0).sqrt();
    let parallel = (REFRACTION * cos_i - cos_t) / (REFRACTION * cos_i + cos_t);
    let crossed = (cos_i - REFRACTION * cos_t) / (cos_i + REFRACTION * cos_t);
    0.5 * (parallel * parallel + crossed * crossed)
}

/// Shares of TT, TRT and the rest in a fibre of `color`, a mass of which would look
/// that colour (Chiang et al. 2016, equation 9).
fn inner_shares(color: f32, roughness: f32, surface: f32) -> [f32; 3] {
    let b = roughness;
    let fit = 5.969 - 0.215 * b + 2.532 * b * b - 10.73 * power(b, 3)
        + 5.574 * power(b, 4)
        + 0.245 * power(b, 5);
    let root = libm::logf(color.clamp(0.002, 0.999)) / fit;
    let passed = libm::expf(-root * root * PATH);
    let (into, kept) = ((1.0 - surface) * (1.0 - surface), surface * passed);
    let tt = into * passed;
    let trt = tt * kept;
    [tt, trt, trt * kept / (1.0 - kept)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{in_cone, point};
    use std::f32::consts::PI;

    fn albedo(fiber: &Fiber, color: Rgb, slant: f32) -> Rgb {
        let model = Marschner::new(fiber);
        let shares = model.shares(color);
        let eye = Vec3::new(libm::cosf(slant), 0.0, libm::sinf(slant));
        let n = 20_000;
        let sum: Rgb = (0..n)
            .map(|i| in_cone(Vec3::Z, -1.0, point(i, 1)))
            .map(|light| model.direct(&Geometry::new(Vec3::Z, light, eye), &shares))
            .sum();
        sum * (4.0 * PI / n as f32)
    }

    #[test]
    fn no_fibre_sends_out_more_light_than_it_gets() {
        for roughness in [0.1, 0.28, 0.6, 1.0] {
            for slant in [0.0, 0.5, 1.1, 1.45] {
                let fiber = Fiber {
                    roughness,
                    ..Fiber::default()
                };
                let white = albedo(&fiber, Rgb::ONE, slant).x;
                assert!(white < 1.03, "{roughness} {slant}: {white}");
                assert!(slant > 1.0 || white > 0.9, "{roughness} {slant}: {white}");
            }
        }
    }

    #[test]
    fn a_darker_colour_sends_out_less_of_its_light() {
        let model = Marschner::new(&Fiber::default());
        let mut before = 0.0;
        for k in 1..20 {
            let s = model.shares(Rgb::splat(k as f32 / 19.0));
            assert!(s.total.x > before && s.total.x <= 1.0);
            assert!((s.forward + s.backward - s.total).length() < 1e-4);
            before = s.total.x;
        }
    }
}
