use super::*;

fn parse(bytes: &[u8]) -> Result<PolygonMesh, ReadError> {
    parse_ply_mesh(bytes, Path::new("a.ply"))
}

fn error(text: &str) -> String {
    parse(text.as_bytes()).unwrap_err().to_string()
}

const TEXT: &str = "ply
format ascii 1.0
comment a square
element vertex 4
property float x
property float y
property double z
property float nx
property float ny
property float nz
property uchar red
property float s
property float t
element face 2
property list uchar int vertex_indices
end_header
0 0 0 0 0 1 255 .25 1.
1 0 0 0 0 1 255 0 1
1 1 0 0 0 1 255 0 1
0 1 -2.5e1 0 0 1 255 0 1
4 0 1 2 3
3 0 2 3
";

#[test]
fn text_is_read_with_normals_and_uvs() {
    let mesh = parse(TEXT.as_bytes()).unwrap();
    assert_eq!(mesh.positions[3], [0.0, 1.0, -25.0]);
    assert_eq!(mesh.face_sizes, [4, 3]);
    assert_eq!(mesh.corner_vertices, [0, 1, 2, 3, 0, 2, 3]);
    assert_eq!(mesh.corner_normals, [[0.0, 0.0, 1.0]; 7]);
    assert_eq!(mesh.corner_uvs[0], [0.25, 1.0]);
    assert_eq!(mesh.corner_uvs.len(), 7);
}

fn binary(encoding: &str, numbers: &[&[u8]]) -> Vec<u8> {
    let mut bytes = format!(
        "ply\r\nformat {encoding} 1.0\r\nelement vertex 3\r\nproperty float x\r\n\
         property float y\r\nproperty double z\r\nelement face 1\r\n\
         property list uchar ushort vertex_index\r\n\
         property list uchar float texcoord\r\nend_header\r\n"
    )
    .into_bytes();
    bytes.extend(numbers.concat());
    bytes
}

fn little_endian() -> Vec<u8> {
    let mut parts = Vec::new();
    for i in 0..3 {
        parts.extend((i as f32).to_le_bytes());
        parts.extend((i as f32 * 2.0).to_le_bytes());
        parts.extend((i as f64 * 3.0).to_le_bytes());
    }
    let uvs: Vec<u8> = (0..6u8).flat_map(|i| f32::from(i).to_le_bytes()).collect();
    binary(
        "binary_little_endian",
        &[&parts, &[3, 0, 0, 1, 0, 2, 0], &[6], &uvs],
    )
}

#[test]
fn both_byte_orders_give_the_same_mesh() {
    let mut parts = Vec::new();
    for i in 0..3 {
        parts.extend((i as f32).to_be_bytes());
        parts.extend((i as f32 * 2.0).to_be_bytes());
        parts.extend((i as f64 * 3.0).to_be_bytes());
    }
    let uvs: Vec<u8> = (0..6u8).flat_map(|i| f32::from(i).to_be_bytes()).collect();
    let big = binary(
        "binary_big_endian",
        &[&parts, &[3, 0, 0, 0, 1, 0, 2], &[6], &uvs],
    );
    let mesh = parse(&little_endian()).unwrap();
    assert_eq!(mesh, parse(&big).unwrap());
    assert_eq!(mesh.positions[2], [2.0, 4.0, 6.0]);
    assert_eq!(mesh.corner_uvs, [[0.0, 1.0], [2.0, 3.0], [4.0, 5.0]]);
}

#[test]
fn every_truncation_is_an_error() {
    let bytes = little_endian();
    for cut in 0..bytes.len() {
        assert!(parse(&bytes[..cut]).is_err(), "cut at {cut}");
    }
    let end = TEXT.len() - 3;
    for cut in 0..end {
        assert!(parse(&TEXT.as_bytes()[..cut]).is_err(), "cut at {cut}");
    }
}

#[test]
fn errors_name_the_element() {
    let cases = [
        (TEXT.replace("4 0 1", "4 9 1"), "vertex 9"),
        (
            TEXT.replace("4 0 1", "4 -1 1"),
            "face 0: -1 is no vertex index",
        ),
        (
            TEXT.replace("4 0 1", "4 .5 1"),
            "face 0: 0.5 is no vertex index",
        ),
        (TEXT.replace("3 0 2 3", "2 0 2"), "face 1: 2 corners"),
        (TEXT.replace("3 0 2 3", "-3 0 2"), "face 1: a list of -3"),
        (TEXT.replace("3 0 2 3", "nan 0 2"), "face 1: a list of NaN"),
        (TEXT.replace("-2.5e1", "nan"), "vertex 3: NaN"),
        (TEXT.replace("-2.5e1", "1e60"), "vertex 3: "),
        (TEXT.replace("-2.5e1", "zero"), "line 20: \"zero\""),
        (
            TEXT.replace("vertex 4", "vertex 18446744073709551615"),
            "only",
        ),
        (TEXT.replace("vertex 4", "vertex 5"), "the file ends here"),
        (TEXT.replace("property double z\n", ""), "lack x, y or z"),
        (
            TEXT.replace("vertex_indices", "corners"),
            "no element `face`",
        ),
        (TEXT.replace("ascii", "morse"), "line 2: header"),
        (
            "ply\nformat binary_little_endian 1.0\nelement x 99999\nend_header\n".into(),
            "only 0",
        ),
    ];
    for (text, expected) in cases {
        let error = error(&text);
        assert!(error.starts_with("a.ply: "), "{error}");
        assert!(error.contains(expected), "{expected}: {error}");
    }
}
