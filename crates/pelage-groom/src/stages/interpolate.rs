//! A hair's vertices from those of its guides, in the hair's local frame.
//!
//! Source: document 004, section 2.2.4. Vertex i of a hair is the weighted mean of the
//! vertices i of its guides, each turned in the tangent plane (see
//! [`weights`](super::weights)). Local space, unit of the mesh.

use super::weights::Share;
use crate::lanes::Rows;
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

/// Writes the vertices of a hair into `lane` of `hair`, as many as there are rows there;
/// those behind the last of the guides stand where that does; `lane` is below
/// [`LANES`](crate::lanes::LANES), and there are rows for all `vertices`. `guides` holds the [`rows`] of
/// all guides of the group, each of `vertices` vertices, one guide after the other.
#[inline(always)]
pub fn interpolate(
    guides: &[Row],
    vertices: usize,
    shares: &[Share],
    lane: usize,
    hair: &mut [Rows],
) {
    let (own, behind) = hair.split_at_mut(vertices);
    let rows = vertices.div_ceil(WIDTH);
    for (row, hair) in own.chunks_mut(WIDTH).enumerate() {
        let mut sums = Row::default();
        for share in shares.iter().filter(|share| share.weight != 0.0) {
            add(share, &guides[share.guide as usize * rows + row], &mut sums);
        }
        for (k, vertex) in hair.iter_mut().enumerate() {
            for (axis, sum) in vertex.0.iter_mut().zip(&sums) {
                axis[lane] = sum[k];
            }
        }
    }
    if let Some(last) = own.last() {
        let last = last.get(lane);
        behind.iter_mut().for_each(|vertex| vertex.set(lane, last));
    }
}

/// Adds a guide's share in some vertices.
#[inline(always)]
fn add(share: &Share, [gx, gy, gz]: &Row, [x, y, z]: &mut Row) {
    for k in 0..WIDTH {
        x[k] += share.cosine * gx[k] - share.sine * gy[k];
        y[k] += share.sine * gx[k] + share.cosine * gy[k];
        z[k] += share.weight * gz[k];
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
        interpolate(&guides, 3, &shares, 7, &mut hair);
        for (k, vertex) in hair.iter().enumerate() {
            assert!(vertex.get(7).distance(guide[k.min(2)]) < 1e-6);
            assert_eq!(vertex.get(6), Vec3::ZERO);
        }
    }
}
