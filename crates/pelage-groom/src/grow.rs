//! Guides grown by rule, so that nobody needs another program to begin.
//!
//! They stand on Halton's points (bases 2 and 3; document 004, 2.1.7 and 3.1.1), in
//! proportion to the density of the hair. A guide starts more upright than it ends: at
//! the fraction t of its length it leans by `lean · (½ + t)` from the normal toward the
//! comb direction, so that `lean` is its mean. A curl winds around that line with a
//! radius that grows from nothing at the root. Guides may be shaped by curvature and torsion
//! instead ([`grow_bend`](crate::grow_bend)); then `lean` is how they leave the root.

use crate::grow_bend::BendFields;
use crate::guide::Guide;
use crate::maps::{FieldMaker, ScalarField};
use crate::random::{Channel, uniform};
use crate::recipe::{Comb, Grow};
use crate::texture::Texture;
use crate::{PlanError, maps::Images};
use pelage_curves::{Vec2, Vec3};
use pelage_surface::{Mesh, RootFrame, RootSampler, radical_inverse};
use rayon::prelude::*;

/// Grows the guides of `grow` on `mesh` at rest.
pub(crate) fn grow(
    grow: &Grow,
    mesh: &Mesh,
    sampler: &RootSampler,
    images: &Images,
) -> Result<Vec<Guide>, PlanError> {
    let mut fields = FieldMaker::new(images, mesh.has_uvs());
    let shape = Shape {
        length: fields.scalar("guides.grow.length", &grow.length)?,
        lean: fields.scalar("guides.grow.lean", &grow.lean)?,
        comb: comb_field(grow, &fields)?,
        radius: fields.scalar("guides.grow.curl.radius", &grow.curl.radius)?,
        turns: fields.scalar("guides.grow.curl.turns", &grow.curl.turns)?,
        bend: BendFields::new(&grow.bend, &mut fields)?,
        segments: grow.segments.max(1),
    };
    // A rotation by the seed (Cranley and Patterson) keeps the points' spread.
    let shifts = [1, 2].map(|k| uniform(grow.seed, k, Channel::GuideRoot) as f64);
    Ok((0..grow.count as u64)
        .into_par_iter()
        .map(|i| {
            let x = (radical_inverse(2, i + 1) + shifts[0]).fract();
            let y = (radical_inverse(3, i + 1) + shifts[1]).fract();
            let root = sampler.place(
                (x * (1u128 << 64) as f64) as u64,
                (y * (1u64 << 32) as f64) as u32,
            );
            let frame = mesh.frame(&root);
            let phase = uniform(grow.seed, i, Channel::GuideCurl);
            Guide {
                root,
                frame,
                local: shape.vertices(&frame, mesh.uv(&root), phase),
            }
        })
        .collect())
}

fn comb_field(grow: &Grow, fields: &FieldMaker) -> Result<CombField, PlanError> {
    Ok(match &grow.comb {
        None => CombField::Tangent,
        Some(Comb::Vector(v)) => CombField::Vector(Vec3::from(*v)),
        Some(Comb::Map(used)) => CombField::Map(fields.texture("guides.grow.comb", used)?),
    })
}

enum CombField {
    Tangent,
    Vector(Vec3),
    Map(Texture),
}

impl CombField {
    /// Unit direction in the tangent plane, local coordinates; +u where there is none.
    fn at(&self, frame: &RootFrame, uv: Vec2) -> Vec3 {
        let local = match self {
            CombField::Tangent => Vec3::X,
            CombField::Vector(v) => frame.local(v.normalize_or_zero()),
            CombField::Map(map) => {
                // 0.5 is no direction, and so is a tile that is not there.
                let code = |channel| map.sample(uv, channel).unwrap_or(0.5) * 2.0 - 1.0;
                Vec3::new(code(0), code(1), 0.0)
            }
        };
        let flat = Vec3::new(local.x, local.y, 0.0);
        // 8-bit codes cannot say exactly 0.5: less than a hundredth is no direction.
        if flat.length_squared() > 1e-4 {
            flat.normalize()
        } else {
            Vec3::X
        }
    }
}

struct Shape {
    length: ScalarField,
    lean: ScalarField,
    comb: CombField,
    radius: ScalarField,
    turns: ScalarField,
    /// `None` where curvature and torsion do not shape guides.
    bend: Option<BendFields>,
    segments: u32,
}

impl Shape {
    /// Vertices in the local frame of the root; `phase` (0..1) turns the curl.
    fn vertices(&self, frame: &RootFrame, uv: Vec2, phase: f32) -> Vec<Vec3> {
        let length = self.length.at(uv).max(0.0);
        let lean = self.lean.at(uv).to_radians();
        let (radius, turns) = (self.radius.at(uv), self.turns.at(uv));
        let along = self.comb.at(frame, uv);
        if let Some(bend) = &self.bend {
            let (sine, cosine) = (libm::sinf(lean), libm::cosf(lean));
            let tangent = along * sine + Vec3::Z * cosine;
            let normal = along * cosine - Vec3::Z * sine;
            return bend.vertices(uv, length, self.segments, [tangent, normal], phase);
        }
        let aside = Vec3::new(-along.y, along.x, 0.0);
        let step = length / self.segments as f32;
        let direction = |t: f32| {
            let angle = lean * (0.5 + t);
            (
                along * libm::sinf(angle) + Vec3::Z * libm::cosf(angle),
                angle,
            )
        };
        let mut line = Vec3::ZERO;
        (0..=self.segments)
            .map(|i| {
                let t = i as f32 / self.segments as f32;
                if i > 0 {
                    line += direction(t - 0.5 / self.segments as f32).0 * step;
                }
                let (_, angle) = direction(t);
                let up = along * libm::cosf(angle) - Vec3::Z * libm::sinf(angle);
                let turn = (turns * t + phase) * std::f32::consts::TAU;
                let reach = radius * t * (2.0 - t);
                line + (aside * libm::cosf(turn) + up * libm::sinf(turn)) * reach
            })
            .collect()
    }
}
