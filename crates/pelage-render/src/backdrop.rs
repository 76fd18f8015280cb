//! What is behind the hair.

use crate::RenderError;
use crate::color::Rgb;
use crate::floor::Floor;
use crate::sampling::smoothstep;
use glam::Vec3;

/// What is behind and below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Backdrop {
    /// A studio's cove: a floor under the lowest point that takes shadows and turns
    /// softly into a wall. Linear RGB as shown, before exposure.
    Studio {
        /// The floor where it is fully lit.
        floor: [f32; 3],
        /// The wall high up.
        wall: [f32; 3],
    },
    /// One linear RGB all over.
    Plain([f32; 3]),
}

impl Default for Backdrop {
    fn default() -> Self {
        Self::Studio {
            floor: [0.46, 0.445, 0.425],
            wall: [0.15, 0.165, 0.185],
        }
    }
}

impl Backdrop {
    /// Refuses colours that are not finite.
    pub(crate) fn check(&self) -> Result<(), RenderError> {
        let colors = match *self {
            Backdrop::Studio { floor, wall } => [floor, wall],
            Backdrop::Plain(color) => [color; 2],
        };
        if colors.iter().flatten().all(|c| c.is_finite() && *c >= 0.0) {
            return Ok(());
        }
        let found = format!("{self:?}");
        let allowed = "finite colours of at least 0";
        Err(RenderError::setting("backdrop", found, allowed))
    }

    /// Radiance seen from `eye` along the unit vector `direction`.
    pub(crate) fn radiance(&self, floor: Option<&Floor>, eye: Vec3, direction: Vec3) -> Rgb {
        match *self {
            Backdrop::Plain(color) => color.into(),
            Backdrop::Studio { floor: low, wall } => {
                let (low, wall) = (Rgb::from(low), Rgb::from(wall));
                let Some(floor) = floor else { return wall };
                // The cove: from floor to wall over a band around the horizon.
                let height = direction.dot(floor.up);
                let far = low.lerp(wall, smoothstep(-0.36, 0.3, height));
                match floor.meet(eye, direction) {
                    Some(p) => far * floor.light(p),
                    None => far * floor.edge(),
                }
            }
        }
    }
}
