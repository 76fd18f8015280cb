//! A hair's vertices from those of its guides, in the hair's local frame.
//!
//! Source: document 004, section 2.2.4. Vertex i of a hair is the weighted mean of the
//! vertices i of its guides, each turned in the tangent plane (see
//! [`weights`](super::weights)). Local space, unit of the mesh.

use super::weights::Share;
use pelage_curves::Vec3;

/// Writes the vertices of a hair. `guides` holds the vertices of all guides of the
/// group, `hair.len()` each, one guide after the other.
#[inline]
pub fn interpolate(guides: &[Vec3], shares: &[Share], hair: &mut [Vec3]) {
    let vertices = hair.len();
    hair.fill(Vec3::ZERO);
    for share in shares {
        if share.weight == 0.0 {
            continue;
        }
        let first = share.guide as usize * vertices;
        for (out, v) in hair.iter_mut().zip(&guides[first..first + vertices]) {
            out.x += share.cosine * v.x - share.sine * v.y;
            out.y += share.sine * v.x + share.cosine * v.y;
            out.z += share.weight * v.z;
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
        let guides = [guide, guide, guide].concat();
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
