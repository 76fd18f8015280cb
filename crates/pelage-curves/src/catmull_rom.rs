//! Catmull-Rom curves through all their vertices, ends duplicated.
//!
//! Source: document 004, section 2.2.8. A strand stores its real vertices only;
//! the phantom vertex before the first (after the last) is the first (last) once
//! more. Everything that evaluates or exports a strand uses this one rule.

use glam::Vec3;

/// The four vertices that shape the piece from `points[i]` to `points[i + 1]`.
///
/// Panics where `i + 1` is not a vertex.
pub fn window(points: &[Vec3], i: usize) -> [Vec3; 4] {
    let last = points.len() - 1;
    [
        points[i.saturating_sub(1)],
        points[i],
        points[i + 1],
        points[(i + 2).min(last)],
    ]
}

/// Bézier control points of the piece shaped by `window`; the same curve.
pub fn to_bezier([a, b, c, d]: [Vec3; 4]) -> [Vec3; 4] {
    [b, b + (c - a) / 6.0, c + (b - d) / 6.0, c]
}

/// Position at `t` in 0..=1 on the piece shaped by `window`.
pub fn position([a, b, c, d]: [Vec3; 4], t: f32) -> Vec3 {
    let (c1, c2, c3) = (
        (c - a) * 0.5,
        a - b * 2.5 + c * 2.0 - d * 0.5,
        (d - a) * 0.5 + (b - c) * 1.5,
    );
    b + (c1 + (c2 + c3 * t) * t) * t
}

/// The piece that the curve is in at `t`, and the parameter inside it; `t` is 0 at the
/// first vertex, 1 at the last, and grows by the same from each vertex to the next
/// (document 004, section 2.2.8). Clamped to the curve.
///
/// `vertices` is at least two.
fn locate(vertices: usize, t: f32) -> (usize, f32) {
    let pieces = vertices - 1;
    let along = (t * pieces as f32).clamp(0.0, pieces as f32);
    let piece = (along as usize).min(pieces - 1);
    (piece, along - piece as f32)
}

/// Where a hair cut at `t` in 0..=1 ends: how many of `points` are kept, the last of them
/// replaced by the point that comes with it, which lies on the curve. `None` where there
/// is nothing to cut.
///
/// This is the vertex-only cut of document 004, section 2.2.8: it costs one point, and
/// the last two pieces bend a little otherwise than they did. [`bezier_until`] is exact.
///
/// ```
/// use pelage_curves::{Vec3, catmull_rom::cut};
/// let points = [Vec3::ZERO, Vec3::X, Vec3::X * 2.0, Vec3::X * 3.0];
/// assert_eq!(cut(&points, 0.5), Some((3, Vec3::X * 1.5)));
/// assert_eq!(cut(&points, 1.0), None);
/// ```
pub fn cut(points: &[Vec3], t: f32) -> Option<(usize, Vec3)> {
    if points.len() < 2 || t >= 1.0 {
        return None;
    }
    let (piece, inside) = locate(points.len(), t);
    let end = position(window(points, piece), inside);
    Some((kept(points.len(), t), end))
}

/// Where a cut passes a vertex by less than this part of a piece, that vertex goes too: a
/// last piece as short as that would point where rounding wills.
const SHORTEST: f32 = 1.0 / 64.0;

/// How many of `vertices` a hair cut at `t` in 0..=1 keeps (see [`cut`]): those up to the
/// first that is not before the cut or hardly, and two at least.
pub fn kept(vertices: usize, t: f32) -> usize {
    if vertices < 2 || t >= 1.0 {
        return vertices;
    }
    let (piece, inside) = locate(vertices, t);
    match inside > SHORTEST {
        true => piece + 2,
        false => piece.max(1) + 1,
    }
}

/// Bézier control points of the curve from its first vertex to `t` in 0..=1, exactly: one
/// cubic a piece, neighbours sharing an end, the last piece split by de Casteljau's
/// algorithm. Empty for fewer than two points.
///
/// ```
/// use pelage_curves::{Vec3, catmull_rom::bezier_until};
/// let points = [Vec3::ZERO, Vec3::X, Vec3::X * 2.0];
/// assert_eq!(bezier_until(&points, 0.75).len(), 7);
/// assert_eq!(bezier_until(&points, 0.75)[6], Vec3::X * 1.5625);
/// ```
pub fn bezier_until(points: &[Vec3], t: f32) -> Vec<Vec3> {
    let Some(&first) = points.first().filter(|_| points.len() > 1) else {
        return Vec::new();
    };
    let (last, inside) = locate(points.len(), t);
    let mut bezier = vec![first];
    for piece in 0..last {
        bezier.extend(&to_bezier(window(points, piece))[1..]);
    }
    let [a, b, c, d] = to_bezier(window(points, last));
    let mix = |p: Vec3, q: Vec3| p + (q - p) * inside;
    let (ab, bc, cd) = (mix(a, b), mix(b, c), mix(c, d));
    let (abc, bcd) = (mix(ab, bc), mix(bc, cd));
    bezier.extend([ab, abc, mix(abc, bcd)]);
    bezier
}

/// Unit tangents at the vertices: the direction of `points[i + 1] - points[i - 1]`
/// with ends duplicated. Where that difference vanishes (two neighbours of a
/// vertex coincide) the outgoing, else the incoming edge is used; a curve without
/// any length gets +Z.
pub fn tangents(points: &[Vec3], tangents: &mut [Vec3]) {
    let last = points.len().saturating_sub(1);
    let mut previous = Vec3::Z;
    for i in 0..points.len() {
        let (before, after) = (points[i.saturating_sub(1)], points[(i + 1).min(last)]);
        previous = tangent(before, points[i], after, previous);
        tangents[i] = previous;
    }
}

/// Unit tangent at `here` between its neighbours; `previous` where all three coincide.
#[inline(always)]
pub(crate) fn tangent(before: Vec3, here: Vec3, after: Vec3, previous: Vec3) -> Vec3 {
    // The vector is chosen first, so that vectors of lanes pay for one root and one division.
    let usable = |v: Vec3| v.length_squared() > 0.0 && v.length_squared() < f32::INFINITY;
    let (across, outgoing, incoming) = (after - before, after - here, here - before);
    let edge = if usable(outgoing) { outgoing } else { incoming };
    let chosen = if usable(across) { across } else { edge };
    let unit = chosen * chosen.length_recip();
    if usable(chosen) { unit } else { previous }
}

/// Smallest axis-aligned box `(min, max)` around the curve itself, without widths.
///
/// The extremes of each cubic are found from the roots of its derivative, so the
/// box is tight (document 004 takes the looser box of the Bézier points).
/// `None` for no points.
pub fn bounds(points: &[Vec3]) -> Option<(Vec3, Vec3)> {
    let first = *points.first()?;
    let (mut low, mut high) = (first, first);
    for i in 0..points.len().saturating_sub(1) {
        let bezier = to_bezier(window(points, i));
        low = low.min(bezier[3]);
        high = high.max(bezier[3]);
        // The curve cannot leave a box that holds all four Bézier points.
        if bezier[1].cmplt(low).any()
            || bezier[2].cmplt(low).any()
            || bezier[1].cmpgt(high).any()
            || bezier[2].cmpgt(high).any()
        {
            widen_by_extremes(window(points, i), &mut low, &mut high);
        }
    }
    Some((low, high))
}

fn widen_by_extremes(window: [Vec3; 4], low: &mut Vec3, high: &mut Vec3) {
    let [a, b, c, d] = window;
    let linear = (c - a) * 0.5;
    let square = (a - b * 2.5 + c * 2.0 - d * 0.5) * 2.0;
    let cube = ((d - a) * 0.5 + (b - c) * 1.5) * 3.0;
    for axis in 0..3 {
        for t in roots_in_unit(cube[axis], square[axis], linear[axis]) {
            let p = position(window, t)[axis];
            low[axis] = low[axis].min(p);
            high[axis] = high[axis].max(p);
        }
    }
}

/// Roots of `a t² + b t + c` strictly inside 0..1.
fn roots_in_unit(a: f32, b: f32, c: f32) -> impl Iterator<Item = f32> {
    let (a, b, c) = (a as f64, b as f64, c as f64);
    let discriminant = b * b - 4.0 * a * c;
    let q = -0.5 * (b + discriminant.max(0.0).sqrt().copysign(b));
    let roots = [q / a, c / q];
    roots
        .into_iter()
        .filter(move |t| discriminant >= 0.0 && *t > 0.0 && *t < 1.0)
        .map(|t| t as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Basis, Curve, Wrap};
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = Vec3> {
        prop::array::uniform3(-10.0f32..10.0).prop_map(Vec3::from)
    }

    #[test]
    fn the_end_tangent_of_a_duplicated_end_is_half_the_first_edge() {
        let points = [Vec3::ZERO, Vec3::X, Vec3::new(2.0, 1.0, 0.0)];
        let bezier = to_bezier(window(&points, 0));
        let derivative = (bezier[1] - bezier[0]) * 3.0;
        assert!(derivative.distance(Vec3::X * 0.5) < 1e-6);
    }

    proptest! {
        #[test]
        fn bounds_hold_the_curve_and_touch_it(points in prop::collection::vec(point(), 2..9)) {
            let (low, high) = bounds(&points).unwrap();
            let (mut seen_low, mut seen_high) = (points[0], points[0]);
            for i in 0..points.len() - 1 {
                for k in 0..=256 {
                    let p = position(window(&points, i), k as f32 / 256.0);
                    seen_low = seen_low.min(p);
                    seen_high = seen_high.max(p);
                }
            }
            let slack = 1e-5 * 40.0;
            prop_assert!((seen_low - low).min_element() > -slack);
            prop_assert!((high - seen_high).min_element() > -slack);
            prop_assert!((seen_low - low).max_element() < 1e-2);
            prop_assert!((high - seen_high).max_element() < 1e-2);
        }

        #[test]
        fn a_cut_ends_on_the_curve_and_the_exact_one_is_the_curve(
            points in prop::collection::vec(point(), 2..9), t in 0.0f32..1.0
        ) {
            let (piece, inside) = locate(points.len(), t);
            let on_curve = position(window(&points, piece), inside);
            let (kept, end) = cut(&points, t).unwrap();
            prop_assert_eq!(end, on_curve);
            prop_assert!((2..=points.len()).contains(&kept) && kept <= piece + 2);
            let bezier = bezier_until(&points, t);
            prop_assert_eq!(bezier.len(), 3 * piece + 4);
            let curve = Curve::new(&bezier, Basis::Bezier, Wrap::Nonperiodic).unwrap();
            for k in 0..=64 {
                let along = k as f32 / 64.0;
                let last = curve.position(piece, along);
                let same = position(window(&points, piece), inside * along);
                prop_assert!(last.distance(same) < 1e-4, "{} {}", last, same);
            }
        }

        #[test]
        fn tangents_are_units_whatever_the_points(
            points in prop::collection::vec(prop::array::uniform3(-1i8..2), 1..8)
        ) {
            let points: Vec<_> =
                points.iter().map(|p| Vec3::new(p[0] as f32, p[1] as f32, p[2] as f32)).collect();
            let mut out = vec![Vec3::ZERO; points.len()];
            tangents(&points, &mut out);
            for t in out {
                prop_assert!((t.length() - 1.0).abs() < 1e-5);
            }
        }
    }
}
