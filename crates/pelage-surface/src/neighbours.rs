//! Many places at once that lie in few pieces: compared with where those begin, instead of
//! looked up one by one.
//!
//! Hairs drawn together are neighbours, and where there are many more hairs than pieces, or a
//! few texels outshine all others, they share two or three pieces. Which one each is in is
//! then a matter of a few comparisons, which processors make of many at once.

use crate::distribution::{Tables, cut};
use crate::lanes::{Found, float};
use crate::part::Part;
use crate::pieces::Names;
use fearless_simd::{Select, Simd, SimdBase, f32x16, u32x16};

/// Pieces that follow each other are compared where they are no more than these: from about so
/// many on looking them up is faster.
pub(crate) const FEW: usize = 8;

/// Pieces that follow each other, and hold all places that are looked for.
pub(crate) struct Few {
    pieces: [Near; FEW],
    count: usize,
}

/// A piece and its share.
#[derive(Clone, Copy)]
struct Near {
    /// Words of the fraction it begins at.
    upper: u32,
    lower: u32,
    /// Bits by which the share is too wide (see [`Tables::locate`]), and the width without.
    cut: u32,
    width: f32,
    triangle: u32,
    part: Part,
}

impl Few {
    pub(crate) fn new() -> Self {
        let none = Near {
            upper: 0,
            lower: 0,
            cut: 0,
            width: 1.0,
            triangle: 0,
            part: Part::WHOLE,
        };
        Self {
            pieces: [none; FEW],
            count: 0,
        }
    }

    /// Takes the pieces of the fractions `least` to `most`; whether they are few.
    #[inline(always)]
    pub(crate) fn find(&mut self, [least, most]: [u64; 2], tables: Tables, names: Names) -> bool {
        // The grid alone tells; waiting for the starts would hold up the many that look up.
        if tables.between(least, most) as usize >= FEW {
            return false;
        }
        let first = tables.share_around(least).0;
        self.count = 0;
        for (k, share) in tables.starts(first).array_windows().enumerate() {
            let &[start, end] = share;
            // Two at a time: whether there is a second would be guessed wrong at every other run.
            if k > 0 && k % 2 == 0 && start > most {
                break;
            }
            if k == FEW {
                return false;
            }
            self.pieces[k] = Near::new(names.get(first + k), start, end - start);
            self.count = k + 1;
        }
        true
    }

    /// In which of the pieces places lie, of whose fractions the words are given.
    #[inline(always)]
    pub(crate) fn hold<S: Simd>(&self, simd: S, upper: u32x16<S>, lower: u32x16<S>) -> Found<S> {
        let (first, others) = match self.pieces[..self.count].split_first() {
            Some(pieces) => pieces,
            None => (&self.pieces[0], &[][..]),
        };
        let number = |x: f32| f32x16::splat(simd, x);
        let part = first.part;
        let mut found = Found {
            triangle: u32x16::splat(simd, first.triangle),
            origin: [number(part.origin[0]), number(part.origin[1])],
            size: number(part.size),
            inside: number(0.0),
            width: number(first.width),
        };
        let mut inside = first.inside(simd, upper, lower);
        for piece in others {
            let (start, below) = (u32x16::splat(simd, piece.upper), lower.simd_lt(piece.lower));
            let after = upper.simd_gt(start) | (upper.simd_eq(start) & !below);
            let part = piece.part;
            inside = after.select(piece.inside(simd, upper, lower), inside);
            found.triangle = after.select(u32x16::splat(simd, piece.triangle), found.triangle);
            found.origin[0] = after.select(number(part.origin[0]), found.origin[0]);
            found.origin[1] = after.select(number(part.origin[1]), found.origin[1]);
            found.size = after.select(number(part.size), found.size);
            found.width = after.select(number(piece.width), found.width);
        }
        found.inside = float(inside);
        found
    }
}

impl Near {
    #[inline(always)]
    fn new((triangle, part): (u32, Part), start: u64, width: u64) -> Self {
        let cut = cut(width);
        Self {
            upper: (start >> 32) as u32,
            lower: start as u32,
            cut,
            width: (width.max(1) >> cut) as f32,
            triangle,
            part,
        }
    }

    /// How far into the share fractions fall; any number for those before.
    #[inline(always)]
    fn inside<S: Simd>(&self, simd: S, upper: u32x16<S>, lower: u32x16<S>) -> u32x16<S> {
        let (zero, one) = (u32x16::splat(simd, 0), u32x16::splat(simd, 1));
        let borrow = lower.simd_lt(self.lower).select(one, zero);
        let (upper, lower) = (upper - self.upper - borrow, lower - self.lower);
        match self.cut {
            // Nothing is in the upper word of a share that is not cut.
            0 => lower,
            1..32 => upper << (32 - self.cut) | lower >> self.cut,
            _ => upper >> (self.cut - 32),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Distribution;
    use crate::pieces::Pieces;
    use crate::subdivide::Piece;
    use fearless_simd::{Level, dispatch};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn neighbours_are_found_where_each_is_looked_up(
            weights in prop::collection::vec(prop_oneof![1e-3f64..1.0, 1e3f64..1e6], 1..40),
            middle: u64, width in 0u32..64, dice: [u64; 16],
        ) {
            let distribution = Distribution::new(&weights).unwrap();
            let piece = |i: usize| Piece { triangle: i as u32 / 3, part: i as u32 % 5 };
            let pieces: Vec<Piece> = (0..weights.len()).map(piece).collect();
            let pieces = Pieces::new(&pieces, weights.len() as u32).unwrap();
            let xs = dice.map(|x| middle.saturating_add(x >> width));
            let (least, most) = (xs.iter().min().unwrap(), xs.iter().max().unwrap());
            let mut few = Few::new();
            if !few.find([*least, *most], distribution.tables(), pieces.names()) {
                return Ok(());
            }
            let (upper, lower) = (xs.map(|x| (x >> 32) as u32), xs.map(|x| x as u32));
            dispatch!(Level::new(), simd => {
                let [upper, lower] = [upper, lower].map(|x| u32x16::load_array(simd, x));
                let found = few.hold(simd, upper, lower);
                for (k, &x) in xs.iter().enumerate() {
                    let (index, [inside, width]) = distribution.tables().locate(x);
                    let (triangle, part) = pieces.get(index);
                    assert_eq!(found.triangle[k], triangle);
                    assert_eq!([found.origin[0][k], found.origin[1][k]], part.origin);
                    assert_eq!(found.size[k], part.size);
                    assert_eq!([found.inside[k], found.width[k]], [inside as f32, width as f32]);
                }
            });
        }
    }
}
