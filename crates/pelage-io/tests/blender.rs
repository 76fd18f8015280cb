//! USD files as Blender imports and exports them (`pip install bpy`, set `PELAGE_PYTHON`).

#![allow(clippy::unwrap_used, reason = "helpers of tests are tests too")]

mod support;

use pelage_io::{WriteOptions, mesh_frames, read_mesh};
use pelage_strands::StreamInfo;
use support::{python, raised, strands, write};

const SCRIPT: &str = r#"
import sys, bpy
import numpy as np
bpy.ops.wm.read_factory_settings(use_empty=True)
assert bpy.ops.wm.usd_import(filepath=sys.argv[1]) == {'FINISHED'}
curves = [o for o in bpy.data.objects if o.type == 'CURVES']
assert len(curves) == 1, [(o.name, o.type) for o in bpy.data.objects]
data = curves[0].data
print('Blender', bpy.app.version_string, 'attributes',
      sorted((a.name, a.domain, a.data_type) for a in data.attributes))
counts = np.array([c.points_length for c in data.curves])
assert (counts == 4 + np.arange(100) % 5).all(), counts
radius = np.empty(len(data.points), 'f4')
data.attributes['radius'].data.foreach_get('value', radius)
# Half the width, which falls from root to tip; the ends come twice.
expected = np.concatenate([
    [.005 * (1 - k / (n - 2)) for k in [0, *range(n - 2), n - 3]] for n in counts])
assert np.allclose(radius, expected, atol=1e-7), (radius[:9], expected[:9])
# (`hairId` is dropped with a warning: Blender has no 64-bit integers.)
group = data.attributes['group']
assert group.domain == 'CURVE' and [d.value for d in group.data] == [i % 2 for i in range(100)]
def height(frame):
    bpy.context.scene.frame_set(frame)
    seen = curves[0].evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    at = np.empty(3 * len(seen.points), 'f4')
    seen.attributes['position'].data.foreach_get('vector', at)
    return at.reshape(-1, 3)[:, 1:]
moved = np.abs(height(2) - height(1)).max(axis=0)
assert np.isclose(moved.max(), 3), moved
"#;

#[test]
fn blender_imports_curves_with_their_radii_attributes_and_motion() {
    let folder = tempfile::tempdir().unwrap();
    let info = StreamInfo {
        frames: vec![1.0, 2.0],
        meters_per_unit: 1.0,
        ..Default::default()
    };
    let first = strands(100);
    let frames = [first.clone(), raised(&first, 3.0)];
    for name in ["a.usdc", "a.usda"] {
        let path = folder.path().join(name);
        write(&path, &WriteOptions::default(), &info, &frames, 33).unwrap();
        if !python("bpy", SCRIPT, &[&path]) {
            return;
        }
    }
}

const EXPORT: &str = r#"
import sys, bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.mesh.primitive_cube_add(size=2)
cube = bpy.context.object
for frame, height in [(1, 0), (3, 8)]:
    cube.location = (0, 0, height)
    cube.keyframe_insert('location', frame=frame)
bpy.context.scene.frame_end = 3
bpy.ops.wm.usd_export(filepath=sys.argv[1], export_animation=True)
"#;

#[test]
fn packages_that_blender_exports_are_read_with_their_frames() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cube.usdz");
    if !python("bpy", EXPORT, &[&path]) {
        return;
    }
    assert_eq!(mesh_frames(&path).unwrap(), [1.0, 2.0, 3.0]);
    let last = read_mesh(&path, Some(3.0)).unwrap().mesh;
    assert_eq!(last.face_sizes, [4; 6]);
    assert!(
        last.positions
            .iter()
            .all(|[.., z]| (6.99..9.01).contains(z))
    );
}
