//! Frizz: hairs bent as a whole, each toward a direction that noise gives its root.
//!
//! Source: document 004, section 2.2.5, with its errata: the animated part moves the
//! domain of the noise (`frequency · root + speed · time · direction`) instead of
//! multiplying it. `p += F · min(root · 4(t - t²) + tip · t², max(root, tip))` with
//! t = i / segments, or by a ramp in the place of that amount; F is three noises of the root
//! at rest, and its part along the normal points into the skin, so that frizz does not
//! lengthen hair. The root stays. Local space, unit of the mesh; frequencies per unit of the
//! mesh, time in frames.

use crate::PlanError;
use crate::blocks::Blocks;
use crate::lanes::{Number, Row, Rows, Vectors};
use crate::maps::{FieldMaker, ScalarField};
use crate::noise::noise_at;
use crate::noise_fields::{NoiseFields, NoiseRows};
use crate::random::Channel;
use crate::recipe;
use crate::stages::roots::Root;
use fearless_simd::{Level, Simd, SimdBase, dispatch};
use pelage_curves::Vec3;

/// The properties of frizz over the surface.
#[derive(Clone, Debug)]
pub struct FrizzFields {
    noise: NoiseFields,
    moving: ScalarField,
    speed: ScalarField,
    direction: Vec3,
}

/// The frizz of hairs side by side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FrizzRows {
    /// Where their roots lie in the domain of the noise.
    place: Rows,
    /// How far those places move in a unit of time.
    velocity: Rows,
    /// Part of the frizz that moves, 0..=1.
    moving: Row,
    /// At root and tip, or what multiplies the ramp.
    amount: [Row; 2],
}

impl FrizzFields {
    /// Reads `[frizz]`; `None` where it bends nothing.
    pub(crate) fn new(
        frizz: &recipe::Frizz,
        maker: &mut FieldMaker,
        seed: u64,
    ) -> Result<Option<Self>, PlanError> {
        let (ends, noise) = ([&frizz.root, &frizz.tip], (seed, Channel::Frizz));
        let noise = NoiseFields::new("frizz", &frizz.frequency, ends, maker, noise)?;
        let moving = maker.scalar("frizz.animation.amount", &frizz.animation.amount)?;
        let speed = maker.scalar("frizz.animation.speed", &frizz.animation.speed)?;
        Ok(noise.map(|noise| Self {
            noise,
            moving,
            speed,
            direction: Vec3::from(frizz.animation.direction),
        }))
    }

    /// Its properties, in the order in which [`rows`](Self::rows) takes their values.
    pub(crate) fn fields(&self) -> [&ScalarField; 7] {
        let [x, y, z, root, tip] = self.noise.fields();
        [x, y, z, root, tip, &self.speed, &self.moving]
    }

    /// The frizz of hairs that grow side by side at `roots`, from what its properties are
    /// there.
    pub(crate) fn rows(&self, roots: &[Root], values: [Row; 7]) -> FrizzRows {
        let [x, y, z, at_root, at_tip, speed, moving] = values;
        let noise = NoiseRows::new([x, y, z, at_root, at_tip]);
        let rest = Rows::of(roots, |root| root.rest);
        FrizzRows {
            place: Rows(std::array::from_fn(|k| {
                let (frequency, rest) = (&noise.frequency.0[k], &rest.0[k]);
                std::array::from_fn(|lane| frequency[lane] * rest[lane])
            })),
            velocity: Rows([0, 1, 2].map(|k| speed.map(|speed| self.direction[k] * speed))),
            moving: moving.map(|moving| moving.clamp(0.0, 1.0)),
            amount: noise.amount,
        }
    }

    /// Whether hairs move with time.
    pub(crate) fn is_moving(&self) -> bool {
        !(self.moving.is_zero() || self.speed.is_zero())
    }
}

/// Bends hairs, with the frizz `rows` block by block, at `time`.
pub(crate) fn frizz(fields: &FrizzFields, rows: &[FrizzRows], time: f32, local: &mut Blocks) {
    let moving = time != 0.0 && fields.is_moving();
    dispatch!(Level::new(), simd => {
        for (block, hairs) in rows.iter().enumerate() {
            let still = noise_of(simd, fields, hairs, 0.0);
            let [x, y, z] = match moving {
                false => still.0,
                true => {
                    let moved = noise_of(simd, fields, hairs, time);
                    let part = Number::load_array(simd, hairs.moving);
                    let rest = Number::splat(simd, 1.0) - part;
                    (still * rest + moved * part).0
                }
            };
            let toward = Vectors([x, y, -z.abs()]);
            let steps = local.steps(block);
            let toward = (toward, hairs.amount);
            bend(simd, fields, toward, steps, local.block_mut(block));
        }
    });
}

/// Bends the hairs of a block, each as far as its amounts at root and tip say.
#[inline(always)]
fn bend<S: Simd>(
    simd: S,
    fields: &FrizzFields,
    (toward, amounts): (Vectors<S>, [Row; 2]),
    steps: Row,
    hairs: &mut [Rows],
) {
    let amounts = amounts.map(|row| Number::load_array(simd, row));
    let steps = Number::load_array(simd, steps);
    for (number, vertex) in hairs.iter_mut().enumerate().skip(1) {
        let ts = steps * number as f32;
        let amounts = fields.noise.amounts(amounts, ts, profile);
        *vertex = (vertex.load(simd) + toward * amounts).rows();
    }
}

/// The noise of the hairs of a block at `time`.
#[inline(always)]
fn noise_of<S: Simd>(simd: S, fields: &FrizzFields, hairs: &FrizzRows, time: f32) -> Vectors<S> {
    let moved = hairs.velocity.load(simd) * Number::splat(simd, time);
    noise_at(fields.noise.seed, hairs.place.load(simd) + moved)
}

/// The document's amount at `t`, of those at root and tip.
#[inline(always)]
fn profile<S: Simd>([root, tip]: [Number<S>; 2], t: Number<S>) -> Number<S> {
    let both = root * 4.0 * (t - t * t) + tip * t * t;
    both.min(root.max(tip))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn root_frizz_bends_the_middle_and_tip_frizz_the_tip() {
        let at = |[root, tip]: [f32; 2], t: f32| {
            dispatch!(Level::new(), simd => {
                let ends = [Number::splat(simd, root), Number::splat(simd, tip)];
                profile(ends, Number::splat(simd, t))[0]
            })
        };
        let bent = |ends| [0.0, 0.25, 0.5, 0.75, 1.0].map(|t| at(ends, t));
        assert_eq!(bent([1.0, 0.0]), [0.0, 0.75, 1.0, 0.75, 0.0]);
        assert_eq!(bent([0.0, 1.0]), [0.0, 0.0625, 0.25, 0.5625, 1.0]);
        // Nothing is bent more than the larger of the two says.
        assert_eq!(bent([1.0, 1.0]), [0.0, 0.8125, 1.0, 1.0, 1.0]);
    }
}
