//! What a picture is made with.

use crate::{Backdrop, LightRig, RenderError};

/// How the fibres' cross-section is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shape {
    /// Flat and turned to the camera: cheap, and right where a hair is about as
    /// thin as a pixel.
    #[default]
    Ribbon,
    /// Round tubes with their true depth, for hairs seen large.
    Round,
}

/// How fibres scatter light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reflection {
    /// Marschner's R, TT and TRT lobes with dual scattering between fibres.
    #[default]
    Marschner,
    /// Kajiya and Kay's diffuse and specular terms: no light passes through a fibre.
    KajiyaKay,
}

/// Optical properties of a fibre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fiber {
    /// Roughness along the fibre, 0.05..=1: width of the highlights.
    pub roughness: f32,
    /// Roughness around the fibre, 0.05..=1.
    pub azimuthal_roughness: f32,
    /// Tilt of the cuticle scales in degrees, −10..=10: moves the white highlight
    /// towards the root and the coloured one towards the tip.
    pub scale_tilt: f32,
    /// Strength of the white surface reflection, 0..=4; 1 is physical.
    pub gloss: f32,
}

impl Default for Fiber {
    fn default() -> Self {
        Self {
            roughness: 0.28,
            azimuthal_roughness: 0.35,
            scale_tilt: 2.5,
            gloss: 1.0,
        }
    }
}

/// Everything about a picture but what it shows and from where.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Width in pixels, 1..=16384.
    pub width: u32,
    /// Height in pixels, 1..=16384.
    pub height: u32,
    /// Rays a pixel, 1..=4096; powers of two spread best.
    pub samples: u32,
    /// Threads; `None` takes what the surrounding pool has. No pixel depends on it.
    pub threads: Option<usize>,
    /// Shape of the fibres.
    pub shape: Shape,
    /// How fibres scatter light.
    pub reflection: Reflection,
    /// Optical properties of the fibres.
    pub fiber: Fiber,
    /// The light.
    pub lights: LightRig,
    /// What is behind and below.
    pub backdrop: Backdrop,
    /// Factor on all light, in stops (powers of two), −20..=20.
    pub exposure: f32,
    /// Whether bright light is rolled off as film does; else it is clipped.
    pub film_tone: bool,
    /// Thinnest hair drawn, in pixels, 0..=4. Thinner ones are drawn this wide and
    /// as much more transparent: the same light with far less noise.
    pub thinnest: f32,
    /// Voxels along the longest side of the density grid, 8..=512. More follow
    /// finer shadows and cost memory by the cube.
    pub grid: u32,
    /// Linear RGB of strands without colours.
    pub hair_color: [f32; 3],
    /// Varies the samples' scramble.
    pub seed: u32,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            width: 1280,
            height: 720,
            samples: 16,
            threads: None,
            shape: Shape::Ribbon,
            reflection: Reflection::Marschner,
            fiber: Fiber::default(),
            lights: LightRig::default(),
            backdrop: Backdrop::default(),
            exposure: 0.0,
            film_tone: true,
            thinnest: 0.7,
            grid: 128,
            hair_color: [0.30, 0.16, 0.07],
            seed: 0,
        }
    }
}

impl Settings {
    /// Width over height.
    pub fn aspect(&self) -> f32 {
        self.width.max(1) as f32 / self.height.max(1) as f32
    }

    /// Refuses what is out of range, naming it.
    pub(crate) fn check(&self) -> Result<(), RenderError> {
        in_range("width", self.width as f32, 1.0, 16384.0, "in 1..=16384")?;
        in_range("height", self.height as f32, 1.0, 16384.0, "in 1..=16384")?;
        in_range("samples", self.samples as f32, 1.0, 4096.0, "in 1..=4096")?;
        in_range("exposure", self.exposure, -20.0, 20.0, "in -20..=20")?;
        in_range("thinnest", self.thinnest, 0.0, 4.0, "in 0..=4")?;
        in_range("grid", self.grid as f32, 8.0, 512.0, "in 8..=512")?;
        let fiber = &self.fiber;
        in_range("roughness", fiber.roughness, 0.05, 1.0, "in 0.05..=1")?;
        let around = fiber.azimuthal_roughness;
        in_range("azimuthal_roughness", around, 0.05, 1.0, "in 0.05..=1")?;
        in_range("scale_tilt", fiber.scale_tilt, -10.0, 10.0, "in -10..=10")?;
        in_range("gloss", fiber.gloss, 0.0, 4.0, "in 0..=4")?;
        for c in self.hair_color {
            in_range("hair_color", c, 0.0, 1.0, "in 0..=1")?;
        }
        if self.threads == Some(0) {
            return Err(RenderError::setting("threads", 0, "at least 1"));
        }
        self.backdrop.check()?;
        self.lights.check()
    }
}

fn in_range(
    name: &'static str,
    found: f32,
    low: f32,
    high: f32,
    allowed: &'static str,
) -> Result<(), RenderError> {
    if found >= low && found <= high {
        Ok(())
    } else {
        Err(RenderError::setting(name, found, allowed))
    }
}
