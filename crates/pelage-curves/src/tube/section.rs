//! A closed cross-section, in units of the radius.

use super::TubeError;
use glam::DVec2;

/// Most points around: pairs of edges are compared, and a square of this is still quick.
const MOST: usize = 4096;

/// A simple closed polygon: what a tube is cut across. It goes round counter-clockwise, x
/// along the frame's normal and y along its binormal, around the curve at 0 (which need not
/// be inside).
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    points: Vec<DVec2>,
    columns: Vec<Column>,
}

/// A vertex of a ring: a point of the section may have two, with the normals of the edges
/// that meet in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Column {
    /// Index of the point.
    pub point: usize,
    /// Unit, outward.
    pub normal: DVec2,
    /// Fraction of the perimeter, 0..=1.
    pub u: f64,
    /// Whether an edge leads on to the next column, instead of a crease.
    pub joined: bool,
}

impl Section {
    /// The section through `points` (3 to 4096; not closed by a repeated first one), turned
    /// round if it goes clockwise. Corners that turn by more than `crease` radians get an
    /// edge, others are shaded smoothly: 0 for all edges sharp, π for none.
    ///
    /// # Errors
    ///
    /// [`TubeError::Points`], [`TubeError::Section`], [`TubeError::SelfTouching`]: a section
    /// that touches itself has no inside to close with a cap.
    pub fn new(points: &[DVec2], crease: f64) -> Result<Self, TubeError> {
        if !(3..=MOST).contains(&points.len()) {
            return Err(TubeError::Points {
                found: points.len(),
            });
        }
        if let Some(index) = points.iter().position(|p| !p.is_finite()) {
            return Err(TubeError::Section { index });
        }
        // Brings products of coordinates into range.
        let size = points
            .iter()
            .fold(0.0, |a: f64, p| a.max(p.abs().max_element()));
        let small: Vec<DVec2> = points
            .iter()
            .map(|&p| p / size.max(f64::MIN_POSITIVE))
            .collect();
        check_simple(&small)?;
        let edges = small.iter().zip(small.iter().cycle().skip(1));
        let area: f64 = edges.map(|(a, b)| a.perp_dot(*b)).sum();
        let mut points = points.to_vec();
        if area < 0.0 {
            points.reverse();
        }
        let columns = columns(&points, crease);
        Ok(Self { points, columns })
    }

    /// A regular polygon of `sides` (3 to 4096) in the unit circle, shaded as the circle.
    ///
    /// # Errors
    ///
    /// [`TubeError::Points`].
    pub fn circle(sides: usize) -> Result<Self, TubeError> {
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / sides as f64;
        let point = |i| DVec2::new(libm::cos(angle(i)), libm::sin(angle(i)));
        let points: Vec<DVec2> = (0..sides.min(MOST + 1)).map(point).collect();
        Self::new(&points, std::f64::consts::PI)
    }

    /// Its points, counter-clockwise.
    pub fn points(&self) -> &[DVec2] {
        &self.points
    }

    /// Vertices of a ring in order around; the last column is the first point again, with
    /// u = 1.
    pub(super) fn columns(&self) -> &[Column] {
        &self.columns
    }
}

fn columns(points: &[DVec2], crease: f64) -> Vec<Column> {
    let n = points.len();
    let edge = |i: usize| points[(i + 1) % n] - points[i % n];
    let outward = |i: usize| -edge(i).perp().normalize_or_zero();
    let perimeter: f64 = (0..n).map(|i| edge(i).length()).sum();
    let mut columns = Vec::with_capacity(n + 1);
    let mut length = 0.0;
    for i in 0..=n {
        let (before, after) = (outward(i + n - 1), outward(i));
        let both = (before + after).normalize_or(after);
        let corner = libm::atan2(before.perp_dot(after).abs(), before.dot(after));
        let u = if i == n { 1.0 } else { length / perimeter };
        let column = |normal, joined| Column {
            point: i % n,
            normal,
            u,
            joined,
        };
        match (corner > crease, i) {
            (true, 0) => columns.push(column(after, true)),
            (true, i) if i == n => columns.push(column(before, false)),
            (true, _) => columns.extend([column(before, false), column(after, true)]),
            (false, i) => columns.push(column(both, i < n)),
        }
        length += edge(i).length();
    }
    columns
}

/// Refuses the first two edges that have more than a shared end in common.
fn check_simple(points: &[DVec2]) -> Result<(), TubeError> {
    let n = points.len();
    for first in 0..n {
        for second in first + 1..n {
            let [a, b] = [points[first], points[(first + 1) % n]];
            let [c, d] = [points[second], points[(second + 1) % n]];
            let touch = match (second == first + 1, (second + 1) % n == first) {
                // Neighbours share a point; a triangle's edges do so at one end only.
                (true, _) => folds_back(a, b, d),
                (_, true) => folds_back(c, d, b),
                _ => touching([a, b], [c, d]),
            };
            if touch {
                return Err(TubeError::SelfTouching { first, second });
            }
        }
    }
    Ok(())
}

/// Whether the edge from `b` to `c` lies on that from `a` to `b`, or one has no length.
fn folds_back(a: DVec2, b: DVec2, c: DVec2) -> bool {
    let (before, after) = (b - a, c - b);
    let folded = before.perp_dot(after) == 0.0 && before.dot(after) <= 0.0;
    folded || before == DVec2::ZERO || after == DVec2::ZERO
}

fn touching([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    let apart = a.max(b).cmplt(c.min(d)).any() || c.max(d).cmplt(a.min(b)).any();
    let side = |p: DVec2, q: DVec2, r: DVec2| {
        let area = (q - p).perp_dot(r - p);
        (area > 0.0) as i8 - (area < 0.0) as i8
    };
    !apart && side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0
}
