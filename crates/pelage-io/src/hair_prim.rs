//! The USD prims that hair becomes, whatever the notation.
//!
//! `/NAME` is an `Xform`, `/NAME/hair` a `BasisCurves`: cubic Catmull-Rom,
//! nonperiodic, ends duplicated, so that every reader draws the same curve (readers
//! disagree on what `pinned` adds). Widths are diameters, one a vertex (Blender
//! misreads the other interpolations).

use crate::columns::{Column, Ends, Field};
use crate::drawable::refused;
use crate::recorder::Recorder;
use pelage_strands::{Bounds, StreamInfo, UpAxis};
use std::io;
use std::path::Path;

/// Name of the curves below the groom's prim.
pub(crate) const CURVES: &str = "hair";

/// The three tokens that say how vertices make a curve; all `uniform token`.
pub(crate) const SHAPE: [(&str, &str); 3] = [
    ("type", "cubic"),
    ("basis", "catmullRom"),
    ("wrap", "nonperiodic"),
];

/// How a field is called in USD.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Attribute {
    /// Name, namespaces included.
    pub(crate) name: &'static str,
    /// Type name, brackets included.
    pub(crate) kind: &'static str,
    /// Domain; `None` for attributes whose schema fixes it.
    pub(crate) interpolation: Option<&'static str>,
}

/// What `field` is called; `None` for fields that USD files leave out.
pub(crate) fn attribute(field: Field) -> Option<Attribute> {
    let (name, kind, interpolation) = match field {
        Field::Points => ("points", "point3f[]", None),
        Field::Counts => ("curveVertexCounts", "int[]", None),
        Field::Widths => ("widths", "float[]", Some("vertex")),
        Field::Normals => ("normals", "normal3f[]", Some("vertex")),
        Field::Colors => ("primvars:displayColor", "color3f[]", Some("vertex")),
        Field::Opacities => ("primvars:displayOpacity", "float[]", Some("vertex")),
        Field::RootUv => ("primvars:st", "texCoord2f[]", Some("uniform")),
        Field::HairId => ("primvars:hairId", "int64[]", Some("uniform")),
        Field::StrandId => ("primvars:strandId", "int[]", Some("uniform")),
        Field::StrandUv => ("primvars:strandUv", "texCoord2f[]", Some("uniform")),
        Field::Group => ("primvars:group", "int[]", Some("uniform")),
        Field::RootRest => ("primvars:restRoot", "point3f[]", Some("uniform")),
        Field::Triangle | Field::Barycentric => return None,
    };
    Some(Attribute {
        name,
        kind,
        interpolation,
    })
}

/// A recorder of `info` into `columns`, which become attributes.
pub(crate) fn recorder(info: &StreamInfo, columns: Vec<Column>) -> io::Result<Recorder> {
    if !is_identifier(&info.name) {
        return Err(refused(format!(
            "{:?} cannot name a prim: letters, digits and _ are allowed, \
             and no digit in front",
            info.name
        )));
    }
    Ok(Recorder::new(info, Ends::Doubled, columns)?.with_extents())
}

/// The fields of a USD file at `path`, but for the points.
///
/// Normals are taken only for `ribbons`: where a file has them, readers draw flat
/// ribbons instead of tubes.
pub(crate) fn columns(path: &Path, ribbons: bool) -> Vec<Column> {
    let column = |field| Column::new(field, path);
    let mut columns = Vec::new();
    if ribbons {
        columns.push(column(Field::Normals));
    }
    columns.extend([
        column(Field::Counts),
        column(Field::Widths),
        column(Field::Colors),
        column(Field::RootUv),
        column(Field::HairId),
        column(Field::StrandId),
        column(Field::Group),
        column(Field::RootRest),
        // These two are last because they often come to nothing: no array behind
        // them has then to move up.
        column(Field::Opacities).usually(1.0),
        column(Field::StrandUv).usually(0.0),
    ]);
    columns
}

fn is_identifier(name: &str) -> bool {
    !name.is_empty()
        && !name.starts_with(|c: char| c.is_ascii_digit())
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// Token of an up axis.
pub(crate) fn up_axis(axis: UpAxis) -> &'static str {
    match axis {
        UpAxis::Y => "Y",
        UpAxis::Z => "Z",
    }
}

/// Numbers of the layer's metadata, in order of writing.
pub(crate) fn layer_numbers(info: &StreamInfo) -> Vec<(&'static str, f64)> {
    let mut numbers = vec![("metersPerUnit", info.meters_per_unit)];
    if let (Some(&first), Some(&last)) = (info.frames.first(), info.frames.last()) {
        numbers.extend([
            ("startTimeCode", first),
            ("endTimeCode", last),
            ("timeCodesPerSecond", info.frames_per_second),
            ("framesPerSecond", info.frames_per_second),
        ]);
    }
    numbers
}

/// The two corners of an `extent`; none for no curves.
pub(crate) fn extent(bounds: &Bounds) -> Vec<[f32; 3]> {
    if bounds.is_empty() {
        return Vec::new();
    }
    vec![bounds.min, bounds.max]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_groom_name_must_be_an_identifier() {
        for name in ["groom", "_1", "Fur_2"] {
            assert!(is_identifier(name), "{name}");
        }
        for name in ["", "1st", "a b", "Haar/Fell", "fur\"", "é"] {
            assert!(!is_identifier(name), "{name}");
        }
    }
}
