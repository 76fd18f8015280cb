//! Roots of many hairs at once, from their numbers to their places.
//!
//! In passes of [`LANES`] hairs side by side, so that processors do the arithmetic of many at
//! once. Where the hairs lie in few pieces, all of it is arithmetic, and one pass does; elsewhere
//! there is a pass for each table, so that processors wait for the memory of many at once.

use crate::distribution::Picks;
use crate::lanes::{Found, LANES};
use crate::neighbours::Few;
use crate::runs::Run;
use crate::{RootSampler, Spread, SurfacePoint};
use fearless_simd::{Simd, SimdBase, SimdInt, i32x16, u32x16, u64x8};

/// Most hairs drawn at once: their numbers stay in the first-level cache, and what one pass
/// writes is on its way there when the next one reads it.
pub(crate) const BATCH: usize = 128;

/// What is written and read again while a batch is drawn.
pub(crate) struct Scratch {
    pub few: Few,
    xs: [u64; BATCH],
    ys: [u32; BATCH],
    picks: Picks<BATCH>,
    hosts: [u32; BATCH],
    parts: [u32; BATCH],
}

impl Scratch {
    pub(crate) fn new() -> Self {
        Self {
            few: Few::new(),
            xs: [0; BATCH],
            ys: [0; BATCH],
            picks: Picks::new(),
            hosts: [0; BATCH],
            parts: [0; BATCH],
        }
    }
}

impl RootSampler {
    /// Draws the roots of `hairs`, those of `run` up to a multiple of [`LANES`], if they lie in
    /// few pieces; whether they do.
    #[inline(always)]
    pub(crate) fn draw_near<S: Simd>(
        &self,
        simd: S,
        run: &Run,
        (hairs, roots): (&[u64], &mut [SurfacePoint]),
        few: &mut Few,
    ) -> bool {
        let (tables, names) = (self.distribution().tables(), self.pieces().names());
        let alone = self.sequence().spread() == Spread::Random;
        if alone || !few.find(run.numbers(), tables, names) {
            return false;
        }
        let (hairs, roots) = (hairs.as_chunks().0, roots.as_chunks_mut().0);
        for (hairs, roots) in hairs.iter().zip(roots) {
            let [upper, lower, y] = self.sequence().samples(simd, hairs);
            few.hold(simd, upper, lower).place(simd, y, roots);
        }
        true
    }

    /// Draws the roots of `hairs` wherever they lie; a multiple of [`LANES`], [`BATCH`] at most.
    #[inline(always)]
    pub(crate) fn draw<S: Simd>(
        &self,
        simd: S,
        hairs: &[u64],
        roots: &mut [SurfacePoint],
        scratch: &mut Scratch,
    ) {
        let (tables, names) = (self.distribution().tables(), self.pieces().names());
        let Scratch {
            xs,
            ys,
            picks,
            hosts,
            parts,
            ..
        } = scratch;
        let count = hairs.len();
        let (xs, hosts, parts) = (&mut xs[..count], &mut hosts[..count], &mut parts[..count]);
        let numbers = xs.as_chunks_mut::<LANES>().0.iter_mut();
        let numbers = numbers.zip(ys.as_chunks_mut::<LANES>().0);
        for (hairs, (xs, ys)) in hairs.as_chunks().0.iter().zip(numbers) {
            let [upper, lower, y] = self.sequence().samples(simd, hairs);
            let (low, high) = lower.interleave(upper);
            bytemuck::cast_slice_mut(&mut xs[..LANES / 2]).copy_from_slice(low.as_slice());
            bytemuck::cast_slice_mut(&mut xs[LANES / 2..]).copy_from_slice(high.as_slice());
            y.store_array(ys);
        }
        tables.locate_all(xs, picks);
        names.get_all(&picks.indices[..count], hosts, parts);
        let (hosts, parts) = (hosts.as_chunks().0, parts.as_chunks().0);
        let (insides, widths) = (picks.insides.as_chunks().0, picks.widths.as_chunks().0);
        let ys = ys.as_chunks().0;
        for (k, roots) in roots.as_chunks_mut().0.iter_mut().enumerate() {
            let (triangle, [u, v, size]) = names.unpacked(simd, &hosts[k], &parts[k]);
            let found = Found {
                triangle,
                origin: [u, v],
                size,
                inside: i32x16::load_array_ref(simd, &insides[k]).to_float(),
                width: i32x16::load_array_ref(simd, &widths[k]).to_float(),
            };
            found.place(simd, u32x16::load_array_ref(simd, &ys[k]), roots);
        }
    }

    /// Draws those hairs that are listed and not yet drawn.
    #[inline(always)]
    pub(crate) fn draw_listed<S: Simd>(&self, simd: S, drawn: &mut Drawn) {
        let (start, end) = (drawn.drawn, drawn.listed);
        let end = start + (end - start).next_multiple_of(LANES);
        let (hairs, roots) = (&drawn.hairs[start..end], &mut drawn.roots[start..end]);
        if start < end {
            self.draw(simd, hairs, roots, &mut drawn.scratch);
        }
        drawn.drawn = drawn.listed;
    }

    /// Draws the roots of `run`, [`BATCH`] at most, and gives them.
    #[inline(always)]
    pub(crate) fn draw_run<'a, S: Simd>(
        &self,
        simd: S,
        run: &Run,
        drawn: &'a mut Drawn<'_>,
    ) -> &'a [SurfacePoint] {
        let padded = (run.count as usize).next_multiple_of(LANES);
        let (hairs, roots) = (&mut drawn.hairs[..padded], &mut drawn.roots[..padded]);
        run.write(simd, hairs);
        if !self.draw_near(simd, run, (hairs, roots), &mut drawn.scratch.few) {
            self.draw(simd, hairs, roots, &mut drawn.scratch);
        }
        &drawn.roots[..run.count as usize]
    }
}

/// Hairs that were listed, and the roots of the first of them.
pub(crate) struct Drawn<'a> {
    pub hairs: &'a mut [u64],
    pub roots: &'a mut [SurfacePoint],
    pub listed: usize,
    /// How many roots are drawn.
    pub drawn: usize,
    pub scratch: Scratch,
}

impl<'a> Drawn<'a> {
    /// What is drawn is written to both of one length.
    pub(crate) fn into(hairs: &'a mut [u64], roots: &'a mut [SurfacePoint]) -> Self {
        Self {
            hairs,
            roots,
            listed: 0,
            drawn: 0,
            scratch: Scratch::new(),
        }
    }

    #[inline(always)]
    pub(crate) fn pass_to(&mut self, visit: &mut impl FnMut(&[u64], &[SurfacePoint])) {
        if self.drawn > 0 {
            visit(&self.hairs[..self.drawn], &self.roots[..self.drawn]);
            (self.listed, self.drawn) = (0, 0);
        }
    }

    /// Adds what was drawn elsewhere, as far as there is room.
    pub(crate) fn append(&mut self, hairs: &[u64], roots: &[SurfacePoint]) {
        let count = hairs.len().min(self.hairs.len() - self.drawn);
        let end = self.drawn + count;
        self.hairs[self.drawn..end].copy_from_slice(&hairs[..count]);
        self.roots[self.drawn..end].copy_from_slice(&roots[..count]);
        (self.listed, self.drawn) = (end, end);
    }
}

/// Where what is drawn waits to be passed on.
pub(crate) struct Room {
    hairs: [u64; ROOM],
    roots: [SurfacePoint; ROOM],
}

/// Two batches, and what fills up the last row.
const ROOM: usize = 2 * BATCH + LANES;

impl Room {
    pub(crate) fn new() -> Self {
        Self {
            hairs: [0; ROOM],
            roots: [SurfacePoint::default(); ROOM],
        }
    }

    pub(crate) fn drawn(&mut self) -> Drawn<'_> {
        Drawn::into(&mut self.hairs, &mut self.roots)
    }
}

impl Run {
    /// Bounds of the first numbers of a stratified run.
    #[inline(always)]
    fn numbers(&self) -> [u64; 2] {
        let rest = u64::MAX
            .checked_shr(self.step.trailing_zeros())
            .unwrap_or(0);
        [self.number & !rest, self.number | rest]
    }

    /// Writes the indices from the first on.
    #[inline(always)]
    pub(crate) fn write<S: Simd>(&self, simd: S, hairs: &mut [u64]) {
        const HALF: usize = LANES / 2;
        let mut first = [0; HALF];
        for (k, hair) in first.iter_mut().enumerate() {
            *hair = self.first.wrapping_add(self.step.wrapping_mul(k as u64));
        }
        let mut now = u64x8::load_array(simd, first);
        for row in hairs.chunks_exact_mut(HALF) {
            now.store_slice(row);
            now += self.step.wrapping_mul(HALF as u64);
        }
    }
}
