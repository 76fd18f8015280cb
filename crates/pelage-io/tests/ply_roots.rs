//! Point clouds of roots, as other programs read them.

#![allow(clippy::unwrap_used, reason = "helpers of tests are tests too")]

mod support;

use pelage_io::WriteOptions;
use pelage_strands::StreamInfo;
use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{DefaultElement, Property};
use std::path::Path;
use support::{python, raised, strands, write, write_still};

#[test]
fn every_property_of_every_root_is_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.ply");
    let strands = strands(3000);
    write_still(&path, &strands);
    let mut file = std::fs::File::open(&path).unwrap();
    let cloud = Parser::<DefaultElement>::new().read_ply(&mut file).unwrap();
    let vertices = &cloud.payload["vertex"];
    assert_eq!(vertices.len(), 3000);
    for (i, vertex) in vertices.iter().enumerate() {
        let first = strands.offsets[i] as usize;
        let floats = |names: &[&str]| -> Vec<f32> {
            let value = |name: &&str| match vertex[*name] {
                Property::Float(value) => value,
                ref other => panic!("{name} is {other:?}"),
            };
            names.iter().map(value).collect()
        };
        assert_eq!(floats(&["x", "y", "z"]), strands.points[first]);
        assert_eq!(floats(&["nx", "ny", "nz"]), strands.normals[first]);
        assert_eq!(floats(&["s", "t"]), strands.root_uv[i]);
        assert_eq!(floats(&["b0", "b1", "b2"]), strands.barycentric[i]);
        let rest = floats(&["rest_x", "rest_y", "rest_z"]);
        assert_eq!(rest, strands.root_rest[i]);
        let hair = strands.hair_id[i] as f64;
        assert!(matches!(vertex["hair_id"], Property::Double(id) if id == hair));
        assert!(matches!(vertex["triangle"], Property::UInt(t) if t == strands.triangle[i]));
        assert!(matches!(vertex["group"], Property::UInt(g) if g == strands.group[i]));
    }
}

#[test]
fn python_reads_the_points() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.ply");
    write_still(&path, &strands(3000));
    let body = r#"
import sys, numpy as np
from plyfile import PlyData
v = PlyData.read(sys.argv[1])["vertex"]
i = np.arange(3000)
x = i.astype("f4") * np.float32(.01)
assert len(v) == 3000 and (v["x"] == x).all() and (v["rest_x"] == x).all()
assert (v["hair_id"] == i + 2**40).all() and (v["triangle"] == i).all()
assert (v["nx"] == 1).all() and (v["b0"] == .5).all() and (v["group"] == i % 2).all()
"#;
    python("plyfile", body, &[&path]);
    let body = "import sys, trimesh\n\
        cloud = trimesh.load(sys.argv[1])\n\
        assert cloud.vertices.shape == (3000, 3), cloud\n";
    python("trimesh", body, &[&path]);
}

fn fails(path: &Path, info: &StreamInfo, frames: &[pelage_strands::StrandBuffer]) -> String {
    let written = write(path, &WriteOptions::default(), info, frames, 10);
    assert!(!path.exists());
    written.unwrap_err().to_string()
}

#[test]
fn what_a_point_cloud_cannot_hold_is_refused_in_words() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.ply");
    let still = StreamInfo::default();
    let mut bare = strands(3);
    bare.normals.clear();
    let words = fails(&path, &still, &[bare]);
    assert!(words.contains("the strands have no normals"), "{words}");
    let mut far = strands(3);
    far.hair_id[1] = (1 << 53) + 1;
    let words = fails(&path, &still, &[far]);
    assert!(words.contains("hair 9007199254740993"), "{words}");
    let moving = StreamInfo {
        frames: vec![1.0, 2.0],
        ..still
    };
    let words = fails(&path, &moving, &[strands(3), raised(&strands(3), 1.0)]);
    assert!(words.contains("one frame"), "{words}");
}
