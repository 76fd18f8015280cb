use super::*;

/// A glTF of one mesh: a square of 4 vertices with normals and uvs in a buffer of
/// `F` (positions 0..48, normals 48..96, uvs 96..128, six u16 indices 128..140).
fn square(nodes: &str, mode: u32, buffer: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
        "nodes":{nodes},
        "meshes":[{{"primitives":[{{"mode":{mode},"indices":3,
            "attributes":{{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2}}}}]}}],
        "accessors":[
            {{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}},
            {{"bufferView":0,"byteOffset":48,"componentType":5126,"count":4,"type":"VEC3"}},
            {{"bufferView":0,"byteOffset":96,"componentType":5126,"count":4,"type":"VEC2"}},
            {{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}}],
        "bufferViews":[{{"buffer":0,"byteLength":128}},
            {{"buffer":0,"byteOffset":128,"byteLength":12}}],
        "buffers":[{{"byteLength":140{buffer}}}]}}"#
    )
}

fn data() -> Vec<u8> {
    let corners = [[0.0f32, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let mut numbers = Vec::new();
    corners
        .iter()
        .for_each(|[x, y]| numbers.extend([*x, *y, 0.0]));
    corners.iter().for_each(|_| numbers.extend([0.0, 0.6, 0.8]));
    corners.iter().for_each(|[x, y]| numbers.extend([*x, *y]));
    let mut bytes: Vec<u8> = numbers.iter().flat_map(|n: &f32| n.to_le_bytes()).collect();
    bytes.extend([0u16, 1, 2, 0, 2, 3].iter().flat_map(|i| i.to_le_bytes()));
    bytes
}

fn glb(json: &str) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let data = data();
    let mut bytes = b"glTF".to_vec();
    bytes.extend(2u32.to_le_bytes());
    bytes.extend((28 + json.len() as u32 + data.len() as u32).to_le_bytes());
    bytes.extend((json.len() as u32).to_le_bytes());
    bytes.extend(b"JSON");
    bytes.extend(json);
    bytes.extend((data.len() as u32).to_le_bytes());
    bytes.extend(b"BIN\0");
    bytes.extend(data);
    bytes
}

fn parse(json: &str) -> Result<PolygonMesh, ReadError> {
    parse_gltf_mesh(&glb(json), Path::new("a.glb"))
}

const PLAIN: &str = r#"[{"mesh":0}]"#;

#[test]
fn a_binary_file_is_read_with_uvs_from_the_lower_left() {
    let mesh = parse(&square(PLAIN, 4, "")).unwrap();
    assert_eq!(mesh.face_sizes, [3, 3]);
    assert_eq!(mesh.corner_vertices, [0, 1, 2, 0, 2, 3]);
    assert_eq!(mesh.corner_uvs[0], [0.0, 1.0]);
    assert_eq!(mesh.corner_uvs[2], [1.0, 0.0]);
    assert!((mesh.corner_normals[0][1] - 0.6).abs() < 1e-6);
}

#[test]
fn strips_and_fans_become_triangles() {
    let strip = parse(&square(PLAIN, 5, "")).unwrap();
    assert_eq!(strip.corner_vertices, [0, 1, 2, 1, 0, 2, 2, 0, 2, 0, 3, 2]);
    let fan = parse(&square(PLAIN, 6, "")).unwrap();
    assert_eq!(fan.corner_vertices, [1, 2, 0, 2, 0, 0, 0, 2, 0, 2, 3, 0]);
    assert!(parse(&square(PLAIN, 3, "")).is_err());
}

#[test]
fn nodes_move_points_and_turn_normals_by_the_inverse_transpose() {
    let nodes = r#"[{"children":[1,2],"translation":[0,0,5]},
        {"mesh":0,"scale":[1,2,1]},
        {"mesh":0,"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}]"#;
    let mesh = parse(&square(nodes, 4, "")).unwrap();
    assert_eq!(mesh.positions[2], [1.0, 2.0, 5.0]);
    assert_eq!(mesh.positions[6], [-1.0, 1.0, 5.0]);
    let [x, y, z] = mesh.corner_normals[0];
    assert_eq!(x, 0.0);
    assert!((y / z - 0.3 / 0.8).abs() < 1e-6);
    // The mirrored square keeps its outside.
    assert_eq!(mesh.corner_vertices[6..9], [4, 6, 5]);
    assert!((mesh.corner_normals[6][2] - 0.8).abs() < 1e-6);
}

#[test]
fn buffers_may_lie_in_the_text_or_beside_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.gltf");
    std::fs::write(folder.path().join("my data.bin"), data()).unwrap();
    let text = square(PLAIN, 4, r#","uri":"my%20data.bin""#);
    std::fs::write(&path, text).unwrap();
    let mesh = read_gltf_mesh(&path).unwrap();
    assert_eq!(mesh, parse(&square(PLAIN, 4, "")).unwrap());
    let uri = r#","uri":"data:application/octet-stream;base64,AAAA""#;
    let error = parse(&square(PLAIN, 4, uri)).unwrap_err().to_string();
    assert!(error.contains("buffer of 3"), "{error}");
    let error = parse(&square(PLAIN, 4, r#","uri":"no.bin""#)).unwrap_err();
    assert_eq!(error.blame, Blame::World);
    assert!(error.to_string().contains("no.bin"), "{error}");
}

#[test]
fn broken_references_are_named() {
    let good = square(PLAIN, 4, "");
    let cases = [
        (
            square(r#"[{"children":[1]},{"children":[0]}]"#, 4, ""),
            "reached twice",
        ),
        (square(r#"[{"children":[7]}]"#, 4, ""), "nodes[7]"),
        (square(r#"[{"mesh":7}]"#, 4, ""), "meshes[7]"),
        (good.replace("\"scene\":0", "\"scene\":9"), "scenes[9]"),
        (
            good.replace("\"POSITION\":0", "\"POSITION\":99"),
            "accessor 99",
        ),
        (good.replace("\"POSITION\":0", "\"POSITION\":3"), "no Vec3"),
        (good.replace("\"POSITION\":0,", ""), "no POSITION"),
        (good.replace("\"indices\":3", "\"indices\":0"), "no Scalar"),
        (good.replace("\"NORMAL\":1", "\"NORMAL\":2"), "no Vec3"),
        (good.replace("\"count\":4", "\"count\":400"), "need"),
        (
            good.replace("\"count\":4", "\"count\":1844674407370955161"),
            "too often",
        ),
        (good.replace("\"count\":6", "\"count\":5"), "no triangles"),
        (good.replace("\"buffer\":0", "\"buffer\":5"), "buffer 5"),
        (
            good.replace("\"byteLength\":128", "\"byteLength\":99999"),
            "view ends",
        ),
        (
            good.replace("\"byteOffset\":96", "\"byteOffset\":18446744073709551615"),
            "need",
        ),
        (good.replace("\"mode\":4", "\"mode\":44"), "unknown mode"),
        (
            good.replace("\"scene\":0", "\"extensionsRequired\":[\"X\"]"),
            "extension X",
        ),
        (
            good.replace("\"mesh\":0", "\"mesh\":0,\"scale\":[1e39,1,1]"),
            "",
        ),
    ];
    for (json, expected) in cases {
        let error = parse(&json).unwrap_err().to_string();
        assert!(error.starts_with("a.glb: "), "{error}");
        assert!(error.contains(expected), "{expected}: {error}");
    }
}

#[test]
fn nodes_cannot_multiply_a_mesh_without_end() {
    let mut nodes = String::from(r#"[{"children":["#);
    let children: Vec<_> = (1..3000).map(|i| i.to_string()).collect();
    nodes += &children.join(",");
    nodes += "]}";
    nodes += &r#",{"mesh":0}"#.repeat(children.len());
    nodes += "]";
    // 300,000 squares from a file of 60 kB.
    let json = square(&nodes, 4, "");
    let primitive = json.split("\"primitives\":[").nth(1).unwrap();
    let primitive = &primitive[..primitive.find("}}").unwrap() + 2];
    let json = json.replacen(primitive, &vec![primitive; 100].join(","), 1);
    let error = parse(&json).unwrap_err();
    assert_eq!(error.blame, Blame::Limit);
}

#[test]
fn every_truncation_is_an_error() {
    let bytes = glb(&square(PLAIN, 4, ""));
    for cut in 0..bytes.len() {
        assert!(
            parse_gltf_mesh(&bytes[..cut], Path::new("a.glb")).is_err(),
            "{cut}"
        );
    }
    let mut short = bytes.clone();
    short[8..12].copy_from_slice(&[3, 0, 0, 0]);
    assert!(parse_gltf_mesh(&short, Path::new("a.glb")).is_err());
}
