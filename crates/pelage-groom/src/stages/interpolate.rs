//! A hair's vertices from those of its guides, in the hair's local frame.
//!
//! Source: document 004, section 2.2.4. Vertex i of a hair is the weighted mean of the
//! vertices i of its guides, each turned in the tangent plane (see
//! [`weights`](super::weights)). Local space, unit of the mesh.

use super::weights::Share;
use crate::lanes::{Rows, turned};
use fearless_simd::{Level, Simd, SimdBase, dispatch, f32x8};
use pelage_curves::Vec3;

/// Vertices that are mixed together.
const WIDTH: usize = 8;

/// Some vertices of a guide that follow each other: all x, all y, all z.
pub type Row = [[f32; WIDTH]; 3];

/// The `vertices` of a guide in rows, the last filled up with zeros.
pub fn rows(vertices: &[Vec3]) -> impl Iterator<Item = Row> {
    vertices.chunks(WIDTH).map(|vertices| {
        let mut row = Row::default();
        for (k, vertex) in vertices.iter().enumerate() {
            [row[0][k], row[1][k], row[2][k]] = vertex.to_array();
        }
        row
    })
}

/// What a hair is mixed of.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mix<'a> {
    /// The [`rows`] of all guides of the group, one guide after the other.
    pub guides: &'a [Row],
    /// Vertices of each guide.
    pub vertices: usize,
    /// The parts that guides have in the hair.
    pub shares: &'a [Share],
}

/// Hairs that are mixed together.
pub const FOUR: usize = 4;

/// Writes the vertices of four hairs into the lanes of `rows` from `lane` on, as many as there
/// are rows there, which is enough for all; behind the last vertex of its guides, all of a
/// hair's stand where that does. Where there are fewer hairs, the last mixes have no vertices.
pub fn interpolate(hairs: [Mix; FOUR], lane: usize, rows: &mut [Rows]) {
    dispatch!(Level::new(), simd => interpolate_with(simd, hairs, lane, rows));
}

/// [`interpolate`] with the instructions `simd`.
#[inline(always)]
pub(crate) fn interpolate_with<S: Simd>(
    simd: S,
    hairs: [Mix; FOUR],
    lane: usize,
    rows: &mut [Rows],
) {
    let longest = hairs.iter().map(|hair| hair.vertices).max().unwrap_or(0);
    for row in 0..longest.div_ceil(WIDTH) {
        let [a, b, c, d] = hairs;
        let [a, b, c, d] = [
            a.row(simd, row),
            b.row(simd, row),
            c.row(simd, row),
            d.row(simd, row),
        ];
        let vertices = &mut rows[row * WIDTH..longest.min((row + 1) * WIDTH)];
        for (axis, (((a, b), c), d)) in a.into_iter().zip(b).zip(c).zip(d).enumerate() {
            for (vertex, numbers) in vertices.iter_mut().zip(&turned([a, b, c, d])) {
                numbers.store_slice(&mut vertex.0[axis][lane..lane + FOUR]);
            }
        }
    }
    for (lane, hair) in (lane..).zip(hairs) {
        let (own, behind) = rows.split_at_mut(hair.vertices);
        if let Some(last) = own.last() {
            let last = last.get(lane);
            behind.iter_mut().for_each(|vertex| vertex.set(lane, last));
        }
    }
}

impl Mix<'_> {
    /// Row `row` of the hair, of zeros where it has none.
    #[inline(always)]
    fn row<S: Simd>(&self, simd: S, row: usize) -> [f32x8<S>; 3] {
        let zero = f32x8::splat(simd, 0.0);
        let [mut x, mut y, mut z] = [zero; 3];
        let rows = self.vertices.div_ceil(WIDTH);
        if row >= rows {
            return [x, y, z];
        }
        for share in self.shares {
            if share.weight == 0.0 {
                continue;
            }
            let [gx, gy, gz] = &self.guides[share.guide as usize * rows + row];
            let gx = f32x8::load_array_ref(simd, gx);
            let gy = f32x8::load_array_ref(simd, gy);
            x += gx * share.cosine - gy * share.sine;
            y += gx * share.sine + gy * share.cosine;
            z += f32x8::load_array_ref(simd, gz) * share.weight;
        }
        [x, y, z]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_guides_reproduce_the_guide() {
        let guide = [
            Vec3::ZERO,
            Vec3::new(0.1, 0.2, 1.0),
            Vec3::new(0.3, 0.1, 2.0),
        ];
        let guides: Vec<Row> = [guide; 3].iter().flat_map(|g| rows(g)).collect();
        let share = |guide, weight| Share {
            guide,
            weight,
            cosine: weight,
            sine: 0.0,
        };
        let mut hair = [Rows::default(); 5];
        let shares = [share(0, 0.2), share(1, 0.5), share(2, 0.3)];
        let mix = Mix {
            guides: &guides,
            vertices: 3,
            shares: &shares,
        };
        let hairs = [Mix::default(), Mix::default(), Mix::default(), mix];
        interpolate(hairs, 4, &mut hair);
        for (k, vertex) in hair.iter().enumerate() {
            assert!(vertex.get(7).distance(guide[k.min(2)]) < 1e-6);
            assert_eq!(vertex.get(6), Vec3::ZERO);
        }
    }
}
