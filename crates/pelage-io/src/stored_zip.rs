//! A ZIP archive of stored (uncompressed) entries whose start is written last.
//!
//! Why not the `zip` crate: entries stream in before their size, checksum or even
//! their first bytes are known. Every local header has room for 64-bit sizes, as
//! NumPy's own have; the central directory uses 64-bit records only where needed.
//! Dates are those of the format's epoch, so archives do not depend on the clock.
//!
//! Source: PKWARE APPNOTE 6.3.10, sections 4.3 and 4.5.3.

use crate::AtomicFile;
use crate::spool::pour;
use crc32fast::Hasher;
use std::io::{self, Read, Seek, SeekFrom, Write};

/// 1980-01-01, 00:00: the epoch of the format's dates, as date and time.
const EPOCH: [u8; 4] = [0, 0, 0x21, 0];
/// Fields of 32 bits with this value are found in the 64-bit record instead.
const IN_64: u32 = u32::MAX;

#[derive(Debug)]
struct Entry {
    name: String,
    /// Where its local header starts.
    offset: u64,
    /// Bytes of its contents.
    size: u64,
    crc: u32,
}

/// The entry being written.
#[derive(Debug)]
struct Open {
    entry: Entry,
    /// Where its contents start.
    start: u64,
    /// Bytes at the start that [`StoredZip::end`] fills in.
    reserved: usize,
    /// Checksum of what follows them.
    hasher: Hasher,
}

/// See the module.
#[derive(Debug)]
pub(crate) struct StoredZip {
    out: AtomicFile,
    at: u64,
    open: Option<Open>,
    entries: Vec<Entry>,
}

impl StoredZip {
    pub(crate) fn new(out: AtomicFile) -> Self {
        Self {
            out,
            at: 0,
            open: None,
            entries: Vec::new(),
        }
    }

    /// Starts an entry and leaves `reserved` bytes at its start for later.
    pub(crate) fn begin(&mut self, name: &str, reserved: usize) -> io::Result<()> {
        let entry = Entry {
            name: name.into(),
            offset: self.at,
            size: 0,
            crc: 0,
        };
        self.raw(&local_header(&entry))?;
        self.open = Some(Open {
            entry,
            start: self.at,
            reserved,
            hasher: Hasher::new(),
        });
        self.raw(&vec![0; reserved])
    }

    fn raw(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.out.write_all(bytes)?;
        self.at += bytes.len() as u64;
        Ok(())
    }

    /// Adds bytes to the entry.
    pub(crate) fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        if let Some(open) = &mut self.open {
            open.hasher.update(bytes);
        }
        self.raw(bytes)
    }

    /// Adds the next `bytes` bytes of `from` to the entry.
    pub(crate) fn put_from(&mut self, from: &mut impl Read, bytes: u64) -> io::Result<()> {
        pour(from, bytes, &mut EntryBytes(self))
    }

    /// Ends the entry, and fills in its `start`, of the length that was reserved.
    pub(crate) fn end(&mut self, start: &[u8]) -> io::Result<()> {
        let Some(open) = self.open.take() else {
            return Ok(());
        };
        debug_assert_eq!(start.len(), open.reserved);
        let mut hasher = Hasher::new();
        hasher.update(start);
        hasher.combine(&open.hasher);
        let entry = Entry {
            size: self.at - open.start,
            crc: hasher.finalize(),
            ..open.entry
        };
        self.out.seek(SeekFrom::Start(entry.offset))?;
        self.out.write_all(&local_header(&entry))?;
        self.out.write_all(start)?;
        self.out.seek(SeekFrom::Start(self.at))?;
        self.entries.push(entry);
        Ok(())
    }

    /// Writes the directory and hands the file back.
    pub(crate) fn finish(mut self) -> io::Result<AtomicFile> {
        let directory: Vec<u8> = self.entries.iter().flat_map(directory_record).collect();
        let end = end_records(self.entries.len() as u64, directory.len() as u64, self.at);
        self.raw(&directory)?;
        self.raw(&end)?;
        Ok(self.out)
    }
}

struct EntryBytes<'a>(&'a mut StoredZip);

impl Write for EntryBytes<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.put(bytes)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Version needed, flags, method (stored), date and checksum: alike in both headers.
fn common_fields(entry: &Entry) -> Vec<u8> {
    let mut out = vec![45, 0, 0, 0, 0, 0];
    out.extend(EPOCH);
    out.extend(entry.crc.to_le_bytes());
    out
}

fn local_header(entry: &Entry) -> Vec<u8> {
    let mut out = b"PK\x03\x04".to_vec();
    out.extend(common_fields(entry));
    out.extend(IN_64.to_le_bytes().repeat(2));
    out.extend((entry.name.len() as u16).to_le_bytes());
    out.extend(20u16.to_le_bytes());
    out.extend(entry.name.as_bytes());
    out.extend(extra_64(&[entry.size, entry.size]));
    out
}

/// The 64-bit record of a header.
fn extra_64(values: &[u64]) -> Vec<u8> {
    let mut out = vec![1, 0];
    out.extend((8 * values.len() as u16).to_le_bytes());
    values.iter().for_each(|v| out.extend(v.to_le_bytes()));
    out
}

/// `value` for a field of 32 bits; what does not fit goes to `large` in order.
fn narrow(value: u64, large: &mut Vec<u64>) -> [u8; 4] {
    match u32::try_from(value) {
        Ok(small) if small != IN_64 => small.to_le_bytes(),
        _ => {
            large.push(value);
            IN_64.to_le_bytes()
        }
    }
}

fn directory_record(entry: &Entry) -> Vec<u8> {
    let mut large = Vec::new();
    let sizes = [
        narrow(entry.size, &mut large),
        narrow(entry.size, &mut large),
    ];
    let offset = narrow(entry.offset, &mut large);
    let extra = if large.is_empty() {
        Vec::new()
    } else {
        extra_64(&large)
    };
    let mut out = b"PK\x01\x02".to_vec();
    out.extend([45, 0]);
    out.extend(common_fields(entry));
    out.extend(sizes.concat());
    out.extend((entry.name.len() as u16).to_le_bytes());
    out.extend((extra.len() as u16).to_le_bytes());
    // No comment, first disk, no attributes.
    out.extend([0; 10]);
    out.extend(offset);
    out.extend(entry.name.as_bytes());
    out.extend(extra);
    out
}

/// What ends an archive whose directory has `entries` records in `size` bytes at
/// `offset`.
fn end_records(entries: u64, size: u64, offset: u64) -> Vec<u8> {
    let mut large = Vec::new();
    let narrowed = [narrow(size, &mut large), narrow(offset, &mut large)].concat();
    let mut out = Vec::new();
    if !large.is_empty() {
        out.extend(b"PK\x06\x06");
        out.extend(44u64.to_le_bytes());
        out.extend([45, 0, 45, 0]);
        out.extend([0; 8]);
        for value in [entries, entries, size, offset] {
            out.extend(value.to_le_bytes());
        }
        // The locator: where the record above starts, on the only disk.
        out.extend(b"PK\x06\x07");
        out.extend([0; 4]);
        out.extend((offset + size).to_le_bytes());
        out.extend([1, 0, 0, 0]);
    }
    out.extend(b"PK\x05\x06");
    out.extend([0; 4]);
    out.extend((entries as u16).to_le_bytes().repeat(2));
    out.extend(narrowed);
    out.extend([0, 0]);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_passes_4_gb_is_written_in_64_bits() {
        let mut entry = Entry {
            name: "a".into(),
            offset: 5,
            size: 7,
            crc: 0,
        };
        assert_eq!(directory_record(&entry).len(), 46 + 1);
        entry.offset = 1 << 32;
        let record = directory_record(&entry);
        assert_eq!(record.len(), 46 + 1 + 12);
        assert_eq!(record[47..51], [1, 0, 8, 0]);
        entry.size = u64::from(u32::MAX);
        assert_eq!(directory_record(&entry).len(), 46 + 1 + 28);
        assert_eq!(end_records(2, 100, 1000).len(), 22);
        assert_eq!(end_records(2, 100, 1 << 33).len(), 22 + 56 + 20);
    }
}
