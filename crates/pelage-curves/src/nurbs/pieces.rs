//! From control points over knots to Bézier pieces.

use glam::DVec4;

/// Distinct knots of the domain, and the homogeneous Bézier points of the pieces between
/// them, of degree 3 at least; neighbours share an end.
pub(super) fn bezier(degree: usize, controls: &[DVec4], knots: &[f64]) -> (Vec<f64>, Vec<DVec4>) {
    let stride = degree.max(3);
    let domain = &knots[degree..=controls.len()];
    let pieces = domain.windows(2).filter(|k| k[0] < k[1]).count();
    let mut breaks = Vec::with_capacity(pieces + 1);
    let mut bezier = Vec::with_capacity(pieces * stride + 1);
    let mut scratch = Vec::with_capacity(degree + 1);
    breaks.push(domain[0]);
    for span in degree..controls.len() {
        let ends = [knots[span], knots[span + 1]];
        if ends[0] == ends[1] {
            continue;
        }
        let mut points: Vec<DVec4> = (0..=degree)
            .map(|ups| blossom(degree, controls, knots, span, ends, ups, &mut scratch))
            .collect();
        while points.len() <= stride {
            points = raised(&points);
        }
        // The end of the piece before, to the bit.
        let skip = usize::from(!bezier.is_empty());
        bezier.extend(&points[skip..]);
        breaks.push(ends[1]);
    }
    (breaks, bezier)
}

/// The polar form of the piece over knot `span` at `ups` times its end and else its start:
/// Bézier point `ups`. All steps are convex combinations.
fn blossom(
    degree: usize,
    controls: &[DVec4],
    knots: &[f64],
    span: usize,
    ends: [f64; 2],
    ups: usize,
    scratch: &mut Vec<DVec4>,
) -> DVec4 {
    scratch.clear();
    scratch.extend(&controls[span - degree..=span]);
    for level in 1..=degree {
        let u = ends[usize::from(level <= ups)];
        for j in (level..=degree).rev() {
            let i = span - degree + j;
            let (low, high) = (knots[i], knots[i + degree + 1 - level]);
            scratch[j] = mix(scratch[j - 1], scratch[j], (u - low) / (high - low));
        }
    }
    scratch[degree]
}

/// The same Bézier curve of one degree more.
fn raised(points: &[DVec4]) -> Vec<DVec4> {
    let n = points.len();
    let inner = (1..n).map(|i| mix(points[i], points[i - 1], i as f64 / n as f64));
    let ends = (points[0], points[n - 1]);
    [ends.0].into_iter().chain(inner).chain([ends.1]).collect()
}

/// Between two points, exact at both.
pub(super) fn mix(a: DVec4, b: DVec4, t: f64) -> DVec4 {
    a * (1.0 - t) + b * t
}
