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
//! How the hair is turned at its root: laid (`stages/laying`) on the mean of the guides'
//! vertices.
//!
//! Along one hair each edge waits for the one before, so sixteen hairs are walked side by
//! side; what is done is done lane by lane, and a hair has the same bits whatever its
//! neighbours.
//!
//! Limits: between a straight guide and a curl κ falls and τ stays, so a tight curl fades by
//! winding more slowly, up to half as wide again on the way. Plane bends to opposite sides
//! and S shapes whose signs do not match go over into the mean of the vertices.

use super::laying::{self, Edges, Maker, says};
use super::weights::Share;
use crate::lanes::{LANES, Row, Rows};
use pelage_curves::Vec3;
use pelage_curves::frenet::polygon::Polygon;

/// Bends below this angle are noise of f32 vertices, and have no plane.
const STRAIGHT: f64 = 1e-4;

/// Tangent of half the sharpest bend: a fold has none.
const SHARPEST: f64 = 1e3;

/// Weight of torsion where nothing bends, beside 1 for a bend of a right angle: so small
/// that a curl's winding wins, and not 0, so that there is always a mean.
const LEAST_SAY: f64 = 1e-3;

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

/// The mixed corners of hairs side by side.
#[derive(Clone, Copy, Debug, Default)]
struct Corners {
    length: Row,
    bend: Row,
    say: Row,
    twist: Row,
}

/// Memory for the hairs side by side. Reused between chunks.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    winder: Winder,
    laid: laying::Scratch,
}

/// Puts hairs together of their corners.
#[derive(Clone, Debug, Default)]
struct Winder {
    mixed: Vec<Corner>,
    corners: Vec<Corners>,
}

/// What a hair is made of.
#[derive(Clone, Copy, Debug)]
pub struct Parts<'a> {
    /// The [`corners`] of all guides of its group, one guide after the other, as many a
    /// guide as the hair has segments.
    pub corners: &'a [Corner],
    /// How much of each guide.
    pub shares: &'a [Share],
}

/// Turns means of vertices into hairs. Hair `i` has the vertices `starts[i]..starts[i + 1]`
/// of `vertices`, which hold what [`interpolate`](super::interpolate) makes of its guides,
/// and is made of `parts(i)`; `None` leaves it as it is.
pub fn wind<'a>(
    parts: impl Fn(usize) -> Option<Parts<'a>>,
    starts: &[u32],
    scratch: &mut Scratch,
    vertices: &mut [Vec3],
) {
    // One guide alone is its own mean.
    let shared = |i: usize| parts(i).filter(|p| p.shares.len() > 1);
    let Scratch { winder, laid } = scratch;
    laying::lay(shared, starts, winder, laid, vertices);
}

impl Maker<Parts<'_>> for Winder {
    fn clear(&mut self) {
        self.corners.clear();
    }

    #[inline(always)]
    fn load(&mut self, lane: usize, parts: Parts, segments: usize, _: &mut [Edges]) {
        self.mixed.clear();
        self.mixed.resize(segments, Corner::default());
        mix(parts, &mut self.mixed);
        if self.corners.len() < segments {
            self.corners.resize(segments, Corners::default());
        }
        for (row, corner) in self.corners.iter_mut().zip(&self.mixed) {
            row.length[lane] = corner.length;
            row.bend[lane] = corner.bend;
            row.say[lane] = corner.say;
            row.twist[lane] = corner.twist;
        }
    }

    /// Makes the edges that have these corners, of hairs that start along +X.
    #[inline(always)]
    fn unroll(&mut self, edges: &mut [Edges]) {
        let (mut tangents, mut normals, mut binormals) =
            (Rows::default(), Rows::default(), Rows::default());
        for lane in 0..LANES {
            tangents.set(lane, Vec3::X);
            normals.set(lane, Vec3::Y);
            binormals.set(lane, Vec3::Z);
        }
        let (mut before, mut wound) = ([0.0; LANES], [0.0; LANES]);
        for (corner, edge) in self.corners.iter().zip(edges) {
            // Copies, so that the compiler sees that nothing overlaps.
            let (corner, mut made) = (*corner, Edges::default());
            for lane in 0..LANES {
                let (t, n, b) = (tangents.get(lane), normals.get(lane), binormals.get(lane));
                let here = corner.length[lane];
                let length = 0.5 * (before[lane] + here);
                let (cosine, sine) = turn(corner.twist[lane], corner.say[lane]);
                let (n, b) = (n * cosine + b * sine, b * cosine - n * sine);
                let twist = angle(cosine, sine);
                let (cosine, sine) = turn(corner.bend[lane], length);
                let (t, n) = (t * cosine + n * sine, n * cosine - t * sine);
                let bend = angle(cosine, sine);
                // Where hardly anything bends a twist is noise.
                let wound_here = wound[lane] + bend + twist.min(4.0 * bend);
                tangents.set(lane, t);
                normals.set(lane, n);
                binormals.set(lane, b);
                before[lane] = here;
                wound[lane] = wound_here;
                made.vector.set(lane, t * here);
                made.length[lane] = here;
                made.say[lane] = says(wound_here);
            }
            *edge = made;
        }
    }
}

/// Sums the corners of the guides.
#[inline(always)]
fn mix(parts: Parts, corners: &mut [Corner]) {
    for share in parts.shares {
        let (first, w) = (share.guide as usize * corners.len(), share.weight);
        let guide = &parts.corners[first..first + corners.len()];
        for (sum, guide) in corners.iter_mut().zip(guide) {
            sum.length += w * guide.length;
            sum.bend += w * guide.bend;
            sum.say += w * guide.say;
            sum.twist += w * guide.twist;
        }
    }
}

/// Cosine and sine of an angle whose half has the tangent `part / whole`; (1, 0) for 0 / 0
/// and what is so small that its square is hardly a number.
#[inline(always)]
fn turn(part: f32, whole: f32) -> (f32, f32) {
    // Powers of two change no bit. Guides that turn back have parts a hundred million times
    // their size, whose squares may be beyond floats.
    const HUGE: f32 = (1u64 << 60) as f32;
    const SMALLER: f32 = 1.0 / (1u128 << 80) as f32;
    let scale = if part.abs().max(whole.abs()) > HUGE {
        SMALLER
    } else {
        1.0
    };
    let (part, whole) = (part * scale, whole * scale);
    let (p, q) = (part * part, whole * whole);
    let square = p + q;
    let over = 1.0 / square;
    let is_angle = square > 1e-37;
    (
        if is_angle { (q - p) * over } else { 1.0 },
        if is_angle {
            2.0 * part * whole * over
        } else {
            0.0
        },
    )
}

/// Grows with the size of an angle, as fast where it is small.
#[inline(always)]
fn angle(cosine: f32, sine: f32) -> f32 {
    1.0 - cosine + sine.abs()
}

#[cfg(test)]
mod tests;
