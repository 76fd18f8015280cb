//! The USD form: the decoded curves as a `BasisCurves` prim, and the numbers beside them.

use super::SuperHelices;
use super::arrays::Entries;
use crate::{WriteOptions, usdc};
use pelage_strands::StreamInfo;
use std::io;
use std::path::Path;

/// What names of the arrays start with, as attributes.
pub(crate) const NAMESPACE: &str = "superHelix:";

pub(super) fn write(path: &Path, strands: &SuperHelices, options: &WriteOptions) -> io::Result<()> {
    let usual = StreamInfo::default();
    let info = StreamInfo {
        up_axis: strands.up_axis.unwrap_or(usual.up_axis),
        meters_per_unit: strands.meters_per_unit.unwrap_or(usual.meters_per_unit),
        ..usual
    };
    let arrays = strands.arrays();
    let beside: Vec<usdc::Beside> = arrays
        .iter()
        .map(|(name, entries)| usdc::Beside {
            name: format!("{NAMESPACE}{name}"),
            entries,
        })
        .collect();
    usdc::write_with(path, options, &info, &strands.decode(None), &beside)
}

/// The type of an array in USD.
pub(crate) fn type_name(entries: &Entries) -> &'static str {
    match entries {
        Entries::Counts(_) => "int[]",
        Entries::Vectors(_) => "float3[]",
        Entries::Numbers(_) => "float[]",
    }
}
