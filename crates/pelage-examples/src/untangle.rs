//! Unfolding the few triangles that flattening leaves upside down.
//!
//! As-rigid-as-possible maps may fold where the surface is strongly curved, always
//! a handful of triangles. The signed areas around a vertex are linear in its
//! position, so their minimum (relative to the areas on the surface) is concave
//! and a pattern search climbs it; vertices of folded triangles do that in turn.

use crate::sheet::Sheet;
use glam::{DVec2, DVec3};

/// Rounds after which a fold is left as it is; tests of each shape tell.
const ROUNDS: usize = 300;

/// Area in the chart over area on the surface below which a triangle counts as
/// folded.
const FOLDED: f64 = 0.02;

/// The ratio a vertex is content with.
const CONTENT: f64 = 0.20;

/// Moves vertices around folded triangles until none is folded.
pub fn untangle(sheet: &Sheet, uv: &mut [DVec2]) {
    let around = Around::new(sheet);
    for _ in 0..ROUNDS {
        let folded: Vec<&[u32; 3]> = (0..sheet.corners.len())
            .filter(|&t| around.ratio(uv, t, None) < FOLDED)
            .map(|t| &sheet.corners[t])
            .collect();
        if folded.is_empty() {
            return;
        }
        for corners in folded {
            for &v in corners {
                uv[v as usize] = around.better(uv, v);
            }
        }
    }
}

/// The triangles around each vertex, and their areas on the surface.
struct Around<'a> {
    sheet: &'a Sheet,
    triangles: Vec<Vec<u32>>,
    areas: Vec<f64>,
}

impl<'a> Around<'a> {
    fn new(sheet: &'a Sheet) -> Self {
        let mut triangles = vec![Vec::new(); sheet.points.len()];
        let mut areas = Vec::with_capacity(sheet.corners.len());
        for (t, corners) in sheet.corners.iter().enumerate() {
            let p: [DVec3; 3] = corners.map(|v| sheet.points[v as usize]);
            areas.push((p[1] - p[0]).cross(p[2] - p[0]).length().max(1e-300));
            for &v in corners {
                triangles[v as usize].push(t as u32);
            }
        }
        Self {
            sheet,
            triangles,
            areas,
        }
    }

    /// Signed area in the chart over area on the surface, one vertex moved.
    fn ratio(&self, uv: &[DVec2], t: usize, moved: Option<(u32, DVec2)>) -> f64 {
        let p = self.sheet.corners[t].map(|v| match moved {
            Some((of, to)) if of == v => to,
            _ => uv[v as usize],
        });
        (p[1] - p[0]).perp_dot(p[2] - p[0]) / self.areas[t]
    }

    /// The least ratio around `v` if it were at `p`.
    fn least(&self, uv: &[DVec2], v: u32, p: DVec2) -> f64 {
        self.triangles[v as usize]
            .iter()
            .map(|&t| self.ratio(uv, t as usize, Some((v, p))))
            .fold(CONTENT, f64::min)
    }

    /// A position of `v` that leaves the triangles around it less folded.
    fn better(&self, uv: &[DVec2], v: u32) -> DVec2 {
        let mut best = uv[v as usize];
        let mut least = self.least(uv, v, best);
        let area: f64 = self.triangles[v as usize]
            .iter()
            .map(|&t| self.areas[t as usize])
            .fold(0.0, f64::max);
        let mut step = area.sqrt();
        for _ in 0..7 {
            let from = best;
            for k in 0..16 {
                let (s, c) = libm::sincos(k as f64 * std::f64::consts::TAU / 16.0);
                let candidate = from + DVec2::new(c, s) * step;
                let value = self.least(uv, v, candidate);
                if value > least {
                    (best, least) = (candidate, value);
                }
            }
            step *= 0.6;
        }
        best
    }
}
