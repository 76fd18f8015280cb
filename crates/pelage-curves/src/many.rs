//! Frames of many curves at once.
//!
//! Along one curve each normal waits for the one before, with two divisions and a root
//! in between: the processor idles. Curves do not wait for each other, so [`LANES`] of
//! them are walked side by side, vertex by vertex, with their coordinates in rows. What
//! is done at a vertex is the text that serves a single curve ([`catmull_rom::tangent`],
//! [`reflect_twice`]), so a curve's frames have the same bits whatever its neighbours and
//! whatever the processor's vectors.

use crate::catmull_rom;
use crate::frames::{double_reflection, perpendicular_part, reflect_twice};
use fearless_simd::{Level, dispatch};
use glam::{Mat4, Vec3, Vec4};
use std::ops::Range;

/// Curves side by side: two of the widest common vectors, so that one's roots and
/// divisions run while the other's are waited for.
const LANES: usize = 16;

/// One vector of each of the curves that are side by side.
#[derive(Clone, Copy, Debug)]
struct Row([[f32; LANES]; 3]);

impl Row {
    const ZERO: Self = Self([[0.0; LANES]; 3]);

    #[inline(always)]
    fn get(&self, lane: usize) -> Vec3 {
        Vec3::new(self.0[0][lane], self.0[1][lane], self.0[2][lane])
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, vector: Vec3) {
        for (row, x) in self.0.iter_mut().zip(vector.to_array()) {
            row[lane] = x;
        }
    }

    /// x, y and z of four neighbouring lanes.
    #[inline(always)]
    fn four(&self, four: usize) -> Mat4 {
        let column = |axis: usize| Vec4::from_slice(&self.0[axis][4 * four..]);
        Mat4::from_cols(column(0), column(1), column(2), Vec4::ZERO)
    }

    #[inline(always)]
    fn set_four(&mut self, four: usize, columns: Mat4) {
        for (axis, row) in self.0.iter_mut().enumerate() {
            columns.col(axis).write_to_slice(&mut row[4 * four..]);
        }
    }

    #[inline(always)]
    fn from_fn(vector: impl Fn(usize) -> Vec3) -> Self {
        let mut row = Self::ZERO;
        for lane in 0..LANES {
            row.set(lane, vector(lane));
        }
        row
    }
}

/// Memory that [`untwisted_normals`] uses again from call to call.
#[derive(Clone, Debug, Default)]
pub struct FrameScratch {
    points: Vec<Row>,
    normals: Vec<Row>,
    /// Of a curve that is walked alone.
    tangents: Vec<Vec3>,
}

/// Where side by side this many times the vertices there are would be walked, as beside one
/// very long curve, curves are walked alone: about as fast, without the memory.
const MOST_IDLE: usize = 4;

/// Writes a unit normal for each vertex of many Catmull-Rom curves, such that their
/// frames turn about them as little as possible: [`catmull_rom::tangents`] and
/// [`double_reflection`](crate::double_reflection) of each curve, to the bit.
///
/// Curve `i` has the vertices `offsets[i]..offsets[i + 1]` of `points`, and
/// `first(i)` is where its first normal should point. `normals` has the length of
/// `points`, and `offsets` one entry more than there are curves; it ascends and ends
/// at that length at most.
///
/// ```
/// use pelage_curves::{FrameScratch, Vec3, untwisted_normals};
///
/// let points = [Vec3::ZERO, Vec3::Z, Vec3::ZERO, Vec3::X, Vec3::ONE];
/// let mut normals = [Vec3::ZERO; 5];
/// untwisted_normals(&points, &[0, 2, 5], |_| Vec3::Y, &mut FrameScratch::default(), &mut normals);
/// assert_eq!(normals[..3], [Vec3::Y; 3]);
/// ```
pub fn untwisted_normals(
    points: &[Vec3],
    offsets: &[u32],
    first: impl Fn(usize) -> Vec3,
    scratch: &mut FrameScratch,
    normals: &mut [Vec3],
) {
    dispatch!(Level::new(), simd => {
        let _ = simd;
        let curves = offsets.len().saturating_sub(1);
        for start in (0..curves).step_by(LANES) {
            // A block that is not full has its last curve several times.
            let curve = |lane: usize| (start + lane).min(curves - 1);
            let ranges: [Range<usize>; LANES] = std::array::from_fn(|lane| {
                offsets[curve(lane)] as usize..offsets[curve(lane) + 1] as usize
            });
            let own = &ranges[..LANES.min(curves - start)];
            let longest = own.iter().map(|range| range.len()).max().unwrap_or(0);
            let all: usize = own.iter().map(|range| range.len()).sum();
            if longest.saturating_mul(LANES) > MOST_IDLE * all {
                for (lane, range) in own.iter().enumerate() {
                    scratch.alone(&points[range.clone()], first(start + lane), &mut normals[range.clone()]);
                }
                continue;
            }
            scratch.load(points, &ranges);
            scratch.walk(Row::from_fn(|lane| first(curve(lane))));
            scratch.store(own, normals);
        }
    });
}

impl FrameScratch {
    fn alone(&mut self, points: &[Vec3], first: Vec3, normals: &mut [Vec3]) {
        self.tangents.resize(points.len(), Vec3::ZERO);
        catmull_rom::tangents(points, &mut self.tangents);
        double_reflection(points, &self.tangents, first, normals);
    }

    /// Puts curves side by side. Shorter ones repeat their last vertex, which leaves the
    /// frames before it as they are: the ends of a curve are duplicated anyway.
    #[inline(always)]
    fn load(&mut self, points: &[Vec3], ranges: &[Range<usize>; LANES]) {
        let curves: [&[Vec3]; LANES] = std::array::from_fn(|lane| &points[ranges[lane].clone()]);
        let longest = curves.iter().map(|curve| curve.len()).max().unwrap_or(0);
        self.points.resize(longest, Row::ZERO);
        self.normals.resize(longest, Row::ZERO);
        for (four, curves) in curves.chunks_exact(4).enumerate() {
            let all = curves.iter().map(|curve| curve.len()).min().unwrap_or(0);
            let (whole, rest) = self.points.split_at_mut(all);
            let [a, b, c, d] = [0, 1, 2, 3].map(|k| &curves[k][..all]);
            for (i, row) in whole.iter_mut().enumerate() {
                row.set_four(four, columns([a[i], b[i], c[i], d[i]]));
            }
            let vertex = |curve: &[Vec3], i: usize| curve.get(i).or(curve.last()).copied();
            for (i, row) in (all..).zip(rest) {
                let vertex = |k: usize| vertex(curves[k], i).unwrap_or(Vec3::ZERO);
                row.set_four(four, columns([0, 1, 2, 3].map(vertex)));
            }
        }
    }

    #[inline(always)]
    fn walk(&mut self, first: Row) {
        let last = self.points.len().saturating_sub(1);
        let mut tangent = Row::from_fn(|_| Vec3::Z);
        let mut normal = first;
        for i in 0..self.points.len() {
            let before = &self.points[i.saturating_sub(1)];
            let (here, after) = (&self.points[i], &self.points[(i + 1).min(last)]);
            let next = Row::from_fn(|k| {
                catmull_rom::tangent(before.get(k), here.get(k), after.get(k), tangent.get(k))
            });
            let carried = match i {
                0 => normal,
                _ => Row::from_fn(|k| {
                    let step = here.get(k) - before.get(k);
                    reflect_twice(step, tangent.get(k), next.get(k), normal.get(k))
                }),
            };
            normal = Row::from_fn(|k| perpendicular_part(carried.get(k), next.get(k)));
            tangent = next;
            self.normals[i] = normal;
        }
    }

    #[inline(always)]
    fn store(&self, ranges: &[Range<usize>], normals: &mut [Vec3]) {
        for (four, ranges) in ranges.chunks(4).enumerate() {
            let all = ranges.iter().map(|range| range.len()).min().unwrap_or(0);
            for (i, row) in self.normals.iter().enumerate() {
                let columns = row.four(four).transpose();
                for (k, range) in ranges.iter().enumerate() {
                    if i < all || i < range.len() {
                        normals[range.start + i] = columns.col(k).truncate();
                    }
                }
            }
        }
    }
}

/// x, y and z of four vectors.
#[inline(always)]
fn columns([a, b, c, d]: [Vec3; 4]) -> Mat4 {
    Mat4::from_cols(a.extend(0.0), b.extend(0.0), c.extend(0.0), d.extend(0.0)).transpose()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Small integers: vertices that coincide and tangents that oppose are common.
    fn curves() -> impl Strategy<Value = Vec<Vec<[i8; 3]>>> {
        let point = prop::array::uniform3(-2i8..3);
        prop::collection::vec(prop::collection::vec(point, 0..9), 0..40)
    }

    proptest! {
        #[test]
        fn many_curves_have_the_frames_of_each_alone(curves in curves(), first: [i8; 3]) {
            let vector = |p: [i8; 3]| Vec3::from(p.map(f32::from));
            let (mut points, mut offsets) = (Vec::new(), vec![0]);
            for curve in &curves {
                points.extend(curve.iter().map(|&p| vector(p)));
                offsets.push(points.len() as u32);
            }
            let first = |i: usize| vector(first) + Vec3::X * i as f32;
            let mut normals = vec![Vec3::ZERO; points.len()];
            let scratch = &mut FrameScratch::default();
            untwisted_normals(&points, &offsets, first, scratch, &mut normals);
            for (i, ends) in offsets.windows(2).enumerate() {
                let range = ends[0] as usize..ends[1] as usize;
                let (mut tangents, mut alone) = (points.clone(), points.clone());
                catmull_rom::tangents(&points[range.clone()], &mut tangents[range.clone()]);
                let own = &mut alone[range.clone()];
                double_reflection(&points[range.clone()], &tangents[range.clone()], first(i), own);
                prop_assert_eq!(&normals[range.clone()], &alone[range]);
            }
        }
    }
    #[test]
    fn a_curve_of_ten_million_vertices_has_frames_in_little_memory() {
        let at = |i: usize| {
            let a = i as f32 * 0.01;
            Vec3::new(libm::cosf(a), libm::sinf(a), a)
        };
        let points: Vec<Vec3> = (0..10_000_000).map(at).collect();
        let offsets = [0, 5, 10_000_000];
        let mut normals = vec![Vec3::ZERO; points.len()];
        let scratch = &mut FrameScratch::default();
        untwisted_normals(&points, &offsets, |_| Vec3::Z, scratch, &mut normals);
        assert!(scratch.points.is_empty());
        assert!(normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-5));
    }
}
