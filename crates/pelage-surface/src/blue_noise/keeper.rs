//! Candidates that are far enough from all roots, in clusters of their own.

use super::cluster::{Cluster, Columns, Distances, Near, TAKEN};
use super::ground::{Ground, LANES, ROW};
use super::pool::Found;
use fearless_simd::{Simd, SimdBase, SimdMask, f32x16, u32x16};

/// Less than a cluster, and as much as one more.
const ROOM: usize = 2 * LANES;

/// Gathers candidates until they fill a cluster.
pub(crate) struct Keeper {
    /// The number that those of the candidates count from.
    first: u64,
    x: [f32; ROOM],
    y: [f32; ROOM],
    z: [f32; ROOM],
    closeness: [f32; ROOM],
    triangle: [u32; ROOM],
    offset: [u32; ROOM],
    near: [f32; ROOM],
    len: usize,
}

impl Keeper {
    pub(crate) fn new(first: u64) -> Self {
        Self {
            first,
            x: [0.0; ROOM],
            y: [0.0; ROOM],
            z: [0.0; ROOM],
            closeness: [0.0; ROOM],
            triangle: [0; ROOM],
            offset: [0; ROOM],
            near: [0.0; ROOM],
            len: 0,
        }
    }

    /// Adds those of `drawn`, which are `near` to roots, that are as far as `floor`; moves
    /// what fills a cluster to `found`.
    #[inline(always)]
    pub(crate) fn keep<S: Simd>(
        &mut self,
        drawn: &Cluster,
        near: &Distances<S>,
        floor: f32,
        ground: &Ground,
        found: &mut Found,
    ) {
        let (simd, columns) = (near.simd, drawn.columns());
        for row in 0..LANES / ROW {
            // Which are kept is as good as random: without branches.
            let kept = near.row(row).simd_ge(floor);
            let (from, to) = (ROW * row, self.len);
            let floats = |lanes: &[f32; LANES]| f32x16::from_slice(simd, &lanes[from..from + ROW]);
            let triangles = u32x16::from_slice(simd, &columns.triangle[from..from + ROW]);
            let offsets = numbers(simd, columns.offset[from]);
            put(floats(&columns.x), kept, &mut self.x, to);
            put(floats(&columns.y), kept, &mut self.y, to);
            put(floats(&columns.z), kept, &mut self.z, to);
            put(floats(&columns.closeness), kept, &mut self.closeness, to);
            put(near.row(row), kept, &mut self.near, to);
            put(triangles, kept, &mut self.triangle, to);
            put(offsets, kept, &mut self.offset, to);
            self.len += kept.to_bitmask().count_ones() as usize;
        }
        if self.len >= LANES {
            self.flush(simd, ground, found);
        }
    }

    /// Moves up to a cluster to `found`.
    #[inline(always)]
    pub(crate) fn flush<S: Simd>(&mut self, simd: S, ground: &Ground, found: &mut Found) {
        if self.len == 0 {
            return;
        }
        if self.len < LANES {
            self.fill_up();
        }
        let mut offset = [0; LANES];
        for (to, from) in offset.iter_mut().zip(&self.offset) {
            *to = *from as u16;
        }
        let columns = Columns {
            x: moved(&mut self.x),
            y: moved(&mut self.y),
            z: moved(&mut self.z),
            closeness: moved(&mut self.closeness),
            triangle: moved(&mut self.triangle),
            offset,
        };
        moved(&mut self.offset);
        self.len -= self.len.min(LANES);
        found.near.push(Near(moved(&mut self.near)));
        found
            .clusters
            .push(Cluster::new(simd, columns, self.first, ground));
    }

    /// Repeats the first candidate in the lanes of a cluster that have none.
    fn fill_up(&mut self) {
        let none = self.len..LANES;
        for column in [&mut self.x, &mut self.y, &mut self.z, &mut self.closeness] {
            let first = column[0];
            column[none.clone()].fill(first);
        }
        let triangle = self.triangle[0];
        self.triangle[none.clone()].fill(triangle);
        self.near[none].fill(TAKEN);
    }
}

/// Writes those of a row that are kept at `to`, and something behind them.
#[inline(always)]
fn put<S: Simd, V: SimdBase<S>>(row: V, kept: V::Mask, column: &mut [V::Element; ROOM], to: usize) {
    row.compress(kept).store_slice(&mut column[to..to + ROW]);
}

/// Takes a cluster out of the front.
#[inline(always)]
fn moved<T: Copy>(column: &mut [T; ROOM]) -> [T; LANES] {
    let (front, rest) = column.split_at_mut(LANES);
    let mut out = [front[0]; LANES];
    out.copy_from_slice(front);
    front.copy_from_slice(rest);
    out
}

/// Numbers from `first` on.
#[inline(always)]
fn numbers<S: Simd>(simd: S, first: u16) -> u32x16<S> {
    let mut numbers = [0; ROW];
    for (k, number) in numbers.iter_mut().enumerate() {
        *number = first as u32 + k as u32;
    }
    u32x16::load_array(simd, numbers)
}
