//! Key, fill, rim and sky.

use crate::RenderError;
use crate::color::Rgb;
use glam::Vec3;

/// A far light, placed relative to the camera so that any view is well lit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Degrees around the up axis: 0 shines from the camera, 90 from the right of
    /// the picture, 180 from behind.
    pub azimuth: f32,
    /// Degrees over the horizon, −90..=90.
    pub elevation: f32,
    /// Linear RGB irradiance on a face turned to the light.
    pub color: [f32; 3],
    /// Half the angle the light covers, in degrees, 0..=60; softens its shadow.
    pub softness: f32,
}

/// Light from all around, by height: overhead, horizon and floor. Linear RGB
/// radiance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sky {
    /// From overhead.
    pub zenith: [f32; 3],
    /// From the sides.
    pub horizon: [f32; 3],
    /// From below, bounced by the floor.
    pub ground: [f32; 3],
}

/// All the light there is.
#[derive(Clone, Debug, PartialEq)]
pub struct LightRig {
    /// Far lights; the first casts the crispest shadows.
    pub lights: Vec<Light>,
    /// Light from all around.
    pub sky: Sky,
}

impl Default for LightRig {
    /// A warm key from the upper left, a cool fill from the right, a strong rim
    /// from behind and a dim, slightly blue sky.
    fn default() -> Self {
        Self {
            lights: vec![
                Light {
                    azimuth: -48.0,
                    elevation: 46.0,
                    color: [4.4, 4.15, 3.75],
                    softness: 5.0,
                },
                Light {
                    azimuth: 60.0,
                    elevation: 18.0,
                    color: [0.55, 0.62, 0.75],
                    softness: 20.0,
                },
                Light {
                    azimuth: 152.0,
                    elevation: 38.0,
                    color: [5.4, 5.2, 4.9],
                    softness: 8.0,
                },
            ],
            sky: Sky {
                zenith: [0.56, 0.60, 0.66],
                horizon: [0.36, 0.365, 0.375],
                ground: [0.22, 0.205, 0.19],
            },
        }
    }
}

impl LightRig {
    /// Refuses numbers that give no light.
    pub(crate) fn check(&self) -> Result<(), RenderError> {
        let bad = |c: [f32; 3]| c.iter().any(|x| !(x.is_finite() && *x >= 0.0));
        for light in &self.lights {
            let angles = [light.azimuth, light.elevation];
            if bad(light.color) || angles.iter().any(|x| !x.is_finite()) {
                let found = format!("{light:?}");
                let allowed = "finite angles and a colour of finite numbers of at least 0";
                return Err(RenderError::setting("light", found, allowed));
            }
            if !(0.0..=60.0).contains(&light.softness) {
                let found = light.softness;
                return Err(RenderError::setting("light.softness", found, "in 0..=60"));
            }
        }
        let sky = [self.sky.zenith, self.sky.horizon, self.sky.ground];
        if sky.into_iter().any(bad) {
            let found = format!("{:?}", self.sky);
            return Err(RenderError::setting("sky", found, "finite and at least 0"));
        }
        Ok(())
    }
}

/// A light in the space of the scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beam {
    /// Unit vector towards the light.
    pub to_light: Vec3,
    /// Irradiance on a face turned to it.
    pub irradiance: Rgb,
    /// Cosine of half the angle it covers.
    pub cos_angle: f32,
}

/// The rig in the space of the scene.
#[derive(Clone, Debug)]
pub(crate) struct Lighting {
    pub beams: Vec<Beam>,
    pub up: Vec3,
    zenith: Rgb,
    horizon: Rgb,
    ground: Rgb,
}

impl Lighting {
    /// Places `rig` around a scene seen along `forward` with `up` upwards (units).
    pub fn new(rig: &LightRig, forward: Vec3, up: Vec3) -> Self {
        // A camera that looks straight down still needs a left and a right.
        let level = forward - up * forward.dot(up);
        let back = -level
            .try_normalize()
            .unwrap_or(crate::sampling::frame(up).0);
        let right = up.cross(back);
        let beams = rig.lights.iter().map(|light| {
            let (sin_a, cos_a) = libm::sincosf(light.azimuth.to_radians());
            let (sin_e, cos_e) = libm::sincosf(light.elevation.to_radians());
            Beam {
                to_light: ((back * cos_a + right * sin_a) * cos_e + up * sin_e).normalize(),
                irradiance: light.color.into(),
                cos_angle: libm::cosf(light.softness.to_radians()),
            }
        });
        Self {
            beams: beams.collect(),
            up,
            zenith: rig.sky.zenith.into(),
            horizon: rig.sky.horizon.into(),
            ground: rig.sky.ground.into(),
        }
    }

    /// Radiance of the sky from the unit direction `d`.
    pub fn sky(&self, d: Vec3) -> Rgb {
        let height = d.dot(self.up);
        let end = if height > 0.0 {
            self.zenith
        } else {
            self.ground
        };
        self.horizon.lerp(end, height.abs().min(1.0))
    }
}
