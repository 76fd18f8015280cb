//! Many places at once that lie in few pieces: compared with where those begin, instead of
//! looked up one by one.
//!
//! Hairs drawn together are neighbours, and where there are many more hairs than pieces, or a
//! few texels outshine all others, they share two or three pieces. Which one each is in is
//! then a matter of a few comparisons, which processors make of many at once.

use crate::distribution::{Rests, Tables, inside};
use crate::part::Packed;
use crate::pieces::Names;

/// Pieces that follow each other are compared where they are less than these, or little more:
/// from about so many on looking them up is faster.
pub(crate) const FEW: u32 = 8;

/// In which pieces `N` places lie.
pub(crate) struct Found<const N: usize> {
    /// Triangles, or splits (see [`Names`]).
    pub hosts: [u32; N],
    pub parts: [Packed; N],
    pub rests: Rests<N>,
}

impl<const N: usize> Found<N> {
    #[inline(always)]
    fn none() -> Self {
        Self {
            hosts: [0; N],
            parts: [Packed::default(); N],
            rests: Rests::new(),
        }
    }

    /// The pieces of the fractions `xs`, looked up one by one.
    #[inline(always)]
    pub(crate) fn anywhere(xs: &[u64; N], tables: Tables, names: Names) -> Self {
        let mut found = Self::none();
        let mut pieces = [0; N];
        tables.locate_all(xs, &mut pieces, &mut found.rests);
        names.get_all(&pieces, &mut found.hosts, &mut found.parts);
        found
    }

    /// The pieces of the fractions `xs`, which may well be few. Asking costs a few percent where
    /// they are not.
    #[inline(always)]
    pub(crate) fn near(xs: &[u64; N], tables: Tables, names: Names) -> Self {
        let mut found = Self::none();
        let (mut least, mut most) = (u64::MAX, 0);
        for &x in xs {
            (least, most) = (x.min(least), x.max(most));
        }
        // The grid alone tells; waiting for the starts would hold up the many that look up.
        let first = match tables.between(least, most) < FEW {
            true => tables.share_around(least).0,
            false => usize::MAX,
        };
        if let Some(row) = Row::<4>::new(first, most, tables, names) {
            row.find(xs, &mut found);
        } else if let Some(row) = Row::<{ FEW as usize }>::new(first, most, tables, names) {
            row.find(xs, &mut found);
        } else {
            return Self::anywhere(xs, tables, names);
        }
        found
    }
}

/// Pieces that follow each other; the last only ends the one before.
struct Row<const W: usize> {
    starts: [u64; W],
    hosts: [u32; W],
    parts: [Packed; W],
}

impl<const W: usize> Row<W> {
    /// The pieces from `first` on, if `most` lies before the last of them.
    #[inline(always)]
    fn new(first: usize, most: u64, tables: Tables, names: Names) -> Option<Self> {
        let starts = *tables.row(first)?;
        let (hosts, parts) = names.row(first)?;
        let row = Self {
            starts,
            hosts,
            parts,
        };
        (starts[W - 1] > most).then_some(row)
    }

    #[inline(always)]
    fn find<const N: usize>(&self, xs: &[u64; N], found: &mut Found<N>) {
        let starts = self.starts;
        for (k, &x) in xs.iter().enumerate() {
            let (mut start, mut end) = (starts[0], starts[W - 1]);
            let (mut host, mut part) = (self.hosts[0], self.parts[0]);
            for (i, &begin) in starts.iter().enumerate().skip(1) {
                let after = begin <= x;
                start = if after { begin } else { start };
                host = if after { self.hosts[i] } else { host };
                part = if after { self.parts[i] } else { part };
            }
            for &begin in starts[1..].iter().rev() {
                end = if begin <= x { end } else { begin };
            }
            (found.hosts[k], found.parts[k]) = (host, part);
            found.rests.set(k, inside(x, (start, end - start)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Distribution;
    use crate::pieces::Pieces;
    use crate::subdivide::Piece;
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
            let found = Found::near(&xs, distribution.tables(), pieces.names());
            for (k, &x) in xs.iter().enumerate() {
                let (index, [inside, width]) = distribution.tables().locate(x);
                let (triangle, part) = pieces.get(index);
                prop_assert_eq!(found.hosts[k], triangle);
                prop_assert_eq!(found.parts[k].part(), part);
                prop_assert_eq!(found.rests.part(k), inside as f32 / width as f32);
            }
        }
    }
}
