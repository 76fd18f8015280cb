//! Ways of drawing roots, ours and those it is measured against.

use super::maps::Map;
use pelage::surface::{Density, Distribution, Mesh, RootSampler, SurfacePoint, Wrap, hash};
use std::collections::VecDeque;
use std::sync::{Mutex, PoisonError};

/// A way of drawing roots, prepared for a surface and a map.
pub trait Method: Send + Sync {
    /// Writes the roots of the hairs from `first` on.
    fn fill(&self, first: u64, roots: &mut [SurfacePoint]);
    /// Bytes of its tables.
    fn bytes(&self) -> usize;
}

/// Names of the methods, in the order of the tables.
pub const METHODS: [&str; 4] = ["guided", "bisection", "alias", "rejection"];

/// Our own where the order of the hairs is of no matter; in a table of its own.
pub const INTERVAL: &str = "interval";

/// Prepares the method `name`.
pub fn prepare<'a>(name: &str, mesh: &'a Mesh, map: &'a Map) -> Box<dyn Method + 'a> {
    match name {
        "bisection" => Box::new(Bisection::new(mesh, map)),
        "alias" => Box::new(Alias::new(mesh, map)),
        "rejection" => Box::new(Rejection::new(mesh, map)),
        INTERVAL => Box::new(Interval::new(mesh, map)),
        _ => Box::new(Guided(sampler(mesh, map))),
    }
}

/// Our sampler of `mesh` by `map`.
pub fn sampler(mesh: &Mesh, map: &Map) -> RootSampler {
    let density = Density {
        value: 1.0,
        map: Some((&map.image, 0, Wrap::Repeat)),
    };
    // No map of ours is black.
    RootSampler::new(mesh, &density, 1).expect("some density")
}

/// Our sampler of `mesh`, which must have an area, of even density.
pub fn even_sampler(mesh: &Mesh, seed: u64) -> RootSampler {
    let even = Density {
        value: 1.0,
        map: None,
    };
    RootSampler::new(mesh, &even, seed).expect("an area")
}

/// Where the share of each element begins, in fractions of 2^64: the sum to bisect.
pub fn starts(distribution: &Distribution) -> Vec<u64> {
    (0..distribution.len())
        .map(|i| distribution.share(i).0)
        .collect()
}

/// Bytes of the pieces of `sampler`, found by `table` instead of its distribution.
fn bytes_with<T>(sampler: &RootSampler, table: &[T]) -> usize {
    sampler.bytes() - sampler.distribution().bytes() + size_of_val(table)
}

/// What Pelage does: [`RootSampler::fill`].
struct Guided(RootSampler);

impl Method for Guided {
    fn fill(&self, first: u64, roots: &mut [SurfacePoint]) {
        self.0.fill(first, roots);
    }

    fn bytes(&self) -> usize {
        self.0.bytes()
    }
}

/// [`RootSampler::fill_in`]: all of the surface in its own order.
struct Interval {
    sampler: RootSampler,
    indices: Mutex<Vec<u64>>,
}

impl Interval {
    fn new(mesh: &Mesh, map: &Map) -> Self {
        Self {
            sampler: sampler(mesh, map),
            indices: Mutex::default(),
        }
    }
}

impl Method for Interval {
    fn fill(&self, first: u64, roots: &mut [SurfacePoint]) {
        // Whatever another thread left there is written anew.
        let mut indices = self.indices.lock().unwrap_or_else(PoisonError::into_inner);
        indices.resize(roots.len(), 0);
        let hairs = first..first + roots.len() as u64;
        self.sampler.fill_in(0, 1 << 64, hairs, &mut indices, roots);
    }

    fn bytes(&self) -> usize {
        self.sampler.bytes()
    }
}

/// The same pieces and numbers; a piece is found by bisecting the whole sum.
struct Bisection {
    sampler: RootSampler,
    starts: Vec<u64>,
}

impl Bisection {
    fn new(mesh: &Mesh, map: &Map) -> Self {
        let sampler = sampler(mesh, map);
        Self {
            starts: starts(sampler.distribution()),
            sampler,
        }
    }
}

impl Method for Bisection {
    fn fill(&self, first: u64, roots: &mut [SurfacePoint]) {
        for (k, root) in roots.iter_mut().enumerate() {
            let (x, y) = self.sampler.sequence().sample(first + k as u64);
            let piece = self.starts.partition_point(|&start| start <= x) - 1;
            let start = self.starts[piece];
            let end = self.starts.get(piece + 1).copied().unwrap_or(u64::MAX);
            let along = (x - start) as f32 / (end - start).max(1) as f32;
            *root = self.sampler.place_in(piece, along, y);
        }
    }

    fn bytes(&self) -> usize {
        bytes_with(&self.sampler, &self.starts)
    }
}

/// Walker's table (Vose's way to fill it): a column and a coin for each sample, constant
/// time for any weights, at the price of all order among the samples.
struct Alias {
    sampler: RootSampler,
    /// For each column, up to which fraction it keeps its piece, and the other one.
    columns: Vec<(u32, u32)>,
}

impl Alias {
    fn new(mesh: &Mesh, map: &Map) -> Self {
        let sampler = sampler(mesh, map);
        let all = sampler.distribution();
        let count = all.len();
        let mut height: Vec<f64> = (0..count)
            .map(|i| all.probability(i) * count as f64)
            .collect();
        let mut columns: Vec<(u32, u32)> = (0..count as u32).map(|i| (u32::MAX, i)).collect();
        let (mut low, mut high): (VecDeque<usize>, VecDeque<usize>) =
            (0..count).partition(|&i| height[i] < 1.0);
        while let (Some(short), Some(&tall)) = (low.pop_front(), high.front()) {
            columns[short] = ((height[short] * (1u64 << 32) as f64) as u32, tall as u32);
            height[tall] -= 1.0 - height[short];
            if height[tall] < 1.0 {
                high.pop_front();
                low.push_back(tall);
            }
        }
        Self { sampler, columns }
    }
}

impl Method for Alias {
    fn fill(&self, first: u64, roots: &mut [SurfacePoint]) {
        for (k, root) in roots.iter_mut().enumerate() {
            let (x, y) = self.sampler.sequence().sample(first + k as u64);
            let wide = x as u128 * self.columns.len() as u128;
            let (column, inside) = ((wide >> 64) as usize, wide as u64);
            let coin = (inside >> 32) as u32;
            let (keep, other) = self.columns[column];
            let (piece, low, high) = if coin < keep {
                (column, 0, keep)
            } else {
                (other as usize, keep, u32::MAX)
            };
            // What is left of the number, stretched: Devroye's reuse.
            let along = (coin - low) as f32 / (high - low).max(1) as f32;
            *root = self.sampler.place_in(piece, along.min(1.0), y);
        }
    }

    fn bytes(&self) -> usize {
        bytes_with(&self.sampler, &self.columns)
    }
}

/// What document 004 compares with: a triangle by area, a place in it, and a coin
/// weighed by the map against its brightest texel.
struct Rejection<'a> {
    mesh: &'a Mesh,
    map: &'a Map,
    areas: Distribution,
    brightest: f32,
}

impl<'a> Rejection<'a> {
    fn new(mesh: &'a Mesh, map: &'a Map) -> Self {
        let areas: Vec<f64> = (0..mesh.triangles().len())
            .map(|t| mesh.area(t).max(f64::MIN_POSITIVE))
            .collect();
        Self {
            mesh,
            map,
            // Areas are positive, and their sum is that of a small surface.
            areas: Distribution::new(&areas).expect("areas"),
            brightest: map.image.texels().iter().fold(0.0, f32::max),
        }
    }

    fn try_one(&self, number: u64) -> (SurfacePoint, bool) {
        let (x, y, coin) = (hash(number), hash(number ^ !0), hash(number ^ 1 << 63));
        let pick = self.areas.pick(x);
        let unit = |word: u64| (word >> 40) as f32 / (1 << 24) as f32;
        let root = pick.rest.sqrt();
        let (u, v) = (1.0 - root, unit(y) * root);
        let place = SurfacePoint {
            triangle: pick.index as u32,
            barycentric: [(1.0 - u - v).max(0.0), u, v],
        };
        let uv = self.mesh.uv(&place);
        let density = self.map.image.sample(uv.x, uv.y, 0, Wrap::Repeat);
        (place, unit(coin) * self.brightest < density)
    }
}

impl Method for Rejection<'_> {
    fn fill(&self, first: u64, roots: &mut [SurfacePoint]) {
        for (k, root) in roots.iter_mut().enumerate() {
            let mut number = hash(first + k as u64);
            loop {
                let (place, taken) = self.try_one(number);
                if taken {
                    *root = place;
                    break;
                }
                number = number.wrapping_add(0x9e37_79b9_7f4a_7c15);
            }
        }
    }

    fn bytes(&self) -> usize {
        self.areas.bytes()
    }
}
