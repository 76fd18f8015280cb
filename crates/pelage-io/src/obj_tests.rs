use super::*;

fn mesh(text: &str) -> PolygonMesh {
    parse_obj_mesh(text.as_bytes(), Path::new("a.obj")).unwrap()
}

fn mesh_error(text: &str) -> String {
    parse_obj_mesh(text.as_bytes(), Path::new("a.obj"))
        .unwrap_err()
        .to_string()
}

fn curves(text: &str) -> CurveSet {
    let mut file = parse_obj_curves(text.as_bytes(), Path::new("a.obj")).unwrap();
    file.sets.remove(0)
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn polygons_stay_polygons_and_objects_are_merged() {
    let text = format!("{SQUARE}o one\nf 1 2 3 4\r\no two\nf 1 2 3\n");
    let mesh = mesh(&text);
    assert_eq!(mesh.positions.len(), 4);
    assert_eq!(mesh.face_sizes, [4, 3]);
    assert_eq!(mesh.corner_vertices, [0, 1, 2, 3, 0, 1, 2]);
    assert!(mesh.corner_uvs.is_empty() && mesh.corner_normals.is_empty());
}

#[test]
fn negative_indices_count_back_from_the_statement() {
    let mesh = mesh(&format!(
        "{SQUARE}vt 0 0\nvt 1 1\nf -4/-2 -3/-1 -2/1\nv 9 9 9\n"
    ));
    assert_eq!(mesh.corner_vertices, [0, 1, 2]);
    assert_eq!(mesh.corner_uvs, [[0.0, 0.0], [1.0, 1.0], [0.0, 0.0]]);
}

#[test]
fn an_attribute_that_some_corner_lacks_is_left_out() {
    let text = format!("{SQUARE}vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\nf 1//1 3//1 4//1\n");
    let mesh = mesh(&text);
    assert!(mesh.corner_uvs.is_empty());
    assert_eq!(mesh.corner_normals, [[0.0, 0.0, 1.0]; 6]);
}

#[test]
fn vertices_may_come_after_the_face_but_must_come() {
    assert_eq!(
        mesh(&format!("f 1 2 3\n{SQUARE}")).corner_vertices,
        [0, 1, 2]
    );
    let error = mesh_error(&format!("{SQUARE}f 1 2 3\nf 1 2 9\n"));
    assert!(error.contains("line 6: vertex 9 does not exist"), "{error}");
}

#[test]
fn errors_name_the_file_and_the_line() {
    let cases = [
        ("v 0 0\n", "line 1"),
        ("v 0 0 0\nv 0 nan 0\n", "line 2"),
        ("v 0 0 1e99\n", "line 1"),
        ("v 0 0 zero\n", "\"zero\" is no number"),
        ("v 0 0 0\nf 0 1 1\n", "line 2: vertex index 0"),
        ("v 0 0 0\nf -2 1 1\n", "line 2: vertex -2 does not exist"),
        ("v 0 0 0\nf 1/-1 1 1\n", "texture coordinate -1"),
        ("v 0 0 0\nf -9223372036854775808 1 1\n", "does not exist"),
        (
            "v 0 0 0\nf 99999999999999999999 1 1\n",
            "is no vertex index",
        ),
        ("v 0 0 0\nf 4294967296 1 1\n", "does not exist"),
        ("v 0 0 0\nf 1/1/1/1 1 1\n", "expected v/vt/vn"),
        ("v 0 0 0\nf 1 1\n", "a face of 2 corners"),
        ("v 0 0 0\n\n\\\nf 1 1\n", "line 3"),
        ("", "there is no face"),
    ];
    for (text, expected) in cases {
        let error = mesh_error(text);
        assert!(error.starts_with("a.obj: "), "{error}");
        assert!(error.contains(expected), "{text:?}: {error}");
    }
}

#[test]
fn comments_continuations_and_byte_order_marks_are_no_trouble() {
    let text = "\u{feff}v 0 0 0 # first\nv 1 0 0\nv 1 1 \\\r\n 0\nusemtl \u{e9}\nf 1 2 3 # end";
    assert_eq!(mesh(text).positions[2], [1.0, 1.0, 0.0]);
}

#[test]
fn polylines_become_curves_with_root_uvs() {
    let text =
        format!("{SQUARE}o fur ball\nvt 0.25 0.75\nvt 0.5 0.5\nl 1/1 2 3\nl 3/2 4\nl 1/2 4\n");
    let set = curves(&text);
    assert_eq!(set.name, "fur ball");
    assert_eq!(set.curves.offsets, [0, 4, 6]);
    assert_eq!(set.curves.root_uv, [[0.25, 0.75], [0.5, 0.5]]);
    assert_eq!(set.attributes.len(), 2);
    assert!(set.curve(0).is_some());
}

#[test]
fn a_mesh_is_told_from_curves() {
    assert!(mesh_error("v 0 0 0\nl 1 1\n").contains("can be read as curves"));
    let text = format!("{SQUARE}f 1 2 3\n");
    let error = parse_obj_curves(text.as_bytes(), Path::new("a.obj")).unwrap_err();
    assert!(error.to_string().contains("can be read as a mesh"));
}
