//! Meshes as text: Wavefront OBJ and USD.

use super::Triangles;
use std::io::{self, Write};

/// Wavefront OBJ; every vertex has its own normal and texture coordinates.
pub(super) fn obj(file: &mut dyn Write, mesh: &Triangles) -> io::Result<()> {
    for p in mesh.positions {
        writeln!(file, "v {} {} {}", p.x, p.y, p.z)?;
    }
    for uv in mesh.uvs {
        writeln!(file, "vt {} {}", uv.x, uv.y)?;
    }
    for n in mesh.normals {
        writeln!(file, "vn {} {} {}", n.x, n.y, n.z)?;
    }
    for triangle in mesh.triangles {
        let [a, b, c] = triangle.map(|corner| corner + 1);
        writeln!(file, "f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}")?;
    }
    Ok(())
}

/// USD text: one `Mesh` prim, not subdivided.
pub(super) fn usda(file: &mut dyn Write, mesh: &Triangles) -> io::Result<()> {
    let extent = mesh
        .extent()
        .map(|p| format!("({}, {}, {})", p.x, p.y, p.z));
    write!(
        file,
        "#usda 1.0\n(\n    defaultPrim = \"mesh\"\n    upAxis = \"Y\"\n)\n\n\
         def Mesh \"mesh\"\n{{\n    float3[] extent = [{}]\n\
         \x20   uniform token subdivisionScheme = \"none\"\n",
        extent.join(", "),
    )?;
    let counts = mesh.triangles.iter().map(|_| 3.to_string());
    list(file, "int[] faceVertexCounts", counts, "")?;
    let corners = mesh.triangles.iter().flatten().map(u32::to_string);
    list(file, "int[] faceVertexIndices", corners, "")?;
    let vectors = |p: &pelage_curves::Vec3| format!("({}, {}, {})", p.x, p.y, p.z);
    list(
        file,
        "point3f[] points",
        mesh.positions.iter().map(vectors),
        "",
    )?;
    let vertex = " (interpolation = \"vertex\")";
    list(
        file,
        "normal3f[] normals",
        mesh.normals.iter().map(vectors),
        vertex,
    )?;
    let uvs = mesh.uvs.iter().map(|uv| format!("({}, {})", uv.x, uv.y));
    list(file, "texCoord2f[] primvars:st", uvs, vertex)?;
    writeln!(file, "}}")
}

fn list(
    file: &mut dyn Write,
    name: &str,
    items: impl Iterator<Item = String>,
    metadata: &str,
) -> io::Result<()> {
    write!(file, "    {name} = [")?;
    for (i, item) in items.enumerate() {
        let between = if i > 0 { ", " } else { "" };
        write!(file, "{between}{item}")?;
    }
    writeln!(file, "]{metadata}")
}
