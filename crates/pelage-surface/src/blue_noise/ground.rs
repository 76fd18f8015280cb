//! The surface as candidates need it: one number leads to a place, along a curve.
//!
//! The shares of the pieces follow each other along a Hilbert curve; here the curve goes
//! on inside each piece. The digits to base 4 of the fraction of a share name a part of
//! the piece, a part of that part, and so on (Basu and Owen 2015, "Low discrepancy
//! constructions in the triangle"), so fractions that are near lead to places that are
//! near, equal intervals get equal mass, and a run of candidates needs no sorting to be
//! a cluster in space.

use super::hierarchy::Bounds;
use crate::part::Part;
use crate::{Mesh, RootSampler};
use fearless_simd::{Level, dispatch};
use pelage_curves::Vec3;
use rayon::prelude::*;

/// A surface scaled to unit area, and its density.
pub(crate) struct Ground<'a> {
    mesh: &'a Mesh,
    sampler: &'a RootSampler,
    normals: Vec<Vec3>,
    /// Area before each piece, and of all; unscaled.
    before: Vec<f64>,
    /// Of each piece.
    closeness: Vec<f32>,
    /// Sum of the steps of the closeness up to each piece; a step counts at most
    /// as a half, so that a few steep ones, as at an edge, make no rough ground.
    steps: Vec<f64>,
    /// What of the mesh becomes the origin.
    centre: Vec3,
    scale: f32,
}

/// Fractions followed at once.
pub(crate) const LANES: usize = 64;

/// Lanes computed at once. Pieces end anywhere, so what is computed of one runs over
/// into the lanes of the next, which come later.
pub(crate) const ROW: usize = 16;

/// Where [`LANES`] fractions lead.
#[derive(Clone)]
pub(crate) struct Places {
    /// Positions on the surface of unit area.
    pub x: [f32; LANES + ROW],
    pub y: [f32; LANES + ROW],
    pub z: [f32; LANES + ROW],
    /// Weight of the triangle's second corner.
    pub u: [f32; LANES + ROW],
    /// Weight of the triangle's third corner.
    pub v: [f32; LANES + ROW],
    /// By what to multiply distances.
    pub closeness: [f32; LANES + ROW],
    pub triangle: [u32; LANES + ROW],
    pub piece: [u32; LANES + ROW],
}

impl Places {
    pub(crate) const fn new() -> Self {
        Self {
            x: [0.0; LANES + ROW],
            y: [0.0; LANES + ROW],
            z: [0.0; LANES + ROW],
            u: [0.0; LANES + ROW],
            v: [0.0; LANES + ROW],
            closeness: [0.0; LANES + ROW],
            triangle: [0; LANES + ROW],
            piece: [0; LANES + ROW],
        }
    }
}

/// Ascending fractions of the mass.
pub(crate) struct Fractions([u64; LANES + ROW]);

impl Fractions {
    /// `LANES` numbers from a function that does not descend.
    #[inline(always)]
    pub(crate) fn new(fraction: impl Fn(usize) -> u64) -> Self {
        let mut fractions = [u64::MAX; LANES + ROW];
        for (lane, x) in fractions[..LANES].iter_mut().enumerate() {
            *x = fraction(lane).min(u64::MAX - 1);
        }
        Self(fractions)
    }
}

impl<'a> Ground<'a> {
    pub(crate) fn new(mesh: &'a Mesh, sampler: &'a RootSampler) -> Self {
        let mut before = Vec::with_capacity(sampler.piece_count() + 1);
        let mut area = 0.0;
        before.push(area);
        for (triangle, part) in sampler.pieces().iter() {
            let side = part.size as f64;
            area += mesh.area(triangle as usize) * side * side;
            before.push(area);
        }
        let closeness: Vec<f32> = before
            .windows(2)
            .enumerate()
            .map(|(piece, ends)| {
                let mass = sampler.distribution().probability(piece);
                closeness(mass, (ends[1] - ends[0]) / area)
            })
            .collect();
        let (low, high) = mesh.bounds();
        Self {
            mesh,
            sampler,
            normals: normals(mesh),
            before,
            steps: steps(&closeness),
            closeness,
            centre: low * 0.5 + high * 0.5,
            // The smallest meshes would need more: they stay smaller.
            scale: (1.0 / area.sqrt()).min(f32::MAX as f64) as f32,
        }
    }

    /// Unit normals of the triangles; 0 where they have no area.
    pub(crate) fn normals(&self) -> &[Vec3] {
        &self.normals
    }

    /// By what to multiply distances on `piece`.
    pub(crate) fn closeness(&self, piece: u32) -> f32 {
        self.closeness[piece as usize]
    }

    /// The longest distance there is, squared.
    pub(crate) fn extent(&self) -> f64 {
        let (low, high) = self.mesh.bounds();
        ((high - low) * self.scale).as_dvec3().length_squared()
    }

    /// What `found` makes of the place of each of `fractions`, which ascend; in rows.
    pub(crate) fn rows<T: Send>(
        &self,
        fractions: &[u64],
        found: impl Fn(&Places, usize, u64) -> T + Sync,
    ) -> Vec<Vec<T>> {
        let row = |row: &[u64]| {
            let mut places = Places::new();
            let last = row.len() - 1;
            let fractions = std::array::from_fn(|lane| row[lane.min(last)].min(u64::MAX - 1));
            dispatch!(Level::new(), simd => {
                let _ = simd;
                self.scattered(&fractions, &mut places)
            });
            let found = |(lane, &x): (usize, &u64)| found(&places, lane, x);
            row.iter().enumerate().map(found).collect()
        };
        fractions.par_chunks(LANES).map(row).collect()
    }

    /// Follows ascending fractions of the mass to their places.
    #[inline(always)]
    pub(crate) fn places(&self, fractions: &Fractions, places: &mut Places) {
        let xs = &fractions.0;
        let mut lane = 0;
        while lane < LANES {
            let (piece, share) = self.sampler.distribution().tables().share_around(xs[lane]);
            let run = self.run(piece, share);
            loop {
                run.places(xs, lane, places);
                // Counts the lanes of this piece in the row.
                let inside = |x: &u64| (*x - share.0 < share.1) as usize;
                let done: usize = xs[lane..lane + ROW].iter().map(inside).sum();
                lane += done;
                if done < ROW || lane >= LANES {
                    break;
                }
            }
        }
    }

    /// As [`places`](Self::places), of fractions that mostly fall in a piece each: they
    /// share nothing but the arithmetic.
    #[inline(always)]
    fn scattered(&self, xs: &[u64; LANES], places: &mut Places) {
        let tables = self.sampler.distribution().tables();
        let runs: [Run; LANES] = std::array::from_fn(|lane| {
            let (piece, share) = tables.share_around(xs[lane]);
            self.run(piece, share)
        });
        let mut weights = [[0.0; 2]; LANES];
        for lane in 0..LANES {
            weights[lane] = along_curve(runs[lane].rest(xs[lane]));
        }
        for (lane, run) in runs.iter().enumerate() {
            run.write(&[weights[lane]], lane, places);
        }
    }

    #[inline(always)]
    fn run(&self, piece: usize, (start, width): (u64, u64)) -> Run {
        let (triangle, part) = self.sampler.pieces().get(piece);
        let [a, b, c] = self.mesh.corners(triangle as usize);
        Run {
            piece: piece as u32,
            triangle,
            closeness: self.closeness[piece],
            part,
            start,
            scale: 4_294_967_296.0 / (width >> 1 | 1) as f64,
            corner: (a - self.centre) * self.scale,
            sides: [(b - a) * self.scale, (c - a) * self.scale],
        }
    }

    /// How far along the curve the fraction `x` of the mass is.
    pub(crate) fn milestone(&self, x: u64) -> Milestone {
        let (piece, (start, width)) = self.sampler.distribution().tables().share_around(x);
        let (low, high) = (self.before[piece], self.before[piece + 1]);
        let area = low + (high - low) * ((x - start) as f64 / width as f64);
        Milestone {
            piece,
            area: area / self.before[self.before.len() - 1],
            steps: self.steps[piece],
        }
    }
}

/// What lies before a place on the curve.
#[derive(Clone, Copy)]
pub(crate) struct Milestone {
    /// Number of pieces.
    piece: usize,
    /// Fraction of the area.
    area: f64,
    /// Sum of the steps of the closeness from piece to piece, as parts of the lower.
    steps: f64,
}

/// Pieces that an average is taken over at least.
const MANY: usize = 8;

/// Mean step of the closeness from piece to piece on rough ground.
const ROUGH: f64 = 0.1;

impl Milestone {
    /// The closeness of all that lies between two milestones, where it holds `mass` and
    /// its density jumps from piece to piece, too often for roots to follow.
    pub(crate) fn rough(&self, next: &Milestone, mass: f64) -> Option<f32> {
        let pieces = next.piece - self.piece;
        let steps = next.steps - self.steps;
        let rough = pieces >= MANY && steps > ROUGH * pieces as f64;
        rough.then(|| closeness(mass, next.area - self.area))
    }
}

fn normals(mesh: &Mesh) -> Vec<Vec3> {
    let normal = |triangle| {
        let [a, b, c] = mesh.corners(triangle).map(|p| p.as_dvec3());
        let normal = (b - a).cross(c - a);
        normal.try_normalize().unwrap_or_default().as_vec3()
    };
    let triangles = 0..mesh.triangles().len();
    triangles.into_par_iter().map(normal).collect()
}

/// Sum of the steps up to each piece.
fn steps(closeness: &[f32]) -> Vec<f64> {
    let (mut last, mut sum) = (closeness[0], 0.0);
    let step = |&closeness: &f32| {
        let (least, most) = (closeness.min(last), closeness.max(last));
        last = closeness;
        sum += (most / least - 1.0).min(0.5) as f64;
        sum
    };
    closeness.iter().map(step).collect()
}

/// By what to multiply distances where `mass` lies on `area`, both fractions of the
/// whole: the root of the density relative to its mean.
fn closeness(mass: f64, area: f64) -> f32 {
    (mass / area.max(f64::MIN_POSITIVE)).sqrt().clamp(1e-9, 1e9) as f32
}

/// What fractions that fall in one piece share.
struct Run {
    piece: u32,
    triangle: u32,
    closeness: f32,
    part: Part,
    /// Where the piece's share begins.
    start: u64,
    /// Turns half the way into the share into a fraction of 2^32.
    scale: f64,
    corner: Vec3,
    sides: [Vec3; 2],
}

impl Run {
    /// Places a row of fractions, as if all fell in this piece.
    #[inline(always)]
    fn places(&self, xs: &[u64; LANES + ROW], first: usize, places: &mut Places) {
        let mut row = [0; ROW];
        row.copy_from_slice(&xs[first..first + ROW]);
        let mut weights = [[0.0; 2]; ROW];
        for k in 0..ROW {
            weights[k] = along_curve(self.rest(row[k]));
        }
        self.write(&weights, first, places);
    }

    /// How far into the share of the piece `x` is, as a fraction of 2^32.
    #[inline(always)]
    fn rest(&self, x: u64) -> u32 {
        // Halved, it fits the signed integers that processors turn into floats.
        let inside = (x.wrapping_sub(self.start) >> 1) as i64 as f64;
        (inside * self.scale) as u32
    }

    /// Writes the places that have `weights` in the piece, from lane `first` on. By way of
    /// arrays of their own, whose loops need no test of bounds and so become one step.
    #[inline(always)]
    fn write<const N: usize>(&self, weights: &[[f32; 2]; N], first: usize, places: &mut Places) {
        let ([along, across], corner, part) = (self.sides, self.corner, self.part);
        let [mut u, mut v, mut x, mut y, mut z] = [[0.0; N]; 5];
        for k in 0..N {
            [u[k], v[k]] = part.at(weights[k][0], weights[k][1]);
            x[k] = corner.x + along.x * u[k] + across.x * v[k];
            y[k] = corner.y + along.y * u[k] + across.y * v[k];
            z[k] = corner.z + along.z * u[k] + across.z * v[k];
        }
        let lanes = first..first + N;
        places.u[lanes.clone()].copy_from_slice(&u);
        places.v[lanes.clone()].copy_from_slice(&v);
        places.x[lanes.clone()].copy_from_slice(&x);
        places.y[lanes.clone()].copy_from_slice(&y);
        places.z[lanes.clone()].copy_from_slice(&z);
        places.closeness[lanes.clone()].fill(self.closeness);
        places.triangle[lanes.clone()].fill(self.triangle);
        places.piece[lanes].fill(self.piece);
    }
}

/// A root taken, as its surroundings see it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Site {
    pub position: Vec3,
    /// Distances count as multiplied by the geometric mean of both ends' closeness.
    pub closeness: f32,
    /// Of the triangle; of unit length.
    pub normal: Vec3,
}

impl Site {
    #[inline(always)]
    pub(crate) fn bounds(&self) -> Bounds {
        Bounds {
            low: self.position,
            high: self.position,
            least: self.closeness,
        }
    }
}

/// Where the fraction `rest` of 2^32 of the curve through the triangle (0, 0), (1, 0),
/// (0, 1) lies: its digits to base 4 name children as [`Part::children`] does, and the
/// place is the centre of the last. All sixteen steps at once: a step adds or, inside an
/// odd number of middle parts, subtracts a power of two.
///
/// [`Part::children`]: crate::part::Part::children
#[inline(always)]
fn along_curve(rest: u32) -> [f32; 2] {
    let (high, low) = (every_second(rest >> 1), every_second(rest));
    let turns = !high & low;
    let mut turned = turns >> 1;
    turned ^= turned >> 1;
    turned ^= turned >> 2;
    turned ^= turned >> 4;
    turned ^= turned >> 8;
    let third = if (turned ^ turns) & 1 == 0 {
        1.0 / 3.0
    } else {
        -1.0 / 3.0
    };
    let sum = |steps: u32| (steps & !turned) as i32 - (steps & turned) as i32;
    let place = |steps| (sum(steps) as f32 + third) * (1.0 / 65536.0);
    [place(high ^ low), place(low)]
}

/// The even bits of a word, close together.
#[inline(always)]
fn every_second(x: u32) -> u32 {
    let x = x & 0x5555_5555;
    let x = (x | x >> 1) & 0x3333_3333;
    let x = (x | x >> 2) & 0x0f0f_0f0f;
    let x = (x | x >> 4) & 0x00ff_00ff;
    (x | x >> 8) & 0x0000_ffff
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_follows_the_children_of_children() {
        for rest in (0..1000u32).map(|k| k.wrapping_mul(0x9e37_79b9)) {
            let part = (0..16).fold(Part::WHOLE, |part, digit| {
                part.children()[(rest >> (30 - 2 * digit) & 3) as usize]
            });
            let [_, u, v] = part.centre();
            let [p, q] = along_curve(rest);
            assert!((u - p).abs() < 1e-6 && (v - q).abs() < 1e-6, "{rest}");
        }
    }
}
