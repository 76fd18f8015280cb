//! Triangles cut until a density map is constant on each piece.
//!
//! Source: document 004, section 2.1.4. A triangle is cut into four by its edge
//! midpoints, again and again, until a piece covers at most one texel; four pieces of
//! equal density are merged again. A piece is named by its place in that tree (0 the
//! whole triangle, 4i + 1 … 4i + 4 its parts), and its corners come from a table.

use crate::window::place;
use crate::{ImageMap, Mesh, Wrap};
use fearless_simd::{Level, dispatch};
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

/// What cutting asks of a density.
pub(crate) trait DensityField: Sync {
    /// The factor everywhere, at least 0.
    fn value(&self) -> f32;

    /// Columns and rows that the finest image in a triangle with corners at `uv` has in
    /// a unit of texture; `None` where the density is the same all over the triangle.
    fn texels(&self, uv: [Vec2; 3]) -> Option<[u32; 2]>;

    /// What the factor is multiplied by at `uv`.
    fn at(&self, uv: Vec2) -> f32;

    /// Appends [`at`](Self::at) for each of `weights` of the second and third of `corners`.
    #[inline(always)]
    fn read(&self, corners: [Vec2; 3], weights: &[[f32; 2]], values: &mut Vec<f32>) {
        let places = weights.iter().map(|&weights| place(corners, weights));
        values.extend(places.map(|uv| self.at(uv)));
    }
}

impl DensityField for Density<'_> {
    fn value(&self) -> f32 {
        self.value
    }

    #[inline(always)]
    fn texels(&self, _: [Vec2; 3]) -> Option<[u32; 2]> {
        self.map.map(|(map, ..)| [map.width(), map.height()])
    }

    #[inline(always)]
    fn at(&self, uv: Vec2) -> f32 {
        let sample =
            |(map, channel, wrap): (&ImageMap, _, _)| map.sample(uv.x, uv.y, channel, wrap);
        self.map.map_or(1.0, sample)
    }

    #[inline(always)]
    fn read(&self, corners: [Vec2; 3], weights: &[[f32; 2]], values: &mut Vec<f32>) {
        match self.map {
            Some((map, channel, wrap)) => {
                map.sample_triangle(corners, weights, channel, wrap, values)
            }
            None => values.resize(values.len() + weights.len(), 1.0),
        }
    }
}

/// Depth at which cutting stops whatever the map: 4^12 pieces a triangle, the
/// texels of a 4096² map that one triangle fills.
pub(crate) const MAX_DEPTH: u32 = 12;

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

    /// Where `(p, q)` of this part lies in the whole.
    #[inline]
    pub(crate) fn at(self, p: f32, q: f32) -> [f32; 2] {
        [
            self.origin[0] + self.size * p,
            self.origin[1] + self.size * q,
        ]
    }

    /// Weights of the whole triangle's corners at `(p, q)` of this part.
    #[inline]
    pub(crate) fn barycentric(self, p: f32, q: f32) -> [f32; 3] {
        let [u, v] = self.at(p, q);
        [(1.0 - u - v).max(0.0), u, v]
    }

    pub(crate) fn centre(self) -> [f32; 3] {
        self.barycentric(1.0 / 3.0, 1.0 / 3.0)
    }
}

/// Index of the first part of depth `depth`, which is the number of those above it.
pub(crate) fn first_part(depth: u32) -> usize {
    ((1usize << (2 * depth)) - 1) / 3
}

/// All parts down to `depth`, at the index that names them.
pub(crate) fn parts(depth: u32) -> Vec<Part> {
    let count = first_part(depth + 1);
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

/// Which part of which triangle a piece of constant density is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Piece {
    pub triangle: u32,
    pub part: u32,
}

/// The pieces of some triangles, in their order, without those of density zero.
#[derive(Debug, Default)]
pub(crate) struct Run {
    pub pieces: Vec<Piece>,
    /// Area times density of each.
    pub weights: Vec<f64>,
}

/// Triangles in a run: their pieces stay in the second-level cache.
const RUN: usize = 256;

/// The pieces of all triangles in the order given, run by run.
pub(crate) fn cut(mesh: &Mesh, order: &[u32], density: &impl DensityField) -> Vec<Run> {
    let table = Table::new();
    let level = Level::new();
    order
        .par_chunks(RUN)
        .map(|triangles| {
            let mut cutter = Cutter {
                mesh,
                density,
                table: &table,
                levels: [const { Vec::new() }; MAX_DEPTH as usize + 1],
                run: Run::default(),
            };
            dispatch!(level, simd => {
                let _ = simd;
                for &triangle in triangles {
                    cutter.cut(triangle);
                }
            });
            cutter.run
        })
        .collect()
}

/// Depth to which parts come from a table; below, from a part of the table inside
/// another, which reaches [`MAX_DEPTH`].
const TABLE_DEPTH: u32 = 6;

/// The parts down to [`TABLE_DEPTH`] and their centres, at the index that names them.
struct Table {
    parts: Vec<Part>,
    centres: Vec<[f32; 2]>,
}

impl Table {
    fn new() -> Self {
        let parts = parts(TABLE_DEPTH);
        let centre = |part: &Part| part.at(1.0 / 3.0, 1.0 / 3.0);
        Self {
            centres: parts.iter().map(centre).collect(),
            parts,
        }
    }

    fn parts(&self, depth: u32) -> &[Part] {
        &self.parts[first_part(depth)..first_part(depth + 1)]
    }

    fn centres(&self, depth: u32) -> &[[f32; 2]] {
        &self.centres[first_part(depth)..first_part(depth + 1)]
    }
}

/// Density of a part whose parts have different ones.
const MIXED: f32 = f32::NAN;

struct Cutter<'a, D> {
    mesh: &'a Mesh,
    density: &'a D,
    table: &'a Table,
    /// Densities of the parts of each depth.
    levels: [Vec<f32>; MAX_DEPTH as usize + 1],
    run: Run,
}

impl<D: DensityField> Cutter<'_, D> {
    #[inline(always)]
    fn cut(&mut self, triangle: u32) {
        let area = self.mesh.area(triangle as usize);
        // A NaN has no area either.
        let has_area = area > 0.0 && area.is_finite();
        if !has_area {
            return;
        }
        let depth = self.sample(triangle);
        let uncut = (0..depth)
            .rev()
            .find(|&d| !self.merge(d))
            .map_or(0, |d| d + 1);
        let weight = area * self.density.value() as f64;
        let (levels, run) = (&self.levels, &mut self.run);
        // The parts above are all mixed.
        for part in 0..1 << (2 * uncut) {
            emit(levels, uncut, part, &mut |d, i, density| {
                run.pieces.push(Piece {
                    triangle,
                    part: (first_part(d) + i) as u32,
                });
                let share = weight / (1u64 << (2 * d)) as f64;
                run.weights.push(share * density as f64);
            });
        }
    }

    /// Reads the density at the centres of the parts that are small enough for the map;
    /// returns their depth.
    #[inline(always)]
    fn sample(&mut self, triangle: u32) -> u32 {
        let all = self.mesh.uvs().get(triangle as usize);
        let uv = all.copied().unwrap_or([Vec2::ZERO; 3]);
        let depth = self
            .density
            .texels(uv)
            .map_or(0, |size| depth_for(uv, size));
        let level = &mut self.levels[depth as usize];
        level.clear();
        let within = depth.min(TABLE_DEPTH);
        for base in self.table.parts(depth - within) {
            let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
            let corners = corners.map(|[p, q]| place(uv, base.at(p, q)));
            let centres = self.table.centres(within);
            self.density.read(corners, centres, level);
        }
        depth
    }

    /// Gives the parts of depth `depth` the density that their four parts share, and
    /// tells whether any could be merged.
    #[inline(always)]
    fn merge(&mut self, depth: u32) -> bool {
        let (above, below) = self.levels.split_at_mut(depth as usize + 1);
        let (above, below) = (&mut above[depth as usize], &below[0]);
        let mut merged = false;
        above.clear();
        above.extend(below.as_chunks().0.iter().map(|&[a, b, c, d]: &[f32; 4]| {
            let same = a == b && a == c && a == d;
            merged |= same;
            if same { a } else { MIXED }
        }));
        merged
    }
}

/// Calls `visit` with depth, number and density of the largest parts of one density in
/// part `i` of depth `d`.
#[inline(always)]
fn emit(levels: &[Vec<f32>], d: u32, i: usize, visit: &mut impl FnMut(u32, usize, f32)) {
    let density = levels[d as usize][i];
    if density.is_nan() {
        emit_parts(levels, d, i, visit);
    } else if density > 0.0 {
        visit(d, i, density);
    }
}

fn emit_parts(levels: &[Vec<f32>], d: u32, i: usize, visit: &mut impl FnMut(u32, usize, f32)) {
    for child in 4 * i..4 * i + 4 {
        emit(levels, d + 1, child, visit);
    }
}

/// Longest side a part may have, in texels, where its area alone would do: slivers of
/// texture are resolved along their length too.
const LONGEST: f32 = 4.0;

/// Least depth at which a part covers at most one texel (document 004, eq. 2.3).
fn depth_for(uv: [Vec2; 3], [width, height]: [u32; 2]) -> u32 {
    let texel = |p: Vec2| p * Vec2::new(width as f32, height as f32);
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
            let area: f32 = parts[first_part(depth)..first_part(depth + 1)]
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
