//! Multi-strands: each hair a bundle of fibres around it.
//!
//! Source: document 004, section 2.2.7, equation 2.5, with its errata: the twist is shared
//! out over the segments, so that it is the whole turn from root to tip, and fibres are
//! scaled by `1 - randomize · ξ`. Vertex i of a fibre lies in the plane of the hair's normal
//! N and binormal B there,
//! `P = (1 - lack) · (M + splay · (x (c N + a s B) + y (a c B - s N)) + offset · t³ · N)`,
//! where t = i / segments, M is the hair's vertex seen from its root, (x, y) the fibre's
//! place in the unit disc, c and s cosine and sine of `twist · t`, a the aspect, and splay is
//! `w · border + (1 - w) · center` with w = 4 (t - ½)² and the border that of the nearer end,
//! or a ramp. All but (x, y) and the lack `randomize · ξ` is the same for the fibres of a
//! hair.
//!
//! Space of the pose, unit of the mesh, angles in radians. Maps are read at the root of
//! the hair.

use crate::PlanError;
use crate::maps::{FieldMaker, ScalarField};
use crate::profile::Profile;
use crate::random::{Channel, uniform, word};
use crate::recipe;
use pelage_curves::{Vec2, Vec3};
use std::f32::consts::{FRAC_PI_2, FRAC_PI_4};

/// The properties of bundles over the surface.
#[derive(Clone, Debug)]
pub struct StrandFields {
    /// Fibres a hair, at least 1.
    pub fibers: u32,
    splay: Profile<3>,
    twist: ScalarField,
    aspect: ScalarField,
    offset: ScalarField,
    randomize: ScalarField,
}

/// The bundle of one hair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bundle {
    /// Largest distance of fibres from the hair at its root, centre and tip; with a ramp,
    /// the first multiplies it.
    pub splay: [f32; 3],
    /// Turn from root to tip.
    pub twist: f32,
    /// Extent along the binormal over that along the normal.
    pub aspect: f32,
    /// Shift of the tip along the normal.
    pub offset: f32,
    /// Part of their length that fibres may lack, 0..=1.
    pub randomize: f32,
}

/// A fibre in its bundle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fiber {
    /// Place in the unit disc.
    pub place: Vec2,
    /// Part of the hair's size that it lacks, 0..=1.
    pub lack: f32,
}

/// What the fibres of a hair have in common at a vertex.
#[derive(Clone, Copy, Debug, Default)]
pub struct Section {
    middle: Vec3,
    across: [Vec3; 2],
}

impl StrandFields {
    /// Reads `[strand]`; `None` where hairs are single.
    pub(crate) fn new(
        strand: &recipe::Strand,
        maker: &mut FieldMaker,
    ) -> Result<Option<Self>, PlanError> {
        let splay = &strand.splay;
        let fields = Self {
            fibers: strand.count,
            splay: Profile::new(
                "strand.splay",
                [
                    ("root", &splay.root),
                    ("center", &splay.center),
                    ("tip", &splay.tip),
                ],
                maker,
            )?,
            twist: maker.scalar("strand.twist", &strand.twist)?,
            aspect: maker.scalar("strand.aspect", &strand.aspect)?,
            offset: maker.scalar("strand.offset", &strand.offset)?,
            randomize: maker.scalar("strand.randomize", &strand.randomize)?,
        };
        Ok((strand.count > 0).then_some(fields))
    }

    /// The distance of fibres along hairs.
    pub(crate) fn splay(&self) -> &Profile<3> {
        &self.splay
    }

    /// Its properties, in the order in which [`Bundle::new`] takes their values.
    pub(crate) fn fields(&self) -> [&ScalarField; 7] {
        let [root, center, tip] = self.splay.fields();
        let (twist, aspect) = (&self.twist, &self.aspect);
        [
            root,
            center,
            tip,
            twist,
            aspect,
            &self.offset,
            &self.randomize,
        ]
    }
}

impl Bundle {
    /// The bundle of a hair from what its properties are at its root.
    pub(crate) fn new(values: [f32; 7]) -> Self {
        let [root, center, tip, twist, aspect, offset, randomize] = values;
        Self {
            splay: [root, center, tip].map(|splay| splay.max(0.0)),
            twist: twist.to_radians(),
            aspect: aspect.max(0.0),
            offset,
            randomize: randomize.clamp(0.0, 1.0),
        }
    }

    /// Fibre number `fiber` of hair `hair` in the groom seeded `seed`.
    pub fn fiber(&self, seed: u64, hair: u64, fiber: u32) -> Fiber {
        let lack = match self.randomize > 0.0 {
            true => {
                let hair = word(seed, hair, Channel::FiberLength);
                self.randomize * uniform(hair, fiber as u64, Channel::FiberLength)
            }
            false => 0.0,
        };
        Fiber {
            place: disc(square(seed, hair, fiber)),
            lack,
        }
    }
}

/// The document's splay at `t`, of those at root, centre and tip.
#[inline(always)]
fn splay([root, center, tip]: [f32; 3], t: f32) -> f32 {
    let border = 4.0 * (t - 0.5) * (t - 0.5);
    let nearer = if t > 0.5 { tip } else { root };
    border * nearer + (1.0 - border) * center
}

/// Writes what the fibres around `hair` have in common, whose splay is that of
/// `fields`. `tangents` and `normals` are the
/// unit vectors of the hair's frames; all four slices have one length.
pub(crate) fn sections(
    fields: &Profile<3>,
    bundle: &Bundle,
    hair: &[Vec3],
    tangents: &[Vec3],
    normals: &[Vec3],
    sections: &mut [Section],
) {
    let step = 1.0 / (hair.len().max(2) - 1) as f32;
    let (sine, cosine) = libm::sincosf(bundle.twist * step);
    let mut turn = Vec2::X;
    for (i, section) in sections.iter_mut().enumerate() {
        let t = i as f32 * step;
        let (normal, binormal) = (normals[i], tangents[i].cross(normals[i]) * bundle.aspect);
        let splay = fields.at(bundle.splay, t, splay);
        *section = Section {
            middle: hair[i] + normal * (bundle.offset * t * t * t),
            across: [
                (normal * turn.x + binormal * turn.y) * splay,
                (binormal * turn.x - normal * turn.y) * splay,
            ],
        };
        turn = Vec2::new(
            turn.x * cosine - turn.y * sine,
            turn.x * sine + turn.y * cosine,
        );
    }
}

/// Writes the vertices of `fiber` around a hair that grows at `root`.
#[inline]
pub fn around(fiber: Fiber, root: Vec3, sections: &[Section], vertices: &mut [Vec3]) {
    let Fiber { place, lack } = fiber;
    for (vertex, section) in vertices.iter_mut().zip(sections) {
        let [x, y] = section.across;
        let whole = section.middle + (x * place.x + y * place.y);
        // So that a fibre without splay and lack is the hair to the bit.
        *vertex = whole + (root - whole) * lack;
    }
}

/// The place of a fibre in the unit square: those of a hair follow a lattice shifted at
/// random, so that few of them already stand apart on all sides and more come between.
/// Roberts 2018, "The unreasonable effectiveness of quasirandom sequences" (R2).
fn square(seed: u64, hair: u64, fiber: u32) -> Vec2 {
    // 2^64 over the plastic number and over its square.
    const STEPS: [u64; 2] = [0xc13f_a9a9_02a6_328f, 0x91e1_0da5_c79e_7b1c];
    let shift = word(seed, hair, Channel::FiberPlace);
    let shifts = [shift, shift << 32];
    let at = |k: usize| shifts[k].wrapping_add(STEPS[k].wrapping_mul(fiber as u64));
    let unit = |word: u64| (word >> 40) as f32 * (1.0 / (1u32 << 24) as f32);
    Vec2::new(unit(at(0)), unit(at(1)))
}

/// Shirley and Chiu's concentric map of the unit square onto the unit disc, which keeps
/// areas and neighbours.
fn disc(square: Vec2) -> Vec2 {
    let Vec2 { x, y } = square * 2.0 - 1.0;
    let (radius, angle) = if x.abs() > y.abs() {
        (x, FRAC_PI_4 * (y / x))
    } else if y != 0.0 {
        (y, FRAC_PI_2 - FRAC_PI_4 * (x / y))
    } else {
        return Vec2::ZERO;
    };
    let (sine, cosine) = libm::sincosf(angle);
    Vec2::new(cosine, sine) * radius
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fibres_fill_the_disc_evenly_and_few_of_a_hair_stand_apart() {
        let bundle = Bundle {
            splay: [1.0; 3],
            twist: 0.0,
            aspect: 1.0,
            offset: 0.0,
            randomize: 0.5,
        };
        let (mut inner, mut right, mut lack, mut nearest) = (0, 0, 0.0, 0.0);
        for hair in 0..4000 {
            let fibers = [0, 1, 2, 3, 4].map(|k| bundle.fiber(7, hair, k));
            for (k, fiber) in fibers.iter().enumerate() {
                assert!(fiber.place.length() <= 1.0 + 1e-6);
                inner += usize::from(fiber.place.length_squared() < 0.5);
                right += usize::from(fiber.place.x > 0.0);
                lack += fiber.lack / 20_000.0;
                let apart = |other: &Fiber| other.place.distance(fiber.place);
                let others = fibers.iter().enumerate().filter(|(j, _)| *j != k);
                nearest += others.map(|(_, f)| apart(f)).fold(9.0, f32::min) / 20_000.0;
            }
        }
        assert!((9_700..10_300).contains(&inner), "{inner} in half the area");
        assert!((9_700..10_300).contains(&right), "{right} on the right");
        assert!((lack - 0.25).abs() < 0.01, "{lack}");
        // Five points thrown at random are 0.44 from their nearest in the mean.
        assert!(nearest > 0.6, "{nearest}");
    }

    #[test]
    fn splay_is_what_was_asked_at_root_centre_and_tip() {
        let ends = [1.0, 2.0, 3.0];
        assert_eq!([0.0, 0.5, 1.0].map(|t| splay(ends, t)), ends);
    }

    #[test]
    fn a_fibre_turns_by_the_twist_and_lies_on_the_ellipse_of_the_aspect() {
        let bundle = Bundle {
            splay: [0.5; 3],
            twist: std::f32::consts::PI,
            aspect: 0.25,
            offset: 2.0,
            randomize: 0.0,
        };
        let hair: Vec<Vec3> = (0..5).map(|i| Vec3::Y + Vec3::Z * i as f32).collect();
        let (tangents, normals) = ([Vec3::Z; 5], [Vec3::X; 5]);
        let mut common = [Section::default(); 5];
        sections(
            &Profile::plain(),
            &bundle,
            &hair,
            &tangents,
            &normals,
            &mut common,
        );
        let fiber = Fiber {
            place: Vec2::X,
            lack: 0.0,
        };
        let mut vertices = [Vec3::ZERO; 5];
        around(fiber, hair[0], &common, &mut vertices);
        let from = |i: usize| vertices[i] - hair[i];
        assert_eq!(from(0), Vec3::X * 0.5);
        // A quarter turn at the middle: along the binormal Y, shorter by the aspect.
        let quarter = Vec3::new(2.0 / 8.0, 0.5 * 0.25, 0.0);
        assert!(from(2).distance(quarter) < 1e-6, "{}", from(2));
        assert!(
            from(4).distance(Vec3::X * (2.0 - 0.5)) < 1e-6,
            "{}",
            from(4)
        );
    }
}
