//! Clumps: hairs drawn to the hair in the middle of their clump.
//!
//! Ours; document 004 has none. A vertex p of a hair moves to p + w (m - p), where
//! w = root · (1 - t) + tip · t with t = i / segments, or by a ramp; m is the point of the middle
//! hair that is as far from its root along the hair: a hair shorter than the middle one
//! ends before its tip, and one longer goes on straight. The root stays. Lengths are
//! nominal, those of the guides as they are mixed and scaled.
//!
//! Works on the pose, so that a clump that closes at rest closes in all poses, and after
//! frizz and kink, so that a clump has those of its middle hair as a whole. Unit of the
//! mesh.

use crate::profile::{Profile, line};
use pelage_curves::{Vec3, catmull_rom};

/// A hair's place in a clump.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member {
    /// Number of the clump, if it has one.
    pub clump: Option<u32>,
    /// How far it is drawn to the middle at root and tip, 0..=1; with a ramp, the first
    /// multiplies it.
    pub drawn: [f32; 2],
    /// Segments of the middle hair that are as long as one of this.
    pub pace: f32,
}

impl Member {
    /// A hair without a clump.
    pub const NONE: Self = Self {
        clump: None,
        drawn: [0.0; 2],
        pace: 1.0,
    };
}

/// Draws a hair to `middle`, the hair in the middle of its clump, along hairs as `drawn`
/// has it.
pub(crate) fn draw(drawn: &Profile<2>, member: &Member, middle: &[Vec3], hair: &mut [Vec3]) {
    let step = 1.0 / (hair.len().max(2) - 1) as f32;
    for (i, vertex) in hair.iter_mut().enumerate().skip(1) {
        let t = i as f32 * step;
        let toward = point(middle, i as f32 * member.pace);
        *vertex += (toward - *vertex) * drawn.at(member.drawn, t, line);
    }
}

/// The point `along` segments from the root of `curve`, which goes on straight at its end.
///
/// Catmull-Rom with ends that go on straight, unlike those of a finished hair: points in
/// between then stand as evenly on a straight curve as its vertices.
fn point(curve: &[Vec3], along: f32) -> Vec3 {
    let segments = curve.len().saturating_sub(1);
    let segment = along as usize;
    if segment < segments {
        let [before, from, to, after] = catmull_rom::window(curve, segment);
        let first = segment == 0;
        let last = segment + 1 == segments;
        let window = [
            if first { from * 2.0 - to } else { before },
            from,
            to,
            if last { to * 2.0 - from } else { after },
        ];
        return catmull_rom::position(window, along - segment as f32);
    }
    match curve {
        [.., before, last] => *last + (*last - *before) * (along - segments as f32),
        [only] => *only,
        [] => Vec3::ZERO,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn straight(segments: usize, step: Vec3) -> Vec<Vec3> {
        (0..=segments).map(|i| step * i as f32).collect()
    }

    #[test]
    fn a_hair_wholly_drawn_lies_on_the_middle_one_at_its_own_length() {
        let middle = straight(6, Vec3::Z);
        for pace in [0.25, 0.5, 1.0, 2.0] {
            let mut hair = straight(4, Vec3::X * pace);
            let member = Member {
                clump: Some(0),
                drawn: [1.0, 1.0],
                pace,
            };
            draw(&Profile::plain(), &member, &middle, &mut hair);
            for (i, vertex) in hair.iter().enumerate() {
                let expected = Vec3::Z * (i as f32 * pace);
                assert!(vertex.distance(expected) < 1e-5, "{vertex}");
            }
        }
    }

    #[test]
    fn a_hair_not_drawn_stays_to_the_bit() {
        let mut hair = straight(4, Vec3::new(0.1, 0.7, 0.3));
        let before = hair.clone();
        let member = Member {
            clump: Some(0),
            drawn: [0.0, 0.0],
            pace: 1.0,
        };
        draw(&Profile::plain(), &member, &straight(4, Vec3::Z), &mut hair);
        assert_eq!(hair, before);
    }
}
