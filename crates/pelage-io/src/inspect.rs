//! Looks into a file: what it holds, and everything that is wrong with it.

use crate::inspect_mesh::MeshReport;
use crate::strands_of::strands_through_vertices;
use crate::usd::{CurvesWithExtent, Extent, read_curves_with_extents};
use crate::{
    AttributeInfo, CurveFile, CurveSet, FileKind, ReadError, mesh_frames, read_curves, read_mesh,
    sniff,
};
use pelage_strands::{Bounds, Fault, Range, Statistics, UpAxis, validate};
use serde::Serialize;
use std::fmt;
use std::path::{Path, PathBuf};

/// Problems of one kind that are listed before the rest is only counted.
const LISTED: usize = 10;

/// What a file holds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Inspection {
    /// The file.
    pub path: PathBuf,
    /// Its format, in words.
    pub format: String,
    /// Up axis, `"Y"` or `"Z"`, where the file tells.
    pub up_axis: Option<&'static str>,
    /// Metres a unit, where the file tells.
    pub meters_per_unit: Option<f64>,
    /// All meshes as one, where there is any.
    pub mesh: Option<MeshReport>,
    /// One report a primitive of curves.
    pub curves: Vec<CurveReport>,
    /// What is wrong with the file as a whole.
    pub problems: Vec<Problem>,
}

/// What a primitive of curves holds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CurveReport {
    /// Where it is in the file.
    pub name: String,
    /// Basis of the curves.
    pub basis: String,
    /// How the curves end.
    pub wrap: String,
    /// Curves.
    pub curves: usize,
    /// Control vertices of all curves.
    pub vertices: usize,
    /// Control vertices a curve.
    pub vertices_per_curve: Option<Span>,
    /// Length of a curve, measured along straight pieces.
    pub length: Option<Span>,
    /// Full width at vertices.
    pub width: Option<Span>,
    /// Smallest and largest corner of the box around the curves, widths included.
    pub bounds: Option<[[f32; 3]; 2]>,
    /// Every attribute of the primitive.
    pub attributes: Vec<AttributeReport>,
    /// Times at which positions are sampled; empty for a still.
    pub frames: Vec<f64>,
    /// What is wrong.
    pub problems: Vec<Problem>,
}

/// An attribute as the file has it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct AttributeReport {
    /// Name.
    pub name: String,
    /// Type as the format calls it.
    #[serde(rename = "type")]
    pub kind: String,
    /// Domain as the format calls it.
    pub domain: String,
    /// Entries.
    pub count: usize,
}

impl From<&AttributeInfo> for AttributeReport {
    fn from(info: &AttributeInfo) -> Self {
        Self {
            name: info.name.clone(),
            kind: info.kind.clone(),
            domain: info.domain.clone(),
            count: info.count,
        }
    }
}

/// Smallest, largest and mean value of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Span {
    /// Smallest.
    pub min: f64,
    /// Largest.
    pub max: f64,
    /// Mean.
    pub mean: f64,
}

impl Span {
    /// `None` where nothing was measured.
    pub(crate) fn of(range: &Range) -> Option<Self> {
        (range.count() > 0).then(|| Self {
            min: range.min,
            max: range.max,
            mean: range.mean(),
        })
    }
}

/// One thing that is wrong.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Problem {
    /// What kind of thing: `zero-length curve`, `unused vertex`, …
    pub kind: String,
    /// Number of the curve, face or vertex, where there is one.
    pub index: Option<usize>,
    /// What was found.
    pub detail: String,
}

impl Problem {
    pub(crate) fn new(kind: &str, index: Option<usize>, detail: impl Into<String>) -> Self {
        Self {
            kind: kind.into(),
            index,
            detail: detail.into(),
        }
    }
}

impl From<&Fault> for Problem {
    fn from(fault: &Fault) -> Self {
        Self::new(&fault.kind.to_string(), fault.strand, fault.detail.clone())
    }
}

/// Looks into `path`. Animated files are looked at in their default state, or at
/// their first sample.
///
/// Fails only where nothing can be read at all; all else that is wrong is listed.
pub fn inspect(path: &Path) -> Result<Inspection, ReadError> {
    let kind = sniff(path)?;
    let mut inspection = Inspection {
        path: path.into(),
        format: kind.to_string(),
        up_axis: None,
        meters_per_unit: None,
        mesh: None,
        curves: Vec::new(),
        problems: Vec::new(),
    };
    let read = curves_of(path, kind)?;
    inspection.space(read.file.up_axis, read.file.meters_per_unit);
    let mut extents = read.extents.iter();
    for set in &read.file.sets {
        let report = CurveReport::of(set, extents.next());
        inspection.curves.push(report);
    }
    if read.has_mesh {
        inspection.add_mesh()?;
    }
    if inspection.mesh.is_none() && inspection.curves.is_empty() && inspection.problems.is_empty() {
        let detail = "it holds neither a mesh nor curves";
        inspection
            .problems
            .push(Problem::new("empty", None, detail));
    }
    Ok(inspection)
}

/// The curves of a file, with the extents that only USD has, and whether to look
/// for a mesh.
fn curves_of(path: &Path, kind: FileKind) -> Result<CurvesWithExtent, ReadError> {
    let (file, has_mesh) = match kind {
        FileKind::Usd => return read_curves_with_extents(path, None),
        // One of the two alone is no mistake.
        FileKind::Obj => match (read_curves(path, None), read_mesh(path, None).is_ok()) {
            (Err(_), true) => (CurveFile::default(), true),
            (curves, has_mesh) => (curves?, has_mesh),
        },
        kind if kind.has_curves() => (read_curves(path, None)?, false),
        _ => (CurveFile::default(), true),
    };
    Ok(CurvesWithExtent {
        file,
        extents: Vec::new(),
        has_mesh,
    })
}

impl Inspection {
    /// Whether nothing is wrong.
    pub fn is_sound(&self) -> bool {
        let of_mesh = self.mesh.iter().all(|mesh| mesh.problems.is_empty());
        let of_curves = self.curves.iter().all(|set| set.problems.is_empty());
        of_mesh && of_curves && self.problems.is_empty()
    }

    fn space(&mut self, up_axis: Option<UpAxis>, meters_per_unit: Option<f64>) {
        self.up_axis = up_axis.map(|axis| match axis {
            UpAxis::Y => "Y",
            UpAxis::Z => "Z",
        });
        self.meters_per_unit = meters_per_unit;
    }

    fn add_mesh(&mut self) -> Result<(), ReadError> {
        let path = self.path.clone();
        match read_mesh(&path, None) {
            Ok(file) => {
                self.space(file.up_axis, file.meters_per_unit);
                let mut report = MeshReport::of(&file.mesh);
                report.frames = mesh_frames(&path)?;
                self.mesh = Some(report);
            }
            // The curves of the file were read, so this is one thing among others.
            Err(error) if !self.curves.is_empty() => {
                let place = error.place.map(|place| format!("{place}: "));
                let detail = format!("{}{}", place.unwrap_or_default(), error.message);
                self.problems
                    .push(Problem::new("unreadable mesh", None, detail));
            }
            Err(error) => return Err(error),
        }
        Ok(())
    }
}

impl CurveReport {
    fn of(set: &CurveSet, extent: Option<&Extent>) -> Self {
        let faults = validate(&set.curves);
        let mut problems: Vec<Problem> = set.faults.iter().map(Problem::from).collect();
        problems.extend(faults.iter().map(Problem::from));
        problems.extend(extent.and_then(extent_problem));
        let statistics = Statistics::of(&strands_through_vertices(set));
        let mut per_curve = Range::default();
        for curve in 0..set.curves.len() {
            per_curve.add(set.curves.vertex_count(curve) as f64);
        }
        let bounds = statistics.bounds;
        Self {
            name: set.name.clone(),
            basis: format!("{:?}", set.basis),
            wrap: format!("{:?}", set.wrap),
            curves: set.curves.len(),
            vertices: set.curves.points.len(),
            vertices_per_curve: Span::of(&per_curve),
            length: Span::of(&statistics.length),
            width: Span::of(&statistics.width),
            bounds: (!bounds.is_empty()).then_some([bounds.min, bounds.max]),
            attributes: set.attributes.iter().map(AttributeReport::from).collect(),
            frames: set.frames.clone(),
            problems,
        }
    }
}

/// What is wrong with an extent: renderers cull by it.
fn extent_problem(extent: &Extent) -> Option<Problem> {
    let computed = extent.computed;
    if computed.is_empty() {
        return None;
    }
    let Some([low, high]) = extent.authored else {
        let detail = "there is none; some renderers then compute it at every load";
        return Some(Problem::new("missing extent", None, detail));
    };
    let slack = 1e-3 * computed.diagonal();
    let holds =
        (0..3).all(|k| low[k] <= computed.min[k] + slack && high[k] >= computed.max[k] - slack);
    let authored = Bounds {
        min: low,
        max: high,
    };
    // Room for widths and for control vertices off the curve is no mistake.
    let tight = authored.diagonal() <= 4.0 * computed.diagonal() + slack;
    let what = match (holds, tight) {
        (true, true) => return None,
        (false, _) => "does not hold the curves",
        (true, false) => "is far larger than the curves",
    };
    let (min, max) = (computed.min, computed.max);
    let detail = format!("{low:?} to {high:?} {what}, which span {min:?} to {max:?}");
    Some(Problem::new("wrong extent", None, detail))
}

impl fmt::Display for Inspection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: {}", self.path.display(), self.format)?;
        if let Some(axis) = self.up_axis {
            writeln!(f, "  up axis          {axis}")?;
        }
        if let Some(unit) = self.meters_per_unit {
            writeln!(f, "  metres a unit    {unit}")?;
        }
        if let Some(mesh) = &self.mesh {
            write!(f, "{mesh}")?;
        }
        for set in &self.curves {
            write!(f, "{set}")?;
        }
        write_problems(f, &self.problems)?;
        if self.is_sound() {
            writeln!(f, "nothing wrong")?;
        }
        Ok(())
    }
}

impl fmt::Display for CurveReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "curves {}: {} {}", self.name, self.basis, self.wrap)?;
        writeln!(f, "  curves           {}", self.curves)?;
        writeln!(f, "  vertices         {}", self.vertices)?;
        write_span(f, "vertices a curve", &self.vertices_per_curve)?;
        write_span(f, "length", &self.length)?;
        write_span(f, "width", &self.width)?;
        write_bounds(f, &self.bounds)?;
        write_frames(f, &self.frames)?;
        for attribute in &self.attributes {
            let AttributeReport {
                name,
                kind,
                domain,
                count,
            } = attribute;
            writeln!(f, "  {name:<24} {kind:<14} {domain:<12} {count}")?;
        }
        write_problems(f, &self.problems)
    }
}

pub(crate) fn write_span(
    f: &mut fmt::Formatter<'_>,
    name: &str,
    span: &Option<Span>,
) -> fmt::Result {
    match span {
        Some(Span { min, max, mean }) => {
            writeln!(f, "  {name:<16} {min:.6} to {max:.6}, mean {mean:.6}")
        }
        None => Ok(()),
    }
}

pub(crate) fn write_bounds(
    f: &mut fmt::Formatter<'_>,
    bounds: &Option<[[f32; 3]; 2]>,
) -> fmt::Result {
    match bounds {
        Some([low, high]) => writeln!(f, "  bounds           {low:?} to {high:?}"),
        None => Ok(()),
    }
}

pub(crate) fn write_frames(f: &mut fmt::Formatter<'_>, frames: &[f64]) -> fmt::Result {
    match frames {
        [] => Ok(()),
        [one] => writeln!(f, "  frames           1, at {one}"),
        [first, .., last] => {
            writeln!(f, "  frames           {}, {first} to {last}", frames.len())
        }
    }
}

/// Lists problems kind by kind, in the order in which kinds first appear.
pub(crate) fn write_problems(f: &mut fmt::Formatter<'_>, problems: &[Problem]) -> fmt::Result {
    let mut kinds: Vec<&str> = Vec::new();
    for problem in problems {
        if !kinds.contains(&problem.kind.as_str()) {
            kinds.push(&problem.kind);
        }
    }
    for kind in kinds {
        let all: Vec<&Problem> = problems.iter().filter(|p| p.kind == kind).collect();
        writeln!(f, "  problem: {kind} ({})", all.len())?;
        for problem in all.iter().take(LISTED) {
            match problem.index {
                Some(index) => writeln!(f, "    {index}: {}", problem.detail)?,
                None => writeln!(f, "    {}", problem.detail)?,
            }
        }
        if all.len() > LISTED {
            writeln!(f, "    and {} more", all.len() - LISTED)?;
        }
    }
    Ok(())
}
