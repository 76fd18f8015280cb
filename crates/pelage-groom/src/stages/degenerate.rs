//! Degenerate vertices: those that stand where the one before them does.
//!
//! Source: document 004, sections 2.2.2 and 2.2.9: of two equal vertices one goes, and a
//! hair left with one vertex is no hair. Equal are vertices that rounding cannot tell
//! apart. Looked at are hairs as their guides shape them at rest, so that what goes is the
//! same at all times and on all poses. Local space, unit of the mesh.

use crate::lanes::{LANES, Row, Rows};
use pelage_curves::Vec3;

/// Vertices nearer to each other than this cannot be told apart, in a hair of `segments`
/// with the nominal length `length` that grows at `root`.
#[inline]
pub fn apart(length: f32, segments: usize, root: Vec3) -> f32 {
    // Mixing guides rounds lengths, and coordinates are rounded where the hair stands.
    let segment = length / segments.max(1) as f32;
    let coordinate = root.abs().max_element() + length;
    (segment * 1e-5).max(coordinate * f32::EPSILON)
}

/// Squares of the shortest steps from vertex to vertex of hairs side by side, which have so
/// many `vertices`.
#[inline(always)]
pub(crate) fn shortest(hairs: &[Rows], vertices: &[u32]) -> Row {
    let mut counts = [0; LANES];
    counts[..vertices.len()].copy_from_slice(vertices);
    let mut shortest = [f32::INFINITY; LANES];
    for (number, pair) in hairs.windows(2).enumerate() {
        for lane in 0..LANES {
            let square = pair[0].get(lane).distance_squared(pair[1].get(lane));
            let own = (number as u32) + 1 < counts[lane];
            shortest[lane] = shortest[lane].min(if own { square } else { f32::INFINITY });
        }
    }
    shortest
}

/// Appends the numbers of the vertices of `hair` that stay; none of a hair that has
/// degenerated. The first stays, and the last in the place of those it stands on.
pub fn distinct(hair: &[Vec3], apart: f32, stay: &mut Vec<u32>) {
    let first = stay.len();
    let mut before: Option<Vec3> = None;
    for (i, &vertex) in hair.iter().enumerate() {
        if before.is_none_or(|before| before.distance(vertex) > apart) {
            stay.push(i as u32);
            before = Some(vertex);
        }
    }
    if stay.len() - first < 2 {
        stay.truncate(first);
    } else if let Some(last) = stay.last_mut() {
        *last = hair.len() as u32 - 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stay(heights: &[f32]) -> Vec<u32> {
        let hair: Vec<Vec3> = heights.iter().map(|&z| Vec3::Z * z).collect();
        let mut stay = Vec::new();
        distinct(&hair, 1e-3, &mut stay);
        // In a lane of a block of longer hairs.
        let rows: Vec<Rows> = (0..9)
            .map(|k| Rows::of(&[Vec3::ZERO, *hair.get(k).unwrap_or(&Vec3::ZERO)], |v| *v))
            .collect();
        let sound = shortest(&rows, &[1, hair.len() as u32])[1] > 1e-6;
        assert_eq!(sound, stay.len() == hair.len());
        stay
    }

    #[test]
    fn of_equal_vertices_one_stays_and_the_ends_do() {
        assert_eq!(stay(&[0.0, 1.0, 2.0]), [0, 1, 2]);
        assert_eq!(stay(&[0.0, 0.0, 1.0, 1.0, 1.0, 2.0]), [0, 2, 5]);
        assert_eq!(stay(&[0.0, 1.0, 2.0, 2.0005]), [0, 1, 3]);
        // Many steps that are too small make one that is not.
        assert_eq!(stay(&[0.0, 0.0004, 0.0008, 0.0012]), [0, 3]);
    }

    #[test]
    fn a_hair_left_with_one_vertex_is_no_hair() {
        assert_eq!(stay(&[0.5; 6]), [0; 0]);
        assert_eq!(stay(&[0.0, 0.0005]), [0; 0]);
        assert_eq!(stay(&[]), [0; 0]);
    }
}
