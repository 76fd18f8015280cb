//! A hair's vertices from the bends and twists of its guides, in the hair's local frame.
//!
//! Source: document 000, section 4.3, option 1, with its errata: curvature and torsion
//! are interpolated at equal fractions of arc length, the length too, and the hair is put
//! together of them (section 4.1). Curls stay curls where guides wind at different phases,
//! which in a mean of vertices cancel. Local space, unit of the mesh, angles as tangents
//! of their halves.
//!
//! κ ds and τ ds are those of the polygon through a guide's resampled vertices (see
//! [`polygon`](pelage_curves::frenet::polygon)), so that equal guides reproduce the guide
//! however coarse. With ℓ for lengths, k and t for tan(κ ds / 2) and tan(τ ds / 2):
//!
//! - ℓ = Σ w ℓ_i and k = Σ w ℓ_i k_i / Σ w ℓ_i: a guide without length has no say.
//! - t is the mean weighted by ℓ_i |k_i|, as κτ B̂ in the document: a straight guide does
//!   not wind, and its torsion, which is none, does not unwind the others.
//!
//! How the hair is turned at its root: such that it fits the mean of the guides' vertices,
//! end on end, and rolled about that line as the tangents agree best. (The document's mean
//! of the first bases tilts a coat of curls: DESIGN.md, "Why are curls fitted?".)
//!
//! Limits: hairs all around three guides whose phases go round once cannot all be curls
//! and change smoothly. Where guides say nothing of the roll, or of the line, the hair goes
//! over into the mean of the vertices, stretched to its length.

use super::interpolate;
use super::weights::Share;
use pelage_curves::frenet::polygon::Polygon;
use pelage_curves::{Vec3, any_perpendicular};

/// Bends below this angle are noise of f32 vertices, and have no plane.
const STRAIGHT: f64 = 1e-4;

/// Tangent of half the sharpest bend: a fold has none.
const SHARPEST: f64 = 1e3;

/// Weight of torsion where nothing bends, beside 1 for a bend of a right angle: so small
/// that a curl's winding wins, and not 0, so that there is always a mean.
const LEAST_SAY: f64 = 1e-3;

/// Below this part of full agreement about the roll a hair goes over to the mean: less
/// keeps more of the curls, more lets neighbours there differ less.
const AGREEMENT: f32 = 0.2;

/// Mean square of the sine between a hair and its line below which it counts as straight:
/// some two degrees.
const SLENDER: f32 = 1e-3;

/// Distance from root to tip, as a part of the length, below which it is no line to lie on.
const SHORT: f32 = 0.1;

/// Where the mean of directions is shorter than this they have hardly a common one.
const COMMON: f32 = 0.1;

/// An edge of a guide and the corner before it, ready to be summed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Corner {
    /// Length of the edge.
    length: f32,
    /// ℓ k, with ℓ the mean of the lengths beside the corner.
    bend: f32,
    /// What the twist counts: ℓ |k|.
    say: f32,
    /// That by t.
    twist: f32,
}

/// Memory for a hair. Reused between hairs.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    corners: Vec<Corner>,
    edges: Vec<Edge>,
}

/// An edge of a hair that starts along +X.
#[derive(Clone, Copy, Debug, Default)]
struct Edge {
    vector: Vec3,
    /// How much it says of the hair's roll.
    say: f32,
}

/// The corners of a guide through `vertices`, one fewer than these.
pub fn corners(vertices: &[Vec3]) -> Vec<Corner> {
    let exact: Vec<_> = vertices.iter().map(|v| v.as_dvec3()).collect();
    let turns = Polygon::of(&exact, STRAIGHT).map_or(Vec::new(), |polygon| polygon.turns);
    let mut before = turns.first().map_or(0.0, |turn| turn.length);
    let corner = turns.iter().map(|turn| {
        let length = (before + turn.length) / 2.0;
        before = turn.length;
        let k = libm::tan(turn.bend / 2.0).clamp(-SHARPEST, SHARPEST);
        let say = length * (k.abs().min(1.0) + LEAST_SAY);
        Corner {
            length: turn.length as f32,
            bend: (length * k) as f32,
            say: say as f32,
            twist: (say * libm::tan(turn.twist / 2.0)) as f32,
        }
    });
    let mut corners: Vec<Corner> = corner.collect();
    corners.resize(vertices.len().saturating_sub(1), Corner::default());
    corners
}

/// Writes the vertices of a hair. `guides` holds the vertices of all guides of the group,
/// `hair.len()` each, one guide after the other, and `profiles` their [`corners`].
pub fn interpolate(
    guides: &[Vec3],
    profiles: &[Corner],
    shares: &[Share],
    scratch: &mut Scratch,
    hair: &mut [Vec3],
) {
    interpolate::interpolate(guides, shares, hair);
    // One guide alone is its own mean.
    if shares.len() < 2 || hair.len() < 2 {
        return;
    }
    let Scratch { corners, edges } = scratch;
    corners.clear();
    corners.resize(hair.len() - 1, Corner::default());
    edges.resize(hair.len() - 1, Edge::default());
    mix(profiles, shares, corners);
    unroll(corners, edges);
    let fit = Fit::new(corners, edges, hair);
    fit.place(corners, edges, hair);
}

/// Sums the corners of the guides.
#[inline]
fn mix(profiles: &[Corner], shares: &[Share], corners: &mut [Corner]) {
    for share in shares {
        let (first, w) = (share.guide as usize * corners.len(), share.weight);
        for (sum, guide) in corners.iter_mut().zip(&profiles[first..]) {
            sum.length += w * guide.length;
            sum.bend += w * guide.bend;
            sum.say += w * guide.say;
            sum.twist += w * guide.twist;
        }
    }
}

/// Writes the edges of the hair that has these corners and starts along +X.
///
/// How much an edge says of the roll falls with how far the hair has wound before it:
/// guides that wind at different rates come to disagree.
#[inline]
fn unroll(corners: &[Corner], edges: &mut [Edge]) {
    let mut wound = 0.0;
    let (mut t, mut n, mut b) = (Vec3::X, Vec3::Y, Vec3::Z);
    let mut before = corners.first().map_or(0.0, |corner| corner.length);
    for (corner, edge) in corners.iter().zip(edges) {
        let length = 0.5 * (before + corner.length);
        before = corner.length;
        let (cosine, sine) = turn(corner.twist, corner.say);
        (n, b) = (n * cosine + b * sine, b * cosine - n * sine);
        let twist = angle(cosine, sine);
        let (cosine, sine) = turn(corner.bend, length);
        (t, n) = (t * cosine + n * sine, n * cosine - t * sine);
        let bend = angle(cosine, sine);
        // Where hardly anything bends a twist is noise.
        wound += bend + twist.min(4.0 * bend);
        let fades = 1.0 / (1.0 + 0.25 * wound * wound);
        *edge = Edge {
            vector: t * corner.length,
            say: fades * fades,
        };
    }
}

/// Cosine and sine of an angle whose half has the tangent `part / whole`; (1, 0) for 0 / 0.
#[inline]
fn turn(part: f32, whole: f32) -> (f32, f32) {
    let (p, q) = (part * part, whole * whole);
    let square = p + q;
    if square > 0.0 {
        let over = 1.0 / square;
        ((q - p) * over, 2.0 * part * whole * over)
    } else {
        (1.0, 0.0)
    }
}

/// Grows with the size of an angle, as fast where it is small.
#[inline]
fn angle(cosine: f32, sine: f32) -> f32 {
    1.0 - cosine + sine.abs()
}

/// A line with two directions across it; right-handed, orthonormal.
#[derive(Clone, Copy)]
struct Axes([Vec3; 3]);

impl Axes {
    fn along(line: Vec3) -> Self {
        let aside = any_perpendicular(line);
        Self([line, aside, line.cross(aside)])
    }

    /// Coordinates of `v` across the line.
    #[inline]
    fn across(&self, v: Vec3) -> [f32; 2] {
        [v.dot(self.0[1]), v.dot(self.0[2])]
    }
}

/// How the hair lies: axes of its own, those they come to lie on, and how much of it is
/// taken instead of the mean (0..=1).
struct Fit {
    from: Axes,
    onto: Axes,
    share: f32,
}

impl Fit {
    /// Fits `edges` to the mean of the vertices, `mean`.
    fn new(corners: &[Corner], edges: &[Edge], mean: &[Vec3]) -> Self {
        let length: f32 = corners.iter().map(|corner| corner.length).sum();
        let chord: Vec3 = edges.iter().map(|edge| edge.vector).sum();
        let whole = mean[mean.len() - 1] - mean[0];
        let line = |v: Vec3| v.try_normalize().unwrap_or(Vec3::Z);
        let (from, mut onto) = (Axes::along(line(chord)), Axes::along(line(whole)));
        // Over the hair: ∫ a·b, ∫ a×b and ∫ a·a of what lies across the lines.
        let (mut dot, mut cross, mut size, mut said) = (0.0, 0.0, 0.0, 0.0);
        for ((corner, edge), pair) in corners.iter().zip(edges).zip(mean.windows(2)) {
            if corner.length > 0.0 {
                let [x, y] = from.across(edge.vector);
                let [u, v] = onto.across(pair[1] - pair[0]);
                let over = edge.say / corner.length;
                said += edge.say * corner.length;
                dot += (x * u + y * v) * over;
                cross += (x * v - y * u) * over;
                size += (x * x + y * y) * over;
            }
        }
        let agreement = (dot * dot + cross * cross).sqrt();
        if agreement > 0.0 {
            let (cosine, sine) = (dot / agreement, cross / agreement);
            let [_, u, v] = onto.0;
            onto.0[1] = u * cosine + v * sine;
            onto.0[2] = v * cosine - u * sine;
        }
        let full = AGREEMENT * size + SLENDER * said;
        let short = SHORT * length;
        let share =
            smooth(agreement, full) * smooth(chord.length(), short) * smooth(whole.length(), short);
        Self { from, onto, share }
    }

    /// Writes the vertices over those of the mean, edge by edge at full length.
    fn place(&self, corners: &[Corner], edges: &[Edge], hair: &mut [Vec3]) {
        let [a, b, c] = self.from.0;
        let [x, y, z] = self.onto.0;
        let (own, rest) = (self.share, 1.0 - self.share);
        let mut before = hair[0];
        let mut end = hair[0];
        for ((corner, edge), vertex) in corners.iter().zip(edges).zip(&mut hair[1..]) {
            let mean = *vertex - before;
            before = *vertex;
            let edge = edge.vector;
            let placed = x * edge.dot(a) + y * edge.dot(b) + z * edge.dot(c);
            end += stretched(mean * rest + placed * own, corner.length);
            *vertex = end;
        }
    }
}

/// `edge` at `length`, which it has already or falls short of; less where it is almost 0,
/// so that the result does not jump there.
#[inline]
fn stretched(edge: Vec3, length: f32) -> Vec3 {
    let soft = COMMON * COMMON * length * length;
    let square = edge.length_squared() + soft;
    if square > 0.0 {
        edge * ((length * length + soft) / square).sqrt()
    } else {
        edge
    }
}

/// 0 at 0, 1 from `full` on, and smooth between; 0 where both are 0.
fn smooth(x: f32, full: f32) -> f32 {
    if x >= full && x > 0.0 {
        return 1.0;
    }
    let t = if x > 0.0 { x / full } else { 0.0 };
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
#[path = "frenet_tests.rs"]
mod tests;
