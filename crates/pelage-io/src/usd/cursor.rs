//! Reads little-endian numbers and packed blocks of a `.usdc` file, checked.

use super::crate_guard::Budget;

/// What is wrong with the file, to follow "the file is no sound USD: ".
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Broken(pub(super) String);

/// Bytes that an LZ4 block can grow to a byte, at most.
pub(super) const LZ4_RATIO: u64 = 255;

/// A place in the bytes of a file.
#[derive(Clone)]
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    position: usize,
}

impl<'a> Cursor<'a> {
    /// A cursor at byte `position`.
    pub(super) fn at(bytes: &'a [u8], position: u64) -> Result<Self, Broken> {
        match usize::try_from(position) {
            Ok(position) if position <= bytes.len() => Ok(Self { bytes, position }),
            _ => Err(Broken(format!(
                "it points to byte {position} of {}",
                bytes.len()
            ))),
        }
    }

    /// Moves by `offset` from where it is.
    pub(super) fn jump(&mut self, offset: i64) -> Result<(), Broken> {
        let target = (self.position as u64).checked_add_signed(offset);
        let target =
            target.ok_or_else(|| Broken(format!("an offset of {offset} leads out of the file")))?;
        *self = Self::at(self.bytes, target)?;
        Ok(())
    }

    /// Bytes from here to the end of the file.
    pub(super) fn left(&self) -> u64 {
        (self.bytes.len() - self.position) as u64
    }

    /// The next `count` bytes.
    pub(super) fn take(&mut self, count: usize) -> Result<&'a [u8], Broken> {
        let end = self.position.checked_add(count);
        let taken = end.and_then(|end| self.bytes.get(self.position..end));
        let taken = taken.ok_or_else(|| {
            Broken(format!(
                "it ends at byte {}, within {count} bytes that start at {}",
                self.bytes.len(),
                self.position
            ))
        })?;
        self.position += count;
        Ok(taken)
    }

    pub(super) fn u8(&mut self) -> Result<u8, Broken> {
        Ok(self.take(1)?[0])
    }

    pub(super) fn u32(&mut self) -> Result<u32, Broken> {
        let bytes = self.take(4)?.try_into();
        Ok(u32::from_le_bytes(bytes.expect("take(4) gives four bytes")))
    }

    pub(super) fn u64(&mut self) -> Result<u64, Broken> {
        let bytes = self.take(8)?.try_into();
        Ok(u64::from_le_bytes(
            bytes.expect("take(8) gives eight bytes"),
        ))
    }

    /// A count of packed entries; the packed block that follows bounds it.
    pub(super) fn count(&mut self) -> Result<u64, Broken> {
        let count = self.u64()?;
        // Integer coding spends at least two bits an entry before LZ4.
        if count > self.left().saturating_mul(LZ4_RATIO * 4) {
            return Err(Broken(format!(
                "it claims {count} entries, more than its size allows"
            )));
        }
        Ok(count)
    }

    /// A count of entries of `size` bytes each that follow unpacked.
    pub(super) fn count_of(&mut self, size: u64) -> Result<u64, Broken> {
        let count = self.u64()?;
        self.room_for(count, size)?;
        Ok(count)
    }

    /// Fails where fewer than `count` entries of `size` bytes are left.
    pub(super) fn room_for(&self, count: u64, size: u64) -> Result<(), Broken> {
        match count.checked_mul(size) {
            Some(bytes) if bytes <= self.left() => Ok(()),
            _ => Err(Broken(format!(
                "it claims {count} entries of {size} bytes where {} bytes are left",
                self.left()
            ))),
        }
    }

    /// Checks the size of a packed block, which unpacks to `unpacked` bytes or more,
    /// and gives the block.
    pub(super) fn packed(&mut self, unpacked: u64) -> Result<&'a [u8], Broken> {
        let size = self.u64()?;
        self.room_for(size, 1)?;
        if unpacked > size.saturating_mul(LZ4_RATIO) + 64 {
            return Err(Broken(format!(
                "it claims that {size} packed bytes unpack to {unpacked}"
            )));
        }
        let block = self.take(size as usize)?;
        // Blocks above 2 GiB come in chunks, which the reader does not know.
        match block.first() {
            Some(&chunks) if chunks != 0 => {
                Err(Broken(format!("a packed block has {chunks} chunks")))
            }
            _ => Ok(block),
        }
    }

    /// Unpacks a block of between `least` and `most` bytes.
    pub(super) fn decompress(
        &mut self,
        least: u64,
        most: u64,
        budget: &Budget,
    ) -> Result<Vec<u8>, Broken> {
        let packed = self.packed(least)?;
        budget.spend(most)?;
        let Some((_, block)) = packed.split_first() else {
            return Err(Broken("a packed block is empty".into()));
        };
        let mut output = vec![0; most as usize];
        let size = lz4_flex::decompress_into(block, &mut output)
            .map_err(|error| Broken(format!("a packed block cannot be unpacked: {error}")))?;
        output.truncate(size);
        Ok(output)
    }

    /// Decodes `count` integers: a common difference, two bits an entry that tell
    /// how many bytes its difference has, then the differences
    /// (`pxr/usd/usd/integerCoding.cpp`).
    pub(super) fn encoded_ints(&mut self, count: u64, budget: &Budget) -> Result<Vec<u32>, Broken> {
        if count == 0 {
            self.packed(0)?;
            return Ok(Vec::new());
        }
        let codes = count.div_ceil(4);
        let (least, most) = encoded_sizes(count);
        let data = self.decompress(least, most, budget)?;
        let mut code = Cursor::at(&data, 0)?;
        let common = code.u32()?;
        let mut rest = Cursor::at(&data, 4 + codes)?;
        let mut output = Vec::with_capacity(count as usize);
        let mut value = 0u32;
        for i in 0..count {
            let byte = data[4 + (i / 4) as usize];
            let difference = match byte >> (2 * (i % 4)) & 3 {
                0 => common,
                1 => rest.u8()? as i8 as u32,
                2 => rest.u8()? as u32 | (rest.u8()? as i8 as u32) << 8,
                _ => rest.u32()?,
            };
            value = value.wrapping_add(difference);
            output.push(value);
        }
        Ok(output)
    }
}

/// Bytes that `count` coded 32-bit integers take before packing: where all
/// differences are the common one, and where none fits in fewer than four bytes.
pub(super) fn encoded_sizes(count: u64) -> (u64, u64) {
    let least = 4 + count.div_ceil(4);
    (least, least + 4 * count)
}
