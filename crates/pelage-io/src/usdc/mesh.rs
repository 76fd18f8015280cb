//! A triangle mesh as a crate file: one `Mesh` prim, not subdivided.

use super::attribute::{Value, Written};
use super::crate_file::CrateFile;
use super::sections::{Sections, SpecKind};
use super::value::{Kind, ValueRep};
use crate::mesh_write::Triangles;
use bytemuck::cast_slice;
use pelage_curves::Vec3;
use std::io;
use std::path::Path;

/// The prim, as in files of text.
const NAME: &str = "mesh";

/// Writes `mesh`, whose arrays fit each other, as the file `path`.
pub(crate) fn write_mesh(path: &Path, mesh: &Triangles) -> io::Result<()> {
    let mut file = CrateFile::create(path)?;
    let mut sections = Sections::new();
    let attributes = attributes(&mut file, &mut sections, mesh)?;
    let layer = [
        ("defaultPrim", sections.token_value(NAME)),
        ("upAxis", sections.token_value("Y")),
        ("primChildren", file.names(&mut sections, &[NAME])?),
    ];
    let layer = sections.spec(SpecKind::Layer, None, "/", &layer);
    let names: Vec<&str> = attributes.iter().map(|a| a.name).collect();
    let prim = [
        ("specifier", ValueRep::inlined(Kind::Specifier, 0)),
        ("typeName", sections.token_value("Mesh")),
        ("properties", file.names(&mut sections, &names)?),
    ];
    let prim = sections.spec(SpecKind::Prim, Some(layer), NAME, &prim);
    for attribute in &attributes {
        attribute.spec(&mut sections, prim);
    }
    file.finish(&sections)
}

/// The values, written, and what they are called.
fn attributes(
    file: &mut CrateFile,
    sections: &mut Sections,
    mesh: &Triangles,
) -> io::Result<Vec<Written<'static>>> {
    let mut array = |kind, count: usize, raw: &[u8]| -> io::Result<Value> {
        Ok(Value::Still(file.array(kind, count as u64, raw)?))
    };
    let count = mesh.positions.len();
    let vectors = |all: &[Vec3]| -> Vec<[f32; 3]> { all.iter().map(|v| v.to_array()).collect() };
    let places = vectors(mesh.positions);
    let extent = mesh.extent().map(|corner| corner.to_array());
    let sizes = vec![3i32; mesh.triangles.len()];
    let corners = mesh.triangles.as_flattened();
    let uvs: Vec<[f32; 2]> = mesh.uvs.iter().map(|uv| uv.to_array()).collect();
    let vertex = |name, kind, value| Written {
        interpolation: Some("vertex"),
        ..Written::plain(name, kind, value)
    };
    Ok(vec![
        Written::plain(
            "extent",
            "float3[]",
            array(Kind::Vec3f, 2, cast_slice(&extent))?,
        ),
        Written {
            uniform: true,
            ..Written::plain(
                "subdivisionScheme",
                "token",
                Value::Still(sections.token_value("none")),
            )
        },
        Written::plain(
            "faceVertexCounts",
            "int[]",
            array(Kind::Int, sizes.len(), cast_slice(&sizes))?,
        ),
        Written::plain(
            "faceVertexIndices",
            "int[]",
            array(Kind::Int, corners.len(), cast_slice(corners))?,
        ),
        Written::plain(
            "points",
            "point3f[]",
            array(Kind::Vec3f, count, cast_slice(&places))?,
        ),
        vertex(
            "normals",
            "normal3f[]",
            array(Kind::Vec3f, count, cast_slice(&vectors(mesh.normals)))?,
        ),
        vertex(
            "primvars:st",
            "texCoord2f[]",
            array(Kind::Vec2f, count, cast_slice(&uvs))?,
        ),
    ])
}
