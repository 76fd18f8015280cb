//! Where the picture is taken from.

use crate::{RenderError, UpAxis};
use glam::Vec3;
use pelage_strands::Bounds;

/// A pinhole camera, positions in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where the camera is.
    pub from: [f32; 3],
    /// What the centre of the picture shows.
    pub to: [f32; 3],
    /// Which way is up; also the normal of the floor. Any length but 0.
    pub up: [f32; 3],
    /// Vertical field of view in degrees, 0..180 exclusive.
    pub fov: f32,
}

/// Share of the picture that framed bounds may fill, in either direction.
const FILL: f32 = 0.88;

impl Camera {
    /// A camera that shows all of `bounds` in a picture of `aspect` (width over
    /// height) from the front, turned 38° and raised 13°: a portrait from three
    /// quarters. The front is +Z where Y is up and −Y where Z is up.
    ///
    /// Empty bounds are taken for the unit cube around the origin.
    pub fn framing(bounds: &Bounds, up: UpAxis, aspect: f32) -> Self {
        Self::framing_from(bounds, up, aspect, 38.0, 13.0)
    }

    /// As [`Camera::framing`], with the azimuth (degrees from the front, towards
    /// +X) and the elevation (degrees over the horizon) given.
    pub fn framing_from(
        bounds: &Bounds,
        up: UpAxis,
        aspect: f32,
        azimuth: f32,
        elevation: f32,
    ) -> Self {
        let (sin_a, cos_a) = libm::sincosf(azimuth.to_radians());
        let (sin_e, cos_e) = libm::sincosf(elevation.clamp(-89.0, 89.0).to_radians());
        let (up, side, front) = match up {
            UpAxis::Y => (Vec3::Y, Vec3::X, Vec3::Z),
            UpAxis::Z => (Vec3::Z, Vec3::X, -Vec3::Y),
        };
        let back = (side * sin_a + front * cos_a) * cos_e + up * sin_e;
        let fov = 24.0;
        let (low, high) = corners(bounds);
        let centre = low + (high - low) * 0.5;
        let distance = fitting_distance(high - centre, back, up, fov, aspect);
        Self {
            from: (centre + back * distance).to_array(),
            to: centre.to_array(),
            up: up.to_array(),
            fov,
        }
    }

    /// Refuses a camera that looks nowhere.
    pub(crate) fn check(&self) -> Result<(), RenderError> {
        let finite = |v: [f32; 3]| v.iter().all(|x| x.is_finite());
        if !(finite(self.from) && finite(self.to) && self.from != self.to) {
            let found = format!("{:?} to {:?}", self.from, self.to);
            let allowed = "two different finite points";
            return Err(RenderError::setting("camera", found, allowed));
        }
        if !finite(self.up) || self.up == [0.0; 3] {
            let found = format!("{:?}", self.up);
            return Err(RenderError::setting("camera.up", found, "a direction"));
        }
        if !(self.fov > 0.0 && self.fov < 180.0) {
            return Err(RenderError::setting("camera.fov", self.fov, "in 0..180"));
        }
        Ok(())
    }
}

fn corners(bounds: &Bounds) -> (Vec3, Vec3) {
    let (low, high) = (Vec3::from(bounds.min), Vec3::from(bounds.max));
    if bounds.is_empty() || !(low.is_finite() && high.is_finite()) {
        return (Vec3::splat(-0.5), Vec3::splat(0.5));
    }
    if low == high {
        return (low - Vec3::splat(0.5), high + Vec3::splat(0.5));
    }
    (low, high)
}

/// Smallest distance at which the eight corners `±half` are all in the picture.
fn fitting_distance(half: Vec3, back: Vec3, up: Vec3, fov: f32, aspect: f32) -> f32 {
    let tan_y = libm::tanf(fov.to_radians() * 0.5) * FILL;
    let tan_x = tan_y * aspect;
    let right = up.cross(back).normalize();
    let top = back.cross(right);
    (0..8)
        .map(|corner| {
            let sign = |bit: u32| if corner >> bit & 1 == 0 { 1.0 } else { -1.0 };
            let p = half * Vec3::new(sign(0), sign(1), sign(2));
            let reach = (p.dot(right).abs() / tan_x).max(p.dot(top).abs() / tan_y);
            p.dot(back) + reach
        })
        .fold(0.0, f32::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stage::View;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_camera_frames_whole_bounds(
            min in prop::array::uniform3(-50.0f32..50.0),
            size in prop::array::uniform3(0.01f32..40.0),
            aspect in 0.3f32..3.0,
            z_up in any::<bool>(),
        ) {
            let up = if z_up { UpAxis::Z } else { UpAxis::Y };
            let max = [min[0] + size[0], min[1] + size[1], min[2] + size[2]];
            let camera = Camera::framing(&Bounds { min, max }, up, aspect);
            let view = View::new(&camera, &crate::stage::Frame::identity(), aspect);
            let mut reach = 0.0f32;
            for i in 0..8 {
                let p = Vec3::from(std::array::from_fn(|k| if i >> k & 1 == 0 { min[k] } else { max[k] }));
                let [x, y] = view.project(p).unwrap();
                reach = reach.max(x.abs()).max(y.abs());
            }
            prop_assert!(reach <= FILL + 1e-3, "a corner at {reach}");
            prop_assert!(reach >= FILL - 1e-2, "too far away: {reach}");
        }
    }
}
