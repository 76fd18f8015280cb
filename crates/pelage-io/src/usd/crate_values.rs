//! How many bytes a value of a `.usdc` file takes once decoded.

use super::crate_guard::{Budget, Tables};
use super::cursor::{Broken, Cursor, encoded_sizes};

/// Levels of dictionaries and time samples within values.
const MAX_DEPTH: u32 = 32;

/// What the reader keeps for a small value, roughly.
const SMALL: u64 = 64;

/// Types by number, from `pxr/usd/usd/crateDataTypes.h`.
mod kind {
    pub const STRING: u8 = 10;
    pub const TOKEN: u8 = 11;
    pub const ASSET_PATH: u8 = 12;
    pub const DICTIONARY: u8 = 31;
    pub const TOKEN_LIST_OP: u8 = 32;
    pub const STRING_LIST_OP: u8 = 33;
    pub const PATH_LIST_OP: u8 = 34;
    pub const REFERENCE_LIST_OP: u8 = 35;
    pub const INT_LIST_OP: u8 = 36;
    pub const INT64_LIST_OP: u8 = 37;
    pub const UINT_LIST_OP: u8 = 38;
    pub const UINT64_LIST_OP: u8 = 39;
    pub const PATH_VECTOR: u8 = 40;
    pub const TOKEN_VECTOR: u8 = 41;
    pub const VARIANT_SELECTION_MAP: u8 = 45;
    pub const TIME_SAMPLES: u8 = 46;
    pub const PAYLOAD: u8 = 47;
    pub const DOUBLE_VECTOR: u8 = 48;
    pub const LAYER_OFFSET_VECTOR: u8 = 49;
    pub const STRING_VECTOR: u8 = 50;
    pub const UNREGISTERED_LIST_OP: u8 = 54;
    pub const PAYLOAD_LIST_OP: u8 = 55;
    pub const TIME_CODE: u8 = 56;
    pub const PATH_EXPRESSION: u8 = 57;
    pub const RELOCATES: u8 = 58;
}

/// A value's type, flags and place: 8 flag bits, 8 of type, 48 of payload.
#[derive(Clone, Copy)]
struct Rep(u64);

impl Rep {
    fn kind(self) -> u8 {
        (self.0 >> 48) as u8
    }
    fn is_array(self) -> bool {
        self.0 >> 63 & 1 == 1
    }
    fn is_inlined(self) -> bool {
        self.0 >> 62 & 1 == 1
    }
    fn is_compressed(self) -> bool {
        self.0 >> 61 & 1 == 1
    }
    fn payload(self) -> u64 {
        self.0 & ((1 << 48) - 1)
    }
}

/// Measures values of one file.
pub(super) struct Values<'a> {
    bytes: &'a [u8],
    tables: &'a Tables,
    budget: &'a Budget,
}

impl<'a> Values<'a> {
    pub(super) fn new(bytes: &'a [u8], tables: &'a Tables, budget: &'a Budget) -> Self {
        Self {
            bytes,
            tables,
            budget,
        }
    }

    pub(super) fn tables(&self) -> &Tables {
        self.tables
    }

    /// Bytes of the value that `rep` stands for; fails where it cannot be read.
    pub(super) fn bytes(&self, rep: u64) -> Result<u64, Broken> {
        self.value(Rep(rep), 0)
    }

    fn value(&self, rep: Rep, depth: u32) -> Result<u64, Broken> {
        // Paid for walking, so that values which share parts cannot multiply.
        self.budget.spend(SMALL)?;
        if depth > MAX_DEPTH {
            return Err(Broken(format!("its values nest deeper than {MAX_DEPTH}")));
        }
        if rep.is_array() {
            return self.array(rep);
        }
        if rep.is_inlined() {
            return Ok(SMALL + self.text(rep, rep.payload() as u32)?);
        }
        let mut at = Cursor::at(self.bytes, rep.payload())?;
        match rep.kind() {
            kind::STRING | kind::TOKEN | kind::ASSET_PATH | kind::PATH_EXPRESSION => {
                Ok(SMALL + self.text(rep, at.u32()?)?)
            }
            kind::DICTIONARY => self.dictionary(&mut at, depth),
            kind::TIME_SAMPLES => self.time_samples(&mut at, depth),
            kind::TOKEN_LIST_OP..=kind::UINT64_LIST_OP
            | kind::UNREGISTERED_LIST_OP
            | kind::PAYLOAD_LIST_OP => self.list_op(rep.kind(), &mut at, depth),
            kind::PATH_VECTOR => self.indices(&mut at, self.tables.paths, |_| SMALL),
            kind::TOKEN_VECTOR => self.tokens(&mut at),
            kind::STRING_VECTOR => self.strings(&mut at),
            kind::VARIANT_SELECTION_MAP => Ok(SMALL * (1 + at.count_of(8)?)),
            kind::RELOCATES => Ok(SMALL * (1 + at.count_of(8)?)),
            kind::LAYER_OFFSET_VECTOR => Ok(16 * (1 + at.count_of(16)?)),
            kind::DOUBLE_VECTOR => self.numbers(rep, 8),
            kind::PAYLOAD => Ok(SMALL),
            _ => Ok(2 * SMALL),
        }
    }

    /// Bytes of the text that a single token or string names.
    fn text(&self, rep: Rep, index: u32) -> Result<u64, Broken> {
        let token = match (rep.kind(), rep.is_inlined()) {
            (kind::TOKEN, _) => index,
            (kind::ASSET_PATH | kind::PATH_EXPRESSION, true) => index,
            (kind::STRING | kind::ASSET_PATH | kind::PATH_EXPRESSION, _) => {
                self.entry(&self.tables.strings, index, "string")?
            }
            _ => return Ok(0),
        };
        Ok(self.entry(&self.tables.tokens, token, "token")? as u64)
    }

    fn entry(&self, table: &[u32], index: u32, what: &str) -> Result<u32, Broken> {
        let entry = table.get(index as usize).copied();
        entry.ok_or_else(|| Broken(format!("a value names {what} {index} of {}", table.len())))
    }

    fn array(&self, rep: Rep) -> Result<u64, Broken> {
        if rep.payload() == 0 {
            return Ok(SMALL);
        }
        if rep.is_inlined() {
            return Err(Broken("an array claims to be stored in place".into()));
        }
        let mut at = Cursor::at(self.bytes, rep.payload())?;
        match rep.kind() {
            kind::STRING | kind::ASSET_PATH | kind::PATH_EXPRESSION => self.strings(&mut at),
            // Tokens become shared text: an entry is as small as a number.
            kind::TOKEN => self.numbers(rep, 4).map(|bytes| 16 * bytes),
            kind => match element_size(kind) {
                Some(size) => self.numbers(rep, size),
                None => Err(Broken(format!("an array has entries of type {kind}"))),
            },
        }
    }

    /// Bytes of an array of entries of `size` bytes.
    fn numbers(&self, rep: Rep, size: u64) -> Result<u64, Broken> {
        if rep.payload() == 0 {
            return Ok(SMALL);
        }
        let mut at = Cursor::at(self.bytes, rep.payload())?;
        if self.tables.version < [0, 5, 0] {
            at.u32()?;
        }
        let count = match self.tables.version < [0, 7, 0] {
            true => at.u32()? as u64,
            false => at.u64()?,
        };
        // Short arrays are never packed, whatever their flag says.
        if !rep.is_compressed() || count < 4 {
            at.room_for(count, size)?;
            return Ok(SMALL + count * size);
        }
        if !is_packable(rep.kind()) {
            return Err(Broken(format!(
                "an array of type {} claims to be packed",
                rep.kind()
            )));
        }
        if is_real(rep.kind()) {
            match at.u8()? {
                b'i' => {}
                b't' => {
                    let table = at.u32()? as u64;
                    at.room_for(table, size)?;
                    at.take((table * size) as usize)?;
                }
                code => return Err(Broken(format!("an array is packed in the way {code}"))),
            }
        }
        let (least, most) = encoded_sizes(count.min(1 << 48));
        at.packed(least)?;
        Ok(SMALL + count.saturating_mul(size.max(4)) + 2 * most)
    }

    fn strings(&self, at: &mut Cursor) -> Result<u64, Broken> {
        let tables = self.tables;
        self.indices(at, tables.strings.len(), |i| {
            tables.tokens[tables.strings[i] as usize] as u64
        })
    }

    fn tokens(&self, at: &mut Cursor) -> Result<u64, Broken> {
        let tokens = &self.tables.tokens;
        self.indices(at, tokens.len(), |i| tokens[i] as u64)
    }

    /// Bytes of a counted list of indices below `limit`, each worth `weight` more.
    fn indices(
        &self,
        at: &mut Cursor,
        limit: usize,
        weight: impl Fn(usize) -> u64,
    ) -> Result<u64, Broken> {
        let count = at.count_of(4)?;
        self.budget.spend(count)?;
        let mut bytes = SMALL;
        for _ in 0..count {
            let index = at.u32()? as usize;
            if index >= limit {
                return Err(Broken(format!("a list names entry {index} of {limit}")));
            }
            bytes += 32 + weight(index);
        }
        Ok(bytes)
    }

    /// A number, then for each entry a key and an offset to where its value's
    /// representation stands; the next entry follows that.
    fn dictionary(&self, at: &mut Cursor, depth: u32) -> Result<u64, Broken> {
        let count = at.u64()?;
        let mut bytes = SMALL;
        for _ in 0..count {
            self.entry(&self.tables.strings, at.u32()?, "string")?;
            let rep = self.distant_rep(at)?;
            bytes += SMALL + self.value(rep, depth + 1)?;
        }
        Ok(bytes)
    }

    fn distant_rep(&self, at: &mut Cursor) -> Result<Rep, Broken> {
        self.follow(at)?;
        Ok(Rep(at.u64()?))
    }

    /// Follows an offset that counts from where it itself starts.
    fn follow(&self, at: &mut Cursor) -> Result<(), Broken> {
        let offset = at.u64()? as i64;
        at.jump(offset.saturating_sub(8))
    }

    fn time_samples(&self, at: &mut Cursor, depth: u32) -> Result<u64, Broken> {
        let times = self.distant_rep(at)?;
        let mut bytes = self.value(times, depth + 1)?;
        self.follow(at)?;
        let count = at.count_of(8)?;
        for _ in 0..count {
            bytes += SMALL + self.value(Rep(at.u64()?), depth + 1)?;
        }
        Ok(bytes)
    }

    /// A byte of flags, then a counted list for each flag but the first.
    fn list_op(&self, kind: u8, at: &mut Cursor, depth: u32) -> Result<u64, Broken> {
        let lists = (at.u8()? >> 1).count_ones();
        let mut bytes = SMALL;
        for _ in 0..lists {
            bytes += match kind {
                kind::TOKEN_LIST_OP => self.tokens(at)?,
                kind::STRING_LIST_OP | kind::UNREGISTERED_LIST_OP => self.strings(at)?,
                kind::PATH_LIST_OP => self.indices(at, self.tables.paths, |_| SMALL)?,
                kind::INT_LIST_OP | kind::UINT_LIST_OP => self.plain(at, 4)?,
                kind::INT64_LIST_OP | kind::UINT64_LIST_OP => self.plain(at, 8)?,
                _ => self.arcs(kind, at, depth)?,
            };
        }
        Ok(bytes)
    }

    fn plain(&self, at: &mut Cursor, size: u64) -> Result<u64, Broken> {
        let count = at.count_of(size)?;
        at.take((count * size) as usize)?;
        Ok(count * size)
    }

    /// References (with a dictionary each) or payloads.
    fn arcs(&self, kind: u8, at: &mut Cursor, depth: u32) -> Result<u64, Broken> {
        let count = at.u64()?;
        at.room_for(count, 8)?;
        for _ in 0..count {
            self.entry(&self.tables.strings, at.u32()?, "string")?;
            let path = at.u32()? as usize;
            if path >= self.tables.paths {
                return Err(Broken(format!("a reference names path {path}")));
            }
            if kind == kind::REFERENCE_LIST_OP || self.tables.version >= [0, 8, 0] {
                at.take(16)?;
            }
            if kind == kind::REFERENCE_LIST_OP {
                self.dictionary(at, depth + 1)?;
            }
            self.budget.spend(4 * SMALL)?;
        }
        Ok(count * 4 * SMALL)
    }
}

fn is_real(kind: u8) -> bool {
    matches!(kind, 7..=9 | kind::TIME_CODE | kind::DOUBLE_VECTOR)
}

/// Whether arrays of this type may be packed: integers and real numbers.
fn is_packable(kind: u8) -> bool {
    matches!(kind, 3..=6) || is_real(kind)
}

/// Bytes of an entry of an array in the file.
fn element_size(kind: u8) -> Option<u64> {
    Some(match kind {
        1 | 2 => 1,
        7 => 2,
        3 | 4 | 8 => 4,
        5 | 6 | 9 | kind::TIME_CODE | kind::DOUBLE_VECTOR => 8,
        // Matrices of 2, 3 and 4 rows of doubles.
        13 => 32,
        14 => 72,
        15 => 128,
        // Quaternions of doubles, floats and halves.
        16 => 32,
        17 => 16,
        18 => 8,
        // Vectors of 2, 3 and 4: doubles, floats, halves, integers.
        19..=30 => {
            let components = 2 + (kind as u64 - 19) / 4;
            components * [8, 4, 2, 4][(kind as usize - 19) % 4]
        }
        _ => return None,
    })
}
