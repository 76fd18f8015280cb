//! Which vertices of the curves of a chunk are written.

use crate::blocks::Blocks;
use crate::capture::Capture;
use crate::clock::{Clock, Stage};
use crate::curves::Curves;
use crate::lanes::LANES;
use crate::plan::Plan;
use crate::stages::{cut, degenerate, thin};
use fearless_simd::{Level, dispatch};
use pelage_curves::Vec3;

/// The numbers of the vertices that stay, curve by curve.
#[derive(Clone, Debug, Default)]
pub(crate) struct Stay {
    kept: Vec<u32>,
    /// Where each curve's begin in `kept`; one more entry than curves.
    starts: Vec<u32>,
    /// Numbers of the hairs with vertices that cannot be told apart, ascending.
    degenerate: Vec<u32>,
    /// The vertices of those that can, hair by hair.
    distinct: Vec<u32>,
    /// Where each one's begin in `distinct`; one more entry than degenerate hairs.
    distinct_starts: Vec<u32>,
    /// Those of one curve that are left before it is thinned.
    left: Vec<u32>,
    points: Vec<Vec3>,
    tangents: Vec<Vec3>,
}

impl Stay {
    /// Number of vertices that stay.
    pub(crate) fn len(&self) -> usize {
        self.kept.len()
    }

    /// Where the vertices that stay start, curve by curve.
    pub(crate) fn offsets(&self) -> &[u32] {
        &self.starts
    }

    /// Numbers of the vertices that stay of curve `i`; none of a hair that has degenerated.
    pub(crate) fn numbers(&self, i: usize) -> &[u32] {
        &self.kept[self.starts[i] as usize..self.starts[i + 1] as usize]
    }

    /// Those, and behind them those of the curves that follow.
    pub(crate) fn numbers_from(&self, i: usize) -> &[u32] {
        &self.kept[self.starts[i] as usize..]
    }

    /// Puts the numbers of the vertices of hair `hair` that are left of the first `uncut`
    /// into `left`.
    fn leave(&mut self, hair: usize, uncut: usize) {
        self.left.clear();
        let Ok(found) = self.degenerate.binary_search(&(hair as u32)) else {
            return self.left.extend(0..uncut as u32);
        };
        let range = self.distinct_starts[found] as usize..self.distinct_starts[found + 1] as usize;
        let (distinct, end) = (&self.distinct[range], uncut as u32 - 1);
        self.left
            .extend(distinct.iter().filter(|&&number| number < end));
        // The vertex where a hair is cut is not where it was.
        if self.left.is_empty() {
            return;
        }
        self.left.push(end);
    }
}

impl Plan {
    /// Notes which vertices of `hairs`, shaped by their guides at rest, are degenerate.
    pub(crate) fn find_degenerate(&self, capture: &Capture, hairs: &Blocks, stay: &mut Stay) {
        stay.degenerate.clear();
        stay.distinct.clear();
        stay.distinct_starts.clear();
        stay.distinct_starts.push(0);
        let apart = |i: usize, vertices: u32| {
            let (length, root) = (capture.lengths[i], capture.roots[i].rest);
            degenerate::apart(length, vertices as usize - 1, root)
        };
        for block in 0..hairs.blocks() {
            let shortest = dispatch!(Level::new(), simd => {
                let _ = simd;
                degenerate::shortest(hairs.block(block), hairs.lengths(block))
            });
            let first = block * LANES;
            for (lane, &vertices) in hairs.lengths(block).iter().enumerate() {
                let apart = apart(first + lane, vertices);
                if shortest[lane] > apart * apart {
                    continue;
                }
                hairs.read(first + lane, &mut stay.points);
                degenerate::distinct(&stay.points, apart, &mut stay.distinct);
                stay.degenerate.push((first + lane) as u32);
                stay.distinct_starts.push(stay.distinct.len() as u32);
            }
        }
    }

    /// Chooses which vertices of `curves` stay.
    pub(crate) fn choose(
        &self,
        capture: &Capture,
        curves: &Curves,
        stay: &mut Stay,
        clock: &mut Clock,
    ) {
        let started = clock.start();
        let fibers = self.fibers();
        stay.kept.clear();
        stay.starts.clear();
        stay.starts.push(0);
        let whole =
            self.thinning.is_none() && capture.cuts.is_empty() && stay.degenerate.is_empty();
        for i in 0..curves.len() {
            let (hair, curve) = (i / fibers, curves.get(i));
            if whole {
                stay.kept.extend(0..curve.len() as u32);
                stay.starts.push(stay.kept.len() as u32);
                continue;
            }
            stay.leave(hair, cut::kept(curve.len(), capture.cut(hair)));
            match self.thinning {
                None => stay.kept.extend_from_slice(&stay.left),
                Some(threshold) => {
                    stay.points.clear();
                    let left = stay.left.iter().map(|&number| curve[number as usize]);
                    stay.points.extend(left);
                    let first = stay.kept.len();
                    thin::thin(threshold, &stay.points, &mut stay.tangents, &mut stay.kept);
                    for kept in &mut stay.kept[first..] {
                        *kept = stay.left[*kept as usize];
                    }
                }
            }
            stay.starts.push(stay.kept.len() as u32);
        }
        clock.stop(Stage::Thin, started);
    }
}
