//! Cem Yuksel's `.hair` files.
//!
//! Source: `cyHairFile.h` (MIT). A header of 128 bytes, then arrays without
//! padding, little-endian, each only if its bit is set: segments, points,
//! thickness, transparency, colours. There is no root UV, identity or normal.
//!
//! Limits: numbers are taken as they are; NaN and negative widths are left for
//! [`pelage_strands::validate`], which names the curve.

use crate::source::read_bytes;
use crate::{AttributeInfo, Blame, CurveFile, CurveSet, ReadError};
use pelage_strands::StrandBuffer;
use std::path::Path;

/// All strands of the `.hair` file `path`, as one set of polylines.
///
/// Widths are the file's thickness, opacities one minus its transparency; both,
/// and colours, come from the header where the file has no array of them.
pub fn read_hair(path: &Path) -> Result<CurveFile, ReadError> {
    parse_hair(&read_bytes(path)?, path)
}

/// Like [`read_hair`], of `bytes`; `path` only names them in errors.
pub fn parse_hair(bytes: &[u8], path: &Path) -> Result<CurveFile, ReadError> {
    let header = Header::parse(bytes, path)?;
    let arrays = header.arrays(bytes, path)?;
    let mut curves = StrandBuffer::new();
    curves.offsets = header.offsets(arrays.segments, path)?;
    let points = header.point_count as usize;
    curves.points = triples(arrays.points);
    curves.widths = match arrays.thickness {
        Some(array) => floats(array).collect(),
        None => vec![header.thickness; points],
    };
    curves.opacities = match arrays.transparency {
        Some(array) => floats(array).map(|t| 1.0 - t).collect(),
        None => vec![1.0 - header.transparency; points],
    };
    curves.colors = match arrays.colors {
        Some(array) => triples(array),
        None => vec![header.color; points],
    };
    let mut set = CurveSet::through_vertices("hair", curves);
    set.attributes = header.attributes();
    Ok(CurveFile {
        sets: vec![set],
        ..CurveFile::default()
    })
}

const HEADER_BYTES: usize = 128;

/// Bits of the header's `arrays` field.
const SEGMENTS: u32 = 1;
const POINTS: u32 = 2;
const THICKNESS: u32 = 4;
const TRANSPARENCY: u32 = 8;
const COLORS: u32 = 16;

/// Name, bit, bytes an entry, and domain of each array, in file order.
const LAYOUT: [(&str, u32, u64, &str); 5] = [
    ("segments", SEGMENTS, 2, "strand"),
    ("points", POINTS, 12, "point"),
    ("thickness", THICKNESS, 4, "point"),
    ("transparency", TRANSPARENCY, 4, "point"),
    ("colors", COLORS, 12, "point"),
];

struct Header {
    hair_count: u32,
    point_count: u32,
    arrays: u32,
    segments: u32,
    thickness: f32,
    transparency: f32,
    color: [f32; 3],
}

/// The bytes of each array that the file has.
#[derive(Default)]
struct Arrays<'a> {
    segments: Option<&'a [u8]>,
    points: &'a [u8],
    thickness: Option<&'a [u8]>,
    transparency: Option<&'a [u8]>,
    colors: Option<&'a [u8]>,
}

impl Header {
    fn parse(bytes: &[u8], path: &Path) -> Result<Self, ReadError> {
        if !bytes.starts_with(b"HAIR") {
            return Err(
                ReadError::file(path, "not a .hair file: it must start with HAIR").at("byte 0"),
            );
        }
        if bytes.len() < HEADER_BYTES {
            let message = format!(
                "{} bytes; the header alone takes {HEADER_BYTES}",
                bytes.len()
            );
            return Err(ReadError::file(path, message));
        }
        let u32_at = |at: usize| {
            u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
        };
        let f32_at = |at| f32::from_bits(u32_at(at));
        Ok(Self {
            hair_count: u32_at(4),
            point_count: u32_at(8),
            arrays: u32_at(12),
            segments: u32_at(16),
            thickness: f32_at(20),
            transparency: f32_at(24),
            color: [f32_at(28), f32_at(32), f32_at(36)],
        })
    }

    fn has(&self, bit: u32) -> bool {
        self.arrays & bit != 0
    }

    /// Entries of an array that covers `domain`.
    fn count(&self, domain: &str) -> u32 {
        match domain {
            "strand" => self.hair_count,
            _ => self.point_count,
        }
    }

    /// Cuts the file into its arrays, before anything is allocated for them.
    fn arrays<'a>(&self, bytes: &'a [u8], path: &Path) -> Result<Arrays<'a>, ReadError> {
        if !self.has(POINTS) {
            return Err(
                ReadError::file(path, "the file has no points (bit 2 of `arrays`)").at("byte 12"),
            );
        }
        let mut arrays = Arrays::default();
        let mut at = HEADER_BYTES;
        for (name, bit, entry, domain) in LAYOUT {
            if !self.has(bit) {
                continue;
            }
            let count = self.count(domain);
            let needed = u64::from(count) * entry;
            let left = bytes.len() - at;
            if needed > left as u64 {
                let message =
                    format!("{count} {name} take {needed} bytes, but only {left} are left");
                return Err(ReadError::new(path, Blame::Limit, message).at(format!("byte {at}")));
            }
            let array = &bytes[at..at + needed as usize];
            at += array.len();
            match bit {
                SEGMENTS => arrays.segments = Some(array),
                POINTS => arrays.points = array,
                THICKNESS => arrays.thickness = Some(array),
                TRANSPARENCY => arrays.transparency = Some(array),
                _ => arrays.colors = Some(array),
            }
        }
        Ok(arrays)
    }

    /// Where each strand's points start, once the counts are known to agree.
    fn offsets(&self, segments: Option<&[u8]>, path: &Path) -> Result<Vec<u32>, ReadError> {
        let points = u64::from(self.point_count);
        let sum = match segments {
            Some(array) => shorts(array).map(|s| u64::from(s) + 1).sum(),
            None => u64::from(self.hair_count) * (u64::from(self.segments) + 1),
        };
        if sum != points {
            let message = format!(
                "the segments of {} hairs ask for {sum} points; the header counts {points}",
                self.hair_count
            );
            return Err(ReadError::file(path, message).at("byte 8"));
        }
        // The sum is `point_count`, a u32, so no partial sum overflows.
        let mut offsets = vec![0];
        let mut end = 0;
        match segments {
            Some(array) => offsets.extend(shorts(array).map(|s| {
                end += u32::from(s) + 1;
                end
            })),
            None => offsets.extend((0..self.hair_count).map(|_| {
                end += self.segments + 1;
                end
            })),
        }
        Ok(offsets)
    }

    fn attributes(&self) -> Vec<AttributeInfo> {
        let kinds = ["unsigned short", "float[3]", "float", "float", "float[3]"];
        let info = |((name, bit, _, domain), kind): ((&str, u32, u64, &str), &str)| {
            let (domain, count) = match self.has(bit) {
                true => (domain, self.count(domain) as usize),
                false => ("constant", 1),
            };
            AttributeInfo {
                name: name.into(),
                kind: kind.into(),
                domain: domain.into(),
                count,
            }
        };
        LAYOUT.into_iter().zip(kinds).map(info).collect()
    }
}

fn shorts(array: &[u8]) -> impl Iterator<Item = u16> {
    array
        .as_chunks::<2>()
        .0
        .iter()
        .map(|&b| u16::from_le_bytes(b))
}

fn floats(array: &[u8]) -> impl Iterator<Item = f32> {
    array
        .as_chunks::<4>()
        .0
        .iter()
        .map(|&b| f32::from_le_bytes(b))
}

fn triples(array: &[u8]) -> Vec<[f32; 3]> {
    let (entries, _) = array.as_chunks::<12>();
    let triple = |entry: &[u8; 12]| {
        let number =
            |i: usize| f32::from_le_bytes([entry[i], entry[i + 1], entry[i + 2], entry[i + 3]]);
        [number(0), number(4), number(8)]
    };
    entries.iter().map(triple).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header(hairs: u32, points: u32, arrays: u32) -> Vec<u8> {
        let mut bytes = b"HAIR".to_vec();
        for number in [hairs, points, arrays, 2] {
            bytes.extend(number.to_le_bytes());
        }
        for number in [0.5f32, 0.25, 0.1, 0.2, 0.3] {
            bytes.extend(number.to_le_bytes());
        }
        bytes.resize(HEADER_BYTES, 0);
        bytes
    }

    fn push(bytes: &mut Vec<u8>, numbers: impl IntoIterator<Item = f32>) {
        bytes.extend(numbers.into_iter().flat_map(f32::to_le_bytes));
    }

    fn parse(bytes: &[u8]) -> Result<CurveFile, ReadError> {
        parse_hair(bytes, Path::new("a.hair"))
    }

    #[test]
    fn all_arrays_are_read_in_order() {
        let mut bytes = header(2, 5, 31);
        bytes.extend([1, 0, 2, 0]);
        push(&mut bytes, (0..15).map(|i| i as f32));
        push(&mut bytes, (0..5).map(|i| i as f32));
        push(&mut bytes, [0.0, 0.25, 0.5, 0.75, 1.0]);
        push(&mut bytes, (0..15).map(|i| i as f32 / 15.0));
        let set = &parse(&bytes).unwrap().sets[0];
        assert_eq!(set.curves.offsets, [0, 2, 5]);
        assert_eq!(set.curves.points[4], [12.0, 13.0, 14.0]);
        assert_eq!(set.curves.widths, [0.0, 1.0, 2.0, 3.0, 4.0]);
        assert_eq!(set.curves.opacities, [1.0, 0.75, 0.5, 0.25, 0.0]);
        assert_eq!(set.curves.colors[1][0], 0.2);
        assert_eq!(set.attributes[2].domain, "point");
    }

    #[test]
    fn what_the_file_lacks_comes_from_its_header() {
        let mut bytes = header(1, 3, POINTS);
        push(&mut bytes, (0..9).map(|i| i as f32));
        let set = &parse(&bytes).unwrap().sets[0];
        assert_eq!(set.curves.offsets, [0, 3]);
        assert_eq!(set.curves.widths, [0.5; 3]);
        assert_eq!(set.curves.opacities, [0.75; 3]);
        assert_eq!(set.curves.colors, [[0.1, 0.2, 0.3]; 3]);
    }

    #[test]
    fn counts_that_disagree_or_do_not_fit_are_refused() {
        let mut bytes = header(1, 4, POINTS);
        push(&mut bytes, [0.0; 12]);
        let error = parse(&bytes).unwrap_err();
        assert!(error.to_string().contains("ask for 3 points"), "{error}");
        let error = parse(&header(u32::MAX, u32::MAX, 31)).unwrap_err();
        assert_eq!(error.blame, Blame::Limit);
        assert!(parse(&header(u32::MAX, 3, POINTS)).is_err());
        assert!(parse(&header(0, 0, SEGMENTS)).is_err());
        assert!(parse(b"HAIR").is_err());
        assert!(parse(b"").is_err());
    }
}
