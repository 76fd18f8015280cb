//! What a picture shows.

use crate::RenderError;
use pelage_strands::{Bounds, StrandBuffer};
use pelage_surface::{ImageMap, Mesh, SurfacePoint};
use std::fmt::Debug;

/// Colours of a surface, place by place: for what no image over its UVs can tell.
pub trait Paint: Debug + Sync {
    /// Linear RGB of the surface at `place`, 0..=1. It should depend on the place alone.
    fn color(&self, place: &SurfacePoint) -> [f32; 3];
}

/// Strands and the surface they grow on, borrowed.
#[derive(Clone, Debug)]
pub struct Scene<'a> {
    /// The strands. Without widths, a strand is 1/2000 of the scene's diagonal
    /// wide; without colours, it has [`crate::Settings::hair_color`]; without
    /// opacities, it is opaque.
    pub strands: Vec<&'a StrandBuffer>,
    /// The surface under the hair.
    pub surface: Option<&'a Mesh>,
    /// Linear RGB of the surface, 0..=1, where there is no `surface_map`.
    pub surface_color: [f32; 3],
    /// Linear RGB over the surface, repeating; needs a surface with UVs.
    pub surface_map: Option<&'a ImageMap>,
    /// What colours the surface instead of `surface_color` and `surface_map`.
    pub surface_paint: Option<&'a dyn Paint>,
}

impl<'a> Scene<'a> {
    /// A scene of `strands` only.
    pub fn of_strands(strands: &'a StrandBuffer) -> Self {
        Self {
            strands: vec![strands],
            surface: None,
            surface_color: [0.22, 0.15, 0.12],
            surface_map: None,
            surface_paint: None,
        }
    }

    /// The same scene with a surface under the hair.
    pub fn on(mut self, surface: &'a Mesh) -> Self {
        self.surface = Some(surface);
        self
    }

    /// The same scene with colours over the surface.
    pub fn painted(mut self, map: &'a ImageMap) -> Self {
        self.surface_map = Some(map);
        self
    }

    /// The same scene with its surface coloured by `paint`.
    pub fn covered(mut self, paint: &'a dyn Paint) -> Self {
        self.surface_paint = Some(paint);
        self
    }

    /// Box of everything finite in the scene, vertices only: curves may bulge out
    /// of it by a little.
    pub fn bounds(&self) -> Bounds {
        let mut bounds = Bounds::default();
        self.finite_points().for_each(|p| bounds.add(p, 0.0));
        bounds
    }

    /// All finite vertices.
    pub(crate) fn finite_points(&self) -> impl Iterator<Item = [f32; 3]> {
        let strands = self.strands.iter().flat_map(|s| s.points.iter());
        let surface = self.surface.iter().flat_map(|m| m.positions().iter());
        let all = strands.copied().chain(surface.map(|p| p.to_array()));
        all.filter(|p| p.iter().all(|x| x.is_finite()))
    }

    /// Refuses arrays that do not fit together. Values may be anything.
    pub(crate) fn check(&self) -> Result<(), RenderError> {
        for strands in &self.strands {
            check_strands(strands)?;
        }
        let color = self.surface_color;
        if color.iter().any(|c| !(0.0..=1.0).contains(c)) {
            let found = format!("{color:?}");
            return Err(RenderError::setting("surface_color", found, "in 0..=1"));
        }
        Ok(())
    }
}

fn check_strands(strands: &StrandBuffer) -> Result<(), RenderError> {
    let vertices = strands.points.len();
    let offsets = &strands.offsets;
    let falls = offsets.windows(2).position(|w| w[0] > w[1]);
    let outside = offsets.iter().position(|&o| o as usize > vertices);
    let empty = if offsets.is_empty() { Some(0) } else { None };
    if let Some(entry) = falls.or(outside).or(empty) {
        return Err(RenderError::OutOfRange {
            array: "offsets",
            entry,
        });
    }
    let arrays = [
        ("widths", strands.widths.len()),
        ("colors", strands.colors.len()),
        ("opacities", strands.opacities.len()),
    ];
    for (array, found) in arrays {
        if found != 0 && found != vertices {
            return Err(RenderError::WrongCount {
                array,
                found,
                expected: vertices,
            });
        }
    }
    Ok(())
}
