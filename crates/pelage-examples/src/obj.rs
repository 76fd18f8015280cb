//! Meshes and guides as Wavefront OBJ text.
//!
//! Source: the OBJ section of Wavefront's "Advanced Visualizer" manual, appendix
//! B1. Numbers are written in the shortest form that reads back as the same f32.

use pelage_strands::StrandBuffer;
use pelage_surface::PolygonMesh;
use std::collections::HashMap;
use std::fmt::Write;

/// Each distinct value once, in order of appearance, and the index (from 1) of
/// each entry.
fn indexed<const N: usize>(values: &[[f32; N]]) -> (Vec<[f32; N]>, Vec<usize>) {
    let mut of = HashMap::with_capacity(values.len());
    let mut distinct = Vec::new();
    let indices = (values.iter())
        .map(|v| {
            *of.entry(v.map(f32::to_bits)).or_insert_with(|| {
                distinct.push(*v);
                distinct.len()
            })
        })
        .collect();
    (distinct, indices)
}

fn lines<const N: usize>(out: &mut String, keyword: &str, values: &[[f32; N]]) {
    for value in values {
        out.push_str(keyword);
        for x in value {
            // Writing to a string cannot fail.
            let _ = write!(out, " {x}");
        }
        out.push('\n');
    }
}

/// `v`, `vt`, `vn` and `f` lines.
pub fn mesh_text(mesh: &PolygonMesh) -> String {
    let mut out = String::from("# pelage example surface\n");
    lines(&mut out, "v", &mesh.positions);
    let (uvs, uv_of) = indexed(&mesh.corner_uvs);
    let (normals, normal_of) = indexed(&mesh.corner_normals);
    lines(&mut out, "vt", &uvs);
    lines(&mut out, "vn", &normals);
    let mut corner = 0;
    for &size in &mesh.face_sizes {
        out.push('f');
        for k in corner..corner + size as usize {
            let vertex = mesh.corner_vertices[k] + 1;
            let _ = write!(out, " {vertex}/{}/{}", uv_of[k], normal_of[k]);
        }
        out.push('\n');
        corner += size as usize;
    }
    out
}

/// `v` lines and an `l` line a curve.
pub fn curves_text(curves: &StrandBuffer) -> String {
    let mut out = String::from("# pelage example guides, roots first\n");
    lines(&mut out, "v", &curves.points);
    for strand in 0..curves.len() {
        out.push('l');
        for vertex in curves.vertices(strand) {
            let _ = write!(out, " {}", vertex + 1);
        }
        out.push('\n');
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_is_four_kinds_of_lines() {
        let mesh = PolygonMesh {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.1, 0.0]],
            face_sizes: vec![3],
            corner_vertices: vec![0, 1, 2],
            corner_uvs: vec![[0.0, 0.0], [1.0, 0.0], [0.0, 0.1]],
            corner_normals: vec![[0.0, 0.0, 1.0]; 3],
        };
        let text = mesh_text(&mesh);
        assert!(text.ends_with("vn 0 0 1\nf 1/1/1 2/2/1 3/3/1\n"), "{text}");
        assert!(text.contains("v 0 0.1 0\n"));
    }
}
