//! USD files as OpenUSD itself reads them (`pip install usd-core numpy`).

#![allow(clippy::unwrap_used, reason = "helpers of tests are tests too")]

mod support;

use pelage_io::WriteOptions;
use pelage_strands::{Bounds, StrandBuffer, StreamInfo, UpAxis};
use std::path::Path;
use support::{push_strand, python, raised, strands, write, write_still};

/// What scripts share: the stage, its curves, and all attributes as plain data.
const PRELUDE: &str = r#"
import sys
from pxr import Sdf, Usd, UsdGeom
import numpy as np

stages = []

def opened(path):
    # Prims do not keep their stage alive.
    stages.append(Usd.Stage.Open(path))
    return stages[-1]

def hair(stage):
    return UsdGeom.BasisCurves(stage.GetDefaultPrim().GetChild('hair'))

def primvar(curves, name):
    p = UsdGeom.PrimvarsAPI(curves).GetPrimvar(name)
    return (str(p.GetTypeName()), str(p.GetInterpolation()), np.array(p.Get())) if p.HasAuthoredValue() else None

def everything(path):
    layer = Sdf.Layer.FindOrOpen(path)
    assert layer, path
    found = {}
    def visit(p):
        spec = layer.GetObjectAtPath(p)
        for key in spec.ListInfoKeys():
            if key in ('primChildren', 'properties'):
                continue
            value = spec.GetInfo(key)
            if key == 'timeSamples':
                value = {t: np.array(v).tolist() for t, v in value.items()}
            elif key == 'default' and hasattr(value, '__len__') and not isinstance(value, str):
                value = np.array(value).tolist()
            found[str(p), key] = value
    layer.Traverse('/', visit)
    return found
"#;

fn check(body: &str, arguments: &[&Path]) {
    python("pxr.Usd", &format!("{PRELUDE}{body}"), arguments);
}

/// Writes `frames` as `.usda` and `.usdc` and runs `body` on each, then demands that
/// both say the same.
fn check_both(info: &StreamInfo, options: &WriteOptions, frames: &[StrandBuffer], body: &str) {
    let folder = tempfile::tempdir().unwrap();
    let (text, binary) = (folder.path().join("a.usda"), folder.path().join("a.usdc"));
    for path in [&text, &binary] {
        write(path, options, info, frames, 7).unwrap();
        check(body, &[path]);
    }
    check(
        "a, b = everything(sys.argv[1]), everything(sys.argv[2])\n\
         for key in a.keys() | b.keys():\n\
         \x20   assert repr(a.get(key)) == repr(b.get(key)), (key, a.get(key), b.get(key))\n",
        &[&text, &binary],
    );
}

fn still() -> StreamInfo {
    StreamInfo::default()
}

#[test]
fn curves_have_doubled_ends_and_all_attributes_in_their_domains() {
    let strands = strands(50);
    let bounds = Bounds::of(&strands);
    let info = StreamInfo {
        name: "fox".into(),
        up_axis: UpAxis::Z,
        meters_per_unit: 0.001,
        ..Default::default()
    };
    let options = WriteOptions {
        tool: "pelage \"0\"\nnext".into(),
        ..Default::default()
    };
    let body = format!(
        r#"
stage = opened(sys.argv[1])
assert UsdGeom.GetStageUpAxis(stage) == 'Z' and UsdGeom.GetStageMetersPerUnit(stage) == 0.001
assert stage.GetRootLayer().documentation == 'pelage "0"\nnext', stage.GetRootLayer().documentation
assert not stage.HasAuthoredTimeCodeRange()
root = stage.GetDefaultPrim()
assert root.GetPath() == '/fox' and root.GetTypeName() == 'Xform'
assert Usd.ModelAPI(root).GetKind() == 'component'
assert len(list(stage.Traverse())) == 2
h = hair(stage)
assert (h.GetTypeAttr().Get(), h.GetBasisAttr().Get(), h.GetWrapAttr().Get()) == ('cubic', 'catmullRom', 'nonperiodic')
assert h.GetTypeAttr().GetVariability() == Sdf.VariabilityUniform
assert h.GetPointsAttr().GetVariability() == Sdf.VariabilityVarying
counts = np.array(h.GetCurveVertexCountsAttr().Get())
assert (counts == [4 + i % 5 for i in range(50)]).all()
points = np.array(h.GetPointsAttr().Get())
assert len(points) == counts.sum()
starts = np.concatenate([[0], np.cumsum(counts)])
for a, b in zip(starts, starts[1:]):
    assert (points[a] == points[a + 1]).all() and (points[b - 1] == points[b - 2]).all()
    assert not (points[a + 1] == points[a + 2]).all()
widths = np.array(h.GetWidthsAttr().Get())
assert h.GetWidthsInterpolation() == 'vertex' and len(widths) == counts.sum()
assert widths[0] == widths[1] == np.float32(0.01)
for name, kind, domain, n in [
    ('displayColor', 'color3f[]', 'vertex', counts.sum()), ('displayOpacity', 'float[]', 'constant', 1),
    ('st', 'texCoord2f[]', 'uniform', 50), ('hairId', 'int64[]', 'uniform', 50),
    ('strandId', 'int[]', 'uniform', 50), ('group', 'int[]', 'uniform', 50), ('restRoot', 'point3f[]', 'uniform', 50)]:
    k, d, v = primvar(h, name)
    assert (k, d, len(v)) == (kind, domain, n), (name, k, d, len(v))
assert (primvar(h, 'hairId')[2] == np.arange(50) + 2**40).all()
assert (primvar(h, 'strandId')[2] == np.arange(50) % 3).all()
assert (primvar(h, 'displayColor')[2][0] == np.float32([0, .5, .1])).all()
assert (primvar(h, 'st')[2] == np.stack([np.arange(50, dtype='f4') * np.float32(.01), np.full(50, .25)], 1)).all()
assert primvar(h, 'strandUv') is None and not h.GetNormalsAttr().HasAuthoredValue()
extent = np.array(h.GetExtentAttr().Get())
assert (extent == np.float32([{:?}, {:?}])).all(), extent
"#,
        bounds.min, bounds.max
    );
    check_both(&info, &options, &[strands], &body);
}

#[test]
fn opacities_are_one_number_or_one_a_vertex() {
    let mut strands = strands(50);
    let constant = "v = primvar(hair(opened(sys.argv[1])), 'displayOpacity')\n\
                    assert v[1] == 'constant' and v[2].tolist() == [1.0]\n";
    check_both(
        &still(),
        &WriteOptions::default(),
        &[strands.clone()],
        constant,
    );
    let last = strands.opacities.len() - 1;
    strands.opacities[last] = 0.25;
    let varied = "h = hair(opened(sys.argv[1])); v = primvar(h, 'displayOpacity')\n\
                  assert v[1] == 'vertex' and len(v[2]) == len(h.GetPointsAttr().Get())\n\
                  assert (v[2][:-2] == 1).all() and (v[2][-2:] == .25).all()\n";
    check_both(
        &still(),
        &WriteOptions::default(),
        &[strands.clone()],
        varied,
    );
    strands.opacities.clear();
    let absent = "assert primvar(hair(opened(sys.argv[1])), 'displayOpacity') is None\n";
    check_both(&still(), &WriteOptions::default(), &[strands], absent);
}

#[test]
fn attributes_that_strands_lack_are_left_out() {
    let whole = strands(5);
    let bare = StrandBuffer {
        offsets: whole.offsets,
        points: whole.points,
        ..Default::default()
    };
    let body = "h = hair(opened(sys.argv[1]))\n\
                names = {a.GetName() for a in h.GetPrim().GetAuthoredAttributes()}\n\
                assert names == {'type', 'basis', 'wrap', 'curveVertexCounts', 'points', 'extent'}, names\n";
    check_both(&still(), &WriteOptions::default(), &[bare], body);
}

#[test]
fn frames_become_time_samples_of_points_extent_and_normals() {
    let info = StreamInfo {
        frames: vec![1.0, 2.5, 4.0],
        frames_per_second: 25.0,
        ..Default::default()
    };
    let options = WriteOptions {
        ribbons: true,
        ..Default::default()
    };
    let first = strands(20);
    let mut last = raised(&first, 2.0);
    last.normals.fill([0.0, 1.0, 0.0]);
    let frames = [first.clone(), raised(&first, 1.0), last];
    let body = r#"
stage = opened(sys.argv[1])
assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (1, 4)
assert (stage.GetTimeCodesPerSecond(), stage.GetFramesPerSecond()) == (25, 25)
h = hair(stage)
for a in [h.GetPointsAttr(), h.GetExtentAttr(), h.GetNormalsAttr()]:
    assert a.GetTimeSamples() == [1, 2.5, 4], a
at = lambda t: np.array(h.GetPointsAttr().Get(t))
assert (at(2.5)[:, 1] == at(1)[:, 1] + np.float32(1)).all()
assert np.allclose(at(1.75)[:, 1], at(1)[:, 1] + .5)
assert len(h.GetWidthsAttr().GetTimeSamples()) == 0 and len(h.GetWidthsAttr().Get()) == len(at(1))
assert h.GetExtentAttr().Get(4)[1][1] > 2
n = lambda t: np.array(h.GetNormalsAttr().Get(t))
assert h.GetNormalsInterpolation() == 'vertex'
assert len(n(1)) == len(at(1)) and (n(2.5) == [1, 0, 0]).all() and (n(4) == [0, 1, 0]).all()
"#;
    check_both(&info, &options, &frames, body);
}

#[test]
fn no_hair_is_a_valid_file() {
    let body = "h = hair(opened(sys.argv[1]))\n\
                for a in [h.GetPointsAttr(), h.GetCurveVertexCountsAttr(), h.GetWidthsAttr(), h.GetExtentAttr()]:\n\
                \x20   assert a.HasAuthoredValue() and len(a.Get()) == 0, a\n\
                assert h.GetCurveCount() == 0\n";
    let none = [StrandBuffer::new()];
    check_both(&still(), &WriteOptions::default(), &none, body);
    let info = StreamInfo {
        frames: vec![1.0, 2.0],
        ..Default::default()
    };
    let none = [StrandBuffer::new(), StrandBuffer::new()];
    let body = "h = hair(opened(sys.argv[1]))\nassert len(h.GetPointsAttr().Get(2)) == 0\n";
    check_both(&info, &WriteOptions::default(), &none, body);
}

#[test]
fn a_curve_of_one_vertex_gets_four_and_one_of_none_goes() {
    let mut strands = StrandBuffer::new();
    for (i, vertices) in [1, 0, 3].into_iter().enumerate() {
        push_strand(&mut strands, i, vertices);
    }
    let body = "h = hair(opened(sys.argv[1]))\n\
                assert list(h.GetCurveVertexCountsAttr().Get()) == [4, 5]\n\
                assert len(h.GetPointsAttr().Get()) == len(h.GetWidthsAttr().Get()) == 9\n\
                assert (primvar(h, 'hairId')[2] - 2**40).tolist() == [0, 2]\n";
    check_both(&still(), &WriteOptions::default(), &[strands], body);
}

#[test]
fn strand_uv_is_written_where_one_is_not_zero() {
    let mut strands = strands(9);
    strands.strand_uv[4] = [0.5, -0.5];
    let body = "v = primvar(hair(opened(sys.argv[1])), 'strandUv')\n\
                assert v[1] == 'uniform' and v[2].tolist() == [[0, 0]] * 4 + [[.5, -.5]] + [[0, 0]] * 4\n";
    check_both(&still(), &WriteOptions::default(), &[strands], body);
}

#[test]
fn a_hundred_thousand_hairs_pass_through_the_spools_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.usdc");
    let mut strands = strands(100_000);
    strands.opacities[300_000] = 0.5;
    write_still(&path, &strands);
    let body = r#"
h = hair(opened(sys.argv[1]))
counts = np.array(h.GetCurveVertexCountsAttr().Get())
assert (counts == 4 + np.arange(100000) % 5).all()
points = np.array(h.GetPointsAttr().Get())
x = np.arange(100000, dtype='f4') * np.float32(.01)
assert (points[:, 0] == np.repeat(x, counts)).all()
opacity = primvar(h, 'displayOpacity')[2]
assert len(opacity) == len(points) and (opacity != 1).sum() in (1, 2)
assert (primvar(h, 'hairId')[2] == np.arange(100000) + 2**40).all()
assert (primvar(h, 'restRoot')[2][:, 0] == x).all()
assert len(primvar(h, 'displayColor')[2]) == len(points)
"#;
    check(body, &[&path]);
}
