//! Which part of which triangle each piece is, in four bytes.
//!
//! Document 004, section 2.1.4, keeps two indices of four bytes a piece. One is enough:
//! nearly always the bits of the largest triangle index and of the deepest part fit one
//! word together. Where they do not (a million triangles, one of which fills a large
//! map), parts that are too deep are named from a *split*: a part of the triangle that
//! is listed as if it were one more triangle.

use crate::lanes::LANES;
use crate::pages::Pages;
use crate::part::{Packed, Part, TABLE_DEPTH, first_part, parts};
use crate::subdivide::Piece;
use fearless_simd::{Simd, SimdBase, SimdMask, f32x16, u32x16};
use std::collections::HashMap;

/// The pieces of a surface, by their index along the distribution.
#[derive(Clone, Debug)]
pub(crate) struct Pieces {
    /// Host and part of each piece; the part in the lower `part_bits`.
    codes: Pages<u32>,
    part_bits: u32,
    parts: Vec<Packed>,
    /// Hosts from this one on are splits.
    triangles: u32,
    splits: Vec<(u32, Part)>,
}

impl Pieces {
    /// How many bits of a word the parts of depth `deepest` need, if the indices of all
    /// `triangles` fit beside them: nearly always.
    pub(crate) fn part_bits(triangles: u32, deepest: u32) -> Option<u32> {
        let bits = part_bits(deepest);
        let fits = deepest <= TABLE_DEPTH && triangles as u64 <= hosts(bits);
        fits.then_some(bits)
    }

    /// Pieces that are packed already, of parts no deeper than `deepest`, with
    /// [`part_bits`](Self::part_bits).
    pub(crate) fn packed(codes: Pages<u32>, triangles: u32, deepest: u32) -> Self {
        Self {
            codes,
            part_bits: part_bits(deepest),
            parts: packed(deepest),
            triangles,
            splits: Vec::new(),
        }
    }

    /// Packs `pieces` of a mesh of `triangles` triangles; `None` for more than 32 bits can
    /// name.
    pub(crate) fn new(pieces: &[Piece], triangles: u32) -> Option<Self> {
        let deepest = depth_of(pieces.iter().map(|p| p.part).max().unwrap_or(0));
        (0..=deepest.min(TABLE_DEPTH))
            .rev()
            .find_map(|depth| Self::with_splits(pieces, triangles, depth))
    }

    /// Packs `pieces` with part indices down to `depth`, if all hosts can be named.
    fn with_splits(pieces: &[Piece], triangles: u32, depth: u32) -> Option<Self> {
        let part_bits = part_bits(depth);
        let mut splits = Vec::new();
        let mut named = HashMap::new();
        let mut codes = Vec::with_capacity(pieces.len());
        for piece in pieces {
            let (base, local) = cut_name(piece.part, depth);
            let host = match base {
                0 => piece.triangle,
                _ => *named.entry((piece.triangle, base)).or_insert_with(|| {
                    splits.push((piece.triangle, part_named(base)));
                    triangles + splits.len() as u32 - 1
                }),
            };
            if triangles as u64 + splits.len() as u64 > hosts(part_bits) {
                return None;
            }
            codes.push(host << part_bits | local);
        }
        Some(Self {
            codes: codes.into(),
            part_bits,
            parts: packed(depth),
            triangles,
            splits,
        })
    }

    /// Triangle and part of piece `index`.
    pub(crate) fn get(&self, index: usize) -> (u32, Part) {
        self.names().get(index)
    }

    /// What naming a piece reads.
    #[inline(always)]
    pub(crate) fn names(&self) -> Names<'_> {
        Names {
            codes: &self.codes,
            part_bits: self.part_bits,
            parts: &self.parts,
            triangles: self.triangles,
            splits: &self.splits,
        }
    }

    /// Number of pieces.
    pub(crate) fn len(&self) -> usize {
        self.codes.len()
    }

    /// All pieces, in order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (u32, Part)> {
        (0..self.len()).map(|i| self.get(i))
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> usize {
        self.codes.len() * 4 + size_of_val(&self.parts[..]) + size_of_val(&self.splits[..])
    }
}

/// The arrays of the pieces, for loops over many (see
/// [`Tables`](crate::distribution::Tables)).
#[derive(Clone, Copy)]
pub(crate) struct Names<'a> {
    codes: &'a [u32],
    part_bits: u32,
    parts: &'a [Packed],
    triangles: u32,
    splits: &'a [(u32, Part)],
}

impl Names<'_> {
    /// Triangle and part of piece `index`.
    #[inline(always)]
    pub(crate) fn get(self, index: usize) -> (u32, Part) {
        let code = self.codes[index];
        let (host, part) = (code >> self.part_bits, self.part(code));
        match host < self.triangles {
            true => (host, part),
            false => self.below(host, part).unwrap_or((host, part)),
        }
    }

    /// Hosts and packed parts of `pieces`.
    #[inline(always)]
    pub(crate) fn get_all(self, pieces: &[u32], hosts: &mut [u32], parts: &mut [u32]) {
        for ((&piece, host), part) in pieces.iter().zip(hosts).zip(parts) {
            let code = self.codes[piece as usize];
            (*host, *part) = (code >> self.part_bits, self.packed(code).0);
        }
    }

    /// Triangles and parts of those `hosts` and `packed`: of the parts the two coordinates
    /// of the origin and the size.
    #[inline(always)]
    pub(crate) fn unpacked<S: Simd>(
        self,
        simd: S,
        hosts: &[u32; LANES],
        packed: &[u32; LANES],
    ) -> (u32x16<S>, [f32x16<S>; 3]) {
        let mut triangles = u32x16::load_array_ref(simd, hosts);
        let mut part = Packed::unpacked(u32x16::load_array_ref(simd, packed));
        if triangles.simd_ge(self.triangles).any_true() {
            for k in 0..LANES {
                if let Some((triangle, own)) = self.below(hosts[k], Packed(packed[k]).part()) {
                    triangles[k] = triangle;
                    [part[0][k], part[1][k]] = own.origin;
                    part[2][k] = own.size;
                }
            }
        }
        (triangles, part)
    }

    /// The part that `code` names, of its host.
    #[inline(always)]
    fn packed(self, code: u32) -> Packed {
        self.parts[(code & ((1 << self.part_bits) - 1)) as usize]
    }

    /// The same, unpacked.
    #[inline(always)]
    fn part(self, code: u32) -> Part {
        self.packed(code).part()
    }

    /// The triangle of a split, and the part of it that `part` of the split is; `None`
    /// for a host that is a triangle. Rare: not where loops over many would carry it along.
    #[cold]
    #[inline(never)]
    fn below(self, host: u32, part: Part) -> Option<(u32, Part)> {
        let split = host.checked_sub(self.triangles)?;
        let (triangle, base) = self.splits[split as usize];
        Some((triangle, base.part(part)))
    }
}

/// All parts down to `depth`.
fn packed(depth: u32) -> Vec<Packed> {
    parts(depth).into_iter().map(Packed::new).collect()
}

/// Bits of the index of a part of depth `depth` at most.
fn part_bits(depth: u32) -> u32 {
    (first_part(depth + 1) - 1)
        .checked_ilog2()
        .map_or(0, |b| b + 1)
}

/// Triangles and splits that fit a word beside `part_bits` bits.
fn hosts(part_bits: u32) -> u64 {
    1 << (32 - part_bits)
}

/// How often the whole was cut to make part `index`.
fn depth_of(index: u32) -> u32 {
    (0..)
        .find(|&d| (index as usize) < first_part(d + 1))
        .unwrap_or(0)
}

/// Splits the name of a part into a base and a name below it of at most `depth` digits.
fn cut_name(index: u32, depth: u32) -> (u32, u32) {
    let (mut base, mut local, mut place) = (index, 0, 1);
    for _ in 0..depth {
        if base == 0 {
            break;
        }
        local += place * ((base - 1) % 4 + 1);
        base = (base - 1) / 4;
        place *= 4;
    }
    (base, local)
}

fn part_named(index: u32) -> Part {
    match index {
        0 => Part::WHOLE,
        _ => part_named((index - 1) / 4).children()[((index - 1) % 4) as usize],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fearless_simd::{Level, dispatch};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_packed_piece_is_the_piece(
            found in prop::collection::vec((0u32..5000, 0u32..349_525), 1..200),
            crowd in 0u32..20,
        ) {
            let triangles = 5000 << crowd.min(18);
            let found: Vec<Piece> = found
                .into_iter()
                .map(|(triangle, part)| Piece { triangle, part })
                .collect();
            let pieces = Pieces::new(&found, triangles).unwrap();
            let last = pieces.len() as u32 - 1;
            let first = std::array::from_fn::<u32, LANES, _>(|k| last.min(k as u32));
            let [mut hosts, mut packed] = [[0; LANES]; 2];
            let names = pieces.names();
            names.get_all(&first, &mut hosts, &mut packed);
            dispatch!(Level::new(), simd => {
                let (triangles, [u, v, size]) = names.unpacked(simd, &hosts, &packed);
                for k in 0..LANES {
                    let part = Part { origin: [u[k], v[k]], size: size[k] };
                    assert_eq!((triangles[k], part), pieces.get(first[k] as usize));
                }
            });
            for (packed, piece) in pieces.iter().zip(&found) {
                prop_assert_eq!(packed, (piece.triangle, part_named(piece.part)));
            }
        }
    }
}
