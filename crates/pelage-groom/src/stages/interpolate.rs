//! A hair's vertices from those of its guides, in the hair's local frame.
//!
//! Source: document 004, section 2.2.4. Vertex i of a hair is the weighted mean of the
//! vertices i of its guides, each turned in the tangent plane (see
//! [`weights`](super::weights)). Local space, unit of the mesh.

use super::weights::Share;
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

/// Writes the vertices of a hair. `guides` holds the [`rows`] of all guides of the group,
/// each of `hair.len()` vertices, one guide after the other.
#[inline(always)]
pub fn interpolate(guides: &[Row], shares: &[Share], hair: &mut [Vec3]) {
    let rows = hair.len().div_ceil(WIDTH);
    for (row, hair) in hair.chunks_mut(WIDTH).enumerate() {
        let [mut x, mut y, mut z] = Row::default();
        for share in shares.iter().filter(|share| share.weight != 0.0) {
            let [gx, gy, gz] = &guides[share.guide as usize * rows + row];
            for k in 0..WIDTH {
                x[k] += share.cosine * gx[k] - share.sine * gy[k];
                y[k] += share.sine * gx[k] + share.cosine * gy[k];
                z[k] += share.weight * gz[k];
            }
        }
        for (k, vertex) in hair.iter_mut().enumerate() {
            *vertex = Vec3::new(x[k], y[k], z[k]);
        }
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
        let mut hair = [Vec3::ONE; 3];
        interpolate(
            &guides,
            &[share(0, 0.2), share(1, 0.5), share(2, 0.3)],
            &mut hair,
        );
        for (h, g) in hair.iter().zip(guide) {
            assert!(h.distance(g) < 1e-6);
        }
    }
}
