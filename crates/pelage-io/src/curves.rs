//! Curves as files give them, whatever the format.

use pelage_curves::{Basis, Curve, Wrap};
use pelage_strands::{Fault, StrandBuffer, UpAxis};

/// All curves of a file.
#[derive(Clone, Debug, Default)]
pub struct CurveFile {
    /// One set a primitive of the file.
    pub sets: Vec<CurveSet>,
    /// Up axis, where the file tells.
    pub up_axis: Option<UpAxis>,
    /// Metres a unit, where the file tells.
    pub meters_per_unit: Option<f64>,
}

/// One primitive of curves.
#[derive(Clone, Debug)]
pub struct CurveSet {
    /// Where it is in the file: a prim path, an object name.
    pub name: String,
    /// Basis of every curve in the set.
    pub basis: Basis,
    /// Ends of every curve in the set.
    pub wrap: Wrap,
    /// Control vertices as the file has them (duplicated ends still there), with
    /// the attributes whose meaning is known, one entry a control vertex or curve.
    pub curves: StrandBuffer,
    /// Every attribute found, known or not.
    pub attributes: Vec<AttributeInfo>,
    /// What the reader had to leave out because its counts do not fit.
    pub faults: Vec<Fault>,
    /// Times at which positions are sampled; empty for a still.
    pub frames: Vec<f64>,
}

/// An attribute of a primitive of curves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AttributeInfo {
    /// Its name in the file.
    pub name: String,
    /// Its type as the format calls it.
    pub kind: String,
    /// Its domain as the format calls it: `vertex`, `uniform`, `constant`, …
    pub domain: String,
    /// Entries found.
    pub count: usize,
}

impl CurveSet {
    /// A set of polylines read as curves through their vertices.
    pub fn through_vertices(name: impl Into<String>, curves: StrandBuffer) -> Self {
        Self {
            name: name.into(),
            basis: Basis::CatmullRom,
            wrap: Wrap::Pinned,
            curves,
            attributes: Vec::new(),
            faults: Vec::new(),
            frames: Vec::new(),
        }
    }

    /// Curve number `index`, or `None` where its vertices are too few for its basis.
    pub fn curve(&self, index: usize) -> Option<Curve<'_>> {
        Curve::new(self.curves.strand_points(index), self.basis, self.wrap).ok()
    }
}
