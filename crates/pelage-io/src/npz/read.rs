//! Reads curves from NumPy archives (`.npz`).
//!
//! Arrays, by name: `points` (n × 3) and `counts` (m) are needed; `widths`,
//! `colors` (n × 3), `opacities`, `normals` (n × 3) have one entry a vertex;
//! `hair_id`, `strand_id`, `root_uv` (m × 2), `strand_uv` (m × 2), `group`,
//! `triangle`, `barycentric` (m × 3), `root_rest` (m × 3) one entry a curve. Real
//! numbers are of 32 or 64 bits, integers too, signed or not. `points` and `normals`
//! may have a leading axis of frames, whose times are in `frames`.
//!
//! Archives with the arrays of Super-Helices (`docs/super-helices.md`) are read as the
//! curves that they decode to.

use super::frames;
use crate::layout::Layout;
use crate::source::read_bytes;
use crate::super_helices::{Arrays, SuperHelices, TELLING, Wrong, curve_file};
use crate::{AttributeInfo, CurveFile, CurveSet, ReadError};
use npyz::npz::NpzArchive;
use npyz::{NpyFile, Order};
use pelage_curves::{Basis, Wrap};
use pelage_strands::{Fault, FaultKind, StrandBuffer};
use std::collections::BTreeMap;
use std::io::{Cursor, Read};
use std::panic::catch_unwind;
use std::path::Path;

/// Bytes that the arrays of a file of `size` bytes may unpack to, all together.
fn budget(size: usize) -> u64 {
    (64 << 20) + 64 * size as u64
}

/// Longest header of an array; NumPy's take about 120 bytes.
const MAX_HEADER: usize = 1024;

/// One array of the archive.
pub(super) struct Array {
    pub(super) kind: String,
    pub(super) shape: Vec<u64>,
    pub(super) numbers: Numbers,
}

pub(super) enum Numbers {
    Real(Vec<f32>),
    Double(Vec<f64>),
    Integer(Vec<i64>),
    /// Of a type that no attribute has.
    Other,
}

/// Reads the curves of the archive `path` at `time`: one set of Catmull-Rom curves
/// through their vertices, named after the file.
///
/// Without a time the first frame counts. Between frames points and normals are
/// interpolated, before the first and after the last they hold.
///
/// Fails where `points` or `counts` are missing or not of the form above. Other
/// arrays that do not fit are left out and listed in
/// [`CurveSet::faults`](crate::CurveSet::faults).
pub fn read_npz_curves(path: &Path, time: Option<f64>) -> Result<CurveFile, ReadError> {
    let mut arrays = arrays_of(path)?;
    if arrays.contains_key(TELLING) {
        return Ok(curve_file(path, &of_arrays(path, arrays)?));
    }
    let frames = frames::cut_to(&mut arrays, time).map_err(|m| ReadError::file(path, m))?;
    let name = path.file_stem().map(|n| n.to_string_lossy().into_owned());
    let mut set = assemble(path, name.unwrap_or_default(), arrays)?;
    set.frames = frames;
    Ok(CurveFile {
        sets: vec![set],
        up_axis: None,
        meters_per_unit: None,
    })
}

/// Reads the Super-Helices of the archive `path`.
pub(crate) fn read_super_helices(path: &Path) -> Result<SuperHelices, ReadError> {
    of_arrays(path, arrays_of(path)?)
}

fn of_arrays(path: &Path, arrays: BTreeMap<String, Array>) -> Result<SuperHelices, ReadError> {
    let faults = Vec::new();
    let assembly = Assembly { arrays, faults };
    SuperHelices::of_arrays(&mut Parameters { path, assembly })
}

/// The archive's arrays as those of Super-Helices.
struct Parameters<'a> {
    path: &'a Path,
    assembly: Assembly,
}

impl Parameters<'_> {
    fn taken<T>(&self, name: &str, read: Result<T, String>) -> Result<T, ReadError> {
        read.map_err(|message| match message.is_empty() {
            true => ReadError::file(self.path, format!("it has no array {name}"))
                .help("its arrays are not those of Super-Helices"),
            false => ReadError::file(self.path, message),
        })
    }
}

impl Arrays for Parameters<'_> {
    type Error = ReadError;

    fn counts(&mut self, name: &str) -> Result<Vec<u32>, ReadError> {
        let read = self.assembly.integers(name).and_then(|all| {
            let narrow: Option<Vec<u32>> = all.iter().map(|&n| u32::try_from(n).ok()).collect();
            narrow.ok_or_else(|| format!("{name} has entries that do not fit in 32 bits"))
        });
        self.taken(name, read)
    }

    fn vectors(&mut self, name: &str) -> Result<Vec<[f32; 3]>, ReadError> {
        let read = self.assembly.reals::<3>(name);
        self.taken(name, read)
    }

    fn numbers(&mut self, name: &str) -> Result<Vec<f32>, ReadError> {
        let read = self.assembly.reals::<1>(name);
        Ok(self.taken(name, read)?.into_iter().flatten().collect())
    }

    fn wrong(&self, Wrong { place, message }: Wrong) -> ReadError {
        ReadError::file(self.path, message).at(place)
    }
}

fn arrays_of(path: &Path) -> Result<BTreeMap<String, Array>, ReadError> {
    let bytes = read_bytes(path)?;
    // The archive reader is old and indexes what it reads; sizes are checked here.
    catch_unwind(|| read_arrays(path, &bytes)).unwrap_or_else(|_| {
        let message = "it is no sound zip archive";
        Err(ReadError::file(path, message))
    })
}

fn read_arrays(path: &Path, bytes: &[u8]) -> Result<BTreeMap<String, Array>, ReadError> {
    let broken = |e: std::io::Error| ReadError::file(path, e.to_string());
    let mut archive = NpzArchive::new(Cursor::new(bytes)).map_err(broken)?;
    let names: Vec<String> = archive.array_names().map(String::from).collect();
    let mut left = budget(bytes.len());
    let mut arrays = BTreeMap::new();
    for name in names {
        let file = npyz::npz::file_name_from_array_name(&name);
        let error = |message: String| {
            // Errors of the header's parser draw pictures below their first line.
            let line = message.lines().next().unwrap_or_default();
            ReadError::file(path, line).at(name.clone())
        };
        let entry = archive.zip_archive().by_name(&file);
        let entry = entry.map_err(|e| error(e.to_string()))?;
        let mut contents = Vec::new();
        let mut limited = entry.take(left + 1);
        let size = limited
            .read_to_end(&mut contents)
            .map_err(|e| error(e.to_string()))?;
        left = left.checked_sub(size as u64).ok_or_else(|| {
            error("the arrays unpack to far more than a file of this size can mean".into())
        })?;
        arrays.insert(name.clone(), parse(&contents).map_err(error)?);
    }
    Ok(arrays)
}

/// Parses a `.npy` file (NumPy's `format.py`, versions 1 to 3).
fn parse(bytes: &[u8]) -> Result<Array, String> {
    let start = check_header(bytes)?;
    let file = NpyFile::new(bytes).map_err(|e| e.to_string())?;
    let shape = file.shape().to_vec();
    let kind = file.dtype().descr().trim_matches('\'').to_owned();
    let entries = shape.iter().try_fold(1u64, |n, &k| n.checked_mul(k));
    let size = file.dtype().num_bytes().unwrap_or(0) as u64;
    let expected = entries.and_then(|n| n.checked_mul(size));
    let found = bytes.len() as u64 - start as u64;
    if size == 0 || expected != Some(found) {
        return Err(format!(
            "it claims the shape {shape:?} of {kind}, but has {found} bytes"
        ));
    }
    if file.order() == Order::Fortran && shape.len() > 1 {
        return Err("it is in Fortran order; save np.ascontiguousarray of it".into());
    }
    let numbers = numbers(file).map_err(|e| e.to_string())?;
    Ok(Array {
        kind,
        shape,
        numbers,
    })
}

/// Refuses headers that the parser cannot cope with (it calls itself for every
/// bracket); gives the place where the data starts.
fn check_header(bytes: &[u8]) -> Result<usize, String> {
    if !bytes.starts_with(b"\x93NUMPY") || bytes.len() < 12 {
        return Err("it is no NumPy array".into());
    }
    let (length, start): (usize, usize) = match bytes[6] {
        1 => (u16::from_le_bytes([bytes[8], bytes[9]]) as usize, 10),
        _ => (
            u32::from_le_bytes([bytes[8], bytes[9], bytes[10], bytes[11]]) as usize,
            12,
        ),
    };
    let header = bytes.get(start..start.saturating_add(length));
    let header = header.ok_or_else(|| format!("it ends within its header of {length} bytes"))?;
    let brackets = header.iter().filter(|c| b"([{".contains(c)).count();
    if length > MAX_HEADER || brackets > 16 {
        return Err("its header is not that of an array of numbers".into());
    }
    Ok(start + length)
}

fn numbers(file: NpyFile<&[u8]>) -> std::io::Result<Numbers> {
    let file = match file.try_data::<f32>() {
        Ok(data) => return Ok(Numbers::Real(data.collect::<Result<_, _>>()?)),
        Err(file) => file,
    };
    let file = match file.try_data::<f64>() {
        Ok(data) => return Ok(Numbers::Double(data.collect::<Result<_, _>>()?)),
        Err(file) => file,
    };
    macro_rules! integers { ($file:ident, $($type:ty),*) => { $(
        let $file = match $file.try_data::<$type>() {
            Ok(data) => {
                let wide = data.map(|x| x.map(|x| x as i64));
                return Ok(Numbers::Integer(wide.collect::<Result<_, _>>()?));
            }
            Err(file) => file,
        };
    )* drop($file); } }
    integers!(file, u32, i32, u64, i64);
    Ok(Numbers::Other)
}

/// Takes arrays out of the archive and deals them out to curves.
struct Assembly {
    arrays: BTreeMap<String, Array>,
    faults: Vec<Fault>,
}

fn assemble(
    path: &Path,
    name: String,
    arrays: BTreeMap<String, Array>,
) -> Result<CurveSet, ReadError> {
    let missing = |what: &str| {
        let message = format!("it has no array {what}");
        ReadError::file(path, message).help("points (n × 3) and counts (m) are needed")
    };
    for needed in ["points", "counts"] {
        arrays.get(needed).ok_or_else(|| missing(needed))?;
    }
    let attributes = arrays.iter().map(|(name, array)| describe(name, array));
    let attributes = attributes.collect();
    let mut all = Assembly {
        arrays,
        faults: Vec::new(),
    };
    let points = all.reals::<3>("points");
    let counts = all.integers("counts");
    let wrong = |message: String| ReadError::file(path, message);
    let (mut points, counts) = (points.map_err(wrong)?, counts.map_err(wrong)?);
    if u32::try_from(points.len()).is_err() {
        let message = format!("it has {} points; at most {} fit", points.len(), u32::MAX);
        return Err(ReadError::new(path, crate::Blame::Limit, message));
    }
    let layout = all.layout(&counts, points.len());
    points.truncate(layout.vertices());
    let curves = all.buffer(points, &layout);
    let mut set = CurveSet::through_vertices(name, curves);
    set.attributes = attributes;
    set.faults = all.faults;
    Ok(set)
}

fn describe(name: &str, array: &Array) -> AttributeInfo {
    let domain = match name {
        "points" | "widths" | "colors" | "opacities" | "normals" => "vertex",
        "counts" | "hair_id" | "strand_id" | "root_uv" | "strand_uv" | "group" | "triangle"
        | "barycentric" | "root_rest" => "uniform",
        _ => "unknown",
    };
    let components: String = array
        .shape
        .iter()
        .skip(1)
        .map(|n| format!("×{n}"))
        .collect();
    AttributeInfo {
        name: name.into(),
        kind: format!("{}{components}", array.kind),
        domain: domain.into(),
        count: array.shape.first().copied().unwrap_or(1) as usize,
    }
}

impl Assembly {
    fn fault(&mut self, detail: String) {
        self.faults.push(Fault {
            kind: FaultKind::WrongCount,
            strand: None,
            detail,
        });
    }

    fn layout(&mut self, counts: &[i64], points: usize) -> Layout {
        if let Some(curve) = counts.iter().position(|&c| c < 0) {
            self.fault(format!("counts[{curve}] is {}; read as 0", counts[curve]));
        }
        let counts: Vec<usize> = counts.iter().map(|&c| c.max(0) as usize).collect();
        let layout = Layout::new(Basis::CatmullRom, Wrap::Pinned, &counts, points);
        if layout.file_vertices() != points as u64 {
            self.fault(format!(
                "points has {points} entries, but counts add up to {}; {} of {} curves are read",
                layout.file_vertices(),
                layout.counts().len(),
                counts.len()
            ));
        }
        layout
    }

    fn buffer(&mut self, points: Vec<[f32; 3]>, layout: &Layout) -> StrandBuffer {
        StrandBuffer {
            offsets: layout.offsets(),
            points,
            widths: self.real(layout, "widths", "vertex"),
            colors: self.vectors(layout, "colors", "vertex"),
            opacities: self.real(layout, "opacities", "vertex"),
            normals: self.vectors(layout, "normals", "vertex"),
            hair_id: self.index(layout, "hair_id", |id| Some(id as u64)),
            strand_id: self.index(layout, "strand_id", |id| u32::try_from(id).ok()),
            root_uv: self.vectors(layout, "root_uv", "uniform"),
            strand_uv: self.vectors(layout, "strand_uv", "uniform"),
            group: self.index(layout, "group", |id| u32::try_from(id).ok()),
            triangle: self.index(layout, "triangle", |id| u32::try_from(id).ok()),
            barycentric: self.vectors(layout, "barycentric", "uniform"),
            root_rest: self.vectors(layout, "root_rest", "uniform"),
        }
    }

    /// The array `name` as vectors of `N` real numbers.
    fn reals<const N: usize>(&mut self, name: &str) -> Result<Vec<[f32; N]>, String> {
        let array = self.arrays.remove(name).ok_or_else(String::new)?;
        let fits = match N {
            1 => array.shape.len() == 1 || array.shape.get(1..) == Some(&[1]),
            _ => array.shape.get(1..) == Some(&[N as u64]),
        };
        match array.numbers {
            Numbers::Real(numbers) if fits => Ok(numbers.as_chunks::<N>().0.to_vec()),
            Numbers::Double(numbers) if fits => {
                let narrow: Vec<f32> = numbers.into_iter().map(|x| x as f32).collect();
                Ok(narrow.as_chunks::<N>().0.to_vec())
            }
            _ => Err(format!(
                "{name} is {} of shape {:?}, not real numbers of shape [n, {N}]",
                array.kind, array.shape
            )),
        }
    }

    fn integers(&mut self, name: &str) -> Result<Vec<i64>, String> {
        let array = self.arrays.remove(name).ok_or_else(String::new)?;
        match array.numbers {
            Numbers::Integer(numbers) if array.shape.len() == 1 => Ok(numbers),
            _ => Err(format!(
                "{name} is {} of shape {:?}, not integers of shape [m]",
                array.kind, array.shape
            )),
        }
    }

    fn vectors<const N: usize>(
        &mut self,
        layout: &Layout,
        name: &str,
        domain: &str,
    ) -> Vec<[f32; N]> {
        let entries = self.reals::<N>(name);
        let dealt = entries.and_then(|entries| {
            let dealt = layout.deal(&entries, domain);
            dealt.map_err(|message| format!("{name} {message}"))
        });
        self.or_fault(dealt)
    }

    fn real(&mut self, layout: &Layout, name: &str, domain: &str) -> Vec<f32> {
        self.vectors::<1>(layout, name, domain)
            .into_iter()
            .flatten()
            .collect()
    }

    fn index<T>(
        &mut self,
        layout: &Layout,
        name: &str,
        narrow: impl Fn(i64) -> Option<T>,
    ) -> Vec<T> {
        let entries = self.integers(name);
        let dealt = entries.and_then(|entries| {
            let dealt = layout.per_curve(&entries, "uniform");
            let dealt = dealt.map_err(|message| format!("{name} {message}"))?;
            let narrow: Option<Vec<T>> = dealt.into_iter().map(narrow).collect();
            narrow.ok_or_else(|| format!("{name} has entries that do not fit in 32 bits"))
        });
        self.or_fault(dealt)
    }

    /// What was read, or nothing and a fault. No message: the array is not there.
    fn or_fault<T>(&mut self, read: Result<Vec<T>, String>) -> Vec<T> {
        read.unwrap_or_else(|message| {
            if !message.is_empty() {
                self.fault(message);
            }
            Vec::new()
        })
    }
}
