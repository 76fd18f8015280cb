//! The surface under the hair, and light on anything flat.

use crate::accel::{SurfaceHit, SurfaceTree};
use crate::color::Rgb;
use crate::light_field::Occluders;
use crate::lights::Lighting;
use crate::sampling::{in_cone, over_cosine, point};
use crate::stage::Frame;
use crate::{Paint, Scene};
use glam::Vec3;
use pelage_surface::{ImageMap, Mesh, SurfacePoint, Wrap};
use rayon::prelude::*;
use std::f32::consts::PI;

/// Directions towards the sky from each vertex.
const TO_SKY: u32 = 24;
/// How dark one fibre's shadow is on the skin: less than black, for light comes
/// through and around.
const SHADOW: f32 = 0.7;

/// Exponent of the highlight of bare skin, a nose or an eye (Blinn and Phong's).
const NARROW: f32 = 90.0;
/// Its height: a dielectric's 4 % over the solid angle of the highlight.
const GLINT: f32 = 0.04 * (NARROW + 2.0) / (8.0 * PI);

/// The surface with the sky's light on it.
pub(crate) struct Skin<'a> {
    mesh: Option<&'a Mesh>,
    color: Rgb,
    map: Option<&'a ImageMap>,
    paint: Option<&'a dyn Paint>,
    /// Triangles in the unit scene.
    pub corners: Vec<[Vec3; 3]>,
    /// Per vertex: mean of sky radiance over the hemisphere, weighted by cosine.
    sky: Vec<Rgb>,
}

impl<'a> Skin<'a> {
    /// The surface of `scene`, not yet lit.
    pub fn new(scene: &Scene<'a>, frame: &Frame) -> Self {
        let mesh = scene.surface;
        let corners = mesh.map_or(Vec::new(), |mesh| {
            let place = |v: u32| frame.place(mesh.positions()[v as usize].to_array());
            mesh.triangles().iter().map(|t| t.map(place)).collect()
        });
        Self {
            mesh,
            color: scene.surface_color.into(),
            map: scene.surface_map,
            paint: scene.surface_paint,
            corners,
            sky: Vec::new(),
        }
    }

    /// Gathers the sky's light for every vertex.
    pub fn light(&mut self, occluders: Occluders, lighting: &Lighting) {
        let Some(mesh) = self.mesh else { return };
        let mut places = vec![(Vec3::ZERO, Vec3::ZERO); mesh.positions().len()];
        for (t, triangle) in mesh.triangles().iter().enumerate() {
            for (k, &vertex) in triangle.iter().enumerate() {
                let place = &mut places[vertex as usize];
                place.0 = self.corners[t][k];
                place.1 += self.normal(t, k);
            }
        }
        self.sky = places
            .par_iter()
            .map(|&(p, normal)| {
                let normal = normal.try_normalize().unwrap_or(lighting.up);
                sky_on(p, normal, TO_SKY, occluders, lighting)
            })
            .collect();
    }

    /// Normal at corner `k` of triangle `t`, flat where the mesh gives none.
    fn normal(&self, t: usize, k: usize) -> Vec3 {
        let [a, b, c] = self.corners[t];
        let flat = || (b - a).cross(c - a).try_normalize().unwrap_or(Vec3::Y);
        self.mesh
            .and_then(|mesh| mesh.normals()[t][k].try_normalize())
            .unwrap_or_else(flat)
    }

    /// Radiance of the surface at `hit`, seen along `direction`. `seed` picks the
    /// parts of the lights that are looked at.
    pub fn radiance(
        &self,
        hit: &SurfaceHit,
        direction: Vec3,
        occluders: Occluders,
        lighting: &Lighting,
        seed: u32,
    ) -> Rgb {
        let t = hit.triangle as usize;
        let [v, w] = hit.weights;
        let u = 1.0 - v - w;
        let corners = self.corners[t];
        let p = corners[0] * u + corners[1] * v + corners[2] * w;
        let normal = self.normal(t, 0) * u + self.normal(t, 1) * v + self.normal(t, 2) * w;
        let normal = normal.try_normalize().unwrap_or(-direction);
        let normal = if normal.dot(direction) > 0.0 {
            -normal
        } else {
            normal
        };
        let sky = self.mesh.map_or(Rgb::ZERO, |mesh| {
            let sky = mesh.triangles()[t].map(|v| self.sky[v as usize]);
            sky[0] * u + sky[1] * v + sky[2] * w
        });
        // Away from the face that was hit, so that it does not shade itself.
        let p = p - direction * 2e-5;
        let (mut sum, mut shine) = (sky, Rgb::ZERO);
        for (k, beam) in lighting.beams.iter().enumerate() {
            let to = in_cone(beam.to_light, beam.cos_angle, point(k as u32, seed));
            let facing = normal.dot(to);
            if facing > 0.0
                && let Some(depth) = occluders.depth(p, to)
            {
                let light = beam.irradiance * (facing * libm::expf(-SHADOW * depth));
                sum += light / PI;
                let half = (to - direction).try_normalize().unwrap_or(normal);
                shine += light * (GLINT * libm::powf(normal.dot(half).max(0.0), NARROW));
            }
        }
        sum * self.color(hit) + shine
    }

    /// What the surface reflects at `hit`.
    fn color(&self, hit: &SurfaceHit) -> Rgb {
        let [v, w] = hit.weights;
        let place = SurfacePoint {
            triangle: hit.triangle,
            barycentric: [1.0 - v - w, v, w],
        };
        let color = match (self.paint, self.map, self.mesh.filter(|m| m.has_uvs())) {
            (Some(paint), ..) => paint.color(&place),
            (None, Some(map), Some(mesh)) => {
                let uv = mesh.uv(&place);
                map.sample_rgb(uv.x, uv.y, Wrap::Repeat)
            }
            _ => return self.color,
        };
        color.map(|c| c.clamp(0.0, 1.0)).into()
    }
}

/// Mean radiance of the sky over the hemisphere of `normal`, weighted by cosine.
pub(crate) fn sky_on(
    p: Vec3,
    normal: Vec3,
    directions: u32,
    occluders: Occluders,
    lighting: &Lighting,
) -> Rgb {
    let sum: Rgb = (0..directions)
        .filter_map(|i| {
            let to = over_cosine(normal, point(i, 21));
            let depth = occluders.depth(p, to)?;
            Some(lighting.sky(to) * libm::expf(-SHADOW * depth))
        })
        .sum();
    sum / directions as f32
}

impl Skin<'_> {
    /// The tree over the surface's triangles.
    pub fn tree(&self) -> SurfaceTree {
        SurfaceTree::new(&self.corners)
    }
}
