//! Triangles in their order along a Hilbert curve.
//!
//! Where on the curve a triangle lies are 33 bits, which counting sorts faster than comparing.
//! Chunks of the mesh are dealt out by the first digit of that number, each within itself; then
//! what all chunks have of one digit comes together and is sorted by the others. So all that
//! is moved about at once fits the second-level cache, and tasks share nothing.

use crate::Mesh;
use crate::hilbert::{INDEX_BITS, hilbert_indices};
use crate::sums::divide;
use fearless_simd::{Level, dispatch};
use pelage_curves::Vec3;
use rayon::prelude::*;

/// Triangles placed on the curve at once.
const LANES: usize = 32;

/// Triangles that are dealt out by one task.
const CHUNK: usize = 1 << 14;

/// Bits of a digit: three of the index, which are 8 × 8 × 8 cells of space, and three passes
/// for the rest of it.
const DIGIT: u32 = 9;

/// Values of a digit.
const HANDS: usize = 1 << DIGIT;

/// Words for which counting takes longer than comparing.
const FEW: usize = 256;

/// Triangles along a Hilbert curve through their centres; in their own order where those lie
/// in one cell.
pub(crate) fn along_curve(mesh: &Mesh) -> Vec<u32> {
    let count = mesh.triangles().len();
    // One word each: where on the curve, then which triangle.
    let bits = usize::BITS - count.leading_zeros();
    let spare = (INDEX_BITS + bits).saturating_sub(64);
    let first_digit = INDEX_BITS - spare + bits - DIGIT;
    let (level, bounds) = (Level::new(), mesh.bounds());
    let mut words = vec![0; count];
    let chunks = words.par_chunks_mut(CHUNK).enumerate();
    let hands: Vec<Hands> = chunks
        .map(|(chunk, words)| {
            let mut placed = vec![0; words.len()];
            dispatch!(level, simd => {
                let _ = simd;
                place(mesh, bounds, chunk * CHUNK, &mut placed);
            });
            for (k, word) in placed.iter_mut().enumerate() {
                *word = *word >> spare << bits | (chunk * CHUNK + k) as u64;
            }
            deal(&placed, words, first_digit)
        })
        .collect();
    let mut order = vec![0; count];
    let lengths = (0..HANDS).map(|hand| hands.iter().map(|h| h.range(hand).len()).sum());
    let parts = divide(&mut order, lengths).into_par_iter().enumerate();
    parts.for_each(|(hand, part)| {
        let mut together = Vec::with_capacity(part.len());
        for (words, hands) in words.chunks(CHUNK).zip(&hands) {
            together.extend_from_slice(&words[hands.range(hand)]);
        }
        sort(&mut together, bits, first_digit);
        for (triangle, word) in part.iter_mut().zip(together) {
            *triangle = (word & ((1 << bits) - 1)) as u32;
        }
    });
    order
}

/// Where on the curve through `bounds` the centres of the triangles from `first` on lie.
#[inline(always)]
fn place(mesh: &Mesh, (low, high): (Vec3, Vec3), first: usize, indices: &mut [u64]) {
    let side = (high - low).max_element().max(f32::MIN_POSITIVE);
    for (row, indices) in indices.chunks_mut(LANES).enumerate() {
        let [a, b, c] = mesh.all_corners::<LANES>(first + row * LANES);
        let mut centres = [[0.0; LANES]; 3];
        for axis in 0..3 {
            for k in 0..LANES {
                centres[axis][k] = (a[axis][k] + b[axis][k] + c[axis][k]) / 3.0;
            }
        }
        let all = hilbert_indices(centres, low, side);
        indices.copy_from_slice(&all[..indices.len()]);
    }
}

/// Where words of each value of a digit begin, and where the last end.
struct Hands([u32; HANDS + 1]);

impl Hands {
    fn range(&self, hand: usize) -> std::ops::Range<usize> {
        self.0[hand] as usize..self.0[hand + 1] as usize
    }
}

/// Puts `words` in the order of their digit at bit `digit`, those of one value in their own.
fn deal(words: &[u64], dealt: &mut [u64], digit: u32) -> Hands {
    let hand = |word: u64| (word >> digit) as usize % HANDS;
    let mut starts = [0; HANDS + 1];
    for &word in words {
        starts[hand(word) + 1] += 1;
    }
    for k in 0..HANDS {
        starts[k + 1] += starts[k];
    }
    let mut next = starts;
    for &word in words {
        let place = &mut next[hand(word)];
        dealt[*place as usize] = word;
        *place += 1;
    }
    Hands(starts)
}

/// Sorts distinct words that agree from bit `high` on, and lie in the order of their bits
/// below `low`.
fn sort(words: &mut Vec<u64>, low: u32, high: u32) {
    if words.len() < FEW {
        return words.sort_unstable();
    }
    let mut dealt = vec![0; words.len()];
    for digit in (low..high).step_by(DIGIT as usize) {
        deal(words, &mut dealt, digit);
        std::mem::swap(words, &mut dealt);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PolygonMesh;
    use crate::fixture::sheet;
    use crate::hilbert::hilbert_index;

    /// The order by its definition.
    fn sorted(mesh: &Mesh) -> Vec<u32> {
        let (low, high) = mesh.bounds();
        let index = |triangle: &u32| {
            let [a, b, c] = mesh.corners(*triangle as usize);
            hilbert_index((a + b + c) / 3.0, low, (high - low).max_element())
        };
        let mut order: Vec<u32> = (0..mesh.triangles().len() as u32).collect();
        order.sort_by_cached_key(index);
        order
    }

    #[test]
    fn triangles_lie_in_the_order_of_their_places_on_the_curve() {
        for n in [1, 3, 40, 150] {
            let mesh = sheet(n);
            assert_eq!(along_curve(&mesh), sorted(&mesh), "{n}");
        }
    }

    #[test]
    fn triangles_of_one_cell_keep_their_order() {
        // One vertex far away: all others share a cell, and one hand.
        let away = |u: f64, v: f64| [u + 1e6 * (u * v).floor(), v, 0.0];
        let mesh = Mesh::new(PolygonMesh::sheet(30, 30, away)).unwrap();
        assert_eq!(along_curve(&mesh), sorted(&mesh));
    }
}
