//! Roots as a PLY point cloud, binary little-endian: one vertex a strand, its first.
//!
//! Source: Greg Turk, "The PLY Polygon File Format" (1994).
//!
//! | property | type | |
//! |---|---|---|
//! | `x y z` | float | position |
//! | `nx ny nz` | float | unit normal |
//! | `s t` | float | texture coordinates, origin lower left |
//! | `hair_id` | double | index of the hair; PLY has no wider integer than 32 bits |
//! | `triangle` | uint | triangle of the surface |
//! | `b0 b1 b2` | float | weights of the triangle's corners |
//! | `group` | uint | interpolation group |
//! | `rest_x rest_y rest_z` | float | position on the surface at rest |
//!
//! The number of vertices stands in the header before the vertices, and is only known
//! after them: a comment beside it keeps room for its digits.

use crate::AtomicFile;
use crate::drawable::{checked, refused};
use crate::file_sink::{Stream, file_sink};
use crate::write::WriteOptions;
use pelage_strands::{StrandBuffer, StreamInfo};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::Path;

file_sink! {
    /// Writes the roots of strands as a point cloud (`.ply`, binary): `x y z`, `nx ny nz`,
    /// `s t`, `hair_id`, `triangle`, `b0 b1 b2`, `group` and `rest_x rest_y rest_z` of
    /// each strand's first vertex. Strands must have all of these attributes; a stream
    /// has one frame.
    PlyRootsWriter, PlyPoints
}

/// Name and type of each property, in the order of [`row`]'s bytes.
const PROPERTIES: [(&str, &str); 17] = [
    ("float", "x"),
    ("float", "y"),
    ("float", "z"),
    ("float", "nx"),
    ("float", "ny"),
    ("float", "nz"),
    ("float", "s"),
    ("float", "t"),
    ("double", "hair_id"),
    ("uint", "triangle"),
    ("float", "b0"),
    ("float", "b1"),
    ("float", "b2"),
    ("uint", "group"),
    ("float", "rest_x"),
    ("float", "rest_y"),
    ("float", "rest_z"),
];

/// Bytes of a vertex: sixteen words and a double.
const ROW_BYTES: usize = 16 * 4 + 8;

/// Digits of the largest number of vertices.
const MOST_DIGITS: usize = 20;

/// Integers up to this one are exact as doubles.
const LARGEST_EXACT: u64 = 1 << 53;

#[derive(Debug)]
struct PlyPoints {
    file: AtomicFile,
    tool: String,
    points: u64,
    /// Frames begun, and whether one is open.
    frames: usize,
    open: bool,
    rows: Vec<u8>,
}

impl Stream for PlyPoints {
    fn begin(path: &Path, options: &WriteOptions, info: &StreamInfo) -> io::Result<Self> {
        if info.frames.len() > 1 {
            return Err(refused("a PLY file holds one frame; ask for a single one"));
        }
        let tool: String = options.tool.chars().filter(|c| !c.is_control()).collect();
        let mut file = AtomicFile::create(path)?;
        file.write_all(header(0, &tool).as_bytes())?;
        Ok(Self {
            file,
            tool,
            points: 0,
            frames: 0,
            open: false,
            rows: Vec::new(),
        })
    }

    fn begin_frame(&mut self) -> io::Result<()> {
        if self.frames > 0 {
            return Err(refused("only 1 frame was announced"));
        }
        self.frames = 1;
        self.open = true;
        Ok(())
    }

    fn write(&mut self, strands: &StrandBuffer) -> io::Result<()> {
        if !self.open {
            return Err(refused("strands came outside a frame"));
        }
        check_complete(checked(strands)?)?;
        self.rows.clear();
        self.rows.reserve(strands.len() * ROW_BYTES);
        for strand in 0..strands.len() {
            // A strand of no vertices has no root either.
            if strands.vertex_count(strand) > 0 {
                self.rows.extend_from_slice(&row(strands, strand)?);
            }
        }
        self.points += (self.rows.len() / ROW_BYTES) as u64;
        self.file.write_all(&self.rows)
    }

    fn end_frame(&mut self) -> io::Result<()> {
        match std::mem::take(&mut self.open) {
            true => Ok(()),
            false => Err(refused("a frame ended that had not begun")),
        }
    }

    fn finish(mut self) -> io::Result<()> {
        if self.open || self.frames == 0 {
            return Err(refused("the stream ended before its frame did"));
        }
        self.file.seek(SeekFrom::Start(0))?;
        self.file
            .write_all(header(self.points, &self.tool).as_bytes())?;
        self.file.commit()
    }
}

/// The header of `points` vertices, of the same length for any number.
fn header(points: u64, tool: &str) -> String {
    let digits = points.to_string();
    let room = "-".repeat(MOST_DIGITS - digits.len());
    let by = if tool.is_empty() { "" } else { " by " };
    let mut header = format!(
        "ply\nformat binary_little_endian 1.0\ncomment roots of hairs{by}{tool}\n\
         comment -{room}\nelement vertex {digits}\n"
    );
    for (kind, name) in PROPERTIES {
        header += &format!("property {kind} {name}\n");
    }
    header + "end_header\n"
}

/// Refuses strands that lack what every vertex of the file has.
fn check_complete(strands: &StrandBuffer) -> io::Result<()> {
    let lengths = [
        ("normals", strands.normals.len()),
        ("root_uv", strands.root_uv.len()),
        ("hair_id", strands.hair_id.len()),
        ("triangle", strands.triangle.len()),
        ("barycentric", strands.barycentric.len()),
        ("group", strands.group.len()),
        ("root_rest", strands.root_rest.len()),
    ];
    match lengths.iter().find(|(_, found)| *found == 0) {
        Some((name, _)) if !strands.points.is_empty() => {
            Err(refused(format!("the strands have no {name}")))
        }
        _ => Ok(()),
    }
}

fn row(strands: &StrandBuffer, strand: usize) -> io::Result<[u8; ROW_BYTES]> {
    let hair = strands.hair_id[strand];
    if hair > LARGEST_EXACT {
        return Err(refused(format!(
            "hair {hair} is past {LARGEST_EXACT}, the last that a double tells apart; write .npz"
        )));
    }
    let first = strands.offsets[strand] as usize;
    let mut row = [0; ROW_BYTES];
    let mut at = 0;
    let mut put = |bytes: &[u8]| {
        row[at..at + bytes.len()].copy_from_slice(bytes);
        at += bytes.len();
    };
    put(bytemuck::bytes_of(&strands.points[first]));
    put(bytemuck::bytes_of(&strands.normals[first]));
    put(bytemuck::bytes_of(&strands.root_uv[strand]));
    put(&(hair as f64).to_le_bytes());
    put(&strands.triangle[strand].to_le_bytes());
    put(bytemuck::bytes_of(&strands.barycentric[strand]));
    put(&strands.group[strand].to_le_bytes());
    put(bytemuck::bytes_of(&strands.root_rest[strand]));
    Ok(row)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_are_of_one_size_whatever_the_count() {
        let short = header(0, "x").len();
        assert_eq!(header(1_000_000, "x").len(), short);
        assert_eq!(header(u64::MAX, "x").len(), short);
    }
}
