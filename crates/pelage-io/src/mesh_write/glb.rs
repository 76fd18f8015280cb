//! Binary glTF 2.0 (GLB): one mesh of one primitive.
//!
//! Source: the glTF 2.0 specification (Khronos, ISO/IEC 12113), sections 3.6 (buffers and
//! accessors), 3.7 (meshes) and 4 (GLB). Texture coordinates have their origin at the upper
//! left there, so v is turned round.

use super::Triangles;
use serde_json::{Value, json};
use std::io::{self, Write};

/// Component types of section 3.6.2.2.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;

/// Targets of buffer views, section 5.11.5.
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;

pub(super) fn glb(file: &mut dyn Write, mesh: &Triangles) -> io::Result<()> {
    let json = pad(describe(mesh).to_string().into_bytes(), b' ');
    let binary = pad(buffer(mesh), 0);
    let length = 12 + 8 + json.len() + 8 + binary.len();
    let too_large = |_| io::Error::other("a GLB file has 4 GB at most; write another format");
    let length = u32::try_from(length).map_err(too_large)?;
    file.write_all(b"glTF")?;
    for number in [2, length, json.len() as u32] {
        file.write_all(&number.to_le_bytes())?;
    }
    file.write_all(b"JSON")?;
    file.write_all(&json)?;
    file.write_all(&(binary.len() as u32).to_le_bytes())?;
    file.write_all(b"BIN\0")?;
    file.write_all(&binary)
}

/// Chunks end at multiples of four bytes.
fn pad(mut bytes: Vec<u8>, with: u8) -> Vec<u8> {
    bytes.resize(bytes.len().next_multiple_of(4), with);
    bytes
}

/// Positions, normals, texture coordinates, indices, one after the other.
fn buffer(mesh: &Triangles) -> Vec<u8> {
    let mut bytes = Vec::new();
    let vectors = mesh.positions.iter().chain(mesh.normals);
    for number in vectors.flat_map(|v| v.to_array()) {
        bytes.extend(number.to_le_bytes());
    }
    for number in mesh.uvs.iter().flat_map(|uv| [uv.x, 1.0 - uv.y]) {
        bytes.extend(number.to_le_bytes());
    }
    for corner in mesh.triangles.iter().flatten() {
        bytes.extend(corner.to_le_bytes());
    }
    bytes
}

fn describe(mesh: &Triangles) -> Value {
    let count = mesh.positions.len();
    let corners = 3 * mesh.triangles.len();
    // Bytes of each run of the buffer.
    let sizes = [12 * count, 12 * count, 8 * count, 4 * corners];
    let mut start = 0;
    let views: Vec<Value> = (sizes.iter().enumerate())
        .map(|(i, &size)| {
            let view = json!({
                "buffer": 0,
                "byteOffset": start,
                "byteLength": size,
                "target": if i == 3 { INDICES } else { VERTICES },
            });
            start += size;
            view
        })
        .collect();
    let [low, high] = mesh.extent().map(|p| p.to_array());
    let floats = |view: u32, kind: &str| json!({ "bufferView": view, "componentType": FLOAT, "count": count, "type": kind });
    let mut positions = floats(0, "VEC3");
    positions["min"] = json!(low);
    positions["max"] = json!(high);
    json!({
        "asset": { "version": "2.0", "generator": "pelage" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{
            "attributes": { "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 },
            "indices": 3,
        }] }],
        "accessors": [
            positions,
            floats(1, "VEC3"),
            floats(2, "VEC2"),
            {
                "bufferView": 3,
                "componentType": UNSIGNED_INT,
                "count": corners,
                "type": "SCALAR",
            },
        ],
        "bufferViews": views,
        "buffers": [{ "byteLength": start }],
    })
}
