//! The arrays of a stream of strands as columns of raw little-endian numbers.

use crate::spool::Spool;
use pelage_strands::{Amount, StrandBuffer};
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

#[cfg(target_endian = "big")]
compile_error!("columns are spooled as the machine holds them; files want little-endian");

/// One attribute of a strand buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Field {
    Points,
    /// Vertices a curve, as written.
    Counts,
    Widths,
    Colors,
    Opacities,
    Normals,
    HairId,
    StrandId,
    RootUv,
    StrandUv,
    Group,
    Triangle,
    Barycentric,
    RootRest,
}

/// What one number of a field is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scalar {
    F32,
    U32,
    U64,
}

impl Field {
    /// Type of a number, and numbers an entry.
    pub(crate) fn element(self) -> (Scalar, usize) {
        use Field::*;
        match self {
            Counts | StrandId | Group | Triangle => (Scalar::U32, 1),
            HairId => (Scalar::U64, 1),
            Widths | Opacities => (Scalar::F32, 1),
            RootUv | StrandUv => (Scalar::F32, 2),
            Points | Colors | Normals | Barycentric | RootRest => (Scalar::F32, 3),
        }
    }

    /// Bytes an entry.
    pub(crate) fn stride(self) -> usize {
        let (scalar, components) = self.element();
        components * if scalar == Scalar::U64 { 8 } else { 4 }
    }

    /// Whether there is an entry a vertex rather than a curve.
    pub(crate) fn is_per_vertex(self) -> bool {
        use Field::*;
        matches!(self, Points | Widths | Colors | Opacities | Normals)
    }

    /// Whether there are values a frame; the others are those of the first frame.
    pub(crate) fn moves(self) -> bool {
        matches!(self, Field::Points | Field::Normals)
    }

    /// Entries that `amount`, counted as written, has of it.
    pub(crate) fn entries(self, amount: Amount) -> u64 {
        if self.is_per_vertex() {
            amount.vertices
        } else {
            amount.strands
        }
    }

    /// Bytes of those entries; `None` for more than any file holds.
    pub(crate) fn size(self, amount: Amount) -> Option<u64> {
        self.entries(amount).checked_mul(self.stride() as u64)
    }

    /// The entries of `strands`; empty where the attribute is absent (and for
    /// `Counts`, which no array holds).
    fn bytes(self, strands: &StrandBuffer) -> &[u8] {
        use bytemuck::cast_slice;
        match self {
            Field::Points => cast_slice(&strands.points),
            Field::Counts => &[],
            Field::Widths => cast_slice(&strands.widths),
            Field::Colors => cast_slice(&strands.colors),
            Field::Opacities => cast_slice(&strands.opacities),
            Field::Normals => cast_slice(&strands.normals),
            Field::HairId => cast_slice(&strands.hair_id),
            Field::StrandId => cast_slice(&strands.strand_id),
            Field::RootUv => cast_slice(&strands.root_uv),
            Field::StrandUv => cast_slice(&strands.strand_uv),
            Field::Group => cast_slice(&strands.group),
            Field::Triangle => cast_slice(&strands.triangle),
            Field::Barycentric => cast_slice(&strands.barycentric),
            Field::RootRest => cast_slice(&strands.root_rest),
        }
    }
}

/// Which vertices of a strand are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ends {
    /// The real ones.
    Real,
    /// The first and the last once more: for formats that must hold the phantom
    /// vertices of a Catmull-Rom curve.
    Doubled,
}

impl Ends {
    /// Vertices written for a strand of `real` vertices.
    pub(crate) fn count(self, real: usize) -> usize {
        match self {
            Ends::Real => real,
            Ends::Doubled => real + 2,
        }
    }

    /// What is written of `real` strands and vertices; stops at the largest number.
    pub(crate) fn amount(self, real: Amount) -> Amount {
        let added = self.count(0) as u64;
        Amount {
            strands: real.strands,
            vertices: real
                .vertices
                .saturating_add(real.strands.saturating_mul(added)),
        }
    }

    /// Entries of `stride` bytes, one a vertex of `strands`, as they are written.
    /// Strands have at least one vertex. `scratch` only lends its memory.
    pub(crate) fn apply<'a>(
        self,
        bytes: &'a [u8],
        stride: usize,
        strands: &StrandBuffer,
        scratch: &'a mut Vec<u8>,
    ) -> &'a [u8] {
        if self == Ends::Real {
            return bytes;
        }
        scratch.clear();
        scratch.reserve(bytes.len() + 2 * stride * strands.len());
        match stride {
            4 => double_ends::<4>(bytes, &strands.offsets, scratch),
            12 => double_ends::<12>(bytes, &strands.offsets, scratch),
            _ => unreachable!("what is written a vertex has one or three floats"),
        }
        scratch
    }
}

/// Entries of `N` bytes with each strand's first and last one twice. `N` is known
/// when compiling because single entries are copied all the time.
fn double_ends<const N: usize>(bytes: &[u8], offsets: &[u32], out: &mut Vec<u8>) {
    let (entries, _) = bytes.as_chunks::<N>();
    for ends in offsets.windows(2) {
        let strand = &entries[ends[0] as usize..ends[1] as usize];
        if let [first, .., last] = strand {
            out.extend_from_slice(first);
            out.extend_from_slice(strand.as_flattened());
            out.extend_from_slice(last);
        } else if let [lone] = strand {
            out.extend_from_slice([*lone; 3].as_flattened());
        }
    }
}

/// What a column amounts to, at the end of the stream or of a frame.
#[derive(Debug)]
pub(crate) enum Content {
    /// Some chunk lacked the attribute: half an attribute is none.
    Absent,
    /// Every number was the column's usual value.
    Usual(f32),
    /// The entries.
    Values(Spool),
}

/// A field being gathered.
#[derive(Debug)]
pub(crate) struct Column {
    pub(crate) field: Field,
    target: PathBuf,
    spool: Spool,
    /// A value (of every component) that needs no spooling while nothing else came.
    usual: Option<f32>,
    /// Entries of the usual value held back so far.
    held_back: u64,
    absent: bool,
}

impl Column {
    /// An empty column of `field` that spools beside `target`.
    pub(crate) fn new(field: Field, target: &Path) -> Self {
        Self {
            field,
            target: target.into(),
            spool: Spool::beside(target),
            usual: None,
            held_back: 0,
            absent: false,
        }
    }

    /// Holds entries back as long as all their numbers are `value`.
    pub(crate) fn usually(mut self, value: f32) -> Self {
        self.usual = Some(value);
        self
    }

    /// Keeps the CRC-32 of the entries, for the first array that the column ends in.
    pub(crate) fn with_checksum(mut self) -> Self {
        self.spool = self.spool.with_checksum();
        self
    }

    /// Whether all strands so far and those of `strands`, which has some, have it.
    pub(crate) fn is_in(&self, strands: &StrandBuffer) -> bool {
        let has = self.field == Field::Counts || !self.field.bytes(strands).is_empty();
        has && !self.absent
    }

    /// Lets the array, which has no entry yet, grow in `target` from `start` on.
    pub(crate) fn place(&mut self, target: &Arc<File>, start: u64) {
        self.spool.place(target, start);
    }

    /// Adds the field's entries of `strands`, none of which is without vertices where
    /// ends are doubled.
    pub(crate) fn take(
        &mut self,
        strands: &StrandBuffer,
        ends: Ends,
        scratch: &mut Vec<u8>,
    ) -> io::Result<()> {
        if strands.is_empty() || self.absent {
            return Ok(());
        }
        if !self.is_in(strands) {
            self.absent = true;
            self.spool = Spool::beside(&self.target);
            return Ok(());
        }
        if self.field == Field::Counts {
            return self.take_counts(strands, ends, scratch);
        }
        let bytes = self.field.bytes(strands);
        let stride = self.field.stride();
        let bytes = if self.field.is_per_vertex() {
            ends.apply(bytes, stride, strands, scratch)
        } else {
            bytes
        };
        self.put(bytes)
    }

    fn take_counts(
        &mut self,
        strands: &StrandBuffer,
        ends: Ends,
        scratch: &mut Vec<u8>,
    ) -> io::Result<()> {
        scratch.clear();
        for pair in strands.offsets.windows(2) {
            let count = ends.count((pair[1] - pair[0]) as usize) as u32;
            scratch.extend_from_slice(&count.to_le_bytes());
        }
        self.spool.put(scratch)
    }

    fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        let stride = self.field.stride();
        if let Some(usual) = self.usual {
            if self.spool.bytes() == 0 && all_are(usual, bytes) {
                self.held_back += (bytes.len() / stride) as u64;
                return Ok(());
            }
            let one = usual.to_le_bytes().repeat(stride / 4);
            for _ in 0..std::mem::take(&mut self.held_back) {
                self.spool.put(&one)?;
            }
        }
        self.spool.put(bytes)
    }

    /// Ends an array; the next entries begin another.
    pub(crate) fn finish(&mut self) -> Content {
        let spool = std::mem::replace(&mut self.spool, Spool::beside(&self.target));
        match self.usual {
            _ if self.absent => Content::Absent,
            Some(usual) if spool.bytes() == 0 => Content::Usual(usual),
            _ => Content::Values(spool),
        }
    }
}

/// Whether every number of `bytes` is `value`; no NaN is.
fn all_are(value: f32, bytes: &[u8]) -> bool {
    bytes
        .chunks_exact(4)
        .all(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]) == value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;

    fn strand(opacities: &[f32]) -> StrandBuffer {
        StrandBuffer {
            offsets: vec![0, opacities.len() as u32],
            points: vec![[0.0; 3]; opacities.len()],
            opacities: opacities.to_vec(),
            ..Default::default()
        }
    }

    fn gather(column: Column, ends: Ends, strands: &[StrandBuffer]) -> Content {
        let mut column = column;
        for strands in strands {
            column.take(strands, ends, &mut Vec::new()).unwrap();
        }
        column.finish()
    }

    fn floats(content: Content) -> Vec<f32> {
        let Content::Values(spool) = content else {
            panic!("no values")
        };
        let mut bytes = Vec::new();
        spool.into_reader().read_to_end(&mut bytes).unwrap();
        bytemuck::pod_collect_to_vec(&bytes)
    }

    fn opacities() -> Column {
        Column::new(Field::Opacities, Path::new("x")).usually(1.0)
    }

    #[test]
    fn a_column_of_the_usual_value_alone_is_not_spooled() {
        let all_one = gather(opacities(), Ends::Doubled, &[strand(&[1.0, 1.0])]);
        assert!(matches!(all_one, Content::Usual(1.0)));
    }

    #[test]
    fn values_held_back_come_before_the_first_unusual_one() {
        let strands = [strand(&[1.0, 1.0]), strand(&[1.0, 0.5]), strand(&[1.0])];
        let content = gather(opacities(), Ends::Real, &strands);
        assert_eq!(floats(content), [1.0, 1.0, 1.0, 0.5, 1.0]);
    }

    #[test]
    fn doubled_ends_repeat_the_first_and_last_entry_of_each_strand() {
        let mut strands = strand(&[1.0, 2.0, 3.0, 4.0, 5.0]);
        strands.offsets = vec![0, 2, 5];
        let content = gather(opacities(), Ends::Doubled, &[strands]);
        assert_eq!(
            floats(content),
            [1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 5.0, 5.0]
        );
    }

    #[test]
    fn an_attribute_that_one_chunk_lacks_is_absent() {
        let mut bare = strand(&[1.0, 0.5]);
        bare.opacities.clear();
        let content = gather(opacities(), Ends::Real, &[strand(&[0.5, 1.0]), bare]);
        assert!(matches!(content, Content::Absent));
        // A chunk without strands says nothing of attributes.
        let none = StrandBuffer::new();
        let content = gather(opacities(), Ends::Real, &[none, strand(&[0.5])]);
        assert_eq!(floats(content), [0.5]);
    }
}
