//! What the guides of a hair are, and how they share it.

use crate::fixture::collect;
use pelage_curves::Vec3;
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
