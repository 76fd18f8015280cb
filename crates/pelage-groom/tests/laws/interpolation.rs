//! What the guides of a hair are, and how they share it.

use crate::fixture::{Fixture, collect};
use pelage_curves::Vec3;
use pelage_groom::random::{Channel, uniform};
use pelage_groom::recipe::Recipe;
use pelage_groom::{Groom, Images, Plan};
use pelage_strands::StrandBuffer;
use pelage_surface::PolygonMesh;
use std::path::Path;

/// Every way to share a hair.
const WAYS: [&str; 5] = [
    "",
    "interpolation.facing = true",
    "interpolation = { method = 'nearest', facing = true }",
    "interpolation.method = 'natural-neighbor'",
    "interpolation = { method = 'natural-neighbor', facing = { exponent = 1.0 } }",
];

/// From root to tip.
fn tip(strands: &StrandBuffer, i: usize) -> Vec3 {
    let points = strands.strand_points(i);
    points[points.len() - 1] - points[0]
}

/// Half the thickness of the ear.
const THIN: f32 = 0.005;

/// A flat ear of two square sides that lie back to back, with a few short guides that
/// lean one way in front and many long ones that lean another way behind.
fn ear(more: &str) -> Plan {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let side = |z: f32| corners.map(|[x, y]| [x, y, z]);
    let mesh = PolygonMesh {
        positions: [side(THIN), side(-THIN)].concat(),
        face_sizes: vec![4, 4],
        corner_vertices: vec![0, 1, 2, 3, 7, 6, 5, 4],
        ..PolygonMesh::default()
    };
    let guides = |across: u32, z: f32, along: Vec3| {
        (0..across * across).map(move |i| {
            let [x, y] = [i % across, i / across].map(|k| (k as f32 + 0.5) / across as f32);
            let root = Vec3::new(x, y, z);
            (0..5).map(|k| root + along * k as f32 / 4.0).collect()
        })
    };
    let front = guides(3, THIN, Vec3::new(0.3, 0.0, 0.1));
    let behind = guides(20, -THIN, Vec3::new(-0.2, 0.9, -0.4));
    let text = format!(
        "{more}
        surface.mesh = 'ear.obj'
        guides.curves = 'guides.usda'
        hair.count = 2000"
    );
    let groom = Groom {
        recipe: Recipe::parse(&text, Path::new("groom.toml")).unwrap(),
        mesh,
        keep_file_normals: false,
        images: Images::new(),
        guides: front.chain(behind).collect(),
    };
    Plan::new(groom).unwrap()
}

/// How many hairs of the ear have not the length of the guides of their side.
fn strangers(more: &str) -> usize {
    let strands = collect(&ear(more), 0..2000, 2);
    let lengths = [Vec3::new(0.3, 0.0, 0.1), Vec3::new(-0.2, 0.9, -0.4)].map(Vec3::length);
    let fits = |&i: &usize| {
        let front = strands.strand_points(i)[0].z > 0.0;
        let length = tip(&strands, i).length();
        (length - lengths[usize::from(!front)]).abs() < 1e-4
    };
    strands.len() - (0..strands.len()).filter(fits).count()
}

#[test]
fn guides_on_the_far_side_of_an_ear_count_nothing_when_facing_is_on() {
    for more in WAYS {
        let found = strangers(more);
        if !more.contains("facing") {
            assert!(found > 500, "{found}");
        } else {
            assert_eq!(found, 0, "{more}");
        }
    }
}

#[test]
fn where_every_guide_points_into_the_skin_hairs_grow_by_distance() {
    let text = "surface.mesh = 'ear.obj'
        guides.curves = 'guides.usda'
        interpolation.facing = true
        hair.count = 200";
    let sheet = PolygonMesh {
        positions: vec![[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]],
        face_sizes: vec![4],
        corner_vertices: vec![0, 1, 2, 3],
        ..PolygonMesh::default()
    };
    let down = |x: f32| vec![Vec3::new(x, 0.5, 0.0), Vec3::new(x, 0.5, -1.0)];
    let groom = Groom {
        recipe: Recipe::parse(text, Path::new("groom.toml")).unwrap(),
        mesh: sheet,
        keep_file_normals: false,
        images: Images::new(),
        guides: [0.1, 0.4, 0.5, 0.6, 0.9].map(down).to_vec(),
    };
    let strands = collect(&Plan::new(groom).unwrap(), 0..200, 1);
    assert_eq!(strands.len(), 200);
    for i in 0..strands.len() {
        assert!((tip(&strands, i) + Vec3::Z).length() < 1e-4);
    }
}

#[test]
fn hairs_that_grow_side_by_side_look_alike_also_where_their_guides_change() {
    for more in [
        "",
        "interpolation.space = 'frenet'",
        "interpolation.space = 'helix'",
    ] {
        let fixture = Fixture {
            flat: true,
            more,
            ..Fixture::default()
        };
        assert_alike(&collect(&fixture.plan(), 0..5000, 2));
    }
}

fn assert_alike(strands: &StrandBuffer) {
    let root = |i: usize| strands.strand_points(i)[0];
    let mut pairs = 0;
    for i in 0..strands.len() {
        for j in i + 1..strands.len() {
            let apart = root(i).distance(root(j));
            if apart < 0.02 {
                pairs += 1;
                // Guides stand 0.25 apart and are 0.4 long: over that distance a tip may
                // turn right round, some 3 lengths a length, and thrice that beside a guide (8.0
                // here in helix space). A jump would be 20.
                let [a, b] = [i, j].map(|k| strands.strand_points(k));
                let between = |k: usize| (a[k] - a[0]).distance(b[k] - b[0]);
                let jump = (1..a.len()).map(between).fold(0.0, f32::max);
                assert!(jump < 9.0 * apart, "hairs {i}, {j}: {jump} over {apart}");
            }
        }
    }
    assert!(pairs > 300, "{pairs}");
}

/// Curls that stand on a sheet, at random phases; hairs of them with more lines.
fn curls(more: &str) -> StrandBuffer {
    let sheet = PolygonMesh {
        positions: vec![[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]],
        face_sizes: vec![4],
        corner_vertices: vec![0, 1, 2, 3],
        ..PolygonMesh::default()
    };
    let guide = |i: u32| {
        let [x, y] = [i % 8, i / 8].map(|k| (k as f32 + 0.5) / 8.0);
        let phase = uniform(1, i as u64, Channel::GuideCurl);
        let at = |k: u32| {
            let t = k as f32 / 36.0;
            let angle = std::f32::consts::TAU * (3.0 * t + phase);
            Vec3::new(
                RADIUS * libm::cosf(angle),
                RADIUS * libm::sinf(angle),
                0.5 * t,
            )
        };
        let root = Vec3::new(x, y, 0.0);
        (0..=36).map(|k| root + at(k) - at(0)).collect()
    };
    let text = format!(
        "{more}
        surface.mesh = 'sheet.obj'
        guides.curves = 'guides.usda'
        hair.count = 2000"
    );
    let groom = Groom {
        recipe: Recipe::parse(&text, Path::new("groom.toml")).unwrap(),
        mesh: sheet,
        keep_file_normals: false,
        images: Images::new(),
        guides: (0..64).map(guide).collect(),
    };
    collect(&Plan::new(groom).unwrap(), 0..2000, 2)
}

const RADIUS: f32 = 0.05;

/// Part of the radius that hair `i` has of its guides: root mean square distance from the
/// middle of whole turns.
fn radius_kept(strands: &StrandBuffer, i: usize) -> f32 {
    let points = strands.strand_points(i);
    let turns = points[..points.len() - 1].iter();
    let flat = turns.map(|p| Vec3::new(p.x, p.y, 0.0));
    let count = flat.len() as f32;
    let middle = flat.clone().sum::<Vec3>() / count;
    let squares: f32 = flat.map(|p| p.distance_squared(middle)).sum();
    (squares / count).sqrt() / RADIUS
}

#[test]
fn curls_keep_their_radius_in_frenet_and_helix_space_and_lose_it_by_vertices() {
    for method in ["inverse-distance", "natural-neighbor"] {
        let mean = |space: &str| {
            let strands = curls(&format!(
                "interpolation = {{ space = '{space}', method = '{method}' }}"
            ));
            let kept = (0..strands.len()).map(|i| radius_kept(&strands, i));
            kept.sum::<f32>() / strands.len() as f32
        };
        let [vertices, frenet, helix] = ["vertices", "frenet", "helix"].map(mean);
        println!("{method}: vertices {vertices}, frenet {frenet}, helix {helix}");
        assert!(vertices < 0.9 && frenet > 0.98, "{vertices} {frenet}");
        assert!(helix > 0.97, "{helix}");
    }
}
