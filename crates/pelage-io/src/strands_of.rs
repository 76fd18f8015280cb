//! Strands *through* their vertices from curves of any basis.
//!
//! A strand holds real vertices only, and its curve is the Catmull-Rom curve
//! through them with duplicated ends; files hold other things as well.

use crate::CurveSet;
use pelage_curves::{Basis, Curve, Vec3, Wrap};
use pelage_strands::StrandBuffer;
use std::ops::Range;

/// Vertices made on each segment of a curve that has to be sampled: its start and
/// three inner points. A Catmull-Rom curve through four points a segment strays
/// from a cubic of moderate bend by some thousandths of the segment's length.
const SAMPLES: usize = 4;

/// The curves of `set` as strands through their vertices, in the same order.
///
/// | curves | strand |
/// |---|---|
/// | linear, Catmull-Rom pinned | the vertices as they are |
/// | Catmull-Rom nonperiodic | without the first and last vertex, which only shape the ends (where they are duplicates, the curve stays the same) |
/// | Bézier, B-spline, periodic | sampled: ends of segments and three points within each, attributes interpolated |
///
/// A curve of a vertex count that its basis does not allow is kept as it is, so
/// that strands and curves keep their numbers.
pub fn strands_through_vertices(set: &CurveSet) -> StrandBuffer {
    let source = &set.curves;
    let as_is = matches!(
        (set.basis, set.wrap),
        (Basis::Linear, Wrap::Nonperiodic | Wrap::Pinned) | (Basis::CatmullRom, Wrap::Pinned)
    );
    if as_is {
        return source.clone();
    }
    let mut strands = StrandBuffer {
        offsets: vec![0],
        hair_id: source.hair_id.clone(),
        strand_id: source.strand_id.clone(),
        root_uv: source.root_uv.clone(),
        strand_uv: source.strand_uv.clone(),
        group: source.group.clone(),
        triangle: source.triangle.clone(),
        barycentric: source.barycentric.clone(),
        root_rest: source.root_rest.clone(),
        ..StrandBuffer::new()
    };
    for index in 0..source.len() {
        let range = source.vertices(index);
        match set.curve(index) {
            None => copy(&mut strands, source, range),
            Some(_) if (set.basis, set.wrap) == (Basis::CatmullRom, Wrap::Nonperiodic) => {
                copy(&mut strands, source, range.start + 1..range.end - 1);
            }
            Some(curve) => sample(&mut strands, source, range, &curve, set),
        }
        strands.offsets.push(strands.points.len() as u32);
    }
    strands
}

/// Appends vertices of `source` as they are.
fn copy(strands: &mut StrandBuffer, source: &StrandBuffer, range: Range<usize>) {
    let inner = |array: usize| if array == 0 { 0..0 } else { range.clone() };
    strands.points.extend(&source.points[range.clone()]);
    let widths = inner(source.widths.len());
    strands.widths.extend(&source.widths[widths]);
    let colors = inner(source.colors.len());
    strands.colors.extend(&source.colors[colors]);
    let opacities = inner(source.opacities.len());
    strands.opacities.extend(&source.opacities[opacities]);
    let normals = inner(source.normals.len());
    strands.normals.extend(&source.normals[normals]);
}

/// Appends points on `curve`, whose vertices are `range` of `source`.
fn sample(
    strands: &mut StrandBuffer,
    source: &StrandBuffer,
    range: Range<usize>,
    curve: &Curve,
    set: &CurveSet,
) {
    let segments = curve.segments();
    let steps = if set.basis == Basis::Linear {
        1
    } else {
        SAMPLES
    };
    for step in 0..=segments * steps {
        let segment = (step / steps).min(segments - 1);
        let t = (step - segment * steps) as f32 / steps as f32;
        strands.points.push(curve.position(segment, t).to_array());
        let weights = weights(set.basis, set.wrap, range.len(), segment, t);
        let scalar = |array: &[f32]| -> f32 {
            let mixed = weights.iter().map(|&(i, w)| array[range.start + i] * w);
            mixed.sum()
        };
        let vector = |array: &[[f32; 3]]| -> Vec3 {
            let mixed = weights
                .iter()
                .map(|&(i, w)| Vec3::from(array[range.start + i]) * w);
            mixed.sum()
        };
        if !source.widths.is_empty() {
            strands.widths.push(scalar(&source.widths));
        }
        if !source.colors.is_empty() {
            strands.colors.push(vector(&source.colors).to_array());
        }
        if !source.opacities.is_empty() {
            strands.opacities.push(scalar(&source.opacities));
        }
        if !source.normals.is_empty() {
            let normal = vector(&source.normals).normalize_or_zero();
            strands.normals.push(normal.to_array());
        }
    }
}

/// Vertices that an attribute at `t` on `segment` is mixed from, and their shares.
///
/// Linear between the vertices that the segment runs along: attributes stay within
/// the range of their neighbours, which a cubic would not grant.
fn weights(basis: Basis, wrap: Wrap, vertices: usize, segment: usize, t: f32) -> [(usize, f32); 2] {
    let along = match (basis, wrap) {
        (Basis::Bezier, _) => 3.0 * (segment as f32 + t),
        // The curve leaves near the second vertex.
        (Basis::BSpline, Wrap::Nonperiodic) => segment as f32 + t + 1.0,
        // Two doubled ends: the curve has two segments more than gaps.
        (Basis::BSpline, Wrap::Pinned) => {
            (segment as f32 + t) * (vertices - 1) as f32 / (vertices + 1) as f32
        }
        _ => segment as f32 + t,
    };
    let low = along.floor();
    let wrapped = |i: usize| match wrap {
        Wrap::Periodic => i % vertices,
        _ => i.min(vertices - 1),
    };
    let share = along - low;
    let low = low as usize;
    [(wrapped(low), 1.0 - share), (wrapped(low + 1), share)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(basis: Basis, wrap: Wrap, points: &[[f32; 3]]) -> CurveSet {
        let mut set = CurveSet::through_vertices("test", StrandBuffer::new());
        (set.basis, set.wrap) = (basis, wrap);
        set.curves.points = points.to_vec();
        set.curves.widths = (0..points.len()).map(|i| i as f32).collect();
        set.curves.offsets = vec![0, points.len() as u32];
        set
    }

    const BEND: [[f32; 3]; 4] = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [2.0, 1.0, 0.0],
        [3.0, 3.0, 1.0],
    ];

    #[test]
    fn doubled_ends_are_dropped_and_the_curve_stays() {
        let doubled = [BEND[0], BEND[0], BEND[1], BEND[2], BEND[3], BEND[3]];
        let set = set(Basis::CatmullRom, Wrap::Nonperiodic, &doubled);
        let strands = strands_through_vertices(&set);
        assert_eq!(strands.points, BEND);
        assert_eq!(strands.widths, [1.0, 2.0, 3.0, 4.0]);
        assert_eq!(strands.offsets, [0, 4]);
    }

    #[test]
    fn pinned_and_linear_curves_stay_as_they_are() {
        for basis in [Basis::CatmullRom, Basis::Linear] {
            let set = set(basis, Wrap::Pinned, &BEND);
            assert_eq!(strands_through_vertices(&set), set.curves);
        }
    }

    #[test]
    fn sampled_curves_lie_on_the_curve_and_keep_their_ends() {
        for basis in [Basis::Bezier, Basis::BSpline] {
            for wrap in [Wrap::Nonperiodic, Wrap::Pinned, Wrap::Periodic] {
                let points = if (basis, wrap) == (Basis::Bezier, Wrap::Periodic) {
                    &BEND[..3]
                } else {
                    &BEND[..]
                };
                let set = set(basis, wrap, points);
                let curve = set.curve(0).unwrap();
                let strands = strands_through_vertices(&set);
                assert_eq!(strands.points.len(), 4 * curve.segments() + 1);
                assert_eq!(strands.widths.len(), strands.points.len());
                assert_eq!(strands.points[0], curve.position(0, 0.0).to_array());
                let end = curve.position(curve.segments() - 1, 1.0).to_array();
                assert_eq!(strands.points.last(), Some(&end));
                assert!(strands.widths.iter().all(|w| (0.0..=3.0).contains(w)));
            }
        }
    }

    #[test]
    fn a_periodic_curve_comes_back_to_its_start() {
        for basis in [Basis::Linear, Basis::CatmullRom, Basis::BSpline] {
            let strands = strands_through_vertices(&set(basis, Wrap::Periodic, &BEND));
            assert_eq!(strands.points.first(), strands.points.last());
            assert_eq!(strands.widths.first(), strands.widths.last());
        }
    }

    #[test]
    fn a_curve_of_too_few_vertices_keeps_its_place() {
        let set = set(Basis::Bezier, Wrap::Nonperiodic, &BEND[..2]);
        assert_eq!(strands_through_vertices(&set).points, BEND[..2]);
    }
}
