//! Strands as Super-Helices: few numbers a strand, for simulators and small files.
//!
//! The forms of the file are in `docs/super-helices.md`: JSON ([`json`]), a USD crate file
//! with the decoded curves beside the numbers ([`usd`]), and NumPy arrays ([`npz`]). All
//! hold the same arrays, named alike, in 32 bits.

mod arrays;
mod check;
mod json;
mod npz;
mod rounding;
mod usd;

pub(crate) use arrays::{Arrays, Entries, TELLING};
pub(crate) use check::Wrong;
pub(crate) use json::is_json;
pub use json::parse_super_helices;
pub(crate) use usd::{NAMESPACE, type_name};

use crate::{CurveFile, CurveSet, FileKind, ReadError, WriteOptions, sniff};
use pelage_curves::super_helix::{Element, FitError, SuperHelix};
use pelage_curves::{DVec3, frenet::Frame};
use pelage_strands::{SinkError, StrandBuffer, UpAxis};
use std::ops::Range;
use std::path::Path;

/// The extensions that [`write_super_helices`] knows.
pub const SUPER_HELIX_EXTENSIONS: [&str; 4] = ["json", "usdc", "usd", "npz"];

/// Strands as Super-Helices, as files hold them: a structure of arrays.
///
/// A strand without elements is a point: all its vertices are at its root.
///
/// ```
/// use pelage_curves::super_helix::{Element, SuperHelix};
/// use pelage_curves::{DVec3, frenet::Frame};
/// use pelage_io::SuperHelices;
/// let half_circle = Element { length: 3.0, twist: 0.0, curvatures: [0.0, 1.0] };
/// let curve = SuperHelix::new(DVec3::ZERO, Frame::IDENTITY, &[half_circle])?;
/// let mut strands = SuperHelices::default();
/// strands.push(&curve, 16, 0.0)?;
/// assert_eq!(strands.decode(None).vertex_count(0), 16);
/// # Ok::<(), pelage_curves::super_helix::FitError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct SuperHelices {
    /// Up axis of the curves, where it is known.
    pub up_axis: Option<UpAxis>,
    /// Metres a unit, where it is known.
    pub meters_per_unit: Option<f64>,
    /// Where each strand's elements start: one entry more than strands, ascending from 0.
    pub offsets: Vec<u32>,
    /// A strand: vertices that it had, and has when it is decoded.
    pub vertices: Vec<u32>,
    /// A strand: where it starts.
    pub roots: Vec<[f32; 3]>,
    /// A strand: unit tangent at the root.
    pub tangents: Vec<[f32; 3]>,
    /// A strand: unit first normal at the root, perpendicular to the tangent; the second is
    /// tangent × first.
    pub normals: Vec<[f32; 3]>,
    /// A strand: no place of it is farther from what it was fitted to, at equal parts of the
    /// arc length.
    pub errors: Vec<f32>,
    /// An element: arc length, 0 or more.
    pub lengths: Vec<f32>,
    /// An element: turn about the tangent, radians per unit of length.
    pub twists: Vec<f32>,
    /// An element: turn about the first normal, radians per unit of length.
    pub curvatures_1: Vec<f32>,
    /// An element: turn about the second normal, radians per unit of length.
    pub curvatures_2: Vec<f32>,
}

impl Default for SuperHelices {
    fn default() -> Self {
        Self {
            up_axis: None,
            meters_per_unit: None,
            offsets: vec![0],
            vertices: Vec::new(),
            roots: Vec::new(),
            tangents: Vec::new(),
            normals: Vec::new(),
            errors: Vec::new(),
            lengths: Vec::new(),
            twists: Vec::new(),
            curvatures_1: Vec::new(),
            curvatures_2: Vec::new(),
        }
    }
}

impl SuperHelices {
    /// Number of strands.
    pub fn len(&self) -> usize {
        self.roots.len()
    }

    /// Whether there is no strand.
    pub fn is_empty(&self) -> bool {
        self.roots.is_empty()
    }

    /// Numbers that make the curves: four an element and six a strand.
    pub fn numbers(&self) -> u64 {
        4 * self.lengths.len() as u64 + 6 * self.len() as u64
    }

    /// Which elements are those of `strand`.
    pub fn elements(&self, strand: usize) -> Range<usize> {
        self.offsets[strand] as usize..self.offsets[strand + 1] as usize
    }

    /// Adds a strand that is a point at `root`.
    pub fn push_point(&mut self, root: [f32; 3], vertices: u32) {
        self.push_root(root, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], vertices);
        self.errors.push(0.0);
        self.offsets.push(self.lengths.len() as u32);
    }

    /// The error that is told of `curve`, fitted with an error of at most `error`: with what
    /// rounding to 32 bits moves it by at most.
    ///
    /// # Errors
    ///
    /// [`FitError`] for numbers that 32 bits do not hold.
    pub fn told_error(curve: &SuperHelix, error: f64) -> Result<f32, FitError> {
        let kept = rounding::Rounded::new(curve)?;
        Ok(rounding::up(error + kept.moved))
    }

    /// Adds `curve`, fitted to a strand of `vertices` vertices with an error of at most
    /// `error`. What is kept as that is [`told_error`](Self::told_error).
    ///
    /// # Errors
    ///
    /// [`FitError`] for numbers that 32 bits do not hold; then nothing is added.
    pub fn push(&mut self, curve: &SuperHelix, vertices: u32, error: f64) -> Result<(), FitError> {
        let kept = rounding::Rounded::new(curve)?;
        let root = kept.curve.root();
        let short = |v: DVec3| v.as_vec3().to_array();
        self.push_root(short(root.position), kept.tangent, kept.normal, vertices);
        for element in kept.curve.elements() {
            self.lengths.push(element.length as f32);
            self.twists.push(element.twist as f32);
            self.curvatures_1.push(element.curvatures[0] as f32);
            self.curvatures_2.push(element.curvatures[1] as f32);
        }
        self.errors.push(rounding::up(error + kept.moved));
        self.offsets.push(self.lengths.len() as u32);
        Ok(())
    }

    fn push_root(&mut self, root: [f32; 3], tangent: [f32; 3], normal: [f32; 3], vertices: u32) {
        self.roots.push(root);
        self.tangents.push(tangent);
        self.normals.push(normal);
        self.vertices.push(vertices);
    }

    /// The curve of `strand`; `None` for a point, and for numbers that are no curve.
    pub fn curve(&self, strand: usize) -> Option<SuperHelix> {
        let element = |i: usize| Element {
            length: self.lengths[i].into(),
            twist: self.twists[i].into(),
            curvatures: [self.curvatures_1[i].into(), self.curvatures_2[i].into()],
        };
        let elements: Vec<Element> = self.elements(strand).map(element).collect();
        let frame = frame(self.tangents[strand], self.normals[strand]);
        SuperHelix::new(wide(self.roots[strand]), frame, &elements).ok()
    }

    /// The strands through vertices at equal steps of arc length: as many as each had, or
    /// `vertices`, but for points. A strand of one vertex is its root.
    pub fn decode(&self, vertices: Option<u32>) -> StrandBuffer {
        let mut strands = StrandBuffer::new();
        for strand in 0..self.len() {
            let own = self.vertices[strand];
            let curve = self.curve(strand).filter(|_| own > 1);
            match curve {
                Some(curve) => {
                    let segments = vertices.unwrap_or(own).max(2) - 1;
                    let points = curve.points(segments as usize);
                    let short = points.iter().map(|point| point.as_vec3().to_array());
                    strands.points.extend(short);
                }
                None => {
                    let here = std::iter::repeat_n(self.roots[strand], own as usize);
                    strands.points.extend(here);
                }
            }
            strands.offsets.push(strands.points.len() as u32);
        }
        strands
    }
}

fn wide(v: [f32; 3]) -> DVec3 {
    DVec3::from(v.map(f64::from))
}

/// The frame of a tangent and a first normal that are so but for rounding.
fn frame(tangent: [f32; 3], normal: [f32; 3]) -> Frame {
    let tangent = wide(tangent).normalize_or(DVec3::X);
    let binormal = tangent.cross(wide(normal)).normalize_or(DVec3::Z);
    Frame {
        tangent,
        normal: binormal.cross(tangent),
        binormal,
    }
}

/// Reads the Super-Helices of `path`, which [`write_super_helices`] wrote: JSON, USD or
/// NumPy arrays.
pub fn read_super_helices(path: &Path) -> Result<SuperHelices, ReadError> {
    match sniff(path)? {
        FileKind::SuperHelices => json::read(path),
        FileKind::Usd => crate::usd::read_super_helices(path),
        FileKind::Npz => crate::npz::read_super_helices(path),
        kind => Err(ReadError::unsupported(
            path,
            format!("a file of the kind {kind} holds no Super-Helices"),
        )
        .help("they are read from the .json, .usdc and .npz files of `pelage fit`")),
    }
}

/// Writes `strands` to the file `path`, whole or not at all, in the form that its extension
/// names; `options` names the tool.
///
/// # Errors
///
/// Another extension, arrays that do not fit each other, or what the system says.
pub fn write_super_helices(
    path: &Path,
    strands: &SuperHelices,
    options: &WriteOptions,
) -> Result<(), SinkError> {
    let name = path.display().to_string();
    if let Err(wrong) = strands.check() {
        return Err(SinkError::new(&name, wrong.to_string()));
    }
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    let written = match &*extension.to_ascii_lowercase() {
        "json" => json::write(path, strands),
        "usdc" | "usd" => usd::write(path, strands, options),
        "npz" => npz::write(path, strands),
        other => {
            let known = SUPER_HELIX_EXTENSIONS.join(", .");
            let message = format!("Super-Helices are not written as .{other}; there are .{known}");
            return Err(SinkError::new(&name, message));
        }
    };
    written.map_err(|error| SinkError::io(&name, error))
}

/// The curves of `strands`, named after the file `path`.
pub(crate) fn curve_file(path: &Path, strands: &SuperHelices) -> CurveFile {
    let name = path.file_stem().map(|n| n.to_string_lossy().into_owned());
    let set = CurveSet::through_vertices(name.unwrap_or_default(), strands.decode(None));
    CurveFile {
        sets: vec![set],
        up_axis: strands.up_axis,
        meters_per_unit: strands.meters_per_unit,
    }
}

#[cfg(test)]
mod tests;
