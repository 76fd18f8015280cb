//! The roots of an interval of the surface, as they come along it: the fastest way to draw roots,
//! where the order of their hairs is of no matter.

use crate::drawing::{BATCH, Drawn, Room};
use crate::lanes::LANES;
use crate::runs::Run;
use crate::{RootSampler, SurfacePoint};
use fearless_simd::{Level, Simd, dispatch};
use std::ops::Range;

/// Runs of an interval that are listed before they are drawn.
const RUNS: usize = 256;

impl RootSampler {
    /// Calls `visit` with those of `hairs` whose first number lies in `low..high` (`high` up
    /// to 2^64) and their roots, a few at a time, in the order of the surface: the fastest way
    /// where the order of the hairs is of no matter.
    pub fn roots_in(
        &self,
        low: u64,
        high: u128,
        hairs: Range<u64>,
        visit: impl FnMut(&[u64], &[SurfacePoint]),
    ) {
        self.roots_in_runs([low as u128, high], hairs, BATCH as u64, visit);
    }

    /// The same, where among so many that follow each other the order may be any: the fewer,
    /// the nearer they are, and the more there is to list.
    pub(crate) fn roots_in_runs(
        &self,
        interval: [u128; 2],
        hairs: Range<u64>,
        most: u64,
        mut visit: impl FnMut(&[u64], &[SurfacePoint]),
    ) {
        let mut room = Room::new();
        let mut drawn = room.drawn();
        self.each_runs(interval, hairs, most, |runs| {
            dispatch!(Level::new(), simd => self.draw_runs(simd, runs, &mut drawn, &mut visit));
            drawn.pass_to(&mut visit);
        });
    }

    /// Writes those of `hairs` whose first number lies in `low..high` to `indices`, and their
    /// roots to `roots`, in the order of [`roots_in`](Self::roots_in); to memory that is far
    /// this is faster than to copy them there. Gives how many there are; those for which there
    /// is no room in both are left out.
    ///
    /// ```
    /// use pelage_surface::{Density, Mesh, PolygonMesh, RootSampler, SurfacePoint};
    /// let sheet = Mesh::new(PolygonMesh::sheet(8, 8, |u, v| [u, v, 0.0])).unwrap();
    /// let even = Density { value: 1.0, map: None };
    /// let sampler = RootSampler::new(&sheet, &even, 1).unwrap();
    /// let (mut hairs, mut roots) = ([0; 60], [SurfacePoint::default(); 60]);
    /// let count = sampler.fill_in(0, 1 << 63, 0..100, &mut hairs, &mut roots);
    /// assert_eq!(count, 50);
    /// assert_eq!(roots[7], sampler.root(hairs[7]));
    /// ```
    pub fn fill_in(
        &self,
        low: u64,
        high: u128,
        hairs: Range<u64>,
        indices: &mut [u64],
        roots: &mut [SurfacePoint],
    ) -> usize {
        let places = indices.len().min(roots.len());
        let mut direct = Drawn::into(&mut indices[..places], &mut roots[..places]);
        let mut room = Room::new();
        let mut drawn = room.drawn();
        let mut count = 0;
        self.each_runs([low as u128, high], hairs, BATCH as u64, |runs| {
            // Drawing in place writes beyond the last root; what comes near the end is copied.
            let fits = |run: &Run| {
                let fits = count + BATCH + LANES <= places;
                count += run.count as usize;
                fits
            };
            let in_place = runs.iter().map(fits).filter(|&fits| fits).count();
            let (now, last) = runs.split_at(in_place);
            dispatch!(Level::new(), simd => {
                self.draw_runs(simd, now, &mut direct, &mut |_, _| {});
            });
            let mut copy = |hairs: &[u64], roots: &[SurfacePoint]| direct.append(hairs, roots);
            dispatch!(Level::new(), simd => self.draw_runs(simd, last, &mut drawn, &mut copy));
            drawn.pass_to(&mut copy);
        });
        count
    }

    /// Calls `visit` with the runs of an interval, many at a time: drawing is compiled for the
    /// processor at hand, and what lists them is not.
    fn each_runs(
        &self,
        interval: [u128; 2],
        hairs: Range<u64>,
        most: u64,
        mut visit: impl FnMut(&[Run]),
    ) {
        let mut runs = Vec::with_capacity(RUNS);
        self.sequence().runs_in(interval, hairs, most, &mut |run| {
            runs.push(run);
            if runs.len() == RUNS {
                visit(&runs);
                runs.clear();
            }
        });
        visit(&runs);
    }

    #[inline(always)]
    fn draw_runs<S: Simd>(
        &self,
        simd: S,
        runs: &[Run],
        drawn: &mut Drawn,
        visit: &mut impl FnMut(&[u64], &[SurfacePoint]),
    ) {
        for run in runs {
            if drawn.hairs.len() < drawn.listed + BATCH + LANES {
                self.draw_listed(simd, drawn);
                drawn.pass_to(visit);
            }
            let (start, count) = (drawn.listed, run.count as usize);
            let end = start + count.next_multiple_of(LANES);
            run.write(simd, &mut drawn.hairs[start..end]);
            if start + count > drawn.drawn + BATCH {
                self.draw_listed(simd, drawn);
            }
            drawn.listed += count;
            // Runs that lie in many pieces wait until they are a batch; what comes after them
            // fills it up.
            let room = (&drawn.hairs[start..end], &mut drawn.roots[start..end]);
            if start == drawn.drawn && self.draw_near(simd, run, room, &mut drawn.scratch.few) {
                drawn.drawn = drawn.listed;
            }
        }
        self.draw_listed(simd, drawn);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::{sheet, spots};
    use crate::{Density, Spread, Wrap};

    #[test]
    fn the_roots_of_an_interval_are_those_of_its_hairs() {
        let map = spots();
        let density = Density {
            value: 1.0,
            map: Some((&map, 0, Wrap::Repeat)),
        };
        let even = RootSampler::new(&sheet(6), &density, 4).unwrap();
        for sampler in [even.clone().with_spread(Spread::Random), even] {
            for (low, high) in [(0, 1 << 64), (1 << 61, 5 << 61), (77, 78)] {
                let mut found = Vec::new();
                sampler.roots_in(low, high, 7..30_000, |hairs, roots| {
                    for (&hair, root) in hairs.iter().zip(roots) {
                        assert_eq!(*root, sampler.root(hair));
                        found.push(hair);
                    }
                });
                let none = SurfacePoint::default();
                for room in [0, 1, 100, found.len(), found.len() + 200] {
                    let (mut hairs, mut roots) = (vec![u64::MAX; room], vec![none; room]);
                    let count = sampler.fill_in(low, high, 7..30_000, &mut hairs, &mut roots);
                    assert_eq!(count, found.len());
                    assert_eq!(hairs[..count.min(room)], found[..count.min(room)]);
                    for (&hair, root) in hairs[..count.min(room)].iter().zip(&roots) {
                        assert_eq!(*root, sampler.root(hair));
                    }
                }
                let mut expected = Vec::new();
                let visit = &mut |hair| expected.push(hair);
                sampler.sequence().indices_in(low, high, 7..30_000, visit);
                found.sort_unstable();
                expected.sort_unstable();
                assert_eq!(found, expected);
            }
        }
    }
}
