//! Hairs in the order of the surface.
//!
//! Hairs that follow each other by their index stand as far apart as they can, so whatever
//! is read for one, of mesh, maps and guides, is far from what is read for the next. Along
//! the surface it is the same few kilobytes for thousands of hairs.

use crate::{BlueNoise, RootSampler, Spread, SurfacePoint};
use rayon::prelude::*;
use std::ops::Range;

/// Hairs that may stand in any order among themselves: fewer than a row of what is done side by
/// side would only take longer to list.
const RUN: u64 = 16;

/// Hairs in the order of the surface, cut into parts of about one size.
///
/// A part depends on the roots, the hairs and the size asked for alone. Each hair is in one
/// part, and neighbours on the surface are mostly in one part or in two that follow each
/// other; inside of a part, they follow each other.
///
/// Stratified roots are listed part by part, in time proportional to their number. Random
/// ones and blue noise are sorted when this is made, and take 8 bytes a hair.
///
/// ```
/// # use pelage_surface::{AlongSurface, Density, Mesh, PolygonMesh, RootSampler};
/// # let mesh = Mesh::new(PolygonMesh::sheet(20, 20, |u, v| [u, v, 0.0]))?;
/// let sampler = RootSampler::new(&mesh, &Density { value: 1.0, map: None }, 0).unwrap();
/// let along = AlongSurface::new(&sampler, 0..10_000, 1000);
/// let (mut hairs, mut roots) = (Vec::new(), Vec::new());
/// for part in 0..along.parts() {
///     along.part(part, &mut hairs, &mut roots);
/// }
/// assert_eq!(roots[0], sampler.root(hairs[0]));
/// hairs.sort();
/// assert!(hairs.into_iter().eq(0..10_000));
/// # Ok::<(), pelage_surface::MeshError>(())
/// ```
#[derive(Clone, Debug)]
pub struct AlongSurface<'a> {
    source: Source<'a>,
    /// A part is an equal share of the surface, weighed by its density; of what is sorted, of
    /// the hairs. They are 2^bits.
    bits: u32,
}

#[derive(Clone, Debug)]
enum Source<'a> {
    Drawn(&'a RootSampler, Range<u64>),
    SortedRandom(&'a RootSampler, Vec<u64>),
    SortedBlueNoise(&'a BlueNoise, Vec<u64>),
}

impl<'a> AlongSurface<'a> {
    /// `hairs` with the roots of `sampler`, in parts of at most about `each`, at least 1.
    pub fn new(sampler: &'a RootSampler, hairs: Range<u64>, each: u64) -> Self {
        let bits = bits(&hairs, each);
        let first_number = |&hair: &u64| sampler.sequence().sample(hair).0;
        let source = match sampler.sequence().spread() {
            Spread::Stratified => Source::Drawn(sampler, hairs),
            Spread::Random => Source::SortedRandom(sampler, sorted(hairs, first_number)),
        };
        Self { source, bits }
    }

    /// The same with the roots of `made`, all of which `hairs` must be among.
    pub fn of_blue_noise(made: &'a BlueNoise, hairs: Range<u64>, each: u64) -> Self {
        let bits = bits(&hairs, each);
        let hairs = sorted(hairs, |&hair| made.piece(hair));
        Self {
            source: Source::SortedBlueNoise(made, hairs),
            bits,
        }
    }

    /// Number of parts, at least 1.
    pub fn parts(&self) -> u64 {
        1 << self.bits
    }

    /// Appends the hairs of part `number`, which is less than [`parts`](Self::parts), and their
    /// roots.
    pub fn part(&self, number: u64, hairs: &mut Vec<u64>, roots: &mut Vec<SurfacePoint>) {
        match &self.source {
            Source::Drawn(sampler, all) => {
                let end = |number: u64| (number as u128) << (64 - self.bits);
                let interval = [end(number), end(number + 1)];
                sampler.roots_in_runs(interval, all.clone(), RUN, |found, places| {
                    hairs.extend(found);
                    roots.extend(places);
                });
            }
            Source::SortedRandom(sampler, sorted) => {
                let own = self.share(number, sorted);
                hairs.extend(own);
                roots.extend(own.iter().map(|&hair| sampler.root(hair)));
            }
            Source::SortedBlueNoise(made, sorted) => {
                let own = self.share(number, sorted);
                hairs.extend(own);
                roots.extend(own.iter().map(|&hair| made.root(hair)));
            }
        }
    }

    fn share<'b>(&self, number: u64, sorted: &'b [u64]) -> &'b [u64] {
        let end = |number: u64| ((number as u128 * sorted.len() as u128) >> self.bits) as usize;
        &sorted[end(number)..end(number + 1)]
    }
}

/// Parts as a power of two, so that they are whole branches of the sequence.
fn bits(hairs: &Range<u64>, each: u64) -> u32 {
    let parts = hairs.end.saturating_sub(hairs.start).div_ceil(each.max(1));
    parts.max(1).next_power_of_two().trailing_zeros()
}

fn sorted<K: Ord>(hairs: Range<u64>, key: impl Fn(&u64) -> K + Sync) -> Vec<u64> {
    let mut hairs: Vec<u64> = hairs.collect();
    hairs.par_sort_unstable_by_key(|hair| (key(hair), *hair));
    hairs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Density;
    use crate::fixture::sheet;
    use proptest::prelude::*;

    fn listed(along: &AlongSurface) -> (Vec<u64>, Vec<SurfacePoint>, usize) {
        let (mut hairs, mut roots, mut largest) = (Vec::new(), Vec::new(), 0);
        for part in 0..along.parts() {
            let before = hairs.len();
            along.part(part, &mut hairs, &mut roots);
            largest = largest.max(hairs.len() - before);
        }
        (hairs, roots, largest)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        #[test]
        fn along_the_surface_stand_the_same_hairs_in_parts_no_larger_than_asked(
            seed: u64, first in 0u64..2000, count in 0u64..2000, each in 1u64..3000, kind in 0..3,
        ) {
            let mesh = sheet(5);
            let density = Density { value: 1.0, map: None };
            let drawn = RootSampler::new(&mesh, &density, seed).unwrap();
            let random = drawn.clone().with_spread(Spread::Random);
            let hairs = first..first + count;
            let made = BlueNoise::new(&mesh, &drawn, if kind == 2 { hairs.end } else { 0 });
            let along = match kind {
                0 => AlongSurface::new(&drawn, hairs.clone(), each),
                1 => AlongSurface::new(&random, hairs.clone(), each),
                _ => AlongSurface::of_blue_noise(&made, hairs.clone(), each),
            };
            let (mut found, roots, largest) = listed(&along);
            for (&hair, root) in found.iter().zip(&roots) {
                let own = match kind {
                    0 => drawn.root(hair),
                    1 => random.root(hair),
                    _ => made.root(hair),
                };
                prop_assert_eq!(*root, own);
            }
            // Of a stratified sequence, an interval has one more or less than its share.
            prop_assert!(largest as u64 <= each + 1, "{} of {}", largest, each);
            found.sort_unstable();
            prop_assert!(found.into_iter().eq(hairs));
        }
    }

    #[test]
    fn hairs_that_follow_each_other_along_the_surface_are_neighbours() {
        let mesh = sheet(32);
        let density = Density {
            value: 1.0,
            map: None,
        };
        let drawn = RootSampler::new(&mesh, &density, 1).unwrap();
        let made = BlueNoise::new(&mesh, &drawn, 20_000);
        let step = |hairs: &[SurfacePoint]| {
            let places: Vec<_> = hairs.iter().map(|root| mesh.frame(root).position).collect();
            let steps = places.windows(2).map(|pair| pair[0].distance(pair[1]));
            steps.sum::<f32>() / places.len() as f32
        };
        let mut by_index = Vec::new();
        drawn.roots(0..20_000, &mut by_index);
        for along in [
            AlongSurface::new(&drawn, 0..20_000, 500),
            AlongSurface::of_blue_noise(&made, 0..20_000, 500),
        ] {
            let (_, roots, _) = listed(&along);
            let (near, far) = (step(&roots), step(&by_index));
            assert!(near < 0.05 * far, "{near} of {far}");
        }
    }
}
