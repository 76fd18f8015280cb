//! Roots as dots on the surface.

use super::paints::BARE;
use pelage::render::Paint;
use pelage::strands::SinkError;
use pelage::surface::{Mesh, SurfacePoint};
use pelage::{RootPlan, Sink, StrandBuffer};
use std::collections::HashMap;

/// Most roots that a picture shows; more would be grey, and take memory.
const MOST: usize = 1_000_000;

/// Keeps the first roots, for a picture.
#[derive(Default)]
pub struct FirstRoots {
    roots: Vec<SurfacePoint>,
    /// Roots that came after those kept.
    pub left_out: u64,
}

impl FirstRoots {
    /// The roots kept, by index of their hairs.
    pub fn roots(&self) -> &[SurfacePoint] {
        &self.roots
    }
}

impl Sink for FirstRoots {
    fn write(&mut self, strands: &StrandBuffer) -> Result<(), SinkError> {
        let kept = strands.len().min(MOST - self.roots.len());
        self.left_out += (strands.len() - kept) as u64;
        let places = strands.triangle.iter().zip(&strands.barycentric);
        self.roots.extend(
            places
                .take(kept)
                .map(|(&triangle, &barycentric)| SurfacePoint {
                    triangle,
                    barycentric,
                }),
        );
        Ok(())
    }
}

/// A dot's radius, as a share of the distance between roots where they are densest.
const SIZE: f32 = 0.34;

/// Largest radius, as a share of the diagonal of the surface's box.
const LARGEST: f32 = 0.008;

/// Linear RGB of a dot.
const DOT: [f32; 3] = [0.012, 0.03, 0.09];

/// A surface with a dot at each root.
#[derive(Debug)]
pub struct Dots<'a> {
    surface: &'a Mesh,
    radius: f32,
    /// Roots by the cell of a grid, two radii wide, that they lie in.
    cells: HashMap<[i32; 3], Vec<[f32; 3]>>,
}

impl<'a> Dots<'a> {
    /// Dots at `roots` of `plan` on `surface`, its posed mesh; none overlap where roots
    /// keep their distance.
    pub fn new(plan: &RootPlan, surface: &'a Mesh, roots: &[SurfacePoint]) -> Self {
        let (low, high) = surface.bounds();
        let largest = (LARGEST * low.distance(high)).max(f32::MIN_POSITIVE);
        let densest = roots.iter().map(|r| plan.density(r)).fold(0.0, f32::max);
        let weighted = plan.sampler().map_or(0.0, |s| s.weighted_area()) as f32;
        let area = weighted / densest.max(f32::MIN_POSITIVE) / roots.len().max(1) as f32;
        let mut dots = Self {
            surface,
            radius: (SIZE * area.sqrt()).clamp(largest * 1e-3, largest),
            cells: HashMap::new(),
        };
        for root in roots {
            let p = surface.position(root).to_array();
            dots.cells.entry(dots.cell(p)).or_default().push(p);
        }
        dots
    }

    fn cell(&self, p: [f32; 3]) -> [i32; 3] {
        p.map(|x| (x / (2.0 * self.radius)).floor() as i32)
    }

    fn is_in_dot(&self, p: [f32; 3]) -> bool {
        let near = |q: &[f32; 3]| {
            let apart: f32 = (0..3).map(|k| (p[k] - q[k]) * (p[k] - q[k])).sum();
            apart <= self.radius * self.radius
        };
        let low = self.cell(p.map(|x| x - self.radius));
        let high = self.cell(p.map(|x| x + self.radius));
        (low[0]..=high[0]).any(|x| {
            (low[1]..=high[1]).any(|y| {
                (low[2]..=high[2]).any(|z| {
                    let cell = self.cells.get(&[x, y, z]);
                    cell.is_some_and(|roots| roots.iter().any(near))
                })
            })
        })
    }
}

impl Paint for Dots<'_> {
    fn color(&self, place: &SurfacePoint) -> [f32; 3] {
        match self.is_in_dot(self.surface.position(place).to_array()) {
            true => DOT,
            false => BARE,
        }
    }
}
