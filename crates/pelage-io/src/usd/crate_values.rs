//! How many bytes a value of a `.usdc` file takes once decoded.

use super::MAX_ITEMS;
use super::crate_guard::{Budget, Tables};
use super::cursor::{Broken, Cursor, encoded_sizes};
use super::kind::{self, element_size, is_packable, is_real};

/// Levels of dictionaries and time samples within values.
const MAX_DEPTH: u32 = 32;

/// What the reader keeps for a small value, roughly.
const SMALL: u64 = 64;

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
            // The one list that the reader looks for in the file all the same.
            if rep.kind() == kind::PAYLOAD_LIST_OP {
                return Err(Broken(
                    "a list of payloads claims to be stored in place".into(),
                ));
            }
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
            kind::PATH_VECTOR => self.paths(&mut at),
            kind::TOKEN_VECTOR => self.tokens(&mut at),
            kind::STRING_VECTOR => self.strings(&mut at),
            kind::VARIANT_SELECTION_MAP => self.pairs(&mut at, |i| self.string(i)),
            kind::RELOCATES => self.pairs(&mut at, |i| self.path(i)),
            kind::LAYER_OFFSET_VECTOR => Ok(16 * (1 + at.count_of(16)?)),
            kind::DOUBLE_VECTOR => self.numbers(rep, 8),
            kind::PAYLOAD => Ok(SMALL + self.string(at.u32()?)? + self.path(at.u32()?)?),
            _ => Ok(2 * SMALL),
        }
    }

    /// Bytes of the text that a single token or string names.
    fn text(&self, rep: Rep, index: u32) -> Result<u64, Broken> {
        match (rep.kind(), rep.is_inlined()) {
            (kind::TOKEN, _) => self.token(index),
            (kind::ASSET_PATH | kind::PATH_EXPRESSION, true) => self.token(index),
            (kind::STRING | kind::ASSET_PATH | kind::PATH_EXPRESSION, _) => self.string(index),
            _ => Ok(0),
        }
    }

    /// Bytes of the token `index`.
    fn token(&self, index: u32) -> Result<u64, Broken> {
        Ok(self.entry(&self.tables.tokens, index, "token")? as u64)
    }

    /// Bytes of the string `index`.
    fn string(&self, index: u32) -> Result<u64, Broken> {
        self.token(self.entry(&self.tables.strings, index, "string")?)
    }

    /// Bytes of the path `index`.
    fn path(&self, index: u32) -> Result<u64, Broken> {
        Ok(self.entry(&self.tables.paths, index, "path")? as u64)
    }

    fn entry(&self, table: &[u32], index: u32, what: &str) -> Result<u32, Broken> {
        let entry = table.get(index as usize).copied();
        entry.ok_or_else(|| Broken(format!("a value names {what} {index} of {}", table.len())))
    }

    fn array(&self, rep: Rep) -> Result<u64, Broken> {
        let kind = rep.kind();
        let is_text = matches!(
            kind,
            kind::STRING | kind::ASSET_PATH | kind::PATH_EXPRESSION
        );
        let size = match kind {
            kind::TOKEN => Some(4),
            _ if is_text => Some(4),
            _ => element_size(kind),
        };
        // Of other types, the reader takes no notice of the flag, nor of a place of 0.
        let Some(size) = size else {
            return Err(Broken(format!("an array has entries of type {kind}")));
        };
        if rep.payload() == 0 {
            return Ok(SMALL);
        }
        if rep.is_inlined() {
            return Err(Broken("an array claims to be stored in place".into()));
        }
        let mut at = Cursor::at(self.bytes, rep.payload())?;
        match kind {
            kind::TOKEN => {
                let count = self.array_count(&mut at)?;
                at.room_for(count, 4)?;
                self.indices(&mut at, count, |i| self.token(i))
            }
            _ if is_text => self.strings(&mut at),
            _ => self.numbers(rep, size),
        }
    }

    /// Bytes of an array of entries of `size` bytes.
    fn numbers(&self, rep: Rep, size: u64) -> Result<u64, Broken> {
        if rep.payload() == 0 {
            return Ok(SMALL);
        }
        let mut at = Cursor::at(self.bytes, rep.payload())?;
        let count = self.array_count(&mut at)?;
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

    /// The number of entries that stands before an array, after its rank in old files.
    fn array_count(&self, at: &mut Cursor) -> Result<u64, Broken> {
        if self.tables.version < [0, 5, 0] {
            at.u32()?;
        }
        match self.tables.version < [0, 7, 0] {
            true => at.u32().map(u64::from),
            false => at.u64(),
        }
    }

    fn strings(&self, at: &mut Cursor) -> Result<u64, Broken> {
        let count = at.count_of(4)?;
        self.indices(at, count, |i| self.string(i))
    }

    fn tokens(&self, at: &mut Cursor) -> Result<u64, Broken> {
        let count = at.count_of(4)?;
        self.indices(at, count, |i| self.token(i))
    }

    fn paths(&self, at: &mut Cursor) -> Result<u64, Broken> {
        let count = at.count_of(4)?;
        self.indices(at, count, |i| self.path(i))
    }

    /// Bytes of a counted list of pairs of indices.
    fn pairs(
        &self,
        at: &mut Cursor,
        bytes: impl Fn(u32) -> Result<u64, Broken>,
    ) -> Result<u64, Broken> {
        let count = at.count_of(8)?;
        self.indices(at, 2 * count, bytes)
    }

    /// Bytes of a list of indices, each worth what stands there.
    fn indices(
        &self,
        at: &mut Cursor,
        count: u64,
        bytes: impl Fn(u32) -> Result<u64, Broken>,
    ) -> Result<u64, Broken> {
        self.budget.spend(count)?;
        let mut all = SMALL;
        for _ in 0..count {
            all += 32 + bytes(at.u32()?)?;
        }
        Ok(all)
    }

    /// A number, then for each entry a key and an offset to where its value's
    /// representation stands; the next entry follows that.
    fn dictionary(&self, at: &mut Cursor, depth: u32) -> Result<u64, Broken> {
        let count = at.u64()?;
        let mut bytes = SMALL;
        for _ in 0..count {
            let key = self.string(at.u32()?)?;
            let rep = self.distant_rep(at)?;
            bytes += SMALL + key + self.value(rep, depth + 1)?;
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
            let count = at.clone().u64()?;
            let is_composed = !matches!(
                kind,
                kind::PATH_LIST_OP | kind::INT_LIST_OP..=kind::UINT64_LIST_OP
            );
            if is_composed && count > MAX_ITEMS as u64 {
                return Err(Broken(format!(
                    "a list has {count} items, more than {MAX_ITEMS}"
                )));
            }
            bytes += match kind {
                kind::TOKEN_LIST_OP => self.tokens(at)?,
                kind::STRING_LIST_OP | kind::UNREGISTERED_LIST_OP => self.strings(at)?,
                kind::PATH_LIST_OP => self.paths(at)?,
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
        let mut bytes = 0;
        for _ in 0..count {
            bytes += 4 * SMALL + self.string(at.u32()?)? + self.path(at.u32()?)?;
            if kind == kind::REFERENCE_LIST_OP || self.tables.version >= [0, 8, 0] {
                at.take(16)?;
            }
            if kind == kind::REFERENCE_LIST_OP {
                bytes += self.dictionary(at, depth + 1)?;
            }
            self.budget.spend(4 * SMALL)?;
        }
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ARRAY: u64 = 1 << 63;
    const INLINED: u64 = 1 << 62;

    /// Bytes of the value at `rep` in a file that holds `numbers` from byte 0 on, whose
    /// only token, string and path are long.
    fn bytes(rep: u64, numbers: &[u32]) -> Result<u64, Broken> {
        let file: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()).collect();
        let tables = Tables {
            version: [0, 8, 0],
            tokens: vec![1_000_000],
            strings: vec![0],
            paths: vec![1_000_000],
        };
        let budget = Budget::of(1 << 30);
        Values::new(&file, &tables, &budget).bytes(rep)
    }

    fn rep(kind: u8, payload: u64) -> u64 {
        (kind as u64) << 48 | payload
    }

    #[test]
    fn flags_that_the_reader_takes_no_notice_of_are_refused() {
        for kind in [
            kind::PAYLOAD_LIST_OP,
            kind::TOKEN_LIST_OP,
            kind::TIME_SAMPLES,
        ] {
            assert!(bytes(ARRAY | rep(kind, 0), &[0; 8]).is_err(), "{kind}");
        }
        assert!(bytes(INLINED | rep(kind::PAYLOAD_LIST_OP, 0), &[0; 8]).is_err());
    }

    #[test]
    fn every_copy_of_a_long_token_or_path_counts() {
        let three = [9, 3, 0, 0, 0, 0, 0, 0];
        for rep in [
            ARRAY | rep(kind::TOKEN, 4),
            ARRAY | rep(kind::STRING, 4),
            rep(kind::PATH_VECTOR, 4),
            rep(kind::TOKEN_VECTOR, 4),
            rep(kind::VARIANT_SELECTION_MAP, 4),
            rep(kind::RELOCATES, 4),
        ] {
            let bytes = bytes(rep, &[&three[..], &[0; 8]].concat()).unwrap();
            assert!(bytes > 3_000_000, "{bytes}");
        }
        let payload = bytes(rep(kind::PAYLOAD, 4), &three).unwrap_err();
        assert!(payload.0.contains("string 3 of 1"), "{payload:?}");
    }

    #[test]
    fn lists_that_are_composed_are_short() {
        let mut file = vec![2u8];
        file.extend((MAX_ITEMS as u64 + 1).to_le_bytes());
        file.resize(40_000, 0);
        let numbers: Vec<u32> = file
            .chunks(4)
            .map(|c| u32::from_le_bytes([c[0], c[1], c[2], c[3]]))
            .collect();
        let error = bytes(rep(kind::TOKEN_LIST_OP, 0), &numbers).unwrap_err();
        assert!(error.0.contains("4097 items"), "{error:?}");
    }
}
