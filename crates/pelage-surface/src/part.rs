//! Parts of a triangle that is cut into four, again and again.
//!
//! A part is named by its place in that tree: 0 the whole triangle, 4i + 1 … 4i + 4 the
//! parts of part i.

use crate::Mesh;
use crate::lanes::float;
use fearless_simd::{Bytes, Simd, SimdInt, f32x16, i32x16, u32x16};
use pelage_curves::Vec3;

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

/// A part of depth [`TABLE_DEPTH`] at most in one word, from which processors make many
/// parts at once: its origin and size in units of the smallest part, a byte each.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Packed(pub u32);

impl Packed {
    pub(crate) fn new(part: Part) -> Self {
        let [u, v, size] =
            [part.origin[0], part.origin[1], part.size].map(|x| (x * UNITS) as i32 as u32 & 0xff);
        Self(size << 16 | v << 8 | u)
    }

    #[inline(always)]
    pub(crate) fn part(self) -> Part {
        let unit = |x: u32| x as i32 as f32 * (1.0 / UNITS);
        Part {
            origin: [unit(self.0 & 0xff), unit(self.0 >> 8 & 0xff)],
            size: ((self.0 << 8) as i32 >> 24) as f32 * (1.0 / UNITS),
        }
    }

    /// The same of parts side by side: the two coordinates of the origin and the size.
    #[inline(always)]
    pub(crate) fn unpacked<S: Simd>(parts: u32x16<S>) -> [f32x16<S>; 3] {
        let size = (parts << 8).bitcast::<i32x16<S>>() >> 24;
        let unit = 1.0 / UNITS;
        [
            float(parts & 0xff) * unit,
            float(parts >> 8 & 0xff) * unit,
            size.to_float::<f32x16<S>>() * unit,
        ]
    }
}

/// Smallest parts of the table along a side of the triangle.
const UNITS: f32 = (1 << TABLE_DEPTH) as f32;

/// Index of the first part of depth `depth`, which is the number of those above it.
pub(crate) const fn first_part(depth: u32) -> usize {
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

/// Depth to which parts come from a table: 5,461 parts, which as [`Packed`] stay in the
/// first-level cache; below, from a part of the table inside
/// another, which reaches [`MAX_DEPTH`].
pub(crate) const TABLE_DEPTH: u32 = 6;

/// The parts down to [`TABLE_DEPTH`] and their centres, at the index that names them.
pub(crate) struct Table {
    parts: Vec<Part>,
    centres: Vec<[f32; 2]>,
}

impl Table {
    pub(crate) fn new() -> Self {
        let parts = parts(TABLE_DEPTH);
        let centre = |part: &Part| part.at(1.0 / 3.0, 1.0 / 3.0);
        Self {
            centres: parts.iter().map(centre).collect(),
            parts,
        }
    }

    pub(crate) fn parts(&self, depth: u32) -> &[Part] {
        &self.parts[first_part(depth)..first_part(depth + 1)]
    }

    pub(crate) fn centres(&self, depth: u32) -> &[[f32; 2]] {
        &self.centres[first_part(depth)..first_part(depth + 1)]
    }
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
    fn a_packed_part_is_the_part() {
        for part in parts(TABLE_DEPTH) {
            assert_eq!(Packed::new(part).part(), part);
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
