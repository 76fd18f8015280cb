//! Thinning: vertices that a hair can do without.
//!
//! Source: document 004, section 2.2.9: the first and the last vertex stay, and a vertex
//! goes where the curve's tangent there is like those before and after it: where the
//! cosines are above the threshold. Unlike there, the tangent before is that of the last
//! vertex that *stays*, and those before and after must be alike too; along a gentle arc
//! of many vertices each is like its neighbours, and all would go. So a hair turns by no
//! more than the threshold between vertices that stay, if it did not between all. Local
//! space; what is left keeps its place, colour and width.

use pelage_curves::{Vec3, catmull_rom};

/// Appends the numbers of the vertices of `hair` that stay to `kept`; `tangents` is
/// scratch.
pub fn thin(threshold: f32, hair: &[Vec3], tangents: &mut Vec<Vec3>, kept: &mut Vec<u32>) {
    tangents.resize(hair.len(), Vec3::ZERO);
    catmull_rom::tangents(hair, tangents);
    let mut before = 0;
    for i in 0..hair.len() {
        let inside = i > 0 && i + 1 < hair.len();
        let alike = |a: usize, b: usize| tangents[a].dot(tangents[b]) > threshold;
        if !(inside && alike(before, i) && alike(i, i + 1) && alike(before, i + 1)) {
            kept.push(i as u32);
            before = i;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kept(threshold: f32, hair: &[Vec3]) -> Vec<u32> {
        let mut kept = Vec::new();
        thin(threshold, hair, &mut Vec::new(), &mut kept);
        kept
    }

    fn arc(vertices: usize, angle: f32) -> Vec<Vec3> {
        let at = |i: usize| angle * i as f32 / (vertices - 1) as f32;
        (0..vertices)
            .map(|i| Vec3::new(libm::cosf(at(i)), libm::sinf(at(i)), 0.0))
            .collect()
    }

    #[test]
    fn a_straight_hair_keeps_its_ends_and_a_threshold_of_1_keeps_all() {
        let straight: Vec<Vec3> = (0..9).map(|i| Vec3::X * i as f32).collect();
        assert_eq!(kept(0.99, &straight), [0, 8]);
        assert_eq!(kept(1.0, &arc(5, 1.0)), [0, 1, 2, 3, 4]);
    }

    #[test]
    fn an_arc_keeps_vertices_as_often_as_it_turns_by_the_threshold() {
        for vertices in [20, 200, 2000] {
            let kept = kept(0.95, &arc(vertices, 3.0));
            // arccos 0.95 is 0.318: at least every so much, and not much more often.
            assert!((9..=12).contains(&kept.len()), "{vertices}: {}", kept.len());
        }
    }
}
