//! `.npz` files as NumPy reads them.

#![allow(clippy::unwrap_used, reason = "helpers of tests are tests too")]

mod support;

use pelage_io::{WriteOptions, sink_for};
use pelage_strands::{StrandBuffer, StreamInfo};
use std::path::Path;
use support::{python, raised, strands, write, write_still};

fn check(body: &str, path: &Path) {
    let script = format!("import sys, numpy as np\nf = np.load(sys.argv[1])\n{body}");
    python("numpy", &script, &[path]);
}

#[test]
fn arrays_have_their_names_types_shapes_and_values() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.npz");
    write_still(&path, &strands(30_000));
    check(
        r#"
m = 30000
counts = 2 + np.arange(m) % 5
n = counts.sum()
expected = dict(points=('f4', (n, 3)), counts=('u4', (m,)), widths=('f4', (n,)), colors=('f4', (n, 3)),
    opacities=('f4', (n,)), normals=('f4', (n, 3)), hair_id=('u8', (m,)), strand_id=('u4', (m,)),
    root_uv=('f4', (m, 2)), strand_uv=('f4', (m, 2)), group=('u4', (m,)), triangle=('u4', (m,)),
    barycentric=('f4', (m, 3)), root_rest=('f4', (m, 3)))
assert f.files == list(expected), f.files
for name, (kind, shape) in expected.items():
    assert f[name].dtype == kind and f[name].shape == shape, name
assert (f['counts'] == counts).all()
x = np.arange(m, dtype='f4') * np.float32(.01)
assert (f['points'][:, 0] == np.repeat(x, counts)).all()
assert (f['hair_id'] == np.arange(m) + 2**40).all() and (f['triangle'] == np.arange(m)).all()
assert (f['barycentric'] == [.5, .25, .25]).all() and (f['root_rest'][:, 0] == x).all()
assert (f['normals'] == [1, 0, 0]).all() and (f['opacities'] == 1).all()
import zipfile
z = zipfile.ZipFile(sys.argv[1])
assert z.testzip() is None
assert {i.date_time for i in z.infolist()} == {(1980, 1, 1, 0, 0, 0)}
"#,
        &path,
    );
}

#[test]
fn frames_give_points_and_normals_a_leading_axis() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.npz");
    let first = strands(40);
    let info = StreamInfo {
        frames: vec![1.0, 1.5],
        ..Default::default()
    };
    let frames = [first.clone(), raised(&first, 1.0)];
    write(&path, &WriteOptions::default(), &info, &frames, 7).unwrap();
    check(
        r#"
n = f['counts'].sum()
assert f['points'].shape == (2, n, 3) == f['normals'].shape and f['widths'].shape == (n,)
assert f['frames'].dtype == 'f8' and f['frames'].tolist() == [1, 1.5]
assert (f['points'][1][:, 1] == f['points'][0][:, 1] + np.float32(1)).all()
"#,
        &path,
    );
}

#[test]
fn no_hair_makes_empty_arrays() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.npz");
    write_still(&path, &StrandBuffer::new());
    check(
        "assert f['points'].shape == (0, 3) and f['counts'].shape == (0,) and f['hair_id'].dtype == 'u8'",
        &path,
    );
}

#[test]
fn attributes_that_strands_lack_are_left_out() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.npz");
    let mut strands = strands(3);
    strands.colors.clear();
    strands.group.clear();
    write_still(&path, &strands);
    check(
        "assert 'colors' not in f and 'group' not in f and 'triangle' in f",
        &path,
    );
}

#[test]
fn roots_without_hair_are_strands_of_one_vertex() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.npz");
    let mut roots = StrandBuffer::new();
    (0..5).for_each(|i| support::push_strand(&mut roots, i, 1));
    write_still(&path, &roots);
    check(
        "assert f['points'].shape == (5, 3) and f['counts'].tolist() == [1] * 5",
        &path,
    );
}

#[test]
#[ignore = "writes 4.4 GB; run after changes to the archive"]
fn arrays_past_4_gb_are_found_by_their_64_bit_sizes() {
    let folder = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).unwrap();
    let path = folder.path().join("a.npz");
    let chunk = StrandBuffer {
        offsets: vec![0, 1_000_000],
        points: (0..1_000_000).map(|i| [i as f32, 1.0, 2.0]).collect(),
        ..Default::default()
    };
    let mut sink = sink_for(&path, &WriteOptions::default()).unwrap();
    sink.begin(&StreamInfo::default()).unwrap();
    sink.begin_frame(0).unwrap();
    for _ in 0..365 {
        sink.write(&chunk).unwrap();
    }
    sink.end_frame().unwrap();
    sink.finish().unwrap();
    check(
        "p = f['points']\n\
         assert p.shape == (365_000_000, 3) and p[-1].tolist() == [999_999, 1, 2]\n\
         assert f['counts'].tolist() == [1_000_000] * 365\n",
        &path,
    );
}
