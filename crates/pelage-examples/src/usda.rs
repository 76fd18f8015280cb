//! Curves with widths as USD text.

use pelage_strands::StrandBuffer;
use std::fmt::Write;

/// One `BasisCurves` prim of Catmull-Rom curves through all their vertices, y up.
pub fn curves_text(curves: &StrandBuffer) -> String {
    let list = |name: &str, items: Vec<String>, rest: &str| {
        format!("    {name} = [{}]{rest}\n", items.join(", "))
    };
    let counts = (0..curves.len()).map(|i| curves.vertex_count(i).to_string());
    let points = curves
        .points
        .iter()
        .map(|[x, y, z]| format!("({x}, {y}, {z})"));
    let widths = curves.widths.iter().map(f32::to_string);
    let mut text = String::from(
        "#usda 1.0\n(\n    defaultPrim = \"curves\"\n    upAxis = \"Y\"\n    \
         metersPerUnit = 1\n)\n\ndef BasisCurves \"curves\"\n{\n",
    );
    for (name, token) in [
        ("type", "cubic"),
        ("basis", "catmullRom"),
        ("wrap", "pinned"),
    ] {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "    uniform token {name} = \"{token}\"");
    }
    text += &list("int[] curveVertexCounts", counts.collect(), "");
    text += &list("point3f[] points", points.collect(), "");
    let vertex = " (interpolation = \"vertex\")";
    text += &list("float[] widths", widths.collect(), vertex);
    text + "}\n"
}
