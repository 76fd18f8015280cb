//! Wavefront OBJ: polygons and polylines.
//!
//! Source: the "Object Files (.obj)" appendix of Wavefront's Advanced Visualizer
//! manual. Read are `v`, `vt`, `vn`, `f`, `l` and the first `o`; other statements
//! (materials, groups, free-form curves) are skipped.
//!
//! Why not `tobj`: its errors carry no line; a negative index that points before
//! the file's start overflows, a zero index means "missing", a corner without uv
//! borrows its neighbour's; `l` with three or more vertices comes out as a face;
//! and vertices are renumbered object by object, so that paint and guides that
//! name them by number are lost.
//!
//! Limits: a vertex named before its own statement is accepted, as most programs
//! do. Colours and weights behind a position are dropped.

use crate::source::read_bytes;
use crate::{AttributeInfo, Blame, CurveFile, CurveSet, ReadError};
use pelage_strands::StrandBuffer;
use pelage_surface::PolygonMesh;
use std::borrow::Cow;
use std::path::Path;

/// All faces of the OBJ file `path`; objects and groups become one mesh.
///
/// Vertices keep the file's order and number. Texture coordinates, and likewise
/// normals, are kept only where every corner of every face names one: half an
/// attribute is none.
pub fn read_obj_mesh(path: &Path) -> Result<PolygonMesh, ReadError> {
    parse_obj_mesh(&read_bytes(path)?, path)
}

/// Like [`read_obj_mesh`], of `bytes`; `path` only names them in errors.
pub fn parse_obj_mesh(bytes: &[u8], path: &Path) -> Result<PolygonMesh, ReadError> {
    let obj = Obj::parse(bytes, path)?;
    if obj.face_sizes.is_empty() {
        let error = ReadError::file(path, "there is no face (`f`) in this file");
        return Err(match obj.line_ends.len() {
            0 => error,
            n => error.help(format!("its {n} polylines can be read as curves")),
        });
    }
    Ok(obj.into_mesh())
}

/// All polylines (`l`) of the OBJ file `path`, as one set.
///
/// A line of two vertices that starts where the line before it ended continues
/// that line: some programs write a polyline segment by segment. Where the first
/// vertex of every polyline has texture coordinates, they are the root's.
pub fn read_obj_curves(path: &Path) -> Result<CurveFile, ReadError> {
    parse_obj_curves(&read_bytes(path)?, path)
}

/// Like [`read_obj_curves`], of `bytes`; `path` only names them in errors.
pub fn parse_obj_curves(bytes: &[u8], path: &Path) -> Result<CurveFile, ReadError> {
    let obj = Obj::parse(bytes, path)?;
    if obj.line_ends.is_empty() {
        let error = ReadError::file(path, "there is no polyline (`l`) in this file");
        return Err(match obj.face_sizes.len() {
            0 => error,
            n => error.help(format!("its {n} faces can be read as a mesh")),
        });
    }
    Ok(CurveFile {
        sets: vec![obj.into_curves()],
        ..CurveFile::default()
    })
}

/// Stands for an index that a corner does not give.
const ABSENT: u32 = u32::MAX;

/// Vertex, texture coordinates and normal of a corner, counted from 0.
#[derive(Clone, Copy)]
struct Corner {
    vertex: u32,
    uv: u32,
    normal: u32,
}

/// Which list an index points into.
#[derive(Clone, Copy)]
enum List {
    Positions,
    Uvs,
    Normals,
}

impl List {
    const NAMES: [&str; 3] = ["vertex", "texture coordinate", "normal"];
}

/// The statements of a file, still in the file's own indices.
#[derive(Default)]
struct Obj {
    name: Option<String>,
    positions: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    normals: Vec<[f32; 3]>,
    face_sizes: Vec<u32>,
    face_corners: Vec<Corner>,
    /// End of each polyline in `line_corners`.
    line_ends: Vec<usize>,
    line_corners: Vec<Corner>,
    /// For each list, the highest index named before it was there, and its line.
    ahead: [Option<(u32, usize)>; 3],
}

/// A complaint about one line, still without the file.
type LineResult<T> = Result<T, String>;

impl Obj {
    fn parse(bytes: &[u8], path: &Path) -> Result<Self, ReadError> {
        let mut obj = Self::default();
        for (line, text) in logical_lines(bytes) {
            obj.statement(line, &text)
                .map_err(|message| ReadError::file(path, message).at(format!("line {line}")))?;
        }
        obj.check_indices_ahead(path)?;
        let lists = [obj.positions.len(), obj.uvs.len(), obj.normals.len()];
        let longest = lists.into_iter().max().max(Some(obj.line_corners.len()));
        if longest >= Some(ABSENT as usize) {
            let message = format!("a list has more than {} entries", ABSENT - 1);
            return Err(ReadError::new(path, Blame::Limit, message));
        }
        Ok(obj)
    }

    fn statement(&mut self, line: usize, text: &str) -> LineResult<()> {
        let text = text.split('#').next().unwrap_or("");
        let mut words = text.split_ascii_whitespace();
        match words.next() {
            Some("v") => self.positions.push(numbers(words, "v", 3)?),
            Some("vt") => self.uvs.push(numbers(words, "vt", 1)?),
            Some("vn") => self.normals.push(numbers(words, "vn", 3)?),
            Some("f") => self.face(line, words)?,
            Some("l") => self.polyline(line, words)?,
            Some("o") if self.name.is_none() => {
                self.name = Some(words.collect::<Vec<_>>().join(" "));
            }
            _ => {}
        }
        Ok(())
    }

    fn face<'a>(&mut self, line: usize, words: impl Iterator<Item = &'a str>) -> LineResult<()> {
        let before = self.face_corners.len();
        for word in words {
            let corner = self.corner(line, word)?;
            self.face_corners.push(corner);
        }
        let size = self.face_corners.len() - before;
        if size < 3 {
            return Err(format!("a face of {size} corners; it needs at least 3"));
        }
        self.face_sizes
            .push(u32::try_from(size).map_err(|_| "a face of too many corners")?);
        Ok(())
    }

    fn polyline<'a>(
        &mut self,
        line: usize,
        words: impl Iterator<Item = &'a str>,
    ) -> LineResult<()> {
        let before = self.line_corners.len();
        for word in words {
            let corner = self.corner(line, word)?;
            self.line_corners.push(corner);
        }
        let added = &self.line_corners[before..];
        if added.len() < 2 {
            let size = added.len();
            return Err(format!(
                "a polyline of {size} vertices; it needs at least 2"
            ));
        }
        let continues = added.len() == 2
            && before > 0
            && self.line_corners[before - 1].vertex == added[0].vertex;
        if continues {
            self.line_corners.remove(before);
            self.line_ends.pop();
        }
        self.line_ends.push(self.line_corners.len());
        Ok(())
    }

    /// Reads `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    fn corner(&mut self, line: usize, word: &str) -> LineResult<Corner> {
        let mut parts = word.split('/');
        let vertex = parts.next().unwrap_or("");
        let uv = parts.next().unwrap_or("");
        let normal = parts.next().unwrap_or("");
        if parts.next().is_some() {
            return Err(format!("{}: expected v/vt/vn", quote(word)));
        }
        let mut optional = |list, part: &str| match part {
            "" => Ok(ABSENT),
            part => self.index(line, list, part),
        };
        Ok(Corner {
            uv: optional(List::Uvs, uv)?,
            normal: optional(List::Normals, normal)?,
            vertex: self.index(line, List::Positions, vertex)?,
        })
    }

    /// Resolves an index: from 1 upwards, or from -1 (the latest) backwards.
    fn index(&mut self, line: usize, list: List, word: &str) -> LineResult<u32> {
        let name = List::NAMES[list as usize];
        let count = match list {
            List::Positions => self.positions.len(),
            List::Uvs => self.uvs.len(),
            List::Normals => self.normals.len(),
        } as i64;
        let number: i64 = word
            .parse()
            .map_err(|_| format!("{} is no {name} index", quote(word)))?;
        let index = match number {
            0 => return Err(format!("{name} index 0; indices start at 1 (or -1)")),
            1.. => number - 1,
            _ => count.checked_add(number).unwrap_or(-1),
        };
        let index = u32::try_from(index)
            .ok()
            .filter(|&index| index != ABSENT)
            .ok_or_else(|| format!("{name} {number} does not exist; {count} came before"))?;
        if index as i64 >= count {
            let ahead = &mut self.ahead[list as usize];
            if ahead.is_none_or(|(highest, _)| index > highest) {
                *ahead = Some((index, line));
            }
        }
        Ok(index)
    }

    fn check_indices_ahead(&self, path: &Path) -> Result<(), ReadError> {
        let counts = [self.positions.len(), self.uvs.len(), self.normals.len()];
        for ((ahead, count), name) in self.ahead.iter().zip(counts).zip(List::NAMES) {
            if let &Some((index, line)) = ahead
                && index as usize >= count
            {
                let number = u64::from(index) + 1;
                let message = format!("{name} {number} does not exist; the file has {count}");
                return Err(ReadError::file(path, message).at(format!("line {line}")));
            }
        }
        Ok(())
    }

    fn into_mesh(self) -> PolygonMesh {
        let corners = &self.face_corners;
        PolygonMesh {
            corner_vertices: corners.iter().map(|c| c.vertex).collect(),
            corner_uvs: gather(&self.uvs, corners.iter().map(|c| c.uv)),
            corner_normals: gather(&self.normals, corners.iter().map(|c| c.normal)),
            positions: self.positions,
            face_sizes: self.face_sizes,
        }
    }

    fn into_curves(self) -> CurveSet {
        let mut curves = StrandBuffer::new();
        let corners = &self.line_corners;
        curves.points = gather(&self.positions, corners.iter().map(|c| c.vertex));
        // `parse` refused more corners than u32 can count.
        let ends = self.line_ends.iter().map(|&end| end as u32);
        curves.offsets = std::iter::once(0).chain(ends).collect();
        let roots = curves.offsets[..curves.len()].iter();
        curves.root_uv = gather(&self.uvs, roots.map(|&root| corners[root as usize].uv));
        let mut attributes = vec![attribute("v", "float3", "vertex", curves.points.len())];
        if !curves.root_uv.is_empty() {
            attributes.push(attribute("vt", "float2", "uniform", curves.root_uv.len()));
        }
        let name = self.name.filter(|name| !name.is_empty());
        let mut set = CurveSet::through_vertices(name.unwrap_or_else(|| "curves".into()), curves);
        set.attributes = attributes;
        set
    }
}

fn attribute(name: &str, kind: &str, domain: &str, count: usize) -> AttributeInfo {
    AttributeInfo {
        name: name.into(),
        kind: kind.into(),
        domain: domain.into(),
        count,
    }
}

/// `list[index]` for every index, or nothing at all where one is absent.
fn gather<T: Copy>(list: &[T], indices: impl Iterator<Item = u32>) -> Vec<T> {
    indices
        .map(|index| list.get(index as usize).copied())
        .collect::<Option<_>>()
        .unwrap_or_default()
}

/// The first `N` numbers of a statement; those behind `required` may be missing.
fn numbers<'a, const N: usize>(
    mut words: impl Iterator<Item = &'a str>,
    statement: &str,
    required: usize,
) -> LineResult<[f32; N]> {
    let mut values = [0.0_f32; N];
    for (i, value) in values.iter_mut().enumerate() {
        let Some(word) = words.next() else {
            if i < required {
                return Err(format!(
                    "`{statement}` has {i} numbers; it needs {required}"
                ));
            }
            break;
        };
        *value = word
            .parse()
            .map_err(|_| format!("{} is no number", quote(word)))?;
        if !value.is_finite() {
            return Err(format!("{} is not a finite 32-bit number", quote(word)));
        }
    }
    Ok(values)
}

/// `word` in quotes, short enough for a message whatever the file holds.
fn quote(word: &str) -> String {
    let mut short: String = word.chars().take(40).collect();
    if short.len() < word.len() {
        short.push('…');
    }
    format!("{short:?}")
}

/// Lines with their number, from 1; lines that end in `\` joined to the next.
fn logical_lines(bytes: &[u8]) -> impl Iterator<Item = (usize, Cow<'_, str>)> {
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let mut physical = bytes.split(|&byte| byte == b'\n').zip(1..);
    std::iter::from_fn(move || {
        let (first, number) = physical.next()?;
        let Some(start) = without_continuation(first) else {
            return Some((number, String::from_utf8_lossy(first)));
        };
        let mut joined = start.to_vec();
        for (more, _) in physical.by_ref() {
            joined.push(b' ');
            match without_continuation(more) {
                Some(more) => joined.extend_from_slice(more),
                None => {
                    joined.extend_from_slice(more);
                    break;
                }
            }
        }
        Some((number, String::from_utf8_lossy(&joined).into_owned().into()))
    })
}

/// What stands before the `\` at the end of `line`, where there is one.
fn without_continuation(line: &[u8]) -> Option<&[u8]> {
    line.trim_ascii_end().strip_suffix(b"\\")
}

#[cfg(test)]
#[path = "obj_tests.rs"]
mod tests;
