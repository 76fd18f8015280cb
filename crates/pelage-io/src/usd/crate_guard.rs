//! Checks a `.usdc` file before `openusd` reads it.
//!
//! The reader trusts every count in the file: it allocates before it reads, so a
//! few hostile bytes end the process (a failed allocation cannot be caught), and
//! its walk over paths visits what a hostile tree names exponentially often. So
//! the structure is walked here first, against one budget of decoded bytes.
//!
//! Layout: OpenUSD `pxr/usd/usd/crateFile.{h,cpp}`, versions 0.4 to 0.12.

use super::crate_values::Values;
use super::cursor::{Broken, Cursor};
use std::cell::Cell;

/// Decoded bytes any file may need, however small it is: still meshes of many
/// time samples store one array that is decoded once a sample.
const BASE_BUDGET: u64 = 512 << 20;

/// Decoded bytes allowed for each byte of the file. Integer coding followed by LZ4
/// reaches thousands, but only for constant arrays, which are a small part.
const BUDGET_PER_BYTE: u64 = 64;

/// Levels of prims a path may have; real scenes stay below 50.
const MAX_DEPTH: u32 = 128;

/// What is left to spend on decoding.
pub(super) struct Budget(Cell<u64>);

impl Budget {
    pub(super) fn of(bytes: u64) -> Self {
        Self(Cell::new(bytes))
    }

    pub(super) fn spend(&self, bytes: u64) -> Result<(), Broken> {
        let left = self.0.get().checked_sub(bytes);
        self.0.set(left.ok_or_else(|| {
            Broken("its arrays unpack to far more than a file of this size can mean".into())
        })?);
        Ok(())
    }
}

/// Tables that values of the file point into.
pub(super) struct Tables {
    pub(super) version: [u8; 3],
    /// Length of each token in bytes.
    pub(super) tokens: Vec<u32>,
    /// Token of each string.
    pub(super) strings: Vec<u32>,
    /// Length of each path in bytes.
    pub(super) paths: Vec<u32>,
}

/// Fails where reading `bytes` as a crate file could exhaust memory or never end.
pub(super) fn check(bytes: &[u8]) -> Result<(), Broken> {
    let budget = Budget::of(BASE_BUDGET + BUDGET_PER_BYTE * bytes.len() as u64);
    let version = check_version(bytes)?;
    let sections = Sections::read(bytes)?;
    let tokens = read_tokens(&mut sections.open("TOKENS")?, &budget)?;
    let strings = read_strings(&mut sections.open("STRINGS")?, tokens.len())?;
    let fields = read_fields(&mut sections.open("FIELDS")?, tokens.len(), &budget)?;
    let mut section = sections.open("FIELDSETS")?;
    let count = section.count()?;
    let fieldsets = section.encoded_ints(count, &budget)?;
    let paths = check_paths(&mut sections.open("PATHS")?, &tokens, &budget)?;
    let tables = Tables {
        version,
        tokens,
        strings,
        paths,
    };
    let values = Values::new(bytes, &tables, &budget);
    check_specs(
        &mut sections.open("SPECS")?,
        &fieldsets,
        &fields,
        &values,
        &budget,
    )
}

fn check_version(bytes: &[u8]) -> Result<[u8; 3], Broken> {
    if bytes.len() < 32 || !bytes.starts_with(openusd::usdc::MAGIC) {
        return Err(Broken("it ends within its header".into()));
    }
    let version = [bytes[8], bytes[9], bytes[10]];
    if !(4..=12).contains(&version[1]) || version[0] != 0 {
        let [major, minor, patch] = version;
        return Err(Broken(format!(
            "it is of crate version {major}.{minor}.{patch}; versions 0.4 to 0.12 can be read"
        )));
    }
    Ok(version)
}

struct Sections<'a> {
    bytes: &'a [u8],
    starts: Vec<(&'a [u8], u64)>,
}

impl<'a> Sections<'a> {
    fn read(bytes: &'a [u8]) -> Result<Self, Broken> {
        let mut header = Cursor::at(bytes, 16)?;
        let mut contents = Cursor::at(bytes, header.u64()?)?;
        let count = contents.u64()?;
        if count == 0 || count >= 64 {
            return Err(Broken(format!("its table of contents has {count} entries")));
        }
        let mut starts = Vec::new();
        for _ in 0..count {
            let name = contents.take(16)?;
            let length = name.iter().position(|&c| c == 0).unwrap_or(name.len());
            let start = contents.u64()?;
            contents.u64()?;
            starts.push((&name[..length], start));
        }
        Ok(Self { bytes, starts })
    }

    fn open(&self, name: &str) -> Result<Cursor<'a>, Broken> {
        let found = self.starts.iter().find(|(n, _)| *n == name.as_bytes());
        let (_, start) = found.ok_or_else(|| Broken(format!("it has no section {name}")))?;
        Cursor::at(self.bytes, *start)
    }
}

/// Lengths of the tokens.
fn read_tokens(section: &mut Cursor, budget: &Budget) -> Result<Vec<u32>, Broken> {
    let count = section.u64()?;
    let size = section.u64()?;
    let text = section.decompress(size, size, budget)?;
    if text.len() as u64 != size {
        return Err(Broken("its tokens unpack to a wrong size".into()));
    }
    let ends = text.iter().filter(|&&c| c == 0).count() as u64;
    if ends != count || text.last().is_some_and(|&c| c != 0) {
        return Err(Broken(format!("it claims {count} tokens and has {ends}")));
    }
    let lengths = text.split(|&c| c == 0).map(|token| token.len() as u32);
    Ok(lengths.take(count as usize).collect())
}

fn read_strings(section: &mut Cursor, tokens: usize) -> Result<Vec<u32>, Broken> {
    let count = section.count_of(4)?;
    let strings: Result<Vec<u32>, Broken> = (0..count).map(|_| section.u32()).collect();
    let strings = strings?;
    all_below(&strings, tokens, "string", "token")?;
    Ok(strings)
}

/// Value representations of the fields.
fn read_fields(section: &mut Cursor, tokens: usize, budget: &Budget) -> Result<Vec<u64>, Broken> {
    let count = section.count()?;
    let names = section.encoded_ints(count, budget)?;
    all_below(&names, tokens, "field", "token")?;
    let size = count
        .checked_mul(8)
        .ok_or_else(|| Broken(format!("it claims {count} fields")))?;
    let reps = section.decompress(size, size, budget)?;
    if reps.len() as u64 != size {
        return Err(Broken("its fields unpack to a wrong size".into()));
    }
    let (reps, _) = reps.as_chunks::<8>();
    Ok(reps.iter().map(|rep| u64::from_le_bytes(*rep)).collect())
}

fn all_below(values: &[u32], limit: usize, what: &str, of: &str) -> Result<(), Broken> {
    match values.iter().position(|&v| v as usize >= limit) {
        Some(i) => Err(Broken(format!(
            "{what} {i} names {of} {}; there are {limit}",
            values[i]
        ))),
        None => Ok(()),
    }
}

/// Walks the tree of paths as the reader will; gives the lengths of the paths.
fn check_paths(section: &mut Cursor, tokens: &[u32], budget: &Budget) -> Result<Vec<u32>, Broken> {
    let total = section.count()?;
    let count = section.count()?;
    let paths = section.encoded_ints(count, budget)?;
    let names = section.encoded_ints(count, budget)?;
    let jumps = section.encoded_ints(count, budget)?;
    // A path table may hold the empty path, which is not in the tree.
    if total > count + 1024 {
        return Err(Broken(format!(
            "it claims {total} paths and has {count} of them"
        )));
    }
    all_below(&paths, total as usize, "path entry", "path")?;
    let mut lengths = vec![1u32; total as usize];
    let mut seen = vec![false; paths.len()];
    let mut pending = vec![(0usize, 0u32, 0u64)];
    if paths.is_empty() {
        pending.clear();
    }
    while let Some((mut index, mut depth, mut parent)) = pending.pop() {
        loop {
            let visited = seen
                .get_mut(index)
                .ok_or_else(|| Broken("its tree of paths leads out of itself".into()))?;
            if std::mem::replace(visited, true) {
                return Err(Broken("its tree of paths meets itself".into()));
            }
            let name = (names[index] as i32).unsigned_abs() as usize;
            let length = tokens.get(name).copied();
            let length =
                length.ok_or_else(|| Broken(format!("path entry {index} names token {name}")))?;
            let path = parent + length as u64 + 1;
            budget.spend(path + 64)?;
            let longest = &mut lengths[paths[index] as usize];
            *longest = (*longest).max(u32::try_from(path).unwrap_or(u32::MAX));
            let jump = jumps[index] as i32;
            let (child, sibling) = (jump > 0 || jump == -1, jump >= 0);
            if child && sibling {
                pending.push((index + jump as usize, depth, parent));
            }
            if child {
                (depth, parent) = (depth + 1, path);
                if depth > MAX_DEPTH {
                    return Err(Broken(format!("its prims nest deeper than {MAX_DEPTH}")));
                }
            }
            if !child && !sibling {
                break;
            }
            index += 1;
        }
    }
    Ok(lengths)
}

/// Adds up what decoding every value of every spec would need.
fn check_specs(
    section: &mut Cursor,
    fieldsets: &[u32],
    fields: &[u64],
    values: &Values,
    budget: &Budget,
) -> Result<(), Broken> {
    let count = section.count()?;
    let paths = section.encoded_ints(count, budget)?;
    let sets = section.encoded_ints(count, budget)?;
    section.encoded_ints(count, budget)?;
    all_below(&paths, values.tables().paths.len(), "spec", "path")?;
    all_below(&sets, fieldsets.len(), "spec", "fieldset")?;
    let mut known: Vec<Option<u64>> = vec![None; fields.len()];
    for set in sets {
        // A set of fields ends at the first invalid index.
        for &field in fieldsets[set as usize..].iter().take_while(|f| **f != !0) {
            let rep = fields.get(field as usize).copied();
            let rep = rep.ok_or_else(|| Broken(format!("a fieldset names field {field}")))?;
            let bytes = match known[field as usize] {
                Some(bytes) => bytes,
                None => values.bytes(rep)?,
            };
            known[field as usize] = Some(bytes);
            budget.spend(bytes + 8)?;
        }
    }
    Ok(())
}
