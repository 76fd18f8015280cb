//! Where the picture is taken from.

use crate::{RenderError, Scene, UpAxis};
use glam::DVec3;
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
        let (low, high) = solid(bounds);
        let corner =
            |i: usize| std::array::from_fn(|k| if i >> k & 1 == 0 { low[k] } else { high[k] });
        let corners: [[f32; 3]; 8] = std::array::from_fn(corner);
        Self::fitting(&corners, up, aspect, 38.0, 13.0)
    }

    /// A camera that shows all of `scene`, as near as it can be: unlike
    /// [`Camera::framing`] it looks at every vertex. `azimuth` is in degrees from the
    /// front towards +X, `elevation` in degrees over the horizon, −89..=89.
    pub fn portrait(scene: &Scene, up: UpAxis, aspect: f32, azimuth: f32, elevation: f32) -> Self {
        let finite: Vec<[f32; 3]> = scene.finite_points().collect();
        let bounds = scene.bounds();
        if finite.is_empty() || bounds.min == bounds.max {
            return Self::framing(&bounds, up, aspect);
        }
        Self::fitting(&finite, up, aspect, azimuth, elevation)
    }

    /// The nearest camera in the given direction whose picture holds all `points`.
    fn fitting(points: &[[f32; 3]], up: UpAxis, aspect: f32, azimuth: f32, elevation: f32) -> Self {
        const FOV: f32 = 24.0;
        let (sin_a, cos_a) = libm::sincosf(azimuth.to_radians());
        let (sin_e, cos_e) = libm::sincosf(elevation.clamp(-89.0, 89.0).to_radians());
        let (up, side, front) = match up {
            UpAxis::Y => (DVec3::Y, DVec3::X, DVec3::Z),
            UpAxis::Z => (DVec3::Z, DVec3::X, DVec3::NEG_Y),
        };
        let level = side * f64::from(sin_a) + front * f64::from(cos_a);
        let back = level * f64::from(cos_e) + up * f64::from(sin_e);
        let right = up.cross(back).normalize_or(side);
        let top = back.cross(right);
        let tan_y = f64::from(libm::tanf(FOV.to_radians() * 0.5) * FILL);
        let tan = [tan_y * f64::from(aspect), tan_y];
        // The picture's four edges are planes through the eye: how far out does each
        // have to be for all points to be inside?
        let mut out = [[f64::NEG_INFINITY; 2]; 2];
        let mut nearest = f64::NEG_INFINITY;
        for p in points {
            let p = DVec3::from(p.map(f64::from));
            let depth = p.dot(back);
            nearest = nearest.max(depth);
            for (k, axis) in [right, top].into_iter().enumerate() {
                let across = p.dot(axis);
                out[k][0] = out[k][0].max(depth * tan[k] + across);
                out[k][1] = out[k][1].max(depth * tan[k] - across);
            }
        }
        let distance = |k: usize| (out[k][0] + out[k][1]) / (2.0 * tan[k]);
        let middle = |k: usize| (out[k][0] - out[k][1]) * 0.5;
        let eye_depth = distance(0).max(distance(1));
        let on_axis = right * middle(0) + top * middle(1);
        // What the camera looks at only matters by its direction.
        let to = nearest.min(eye_depth - 1e-3 * eye_depth.abs().max(1.0));
        Self {
            from: (on_axis + back * eye_depth).as_vec3().to_array(),
            to: (on_axis + back * to).as_vec3().to_array(),
            up: up.as_vec3().to_array(),
            fov: FOV,
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

/// The corners of `bounds`, or of a unit cube where they enclose nothing.
fn solid(bounds: &Bounds) -> ([f32; 3], [f32; 3]) {
    let finite = bounds.min.iter().chain(&bounds.max).all(|x| x.is_finite());
    if bounds.is_empty() || !finite {
        return ([-0.5; 3], [0.5; 3]);
    }
    if bounds.min == bounds.max {
        return (bounds.min.map(|x| x - 0.5), bounds.max.map(|x| x + 0.5));
    }
    (bounds.min, bounds.max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stage::View;
    use glam::Vec3;
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
