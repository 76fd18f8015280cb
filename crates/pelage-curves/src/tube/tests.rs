use super::*;
use crate::nurbs::tests::circle;
use crate::{Chain, Vec3};
use glam::DVec2;
use proptest::prelude::*;
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

/// Directed edges, joined by the bits of their positions: how often each goes one way more
/// than the other. None where the mesh is closed.
fn leaks(mesh: &TubeMesh) -> usize {
    let place = |i: u32| {
        mesh.positions[i as usize]
            .to_array()
            .map(|x| (x + 0.0).to_bits())
    };
    let mut edges: HashMap<_, i32> = HashMap::new();
    for t in &mesh.triangles {
        for k in 0..3 {
            let (a, b) = (place(t[k]), place(t[(k + 1) % 3]));
            let (key, sign) = if a < b { ((a, b), 1) } else { ((b, a), -1) };
            *edges.entry(key).or_default() += sign;
        }
    }
    edges.values().filter(|&&n| n != 0).count()
}

/// Vertices - edges + triangles, joined by position.
fn euler(mesh: &TubeMesh) -> i64 {
    let place = |i: u32| mesh.positions[i as usize].to_array().map(f32::to_bits);
    let (mut vertices, mut edges) = (Vec::new(), Vec::new());
    for t in &mesh.triangles {
        for k in 0..3 {
            let (a, b) = (place(t[k]), place(t[(k + 1) % 3]));
            vertices.push(a);
            edges.push((a.min(b), a.max(b)));
        }
    }
    vertices.sort();
    vertices.dedup();
    edges.sort();
    edges.dedup();
    vertices.len() as i64 - edges.len() as i64 + mesh.triangles.len() as i64
}

fn volume(mesh: &TubeMesh) -> f64 {
    let corner = |i: u32| mesh.positions[i as usize].as_dvec3();
    let part = |t: &[u32; 3]| corner(t[0]).dot(corner(t[1]).cross(corner(t[2])));
    mesh.triangles.iter().map(part).sum::<f64>() / 6.0
}

fn line(end: DVec3) -> Chain {
    Chain::catmull_rom(&[DVec3::ZERO, end], 0.5).unwrap()
}

fn even(parts: usize) -> Tube {
    Tube {
        rings: Rings::Even(parts),
        ..Tube::default()
    }
}

#[test]
fn a_straight_tube_is_a_prism_to_its_volume_and_its_normals() {
    for (framing, caps) in [
        (Framing::Frenet, Caps::Flat),
        (Framing::Propagated, Caps::Flat),
    ] {
        let tube = Tube {
            framing,
            caps,
            ..even(3)
        };
        let section = Section::circle(7).unwrap();
        let mesh = tube.sweep(&line(DVec3::ONE), &section, |_| 0.5).unwrap();
        assert_eq!((leaks(&mesh), euler(&mesh)), (0, 2));
        let exact = 7.0 / 2.0 * libm::sin(TAU / 7.0) * 0.25 * 3f64.sqrt();
        assert!((volume(&mesh) / exact - 1.0).abs() < 1e-6);
        let axis = Vec3::ONE.normalize();
        for (p, n) in mesh.positions.iter().zip(&mesh.normals).take(4 * 8) {
            assert!(n.distance((*p - axis * p.dot(axis)).normalize()) < 1e-5);
        }
    }
}

#[test]
fn a_cone_comes_to_a_point_without_a_leak_and_its_normals_lean() {
    let section = Section::circle(16).unwrap();
    let mesh = even(4)
        .sweep(&line(DVec3::Z * 2.0), &section, |t| 1.0 - t)
        .unwrap();
    assert_eq!((leaks(&mesh), euler(&mesh)), (0, 2));
    let exact = 16.0 / 2.0 * libm::sin(TAU / 16.0) * 2.0 / 3.0;
    assert!((volume(&mesh) / exact - 1.0).abs() < 1e-6);
    for normal in &mesh.normals[..5 * 17] {
        assert!((normal.z - 1.0 / 5f32.sqrt()).abs() < 1e-5, "{normal}");
    }
}

#[test]
fn a_torus_has_the_volume_of_pappus_and_its_normals_to_the_second_order() {
    let tube = |n| Tube {
        closed: true,
        first: DVec3::Z,
        ..even(n)
    };
    for n in [16, 64] {
        let section = Section::circle(n).unwrap();
        let mesh = tube(n).sweep(&circle(3.0), &section, |_| 1.0).unwrap();
        assert_eq!((leaks(&mesh), euler(&mesh)), (0, 0));
        let exact = TAU * 3.0 * PI;
        let error = 1.0 - volume(&mesh) / exact;
        assert!(error > 0.0 && error < 16.0 / (n * n) as f64, "{n}: {error}");
        for (p, n) in mesh.positions.iter().zip(&mesh.normals) {
            let center = Vec3::new(p.x, p.y, 0.0).normalize() * 3.0;
            assert!(n.distance((*p - center).normalize()) < 2e-5);
        }
    }
}

#[test]
fn along_an_arc_normals_are_right_at_the_ends_too_to_the_second_order() {
    let arc = circle(3.0).split(1.0).unwrap()[0].clone();
    let mut before = f32::INFINITY;
    for parts in [8, 16, 32] {
        let section = Section::circle(8).unwrap();
        let mesh = Tube {
            first: DVec3::Z,
            ..even(parts)
        }
        .sweep(&arc, &section, |_| 1.0)
        .unwrap();
        let side = mesh
            .positions
            .iter()
            .zip(&mesh.normals)
            .take((parts + 1) * 9);
        let errors = side.map(|(p, n)| {
            let center = Vec3::new(p.x, p.y, 0.0).normalize() * 3.0;
            n.distance((*p - center).normalize())
        });
        let worst = errors.fold(0.0, f32::max);
        assert!(worst < before / 3.5 && worst < 0.02, "{parts}: {worst}");
        before = worst;
    }
}

#[test]
fn round_caps_make_a_capsule_and_of_a_point_a_sphere() {
    for length in [1.0, 0.0] {
        let mut before = f64::INFINITY;
        for n in [8usize, 16, 32] {
            let tube = Tube {
                caps: Caps::Round(n),
                ..even(1)
            };
            let section = Section::circle(4 * n).unwrap();
            let mesh = tube
                .sweep(&line(DVec3::Z * length), &section, |_| 1.0)
                .unwrap();
            assert_eq!((leaks(&mesh), euler(&mesh)), (0, 2));
            let error = 1.0 - volume(&mesh) / (4.0 / 3.0 * PI + PI * length);
            assert!(error > 0.0 && error < before / 3.5, "{n}: {error}");
            before = error;
            for (p, normal) in mesh.positions.iter().zip(&mesh.normals) {
                let center = Vec3::Z * p.z.clamp(0.0, length as f32);
                let miss = normal.distance(*p - center);
                assert!(miss < 1e-6, "{p} {normal}: {miss}");
            }
        }
    }
}

#[test]
fn texture_coordinates_go_by_arc_length_and_meet_at_the_seam() {
    let path = Chain::catmull_rom(&[DVec3::ZERO, DVec3::Z, DVec3::Z * 5.0], 0.0).unwrap();
    let mesh = even(4)
        .sweep(&path, &Section::circle(6).unwrap(), |_| 0.5)
        .unwrap();
    for (ring, i) in mesh.positions[..5 * 7].chunks(7).zip(0..) {
        let uvs = &mesh.uvs[7 * i..7 * i + 7];
        assert_eq!((ring[0], uvs[0].x, uvs[6].x), (ring[6], 0.0, 1.0));
        for (j, uv) in uvs.iter().enumerate() {
            assert!((uv.x - j as f32 / 6.0).abs() < 1e-6);
            assert!((uv.y - i as f32 / 4.0).abs() < 1e-6 && (ring[j].z - 5.0 * uv.y).abs() < 1e-5);
        }
    }
    assert!(
        mesh.uvs
            .iter()
            .all(|uv| uv.cmpge(glam::Vec2::ZERO).all() && uv.cmple(glam::Vec2::ONE).all())
    );
}

#[test]
fn creases_have_both_normals_and_leak_nothing() {
    let square = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].map(DVec2::from);
    let section = Section::new(&square, 0.5).unwrap();
    let mesh = even(2).sweep(&line(DVec3::Z), &section, |_| 1.0).unwrap();
    assert_eq!((leaks(&mesh), euler(&mesh)), (0, 2));
    assert!((volume(&mesh) - 4.0).abs() < 1e-6);
    for n in &mesh.normals {
        assert_eq!(n.abs().max_element(), 1.0, "{n}");
    }
}

#[test]
fn rings_stand_where_the_curve_bends() {
    let tube = |angle, most| Tube {
        rings: Rings::Bends { angle, most },
        caps: Caps::Open,
        ..Tube::default()
    };
    let section = Section::circle(3).unwrap();
    let rings = |tube: Tube, curve: &Chain, radius: fn(f64) -> f64| {
        tube.sweep(curve, &section, radius).unwrap().positions.len() / 4
    };
    assert_eq!(
        rings(tube(0.1, 100), &line(DVec3::Z), |_| 1.0),
        2,
        "a straight tube needs its ends"
    );
    assert_eq!(
        rings(tube(0.1, 100), &line(DVec3::Z), |t| 1.0 - t),
        2,
        "so does a cone"
    );
    assert!(
        rings(tube(0.1, 100), &line(DVec3::Z), |t| 1.0 + t * t) > 6,
        "a horn needs more"
    );
    let circle = circle(2.0);
    for (angle, parts) in [(0.5, 13), (0.1, 63), (0.02, 315)] {
        let mesh = Tube {
            closed: true,
            ..tube(angle, 1000)
        }
        .sweep(&circle, &section, |_| 0.1)
        .unwrap();
        assert_eq!(mesh.positions.len() / 4, parts + 1, "{angle}");
    }
    let mesh = Tube {
        closed: true,
        ..tube(0.001, 50)
    }
    .sweep(&circle, &section, |_| 0.1)
    .unwrap();
    assert_eq!(mesh.positions.len() / 4, 51, "no more than asked for");
    // A hook: straight for long, then a quarter turn.
    let bezier = [
        [0.0, 0.0],
        [3.0, 0.0],
        [6.0, 0.0],
        [9.0, 0.0],
        [9.6, 0.0],
        [10.0, 0.4],
        [10.0, 1.0],
    ];
    let hook = Chain::bezier(&bezier.map(|[x, y]| DVec3::new(x, y, 0.0))).unwrap();
    let mesh = tube(0.1, 1000).sweep(&hook, &section, |_| 0.1).unwrap();
    let bent = mesh.uvs.iter().filter(|uv| uv.y > 0.85).count();
    assert!(
        bent as f64 > 0.9 * mesh.uvs.len() as f64,
        "{bent} of {}",
        mesh.uvs.len()
    );
}

#[test]
fn a_section_with_points_on_straight_edges_and_notches_closes_with_its_own_area() {
    let l = [
        [0.0, 0.0],
        [1.0, 0.0],
        [2.0, 0.0],
        [2.0, 1.0],
        [1.0, 1.0],
        [1.0, 1.5],
        [1.0, 2.0],
        [0.0, 2.0],
        [0.0, 1.0],
    ];
    let mut points = l.map(DVec2::from);
    for _ in 0..2 {
        let section = Section::new(&points, 0.1).unwrap();
        let mesh = even(1).sweep(&line(DVec3::Z), &section, |_| 1.0).unwrap();
        assert_eq!((leaks(&mesh), euler(&mesh)), (0, 2));
        assert!((volume(&mesh) - 3.0).abs() < 1e-6);
        points.reverse();
    }
}

#[test]
fn a_curve_without_length_gives_its_caps_back_to_back() {
    let section = Section::circle(5).unwrap();
    let mesh = even(3)
        .sweep(&line(DVec3::ZERO), &section, |_| 1.0)
        .unwrap();
    assert_eq!((leaks(&mesh), mesh.triangles.len()), (0, 6));
    let nothing = even(3)
        .sweep(&line(DVec3::ZERO), &section, |_| 0.0)
        .unwrap();
    assert!(nothing.triangles.is_empty());
}

proptest! {
    #[test]
    fn tubes_are_closed_and_never_nan_whatever_the_curve_and_the_rule(
        points in prop::collection::vec(prop::array::uniform3(-1i8..2), 1..7),
        spokes in prop::collection::vec(0.2f64..2.0, 3..9),
        rule in 0usize..4, caps in 0usize..4, adaptive: bool, closed: bool, crease in 0.0f64..4.0,
        profile in 0usize..4,
    ) {
        let points: Vec<DVec3> = points.iter().map(|p| DVec3::from(p.map(f64::from))).collect();
        let curve = match closed {
            true => Chain::closed_catmull_rom(&points, 0.5),
            false => Chain::catmull_rom(&points, 0.5),
        }.unwrap();
        let n = spokes.len() as f64;
        let star = |(i, r): (usize, &f64)| {
            let a = TAU * i as f64 / n;
            DVec2::new(libm::cos(a), libm::sin(a)) * *r
        };
        let star: Vec<DVec2> = spokes.iter().enumerate().map(star).collect();
        let section = Section::new(&star, crease).unwrap();
        let tube = Tube {
            framing: [
                Framing::Frenet,
                Framing::UpAxis(DVec3::Z),
                Framing::Propagated,
                Framing::DoubleReflection,
            ][rule],
            first: DVec3::X,
            rings: match adaptive {
                true => Rings::Bends { angle: 0.3, most: 40 },
                false => Rings::Even(9),
            },
            caps: [Caps::Flat, Caps::Flat, Caps::Round(3), Caps::Round(0)][caps],
            closed,
        };
        let radius = |t: f64| [0.3, 0.3 * t, 0.3 * (1.0 - t), (0.5 - t).abs()][profile];
        let mesh = tube.sweep(&curve, &section, radius).unwrap();
        prop_assert_eq!(leaks(&mesh), 0);
        prop_assert!(mesh.positions.iter().all(|p| p.is_finite()));
        prop_assert!(mesh.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-5));
        prop_assert!(mesh.uvs.iter().all(|uv| uv.min_element() >= 0.0 && uv.max_element() <= 1.0));
        prop_assert_eq!(mesh.positions.len(), mesh.normals.len());
        prop_assert_eq!(mesh.positions.len(), mesh.uvs.len());
        prop_assert!(mesh.triangles.iter().flatten().all(|&i| (i as usize) < mesh.positions.len()));
    }
}
