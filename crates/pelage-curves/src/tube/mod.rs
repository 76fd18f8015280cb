//! Generalised cylinders: a section swept along a curve.
//!
//! Source: document 003 ("incrementally sliding a disc, or any cross-sectional curve, along
//! the spline"). Positions are computed in f64 and stored in f32. The radius may be 0,
//! where the tube comes to a point. Where it is larger than the curve's radius of curvature
//! the side passes through itself, as it must; the mesh stays closed.

mod ears;
mod error;
mod mesh;
mod rings;
mod section;

use crate::Framing;
use crate::frenet::SpaceCurve;
use glam::DVec3;
use rings::Ring;

pub use error::TubeError;
pub use mesh::TubeMesh;
pub use rings::Rings;
pub use section::Section;

/// How the ends of a tube are closed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Caps {
    /// Not at all.
    Open,
    /// By the section itself, with a sharp rim.
    #[default]
    Flat,
    /// By half a sphere (of the section, shrinking as a circle does) of so many rings.
    Round(usize),
}

/// How a section is swept along a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tube {
    /// Which way the section is turned.
    pub framing: Framing,
    /// Where its x axis should point at the start.
    pub first: DVec3,
    /// Where the rings stand.
    pub rings: Rings,
    /// The ends; none if it closes.
    pub caps: Caps,
    /// Whether the curve ends where it starts, and the tube closes into a ring. Its frames
    /// are closed too, and the radius at 1 is taken to be that at 0.
    pub closed: bool,
}

impl Default for Tube {
    fn default() -> Self {
        Self {
            framing: Framing::default(),
            first: DVec3::X,
            rings: Rings::Bends {
                angle: 0.1,
                most: 10_000,
            },
            caps: Caps::default(),
            closed: false,
        }
    }
}

impl Tube {
    /// Sweeps `section` along `curve`, scaled by `radius` of the fraction 0..=1 of its
    /// length.
    ///
    /// A curve without length gives its two caps, back to back.
    ///
    /// # Errors
    ///
    /// [`TubeError::Curve`], [`TubeError::Radius`], [`TubeError::Angle`],
    /// [`TubeError::NotClosed`], [`TubeError::TooFar`], [`TubeError::TooMany`].
    ///
    /// ```
    /// use pelage_curves::tube::{Section, Tube};
    /// use pelage_curves::{Chain, DVec3};
    /// let path = Chain::catmull_rom(&[DVec3::ZERO, DVec3::Z, DVec3::new(1.0, 0.0, 2.0)], 0.5)?;
    /// let horn = Tube::default().sweep(&path, &Section::circle(12)?, |t| 0.2 * (1.0 - t))?;
    /// assert_eq!(horn.positions.len(), horn.normals.len());
    /// assert!(horn.triangles.iter().flatten().all(|&i| (i as usize) < horn.positions.len()));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn sweep(
        &self,
        curve: &impl SpaceCurve,
        section: &Section,
        radius: impl Fn(f64) -> f64,
    ) -> Result<TubeMesh, TubeError> {
        let caps = if self.closed { Caps::Open } else { self.caps };
        self.check_size(section, caps)?;
        let mut rings = rings::along(curve, self, &radius)?;
        if let Caps::Round(count) = caps {
            round(&mut rings, count.max(1));
        }
        let mut mesh = TubeMesh::side(section, &rings, self.closed)?;
        if let (Caps::Flat, [first, .., last]) = (caps, &rings[..]) {
            mesh.cap(section, first, false);
            mesh.cap(section, last, true);
        }
        Ok(mesh)
    }

    /// Refuses what 32-bit indices could not count, before memory is asked for.
    fn check_size(&self, section: &Section, caps: Caps) -> Result<(), TubeError> {
        let along = match self.rings {
            Rings::Even(parts) => parts,
            Rings::Bends { .. } => 1,
        };
        let over = match caps {
            Caps::Round(count) => count.saturating_mul(2),
            _ => 2,
        };
        mesh::check_size(section, along.saturating_add(over))
    }
}

/// Puts `count` rings before the first and after the last that shrink to a point as a
/// quarter of a circle does.
fn round(rings: &mut Vec<Ring>, count: usize) {
    let quarter = std::f64::consts::FRAC_PI_2;
    let shrunk = |end: &Ring, i: usize, sign: f64| {
        let angle = quarter * i as f64 / count as f64;
        // The last is a point, to the bit.
        let part = if i == count { 0.0 } else { libm::cos(angle) };
        Ring {
            center: end.center + end.frame.tangent * (sign * end.radius * libm::sin(angle)),
            radius: end.radius * part,
            s: end.s + sign * end.radius * angle,
            cap: Some(sign * angle),
            ..*end
        }
    };
    let (first, last) = (rings[0], rings[rings.len() - 1]);
    rings.splice(..0, (1..=count).rev().map(|i| shrunk(&first, i, -1.0)));
    rings.extend((1..=count).map(|i| shrunk(&last, i, 1.0)));
}

#[cfg(test)]
mod bad_tests;
#[cfg(test)]
mod tests;
