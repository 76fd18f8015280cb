//! A hair's vertices from the Super-Helices of its guides, in the hair's local frame.
//!
//! Source: document 002 for the curve and its fit (`pelage_curves::super_helix`), document
//! 000, section 4.3, option 1, for mixing at equal fractions of arc length; the rest is our
//! own. Guides are told by a few elements of constant twist and curvatures, these are mixed,
//! and the hair is put together of them exactly. Local space, unit of the mesh; angles in
//! radians, per length of the whole guide, so that a smaller copy of a guide has the same.
//!
//! With ℓ for lengths, b for the bend (q1, q2) and τ for the twist q0 of an element:
//!
//! - ℓ = Σ w ℓ_i and b = Σ w ℓ_i b_i / Σ w ℓ_i: a guide without length has no say.
//! - τ is the mean weighted by ℓ_i |b_i|, as in the [`frenet`](super::frenet) stage: a
//!   straight guide does not wind, and does not unwind the others.
//!
//! Bends can be compared only in frames that are chosen alike. One that is chosen by the
//! surface sees curls of opposite phase bend to opposite sides, and cancels them as a mean of
//! vertices does; so each guide chooses its own: its first normal points to where it
//! bends. How the hair is turned at its root is no matter of that frame: it is
//! laid (`stages/laying`) on the mean of the guides' vertices, and by that the turns of the
//! shares in the tangent plane are in it.
//!
//! Limits: what is finer than an element is left out, also of a hair that has one guide alone,
//! so that nothing jumps there. Between a straight guide and a curl the bend falls and the
//! twist stays, so a tight curl fades by winding more slowly. Guides whose bends cancel
//! (an S as long one way as the other) choose a frame by little, and may choose opposite ones.

mod fit;

use super::laying::{self, Edges, Maker, says};
use super::weights::Share;
pub use fit::Helices;
use fit::bend;
use pelage_curves::glam::DMat3;
use pelage_curves::super_helix::Element;
use pelage_curves::{DVec3, Vec3};

/// One element of a guide, ready to be summed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Part {
    /// ℓ b.
    bend: [f32; 2],
    /// What the twist counts: ℓ |b|, and a little more.
    say: f32,
    /// That by τ.
    twist: f32,
}

/// Memory for the hairs side by side. Reused between chunks.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    walker: Walker,
    laid: laying::Scratch,
}

/// Puts hairs together of their elements.
#[derive(Clone, Debug, Default)]
struct Walker {
    mixed: Vec<Part>,
}

/// What a hair is made of.
#[derive(Clone, Copy, Debug)]
pub struct Parts<'a> {
    /// The guides of its group.
    pub helices: &'a Helices,
    /// How much of each guide.
    pub shares: &'a [Share],
}

/// Turns means of vertices into hairs. Hair `i` has the vertices `starts[i]..starts[i + 1]`
/// of `vertices`, one at least, which hold what [`interpolate`](super::interpolate) makes of
/// its guides, and is made of `parts(i)`; `None` leaves it as it is.
pub fn wind<'a>(
    parts: impl Fn(usize) -> Option<Parts<'a>>,
    starts: &[u32],
    scratch: &mut Scratch,
    vertices: &mut [Vec3],
) {
    let Scratch { walker, laid } = scratch;
    laying::lay(parts, starts, walker, laid, vertices);
}

impl Maker<Parts<'_>> for Walker {
    fn clear(&mut self) {}

    // One hair at a time: elements of hairs side by side need not meet at the same vertices.
    #[inline(always)]
    fn load(&mut self, lane: usize, parts: Parts, segments: usize, edges: &mut [Edges]) {
        let helices = parts.helices;
        let length = mix(parts, &mut self.mixed);
        let rates = self.mixed.iter().map(|part| rate(part, length));
        let mut wound = 0.0;
        walk(&helices.joints, rates, segments, |index, edge, turned| {
            let edge = (edge * length).as_vec3();
            wound += turned;
            edges[index].vector.set(lane, edge);
            edges[index].length[lane] = edge.length();
            edges[index].say[lane] = says(wound as f32);
        });
    }

    fn unroll(&mut self, _: &mut [Edges]) {}
}

/// Sums the elements of the guides; gives the hair's length.
#[inline(always)]
fn mix(parts: Parts, mixed: &mut Vec<Part>) -> f64 {
    let (helices, elements) = (parts.helices, parts.helices.elements());
    mixed.clear();
    mixed.resize(elements, Part::default());
    let mut length = 0.0;
    for share in parts.shares.iter().filter(|share| share.weight != 0.0) {
        let (guide, w) = (share.guide as usize, share.weight);
        length += f64::from(w) * f64::from(helices.lengths[guide]);
        let own = &helices.parts[guide * elements..][..elements];
        for (sum, part) in mixed.iter_mut().zip(own) {
            sum.bend[0] += w * part.bend[0];
            sum.bend[1] += w * part.bend[1];
            sum.say += w * part.say;
            sum.twist += w * part.twist;
        }
    }
    length
}

/// (q0, q1, q2) of a mixed element; straight where there is nothing to divide by.
#[inline(always)]
fn rate(part: &Part, length: f64) -> DVec3 {
    let over = |x: f32, whole: f64| {
        if whole > 0.0 {
            f64::from(x) / whole
        } else {
            0.0
        }
    };
    let twist = over(part.twist, f64::from(part.say));
    DVec3::new(
        twist,
        over(part.bend[0], length),
        over(part.bend[1], length),
    )
}

/// Calls `edge` with the index and the vector of each of `segments` edges of equal arc length,
/// of a hair of length 1 that starts along +X, and with how far it winds along it.
#[inline(always)]
fn walk(
    joints: &[f64],
    rates: impl Iterator<Item = DVec3>,
    segments: usize,
    mut edge: impl FnMut(usize, DVec3, f64),
) {
    let (mut frame, mut index, mut from) = (DMat3::IDENTITY, 0, 0.0);
    // What of the edge is done.
    let (mut vector, mut turned, mut is_begun) = (DVec3::ZERO, 0.0, false);
    for (rate, ends) in rates.zip(joints.windows(2)) {
        let winds = winding(rate);
        // Whole edges of one element are all alike.
        let whole = motion(rate, 1.0 / segments as f64);
        while index < segments && from < ends[1] {
            let end = (index + 1) as f64 / segments as f64;
            let to = end.min(ends[1]);
            let (turn, shift) = match is_begun || to < end {
                true => motion(rate, to - from),
                false => whole,
            };
            vector += frame * shift;
            turned += winds * (to - from);
            frame *= turn;
            (from, is_begun) = (to, to < end);
            if !is_begun {
                edge(index, vector, turned);
                (vector, turned) = (DVec3::ZERO, 0.0);
                index += 1;
            }
        }
    }
}

/// Turn and shift over a part of a hair of length 1.
#[inline(always)]
fn motion(rate: DVec3, length: f64) -> (DMat3, DVec3) {
    let element = Element {
        length,
        twist: rate.x,
        curvatures: [rate.y, rate.z],
    };
    element.motion()
}

/// How fast a hair winds; where hardly anything bends a twist is noise.
#[inline(always)]
fn winding(rate: DVec3) -> f64 {
    let bend = bend(rate);
    bend + rate.x.abs().min(4.0 * bend)
}

#[cfg(test)]
mod tests;
