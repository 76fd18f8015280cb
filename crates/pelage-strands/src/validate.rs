//! Everything that can be wrong with strands, each with the place it was found.

use crate::StrandBuffer;
use std::collections::HashMap;
use std::fmt;

/// What is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum FaultKind {
    /// An array has the wrong number of entries.
    WrongCount,
    /// Offsets that do not ascend or leave the points.
    BadOffsets,
    /// A curve of no or one vertex.
    TooFewVertices,
    /// A NaN or infinite number.
    NotFinite,
    /// A curve whose vertices all coincide.
    ZeroLength,
    /// A width below zero.
    NegativeWidth,
    /// An opacity outside 0..=1.
    OpacityRange,
    /// Two strands with the same hair and strand index.
    DuplicateId,
}

impl fmt::Display for FaultKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            FaultKind::WrongCount => "wrong count",
            FaultKind::BadOffsets => "bad offsets",
            FaultKind::TooFewVertices => "curve of fewer than two vertices",
            FaultKind::NotFinite => "not a finite number",
            FaultKind::ZeroLength => "zero-length curve",
            FaultKind::NegativeWidth => "negative width",
            FaultKind::OpacityRange => "opacity outside 0..1",
            FaultKind::DuplicateId => "duplicate id",
        })
    }
}

/// One thing wrong, with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// What is wrong.
    pub kind: FaultKind,
    /// The strand (or, for arrays of a wrong length, `None`).
    pub strand: Option<usize>,
    /// The array and entry, with what was found.
    pub detail: String,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.strand {
            Some(strand) => write!(f, "{}: curve {strand}: {}", self.kind, self.detail),
            None => write!(f, "{}: {}", self.kind, self.detail),
        }
    }
}

/// Lists every fault of `strands`, in order of the arrays; empty where all is well.
///
/// Never panics, whatever the arrays hold. Where counts or offsets are wrong, the
/// checks that rely on them are left out.
///
/// ```
/// use pelage_strands::{StrandBuffer, validate};
/// let mut strands = StrandBuffer::new();
/// strands.points = vec![[0.0, f32::NAN, 0.0], [1.0; 3]];
/// strands.offsets = vec![0, 2];
/// let faults = validate(&strands);
/// assert_eq!(faults[0].to_string(), "not a finite number: curve 0: points[0].y is NaN");
/// ```
pub fn validate(strands: &StrandBuffer) -> Vec<Fault> {
    let mut faults = wrong_counts(strands);
    if !faults.is_empty() {
        return faults;
    }
    for strand in 0..strands.len() {
        shape_faults(strands, strand, &mut faults);
        value_faults(strands, strand, &mut faults);
    }
    let mut seen: HashMap<(u64, u32), usize> = HashMap::new();
    for (strand, &id) in strands.hair_id.iter().enumerate() {
        let fibre = strands.strand_id.get(strand).copied().unwrap_or(0);
        if let Some(first) = seen.insert((id, fibre), strand) {
            let detail = format!("hair {id} strand {fibre} is also curve {first}");
            faults.push(Fault {
                kind: FaultKind::DuplicateId,
                strand: Some(strand),
                detail,
            });
        }
    }
    faults
}

fn wrong_counts(strands: &StrandBuffer) -> Vec<Fault> {
    let mut faults = Vec::new();
    let ascending = strands.offsets.first() == Some(&0)
        && strands.offsets.windows(2).all(|w| w[0] <= w[1])
        && strands.offsets.last().map(|&o| o as usize) == Some(strands.points.len());
    if !ascending {
        let detail = format!("offsets must ascend from 0 to {}", strands.points.len());
        faults.push(Fault {
            kind: FaultKind::BadOffsets,
            strand: None,
            detail,
        });
        return faults;
    }
    let vertices = strands.points.len();
    let curves = strands.len();
    let arrays = [
        ("widths", strands.widths.len(), vertices),
        ("colors", strands.colors.len(), vertices),
        ("opacities", strands.opacities.len(), vertices),
        ("normals", strands.normals.len(), vertices),
        ("hair_id", strands.hair_id.len(), curves),
        ("strand_id", strands.strand_id.len(), curves),
        ("root_uv", strands.root_uv.len(), curves),
        ("strand_uv", strands.strand_uv.len(), curves),
        ("group", strands.group.len(), curves),
        ("triangle", strands.triangle.len(), curves),
        ("barycentric", strands.barycentric.len(), curves),
        ("root_rest", strands.root_rest.len(), curves),
    ];
    for (name, found, expected) in arrays {
        if found != 0 && found != expected {
            let detail = format!("{name} has {found} entries, not {expected}");
            faults.push(Fault {
                kind: FaultKind::WrongCount,
                strand: None,
                detail,
            });
        }
    }
    faults
}

fn shape_faults(strands: &StrandBuffer, strand: usize, faults: &mut Vec<Fault>) {
    let points = strands.strand_points(strand);
    let mut add = |kind, detail| {
        faults.push(Fault {
            kind,
            strand: Some(strand),
            detail,
        })
    };
    if points.len() < 2 {
        add(
            FaultKind::TooFewVertices,
            format!("{} vertices", points.len()),
        );
    } else if points.iter().all(|p| *p == points[0]) {
        add(
            FaultKind::ZeroLength,
            format!("{} vertices at one place", points.len()),
        );
    }
}

fn value_faults(strands: &StrandBuffer, strand: usize, faults: &mut Vec<Fault>) {
    let mut add = |kind, detail| {
        faults.push(Fault {
            kind,
            strand: Some(strand),
            detail,
        })
    };
    let vectors = [
        ("points", &strands.points),
        ("colors", &strands.colors),
        ("normals", &strands.normals),
    ];
    for (name, array) in vectors {
        for (i, v) in array
            .get(strands.vertices(strand))
            .unwrap_or(&[])
            .iter()
            .enumerate()
        {
            if let Some(axis) = v.iter().position(|x| !x.is_finite()) {
                let axis_name = ["x", "y", "z"][axis];
                add(
                    FaultKind::NotFinite,
                    format!("{name}[{i}].{axis_name} is {}", v[axis]),
                );
            }
        }
    }
    for (i, &w) in strands
        .widths
        .get(strands.vertices(strand))
        .unwrap_or(&[])
        .iter()
        .enumerate()
    {
        if !w.is_finite() {
            add(FaultKind::NotFinite, format!("widths[{i}] is {w}"));
        } else if w < 0.0 {
            add(FaultKind::NegativeWidth, format!("widths[{i}] is {w}"));
        }
    }
    let opacities = strands
        .opacities
        .get(strands.vertices(strand))
        .unwrap_or(&[]);
    for (i, &o) in opacities.iter().enumerate() {
        if !(0.0..=1.0).contains(&o) {
            add(FaultKind::OpacityRange, format!("opacities[{i}] is {o}"));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kinds(strands: &StrandBuffer) -> Vec<FaultKind> {
        validate(strands).into_iter().map(|f| f.kind).collect()
    }

    fn two_strands() -> StrandBuffer {
        let mut strands = StrandBuffer::new();
        strands.points = vec![[0.0; 3], [1.0; 3], [0.0; 3], [2.0; 3]];
        strands.offsets = vec![0, 2, 4];
        strands
    }

    #[test]
    fn sound_strands_have_no_fault() {
        assert!(validate(&two_strands()).is_empty());
    }

    #[test]
    fn each_fault_is_found_with_its_curve() {
        let mut strands = two_strands();
        strands.widths = vec![1.0, -1.0, 1.0, 1.0];
        strands.hair_id = vec![3, 3];
        strands.points[3] = [0.0; 3];
        let faults = validate(&strands);
        let found: Vec<_> = faults.iter().map(|f| (f.kind, f.strand)).collect();
        assert_eq!(
            found,
            [
                (FaultKind::NegativeWidth, Some(0)),
                (FaultKind::ZeroLength, Some(1)),
                (FaultKind::DuplicateId, Some(1)),
            ]
        );
    }

    #[test]
    fn wrong_counts_and_offsets_do_not_panic() {
        let mut strands = two_strands();
        strands.widths = vec![1.0];
        assert_eq!(kinds(&strands), [FaultKind::WrongCount]);
        strands.offsets = vec![0, 9, 4];
        assert_eq!(kinds(&strands), [FaultKind::BadOffsets]);
        strands.offsets = vec![];
        assert_eq!(kinds(&strands), [FaultKind::BadOffsets]);
    }
}
