//! Laws of frames on displaced surfaces: closed forms and finite differences.
#![allow(clippy::unwrap_used)]

use pelage_curves::{DVec3, Vec2, Vec3};
use pelage_surface::{Displacement, Mesh, PolygonMesh, SurfacePoint};
use proptest::prelude::*;
use std::f32::consts::{PI, TAU};

/// The unit sphere as `2n × n` quads of longitude and latitude, u = longitude / 2π from
/// 0 to 1 and v from pole to pole, with its own normals. `mirrored` turns u round on the
/// half of y < 0, which then has the texture of the other.
fn sphere(n: u32, mirrored: bool) -> Mesh {
    let mut mesh = PolygonMesh::default();
    for (row, column) in (0..n).flat_map(|row| (0..2 * n).map(move |column| (row, column))) {
        mesh.face_sizes.push(4);
        for (across, up) in [(0, 0), (1, 0), (1, 1), (0, 1)] {
            let u = (column + across) as f32 / (2 * n) as f32;
            let v = (row + up) as f32 / n as f32;
            let at = direction(u, v).to_array();
            mesh.corner_vertices.push(mesh.positions.len() as u32);
            mesh.positions.push(at);
            mesh.corner_normals.push(at);
            let turned = mirrored && column >= n;
            mesh.corner_uvs.push([if turned { 1.0 - u } else { u }, v]);
        }
    }
    Mesh::new(mesh).unwrap()
}

fn direction(u: f32, v: f32) -> Vec3 {
    let (longitude, latitude) = (TAU * u, PI * (v - 0.5));
    let around = libm::cosf(latitude);
    let (x, y) = (libm::cosf(longitude), libm::sinf(longitude));
    Vec3::new(around * x, around * y, libm::sinf(latitude))
}

/// Waves on the sphere that are smooth at the poles: 0.1 sin(3 longitude) cos³(latitude),
/// with their derivatives by u and v.
fn waves(uv: Vec2) -> Displacement {
    let (longitude, latitude) = (TAU * uv.x, PI * (uv.y - 0.5));
    let (c, s) = (libm::cosf(latitude), libm::sinf(latitude));
    let wave = 0.1 * libm::sinf(3.0 * longitude);
    Displacement {
        height: wave * c * c * c,
        slope: Vec2::new(
            TAU * 0.3 * libm::cosf(3.0 * longitude) * c * c * c,
            -PI * wave * 3.0 * c * c * s,
        ),
    }
}

/// Normal of the surface (1 + waves) r: r less the gradient over the sphere by 1 + waves.
fn normal_of_waves(at: Vec3) -> Vec3 {
    let (longitude, c) = (libm::atan2f(at.y, at.x), at.truncate().length());
    let wave = 0.1 * libm::sinf(3.0 * longitude);
    let east = Vec3::new(-libm::sinf(longitude), libm::cosf(longitude), 0.0);
    let north = at.cross(east);
    let eastward = 0.3 * libm::cosf(3.0 * longitude) * c * c;
    let northward = -wave * 3.0 * c * c * at.z;
    let gradient = east * eastward + north * northward;
    (at - gradient / (1.0 + wave * c * c * c)).normalize()
}

fn points(mesh: &Mesh) -> impl Iterator<Item = SurfacePoint> {
    let inside = [[0.2, 0.3, 0.5], [0.6, 0.3, 0.1], [0.05, 0.05, 0.9]];
    let triangles = 0..mesh.triangles().len() as u32;
    let sound = triangles.filter(|&t| mesh.area(t as usize) > 0.0);
    sound.flat_map(move |triangle| {
        inside.map(|barycentric| SurfacePoint {
            triangle,
            barycentric,
        })
    })
}

#[test]
fn on_a_sphere_with_waves_the_error_falls_with_the_size_of_the_triangles() {
    let mut previous = f32::INFINITY;
    for n in [16, 32, 64, 128] {
        let mesh = sphere(n, false);
        // At the poles the texture has no direction, and its triangles no size.
        let away_from_poles = |point: &SurfacePoint| mesh.position(point).z.abs() < 0.95;
        let errors = points(&mesh).filter(away_from_poles).map(|point| {
            let frame = mesh.displaced_frame(&point, &waves(mesh.uv(&point)));
            let expected = normal_of_waves(mesh.position(&point).normalize());
            frame.normal.distance(expected)
        });
        let worst = errors.fold(0.0, f32::max);
        assert!(worst < 0.6 * previous, "{n}: {worst} after {previous}");
        previous = worst;
    }
    assert!(previous < 0.01, "{previous}");
}

#[test]
fn a_sphere_that_is_blown_up_keeps_its_normals() {
    let mesh = sphere(12, false);
    let by = Displacement {
        height: 0.75,
        slope: Vec2::ZERO,
    };
    for point in points(&mesh) {
        let (plain, frame) = (mesh.frame(&point), mesh.displaced_frame(&point, &by));
        assert!(frame.normal.distance(plain.normal) < 1e-6);
        let expected = plain.position + plain.normal * 0.75;
        assert!(frame.position.distance(expected) < 1e-6);
    }
}

#[test]
fn no_displacement_gives_the_frame_of_the_plain_surface_to_the_bit() {
    let mesh = sphere(6, true);
    for point in points(&mesh) {
        let frame = mesh.displaced_frame(&point, &Displacement::default());
        assert_eq!(frame, mesh.frame(&point));
    }
}

#[test]
fn the_texture_of_a_mirrored_half_gives_the_same_surface_with_normals_outward() {
    let (plain, mirrored) = (sphere(16, false), sphere(16, true));
    // The same on both halves, so that only the direction of u differs.
    let even = |uv: Vec2| {
        let angle = 2.0 * TAU * uv.x;
        Displacement {
            height: 0.1 * libm::cosf(angle),
            slope: Vec2::new(-0.2 * TAU * libm::sinf(angle), 0.0),
        }
    };
    for point in points(&plain) {
        let one = plain.displaced_frame(&point, &even(plain.uv(&point)));
        let other = mirrored.displaced_frame(&point, &even(mirrored.uv(&point)));
        assert!(one.position.distance(other.position) < 1e-5);
        assert!(one.normal.distance(other.normal) < 1e-3);
        assert!(one.normal.dot(plain.normal(&point)) > 0.0);
    }
}

/// A corner of a triangle with the texture coordinates `uv`.
fn corner_at(mesh: &Mesh, uv: [f32; 2]) -> SurfacePoint {
    let corners = (0..mesh.triangles().len()).flat_map(|t| [0, 1, 2].map(|k| (t, k)));
    let mut sound = corners.filter(|&(t, _)| mesh.area(t) > 0.0);
    let found = sound.find(|&(t, k)| mesh.uvs()[t][k] == uv.into());
    let (triangle, k) = found.unwrap();
    let mut barycentric = [0.0; 3];
    barycentric[k] = 1.0;
    SurfacePoint {
        triangle: triangle as u32,
        barycentric,
    }
}

#[test]
fn frames_on_both_sides_of_a_seam_agree_as_the_triangles_become_small() {
    let mut previous = f32::INFINITY;
    for n in [16, 32, 64, 128] {
        let mesh = sphere(n, false);
        let mut worst = 0.0f32;
        for row in n / 4..3 * n / 4 {
            let [a, b] = [0.0, 1.0].map(|u| {
                let side = corner_at(&mesh, [u, row as f32 / n as f32]);
                mesh.displaced_frame(&side, &waves(mesh.uv(&side)))
            });
            assert!(a.position.distance(b.position) < 1e-5);
            worst = worst.max(a.normal.distance(b.normal));
        }
        assert!(worst < 0.6 * previous, "{n}: {worst} after {previous}");
        previous = worst;
    }
}

fn alone(positions: [[f32; 3]; 3], uvs: [[f32; 2]; 3]) -> Mesh {
    Mesh::new(PolygonMesh {
        positions: positions.to_vec(),
        face_sizes: vec![3],
        corner_vertices: vec![0, 1, 2],
        corner_uvs: uvs.to_vec(),
        ..PolygonMesh::default()
    })
    .unwrap()
}

/// Bumps in texture space, in f64: height, and slope along u and v.
fn bumps([u, v]: [f64; 2]) -> (f64, [f64; 2]) {
    let (a, b) = (2.0 * u + v, u - 3.0 * v);
    let slope_u = 0.4 * libm::cos(a) - 0.1 * libm::sin(b);
    let slope_v = 0.2 * libm::cos(a) + 0.3 * libm::sin(b);
    (0.2 * libm::sin(a) + 0.1 * libm::cos(b), [slope_u, slope_v])
}

/// One flat triangle with [`bumps`], by the weights s and t of its last two corners.
struct Bumpy {
    corners: [DVec3; 3],
    uvs: [[f32; 2]; 3],
}

impl Bumpy {
    fn uv(&self, s: f64, t: f64) -> [f64; 2] {
        [0, 1].map(|k| {
            let [a, b, c] = self.uvs.map(|uv| uv[k] as f64);
            a + (b - a) * s + (c - a) * t
        })
    }

    fn scaled_normal(&self) -> DVec3 {
        let [p, q, r] = self.corners;
        (q - p).cross(r - p)
    }

    fn surface(&self, s: f64, t: f64) -> DVec3 {
        let [p, q, r] = self.corners;
        let height = bumps(self.uv(s, t)).0;
        p + (q - p) * s + (r - p) * t + self.scaled_normal().normalize() * height
    }

    /// Normal at (s, t) from positions `step` apart.
    fn normal(&self, s: f64, t: f64, step: f64) -> DVec3 {
        let along_s = self.surface(s + step, t) - self.surface(s - step, t);
        let along_t = self.surface(s, t + step) - self.surface(s, t - step);
        along_s.cross(along_t).normalize()
    }
}

proptest! {
    #[test]
    fn the_normal_is_that_of_finite_differences_of_ever_smaller_steps(
        corners in prop::array::uniform3(prop::array::uniform3(-1.0f32..1.0)),
        uvs in prop::array::uniform3(prop::array::uniform2(-1.0f32..2.0)),
    ) {
        let bumpy = Bumpy { corners: corners.map(|c| Vec3::from(c).as_dvec3()), uvs };
        prop_assume!(bumpy.scaled_normal().length() > 0.1);
        let mesh = alone(corners, uvs);
        let point = SurfacePoint { triangle: 0, barycentric: [0.25, 0.25, 0.5] };
        let (height, slope) = bumps(bumpy.uv(0.25, 0.5));
        let slope = Vec2::from(slope.map(|x| x as f32));
        let frame = mesh.displaced_frame(&point, &Displacement { height: height as f32, slope });
        for step in [1e-2, 1e-3, 1e-4] {
            let expected = bumpy.normal(0.25, 0.5, step).as_vec3();
            let error = frame.normal.distance(expected) as f64;
            prop_assert!(error < 1e4 * step * step + 1e-5, "{step}: {error}");
        }
        prop_assert!(frame.position.distance(bumpy.surface(0.25, 0.5).as_vec3()) < 1e-5);
        let plain = mesh.frame(&point).tangent;
        let part = plain - frame.normal * plain.dot(frame.normal);
        prop_assume!(part.length() > 0.01);
        prop_assert!(frame.tangent.distance(part.normalize()) < 1e-3);
    }

    #[test]
    fn texture_without_area_and_steep_slopes_still_give_a_frame(
        corners in prop::array::uniform3(prop::array::uniform3(-1i8..2)),
        uvs in prop::array::uniform3(prop::array::uniform2(-1i8..2)),
        height in -1e20f32..1e20, slope in prop::array::uniform2(-1e20f32..1e20),
    ) {
        let mesh = alone(corners.map(|c| c.map(f32::from)), uvs.map(|c| c.map(f32::from)));
        let point = SurfacePoint { triangle: 0, barycentric: [0.25, 0.5, 0.25] };
        let frame = mesh.displaced_frame(&point, &Displacement { height, slope: slope.into() });
        prop_assert!((frame.normal.length() - 1.0).abs() < 1e-5);
        prop_assert!((frame.tangent.length() - 1.0).abs() < 1e-5);
        prop_assert!(frame.tangent.dot(frame.normal).abs() < 1e-5);
        prop_assert!(frame.normal.dot(mesh.normal(&point)) > -1e-5);
    }
}
