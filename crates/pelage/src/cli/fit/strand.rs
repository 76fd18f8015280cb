//! The fit of one strand.

use super::Wish;
use anyhow::{Context, Result};
use pelage::curves::frenet::{CatmullRom, SpaceCurve};
use pelage::curves::super_helix::{Fit, FitError, Goal, Settings, fit};
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
    pub fn new(points: &[Vec3], wish: &Wish, index: usize) -> Result<Self> {
        if points.is_empty() {
            return Ok(Self::Point);
        }
        let points: Vec<DVec3> = points.iter().map(|p| p.as_dvec3()).collect();
        let found = CatmullRom::new(&points)
            .map_err(Into::into)
            .and_then(|target| within(&target, wish));
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

/// How often a strand is fitted for a bound that rounding takes it beyond.
const TRIES: u32 = 4;

/// What is wished, as it is kept: a strand that winds much is moved by rounding more than is
/// left to that at first, and is fitted closer.
fn within(target: &impl SpaceCurve, wish: &Wish) -> Result<Fit, FitError> {
    let mut found = fit(target, &Settings::new(wish.goal))?;
    let Some(bound) = wish.bound else {
        return Ok(found);
    };
    for _ in 1..TRIES {
        let length = found.curve.length();
        // What 32 bits do not hold is told where it is to be written.
        let Ok(told) = SuperHelices::told_error(&found.curve, found.worst).map(f64::from) else {
            break;
        };
        // Another fit is rounded a little otherwise.
        let left = bound.length(length) - 1.1 * (told - found.worst);
        if !found.kept || bound.keeps(told, length) || left <= 0.0 {
            break;
        }
        found = fit(target, &Settings::new(Goal::Error(left)))?;
    }
    Ok(found)
}
