//! The scene's own unit of length, and the camera in it.
//!
//! Everything is moved and scaled so that the bounds are centred on the origin
//! and one unit long: tolerances are then plain numbers, and huge or tiny
//! coordinates neither overflow nor vanish when squared.

use crate::Camera;
use glam::{DVec3, Vec3};
use pelage_strands::Bounds;

/// From world space to the unit scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    centre: DVec3,
    /// Unit scene lengths in one world length.
    pub scale: f64,
}

impl Frame {
    /// Leaves everything as it is.
    #[cfg(test)]
    pub fn identity() -> Self {
        Self {
            centre: DVec3::ZERO,
            scale: 1.0,
        }
    }

    /// The frame whose unit is the diagonal of `bounds`.
    pub fn of(bounds: &Bounds) -> Self {
        if bounds.is_empty() {
            return Self {
                centre: DVec3::ZERO,
                scale: 1.0,
            };
        }
        let low = DVec3::from(bounds.min.map(f64::from));
        let high = DVec3::from(bounds.max.map(f64::from));
        let diagonal = (high - low).length();
        Self {
            centre: (low + high) * 0.5,
            scale: if diagonal > 0.0 { 1.0 / diagonal } else { 1.0 },
        }
    }

    /// A world position in the unit scene.
    pub fn place(&self, p: [f32; 3]) -> Vec3 {
        ((DVec3::from(p.map(f64::from)) - self.centre) * self.scale).as_vec3()
    }

    /// A world length in the unit scene.
    pub fn length(&self, length: f32) -> f32 {
        (f64::from(length) * self.scale) as f32
    }
}

/// The camera in the unit scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    /// Where rays start.
    pub eye: Vec3,
    /// Unit vector into the picture.
    pub forward: Vec3,
    /// Unit up of the world.
    pub world_up: Vec3,
    /// Half the picture's width at distance 1.
    right: Vec3,
    /// Half the picture's height at distance 1.
    top: Vec3,
}

impl View {
    /// `camera` for a picture of `aspect`, in the space of `frame`.
    pub fn new(camera: &Camera, frame: &Frame, aspect: f32) -> Self {
        let eye = frame.place(camera.from);
        let to = DVec3::from(camera.to.map(f64::from)) - DVec3::from(camera.from.map(f64::from));
        let forward = to.normalize_or(DVec3::NEG_Z).as_vec3();
        let up = DVec3::from(camera.up.map(f64::from));
        let world_up = up.normalize_or(DVec3::Y).as_vec3();
        let right = forward.cross(world_up).try_normalize();
        let right = right.unwrap_or_else(|| crate::sampling::frame(forward).0);
        let top = right.cross(forward);
        let tan = libm::tanf(camera.fov.to_radians() * 0.5);
        Self {
            eye,
            forward,
            world_up,
            right: right * (tan * aspect),
            top: top * tan,
        }
    }

    /// Unit direction through the picture at `x`, `y` in −1..=1, y upwards.
    pub fn direction(&self, x: f32, y: f32) -> Vec3 {
        (self.forward + self.right * x + self.top * y).normalize()
    }

    /// Distance along the view axis; negative behind the camera.
    pub fn depth(&self, p: Vec3) -> f32 {
        (p - self.eye).dot(self.forward)
    }

    /// Height of a pixel at depth 1 in a picture `height` pixels high.
    pub fn pixel(&self, height: u32) -> f32 {
        2.0 * self.top.length() / height as f32
    }

    /// Where `p` is in the picture, −1..=1 in both directions when inside.
    #[cfg(test)]
    pub fn project(&self, p: Vec3) -> Option<[f32; 2]> {
        let depth = self.depth(p);
        let d = (p - self.eye) / depth;
        let along = |axis: Vec3| d.dot(axis) / axis.length_squared();
        (depth > 0.0).then(|| [along(self.right), along(self.top)])
    }
}
