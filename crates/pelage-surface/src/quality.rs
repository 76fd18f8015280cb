//! How evenly roots are spread: the measures that the literature compares.
//!
//! Sources: Lagae and Dutré 2008, "A Comparison of Methods for Generating Poisson Disk
//! Distributions", for the smallest distance relative to that of the densest packing;
//! Clark and Evans 1954, "Distance to Nearest Neighbor as a Measure of Spatial
//! Relationships in Populations", for the mean distance relative to that of chance;
//! Ulichney 1987, "Digital Halftoning", for the radially averaged power spectrum.

use crate::blue_noise::hierarchy::{Bounds, Hierarchy};
use crate::hilbert::hilbert_index;
use pelage_curves::Vec3;
use std::ops::Range;

/// A root as its neighbours see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Position.
    pub position: Vec3,
    /// Unit normal of the surface. Samples whose normals differ by 90 degrees or more
    /// (the two sides of a sheet or of an ear) do not count as neighbours.
    pub normal: Vec3,
    /// Density of roots there relative to the mean over the area; positive.
    pub density: f64,
}

impl Sample {
    fn bounds(&self) -> Bounds {
        Bounds {
            low: self.position,
            high: self.position,
            least: self.density.sqrt() as f32,
        }
    }
}

/// The smallest distance between two of `samples`, relative to the distance in the
/// hexagonal packing of as many points on the same `area`, √(2 · area / (√3 · n)). 1 for
/// a perfect lattice; saturated Poisson-disk sets have 0.7 to 0.78. Distances are
/// Euclidean, multiplied by the fourth root of the product of both relative densities.
///
/// Infinite where no two samples are neighbours.
pub fn smallest_distance_ratio(samples: &[Sample], area: f64) -> f64 {
    let all = Neighbours::new(samples);
    let nearer = |least, i| all.nearest(i, i, least);
    let least = (0..samples.len()).fold(f32::INFINITY, nearer);
    if least == f32::INFINITY {
        return f64::INFINITY;
    }
    let hexagonal = 2.0 * area / (3.0f64.sqrt() * samples.len() as f64);
    (least as f64 / hexagonal).sqrt()
}

/// The mean distance of `samples` to their nearest neighbours, relative to that of as many
/// independent points on the same `area`, √(area / n) / 2. 1 for independent points, 2 for
/// a square lattice, 2.15 for the hexagonal one, below 1 for clusters. Distances are as in
/// [`smallest_distance_ratio`]; samples without a neighbour are left out.
///
/// NaN where no two samples are neighbours.
pub fn nearest_distance_ratio(samples: &[Sample], area: f64) -> f64 {
    let all = Neighbours::new(samples);
    let nearest = (0..samples.len()).map(|i| {
        // Those beside it on the curve are near enough to begin with.
        let beside = all.least_in(i, i.saturating_sub(1)..i + 2, f32::INFINITY);
        all.nearest(i, samples.len(), beside)
    });
    let found = nearest.filter(|gap| gap.is_finite());
    let (sum, count) = found.fold((0.0, 0), |(sum, count), gap| {
        (sum + (gap as f64).sqrt(), count + 1)
    });
    let independent = (area / samples.len() as f64).sqrt() / 2.0;
    sum / count as f64 / independent
}

/// Samples along a curve, and the bounds of leaves of them.
struct Neighbours {
    sorted: Vec<Sample>,
    tree: Hierarchy,
}

/// Samples in a leaf of their hierarchy.
const LEAF: usize = 8;

impl Neighbours {
    fn new(samples: &[Sample]) -> Self {
        let sorted = along_curve(samples);
        let leaves = sorted.chunks(LEAF);
        let leaves = leaves.map(|leaf| Bounds::around(leaf.iter().map(Sample::bounds)));
        Self {
            tree: Hierarchy::new(leaves),
            sorted,
        }
    }

    /// The smallest squared distance of sample `i` to others below `end`, or `least` where
    /// none is nearer.
    fn nearest(&self, i: usize, end: usize, mut least: f32) -> f32 {
        let bounds = self.sorted[i].bounds();
        self.tree.near_shrinking(&bounds, least, |leaf| {
            let last = ((leaf + 1) * LEAF).min(end);
            least = self.least_in(i, leaf * LEAF..last, least);
            least
        });
        least
    }

    /// The same among the samples of `range`, of which there may be fewer.
    fn least_in(&self, i: usize, range: Range<usize>, mut least: f32) -> f32 {
        let sample = &self.sorted[i];
        let bounds = sample.bounds();
        for k in range.start..range.end.min(self.sorted.len()) {
            let other = &self.sorted[k];
            let gap = other.bounds().gap(&bounds);
            if k != i && gap < least && sample.normal.dot(other.normal) > 0.0 {
                least = gap;
            }
        }
        least
    }
}

fn along_curve(samples: &[Sample]) -> Vec<Sample> {
    let Bounds { low, high, .. } = Bounds::around(samples.iter().map(Sample::bounds));
    let side = (high - low).max_element().max(f32::MIN_POSITIVE);
    let mut sorted = samples.to_vec();
    sorted.sort_by_cached_key(|s| hilbert_index(s.position, low, side));
    sorted
}

/// The power spectrum of `points` of the unit square, averaged over circles: for each
/// frequency 1, 2, … up to `frequencies` (in cycles over the square), the mean of
/// |Σ exp(-2πi k·x)|² / n over the whole-numbered k whose length rounds to it.
///
/// White noise has power 1 at all frequencies. Blue noise has next to none below
/// √n, and about 1 far above. At whole-numbered frequencies the square itself has no
/// power, so points that do not repeat across its borders need no window.
pub fn radial_power_spectrum(points: &[[f64; 2]], frequencies: usize) -> Vec<(f64, f64)> {
    let most = frequencies as i64;
    let mut sums = vec![(0.0, 0u32); frequencies + 1];
    let columns: Vec<Wave> = points.iter().map(|p| Wave::new(p[0])).collect();
    // Half the plane: the other has the same powers.
    for y in 0..=most {
        let mut waves: Vec<Wave> = points
            .iter()
            .map(|p| Wave::new(p[1] * y as f64 - p[0] * most as f64))
            .collect();
        for x in -most..=most {
            let (re, im) = waves
                .iter()
                .fold((0.0, 0.0), |(re, im), w| (re + w.re, im + w.im));
            let ring = ((x * x + y * y) as f64).sqrt().round() as usize;
            if ring <= frequencies {
                sums[ring].0 += (re * re + im * im) / points.len() as f64;
                sums[ring].1 += 1;
            }
            for (wave, column) in waves.iter_mut().zip(&columns) {
                *wave = wave.and(*column);
            }
        }
    }
    let mean = |(ring, (sum, count)): (usize, &(f64, u32))| (ring as f64, sum / *count as f64);
    sums.iter().enumerate().skip(1).map(mean).collect()
}

/// exp(-2πi · turns).
#[derive(Clone, Copy)]
struct Wave {
    re: f64,
    im: f64,
}

impl Wave {
    fn new(turns: f64) -> Self {
        let angle = -2.0 * std::f64::consts::PI * turns;
        Self {
            re: libm::cos(angle),
            im: libm::sin(angle),
        }
    }

    fn and(self, other: Wave) -> Wave {
        Wave {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn at(position: [f32; 3]) -> Sample {
        Sample {
            position: position.into(),
            normal: Vec3::Z,
            density: 1.0,
        }
    }

    proptest! {
        #[test]
        fn distances_are_those_of_comparing_all(
            places in prop::collection::vec((prop::array::uniform3(0f32..1.0), 0.1f64..5.0), 2..90),
        ) {
            let samples: Vec<Sample> = places
                .iter()
                .map(|&(p, density)| Sample { density, ..at(p) })
                .collect();
            let mut nearest = vec![f64::INFINITY; samples.len()];
            for (i, a) in samples.iter().enumerate() {
                for (j, b) in samples.iter().enumerate().filter(|(j, _)| *j != i) {
                    let scale = (a.density * b.density).sqrt().sqrt();
                    let distance = a.position.distance(b.position) as f64 * scale;
                    nearest[j] = nearest[j].min(distance);
                }
            }
            let count = samples.len() as f64;
            let least = nearest.iter().copied().fold(f64::INFINITY, f64::min);
            let hexagonal = (2.0 / (3f64.sqrt() * count)).sqrt();
            let ratio = smallest_distance_ratio(&samples, 1.0);
            prop_assert!((ratio - least / hexagonal).abs() < 1e-5);
            let mean = nearest.iter().sum::<f64>() / count;
            let ratio = nearest_distance_ratio(&samples, 1.0);
            prop_assert!((ratio - mean * 2.0 * count.sqrt()).abs() < 1e-4);
        }
    }

    #[test]
    fn a_hexagonal_packing_has_the_ratios_of_the_literature() {
        let (n, height) = (30, 3f32.sqrt() / 2.0);
        let lattice = (0..n * n).map(|i| {
            let (x, y) = ((i % n) as f32, (i / n) as f32);
            at([x + 0.5 * (y % 2.0), y * height, 0.0])
        });
        let area = (n * n) as f64 * height as f64;
        let lattice: Vec<Sample> = lattice.collect();
        let ratio = smallest_distance_ratio(&lattice, area);
        assert!((ratio - 1.0).abs() < 1e-5, "{ratio}");
        let ratio = nearest_distance_ratio(&lattice, area);
        assert!((ratio - 2.149).abs() < 1e-3, "{ratio}");
    }

    #[test]
    fn samples_that_face_apart_are_no_neighbours() {
        let other = Sample {
            normal: -Vec3::Z,
            ..at([0.0; 3])
        };
        assert_eq!(
            smallest_distance_ratio(&[at([0.0; 3]), other], 1.0),
            f64::INFINITY
        );
        assert_eq!(smallest_distance_ratio(&[], 1.0), f64::INFINITY);
        assert!(nearest_distance_ratio(&[at([0.0; 3]), other], 1.0).is_nan());
    }

    #[test]
    fn white_noise_has_power_one_and_a_lattice_one_peak() {
        let number = |k: u64| (crate::hash(k) >> 11) as f64 / (1u64 << 53) as f64;
        let white: Vec<[f64; 2]> = (0..2000)
            .map(|k| [number(2 * k), number(2 * k + 1)])
            .collect();
        let spectrum = radial_power_spectrum(&white, 40);
        assert_eq!(spectrum.len(), 40);
        let mean = spectrum[9..].iter().map(|(_, p)| p).sum::<f64>() / 31.0;
        assert!((mean - 1.0).abs() < 0.1, "{mean}");
        let lattice: Vec<[f64; 2]> = (0..400)
            .map(|k| [(k % 20) as f64 / 20.0, (k / 20) as f64 / 20.0])
            .collect();
        let spectrum = radial_power_spectrum(&lattice, 30);
        assert!(spectrum[..19].iter().all(|(_, power)| *power < 1e-9));
        assert!(spectrum[19].1 > 1.0);
    }
}
