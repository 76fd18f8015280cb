//! The shapes of guides that curvature and torsion give: `[guides.grow.bend]`.
//!
//! Source: document 000, section 4.1, with its errata: along each segment curvature and
//! torsion are those in its middle, and the segment is a helix, exactly. They are told in
//! degrees over the length of the guide, κ L and τ L, so that a guide keeps its shape
//! whatever its length. Local space, unit of the mesh.

use crate::PlanError;
use crate::maps::{FieldMaker, ScalarField};
use crate::profile::Profile;
use crate::recipe;
use pelage_curves::frenet::{Apparatus, Frame, Segment};
use pelage_curves::{DVec3, Vec2, Vec3};

/// The properties of bent guides over the surface.
pub(crate) struct BendFields {
    curvature: Profile<1>,
    torsion: Profile<1>,
    roll: ScalarField,
    random: ScalarField,
}

impl BendFields {
    /// Reads the section; `None` where nothing bends.
    pub(crate) fn new(
        bend: &recipe::Bend,
        maker: &mut FieldMaker,
    ) -> Result<Option<Self>, PlanError> {
        let key = "guides.grow.bend";
        let fields = Self {
            curvature: Profile::new(key, [("curvature", &bend.curvature)], maker)?,
            torsion: Profile::new(key, [("torsion", &bend.torsion)], maker)?,
            roll: maker.scalar("guides.grow.bend.roll", &bend.roll)?,
            random: maker.scalar("guides.grow.bend.random", &bend.random)?,
        };
        Ok(Some(fields).filter(|fields| !fields.curvature.is_zero()))
    }

    /// The `segments + 1` vertices of a guide of `length` with its root at `uv`, which
    /// leaves along `tangent` and bends to `normal`, unit vectors; `chance` (0..1) is drawn
    /// for the guide.
    pub(crate) fn vertices(
        &self,
        uv: Vec2,
        length: f32,
        segments: u32,
        [tangent, normal]: [Vec3; 2],
        chance: f32,
    ) -> Vec<Vec3> {
        if length <= 0.0 {
            return vec![Vec3::ZERO; segments as usize + 1];
        }
        let values = |profile: &Profile<1>| profile.fields().map(|field| field.at(uv));
        let ends = [&self.curvature, &self.torsion].map(values);
        let step = length as f64 / segments as f64;
        let turns = |t: f32| {
            let [curvature, torsion] = [(&self.curvature, ends[0]), (&self.torsion, ends[1])];
            [curvature, torsion].map(|(profile, values)| {
                let degrees = profile.at(values, t, |[value], _| value);
                (degrees as f64).to_radians() / length as f64
            })
        };
        let segments = (0..segments).map(|i| {
            let [curvature, torsion] = turns((i as f32 + 0.5) / segments as f32);
            Segment {
                length: step,
                curvature,
                torsion,
            }
        });
        let roll = self.roll.at(uv).to_radians()
            + self.random.at(uv).clamp(0.0, 1.0) * chance * std::f32::consts::TAU;
        let (sine, cosine) = libm::sincos(roll as f64);
        let (tangent, normal) = (tangent.as_dvec3(), normal.as_dvec3());
        let aside = tangent.cross(normal);
        let curve = Apparatus {
            start: DVec3::ZERO,
            frame: Frame::new(tangent, normal * cosine + aside * sine),
            segments: segments.collect(),
        };
        curve.points().iter().map(|point| point.as_vec3()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::maps::Images;
    use crate::recipe::Recipe;
    use std::path::Path;

    /// A guide of length 2 that leaves along Z and bends to X, with this `bend`.
    fn guide(bend: &str, chance: f32) -> Option<Vec<Vec3>> {
        let text =
            format!("surface.mesh = 'm'\nguides.grow = {{ length = 2, bend = {{ {bend} }} }}");
        let recipe = Recipe::parse(&text, Path::new("groom.toml")).unwrap();
        let images = Images::new();
        let mut maker = FieldMaker::new(&images, true);
        let bend = recipe.guides.grow.unwrap().bend;
        let fields = BendFields::new(&bend, &mut maker).unwrap()?;
        Some(fields.vertices(Vec2::ZERO, 2.0, 32, [Vec3::Z, Vec3::X], chance))
    }

    #[test]
    fn curvature_alone_is_a_circle_that_closes_at_a_full_turn() {
        let circle = guide("curvature = 360", 0.0).unwrap();
        let radius = 1.0 / std::f32::consts::PI;
        for vertex in &circle {
            let apart = vertex.distance(Vec3::X * radius);
            assert!((apart - radius).abs() < 1e-6, "{vertex}");
        }
        assert!(circle[32].length() < 1e-6);
        assert!(circle[1].z > 0.0);
        let left = guide("curvature = -360", 0.0).unwrap();
        assert!((left[16].x + 2.0 * radius).abs() < 1e-6);
    }

    #[test]
    fn curvature_and_torsion_are_a_helix_of_that_radius_and_pitch() {
        let helix = guide("curvature = 1440, torsion = 720", 0.0).unwrap();
        // Over a length of 2: 8π and 4π, so 4π and 2π in a unit.
        let (k, t) = (4.0 * std::f32::consts::PI, 2.0 * std::f32::consts::PI);
        let (radius, w) = (k / (k * k + t * t), (k * k + t * t).sqrt());
        // The axis is along τ T + κ B, through the first vertex moved by the radius to N.
        let axis = (Vec3::Z * t + Vec3::Z.cross(Vec3::X) * k) / w;
        for (i, vertex) in helix.iter().enumerate() {
            let from = *vertex - Vec3::X * radius;
            let along = from.dot(axis);
            assert!((along - t / w * i as f32 / 16.0).abs() < 1e-5);
            assert!(((from - axis * along).length() - radius).abs() < 1e-5);
        }
    }

    #[test]
    fn ramps_and_rolls_do_what_they_say() {
        let ramp = guide("curvature = { ramp = [[0, 0], [0.5, 0], [1, 720]] }", 0.0).unwrap();
        assert!(
            ramp[16].distance(Vec3::Z) < 1e-6,
            "straight up to the middle"
        );
        assert!(ramp[32].x > 0.1);
        let rolled = guide("curvature = 90, roll = 90", 0.0).unwrap();
        let chance = guide("curvature = 90, random = 0.5", 0.5).unwrap();
        assert!(rolled[32].x.abs() < 1e-6 && rolled[32].y > 0.1);
        for (a, b) in rolled.iter().zip(&chance) {
            assert!(a.distance(*b) < 1e-6);
        }
        assert_eq!(guide("torsion = 90", 0.0), None);
        assert_eq!(guide("curvature = { ramp = [[0, 0]] }", 0.0), None);
    }
}
