//! The fit of one strand.

use anyhow::{Context, Result};
use pelage::curves::frenet::CatmullRom;
use pelage::curves::super_helix::{Fit, Goal, Settings, fit};
use pelage::curves::{DVec3, Vec3};
use pelage::io::SuperHelices;

/// A strand's Super-Helix, or that it is a point.
pub enum Fitted {
    Curve(Box<Fit>),
    /// It has no length, or less than two vertices.
    Point,
}

impl Fitted {
    /// Fits strand number `index` through `points`.
    pub fn new(points: &[Vec3], goal: Goal, index: usize) -> Result<Self> {
        if points.is_empty() {
            return Ok(Self::Point);
        }
        let points: Vec<DVec3> = points.iter().map(|p| p.as_dvec3()).collect();
        let found = CatmullRom::new(&points)
            .map_err(Into::into)
            .and_then(|target| fit(&target, &Settings::new(goal)));
        let found = found.with_context(|| format!("strand {index} cannot be fitted"))?;
        Ok(match found.curve.length() > 0.0 {
            true => Self::Curve(Box::new(found)),
            false => Self::Point,
        })
    }

    /// Adds it, fitted to `points`, to `helices`.
    pub fn push(&self, helices: &mut SuperHelices, points: &[Vec3], index: usize) -> Result<()> {
        let vertices = points.len() as u32;
        match self {
            Self::Curve(fit) => helices
                .push(&fit.curve, vertices, fit.worst)
                .with_context(|| format!("strand {index} is too small or large for 32 bits")),
            Self::Point => {
                let root = points.first().copied().unwrap_or_default();
                helices.push_point(root.to_array(), vertices);
                Ok(())
            }
        }
    }
}
