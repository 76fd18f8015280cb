//! A ZIP archive of stored (uncompressed) entries whose contents may be in place
//! before their headers.
//!
//! Why not the `zip` crate: contents grow in spools, many of them side by side in the
//! archive itself. Every local header has room for 64-bit sizes, as NumPy's own have;
//! the central directory uses 64-bit records only where needed. Dates are those of the
//! format's epoch, so archives do not depend on the clock.
//!
//! Source: PKWARE APPNOTE 6.3.10, sections 4.3 and 4.5.3.

use crate::AtomicFile;
use crate::spool::Spool;
use crc32fast::Hasher;
use std::fs::File;
use std::io::{self, Write};
use std::sync::Arc;

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

/// See the module.
#[derive(Debug)]
pub(crate) struct StoredZip {
    out: AtomicFile,
    /// The same file, for spools.
    handle: Arc<File>,
    at: u64,
    entries: Vec<Entry>,
}

impl StoredZip {
    pub(crate) fn new(out: AtomicFile) -> io::Result<Self> {
        Ok(Self {
            handle: out.handle()?,
            out,
            at: 0,
            entries: Vec::new(),
        })
    }

    /// The archive's file, for spools to grow in.
    pub(crate) fn handle(&self) -> &Arc<File> {
        &self.handle
    }

    /// Where the next entry starts.
    pub(crate) fn end(&self) -> u64 {
        self.at
    }

    /// Bytes before the contents of an entry called `name`.
    pub(crate) fn head_bytes(name: &str) -> u64 {
        LOCAL_HEADER_BYTES + name.len() as u64
    }

    fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.out.write_all(bytes)?;
        self.at += bytes.len() as u64;
        Ok(())
    }

    /// Adds an entry of `start`, then all of `rest`, which has a checksum. Spools
    /// with a place come in the order of their places.
    pub(crate) fn add(&mut self, name: &str, start: &[u8], rest: Spool) -> io::Result<()> {
        let mut hasher = Hasher::new();
        hasher.update(start);
        if let Some(checksum) = rest.checksum() {
            hasher.combine(checksum);
        }
        let bytes = rest.bytes();
        self.begin(name, start, bytes, hasher)?;
        rest.settle(&mut self.out, self.at)?;
        self.at += bytes;
        Ok(())
    }

    /// Adds an entry of `bytes`.
    pub(crate) fn add_bytes(&mut self, name: &str, bytes: &[u8]) -> io::Result<()> {
        let mut hasher = Hasher::new();
        hasher.update(bytes);
        self.begin(name, bytes, 0, hasher)
    }

    /// Starts an entry of `start` and `more` bytes that will follow; `hasher` has
    /// the checksum of them all.
    fn begin(&mut self, name: &str, start: &[u8], more: u64, hasher: Hasher) -> io::Result<()> {
        let entry = Entry {
            name: name.into(),
            offset: self.at,
            size: start.len() as u64 + more,
            crc: hasher.finalize(),
        };
        self.put(&local_header(&entry))?;
        self.entries.push(entry);
        self.put(start)
    }

    /// Writes the directory and hands the file back.
    pub(crate) fn finish(mut self) -> io::Result<AtomicFile> {
        let directory: Vec<u8> = self.entries.iter().flat_map(directory_record).collect();
        let end = end_records(self.entries.len() as u64, directory.len() as u64, self.at);
        self.put(&directory)?;
        self.put(&end)?;
        self.out.end_at(self.at)?;
        Ok(self.out)
    }
}

/// Version needed, flags, method (stored), date and checksum: alike in both headers.
fn common_fields(entry: &Entry) -> Vec<u8> {
    let mut out = vec![45, 0, 0, 0, 0, 0];
    out.extend(EPOCH);
    out.extend(entry.crc.to_le_bytes());
    out
}

/// Bytes of a local header but for the name.
const LOCAL_HEADER_BYTES: u64 = 50;

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
    fn a_local_header_is_as_long_as_was_reserved() {
        let entry = Entry {
            name: "points.npy".into(),
            offset: 5,
            size: 7,
            crc: 0,
        };
        let bytes = local_header(&entry).len() as u64;
        assert_eq!(bytes, StoredZip::head_bytes(&entry.name));
    }

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
