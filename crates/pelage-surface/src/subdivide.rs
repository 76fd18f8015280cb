//! Triangles cut until a density map is constant on each piece.
//!
//! Source: document 004, section 2.1.4. A triangle is cut into four by its edge
//! midpoints, again and again, until a piece covers at most one texel; four pieces of
//! equal density are merged again. A piece is named by its place in that tree (0 the
//! whole triangle, 4i + 1 … 4i + 4 its parts), and its corners come from a table.

use crate::{ImageMap, Mesh, Wrap};
use pelage_curves::{Vec2, Vec3};
use rayon::prelude::*;

/// Hair density over a surface: a number, or a number times a channel of a map.
#[derive(Clone, Copy, Debug)]
pub struct Density<'a> {
    /// The factor, at least 0.
    pub value: f32,
    /// Map, channel and wrap.
    pub map: Option<(&'a ImageMap, u32, Wrap)>,
}

/// Depth at which cutting stops whatever the map: 4^10 pieces a triangle, a texel of
/// a 1024² map that one triangle fills.
pub(crate) const MAX_DEPTH: u32 = 10;

/// A part of a triangle in barycentric coordinates: the triangle
/// `origin, origin + (size, 0), origin + (0, size)`; `size` is negative for the middle
/// parts, which point the other way. All numbers are dyadic, so exact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Part {
    pub origin: [f32; 2],
    pub size: f32,
}

impl Part {
    pub(crate) const WHOLE: Part = Part {
        origin: [0.0, 0.0],
        size: 1.0,
    };

    /// The four parts, in an order in which each touches the one before.
    pub(crate) fn children(self) -> [Part; 4] {
        let [u, v] = self.origin;
        let half = self.size / 2.0;
        [
            Part {
                origin: [u, v],
                size: half,
            },
            Part {
                origin: [u + half, v + half],
                size: -half,
            },
            Part {
                origin: [u + half, v],
                size: half,
            },
            Part {
                origin: [u, v + half],
                size: half,
            },
        ]
    }

    /// The part of this part that `inner` is of the whole.
    #[inline]
    pub(crate) fn part(self, inner: Part) -> Part {
        let along = |k: usize| self.origin[k] + self.size * inner.origin[k];
        Part {
            origin: [along(0), along(1)],
            size: self.size * inner.size,
        }
    }

    /// Weights of the whole triangle's corners at `(p, q)` of this part.
    #[inline]
    pub(crate) fn barycentric(self, p: f32, q: f32) -> [f32; 3] {
        let (u, v) = (
            self.origin[0] + self.size * p,
            self.origin[1] + self.size * q,
        );
        [(1.0 - u - v).max(0.0), u, v]
    }

    pub(crate) fn centre(self) -> [f32; 3] {
        self.barycentric(1.0 / 3.0, 1.0 / 3.0)
    }
}

/// Number of parts down to `depth`.
pub(crate) fn parts_down_to(depth: u32) -> usize {
    ((1usize << (2 * (depth + 1))) - 1) / 3
}

/// All parts down to `depth`, at the index that names them.
pub(crate) fn parts(depth: u32) -> Vec<Part> {
    let count = parts_down_to(depth);
    let mut parts = Vec::with_capacity(count);
    parts.push(Part::WHOLE);
    let mut parent = 0;
    while parts.len() < count {
        let children = parts[parent].children();
        parts.extend(children);
        parent += 1;
    }
    parts
}

/// A part of a triangle with constant density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Piece {
    pub triangle: u32,
    pub part: u32,
    pub weight: f64,
}

/// The pieces of all triangles in the order given, without those of density zero.
pub(crate) fn pieces(mesh: &Mesh, order: &[u32], density: &Density) -> Vec<Piece> {
    order
        .par_chunks(1024)
        .map(|triangles| {
            let mut pieces = Vec::new();
            for &triangle in triangles {
                Cutter::new(mesh, triangle, density).cut(&mut pieces);
            }
            pieces
        })
        .collect::<Vec<_>>()
        .concat()
}

struct Cutter<'a> {
    triangle: u32,
    area: f64,
    uv: [Vec2; 3],
    depth: u32,
    density: &'a Density<'a>,
}

impl<'a> Cutter<'a> {
    fn new(mesh: &Mesh, triangle: u32, density: &'a Density<'a>) -> Self {
        let area = mesh.area(triangle as usize);
        let uv = mesh
            .uvs()
            .get(triangle as usize)
            .copied()
            .unwrap_or([Vec2::ZERO; 3]);
        let depth = density.map.map_or(0, |(map, ..)| depth_for(uv, map));
        Self {
            triangle,
            area,
            uv,
            depth,
            density,
        }
    }

    fn cut(&self, pieces: &mut Vec<Piece>) {
        if self.area > 0.0 && self.area.is_finite() {
            self.cut_part(0, Part::WHOLE, 0, pieces);
        }
    }

    /// Appends the pieces of a part; returns its density where it is constant.
    fn cut_part(&self, index: u32, part: Part, depth: u32, pieces: &mut Vec<Piece>) -> Option<f32> {
        let share = self.area / (1u64 << (2 * depth)) as f64;
        let start = pieces.len();
        let constant = if depth == self.depth {
            Some(self.density_at(part.centre()))
        } else {
            let mut densities = [None; 4];
            for (j, child) in part.children().into_iter().enumerate() {
                densities[j] = self.cut_part(4 * index + 1 + j as u32, child, depth + 1, pieces);
            }
            densities[0].filter(|_| densities.iter().all(|d| *d == densities[0]))
        };
        if let Some(density) = constant {
            pieces.truncate(start);
            let weight = share * density as f64;
            if weight > 0.0 {
                pieces.push(Piece {
                    triangle: self.triangle,
                    part: index,
                    weight,
                });
            }
        }
        constant
    }

    fn density_at(&self, [a, b, c]: [f32; 3]) -> f32 {
        let uv = self.uv[0] * a + self.uv[1] * b + self.uv[2] * c;
        let map = self.density.map;
        self.density.value * map.map_or(1.0, |(map, k, wrap)| map.sample(uv.x, uv.y, k, wrap))
    }
}

/// Longest side a part may have, in texels, where its area alone would do: slivers of
/// texture are resolved along their length too.
const LONGEST: f32 = 4.0;

/// Least depth at which a part covers at most one texel (document 004, eq. 2.3).
fn depth_for(uv: [Vec2; 3], map: &ImageMap) -> u32 {
    let texel = |p: Vec2| p * Vec2::new(map.width() as f32, map.height() as f32);
    let [a, b, c] = uv.map(texel);
    let area = (b - a).perp_dot(c - a).abs() / 2.0;
    let longest = (b - a).length().max((c - b).length()).max((a - c).length());
    (0..MAX_DEPTH)
        .find(|&d| {
            let side = (1u32 << d) as f32;
            area <= side * side && longest <= LONGEST * side
        })
        .unwrap_or(MAX_DEPTH)
}

/// Centre of a part of a triangle in space.
pub(crate) fn centre(mesh: &Mesh, triangle: u32, part: Part) -> Vec3 {
    let [a, b, c] = mesh.corners(triangle as usize);
    let w = part.centre();
    a * w[0] + b * w[1] + c * w[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_fill_the_triangle() {
        let parts = parts(3);
        for depth in 0..=3u32 {
            let first = ((1usize << (2 * depth)) - 1) / 3;
            let area: f32 = parts[first..first + (1 << (2 * depth))]
                .iter()
                .map(|p| p.size * p.size)
                .sum();
            assert_eq!(area, 1.0, "depth {depth}");
        }
    }

    #[test]
    fn a_child_is_named_four_times_its_parent_and_its_number() {
        let parts = parts(3);
        for parent in 0..5 {
            for (j, child) in parts[parent].children().into_iter().enumerate() {
                assert_eq!(parts[4 * parent + 1 + j], child);
            }
        }
    }
}
