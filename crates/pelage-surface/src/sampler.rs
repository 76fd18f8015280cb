//! Roots of hairs on a surface, in proportion to a density.
//!
//! Source: document 004, section 2.1, with the errata applied and the laws of the
//! design: root `i` depends on the seed and `i` alone; more roots keep the old ones;
//! the roots of a region can be listed without making the others. Triangles lie along
//! a Hilbert curve through the rest pose, so that the stratification of the first
//! number becomes one in space, and a region becomes a few intervals of it.

use crate::density::{Density, DensityField};
use crate::distribution::Distribution;
use crate::pieces::Pieces;
use crate::subdivide::{Piece, Plan};
use crate::sums::Sums;
use crate::triangle_order::along_curve;
use crate::{Mesh, RootSequence, Spread, SurfacePoint, TiledDensity};

/// Draws roots on a mesh in proportion to a density.
#[derive(Clone, Debug)]
pub struct RootSampler {
    distribution: Distribution,
    pieces: Pieces,
    sequence: RootSequence,
    seed: u64,
}

impl RootSampler {
    /// A sampler of `mesh` at rest by `density`, for the hairs of `seed`; `None` where
    /// no piece of the surface has any density (no hair can grow).
    pub fn new(mesh: &Mesh, density: &Density, seed: u64) -> Option<Self> {
        Self::by(mesh, density, seed)
    }

    /// As [`new`](Self::new), by a density that is painted on UDIM tiles.
    pub fn tiled(mesh: &Mesh, density: &TiledDensity, seed: u64) -> Option<Self> {
        Self::by(mesh, density, seed)
    }

    fn by(mesh: &Mesh, density: &impl DensityField, seed: u64) -> Option<Self> {
        let (pieces, sums) = pieces(mesh, density)?;
        Some(Self {
            distribution: Distribution::of_sums(sums)?,
            pieces,
            sequence: RootSequence::new(seed, Spread::default()),
            seed,
        })
    }

    /// The same roots spread in another way.
    pub fn with_spread(self, spread: Spread) -> Self {
        Self {
            sequence: RootSequence::new(self.seed, spread),
            ..self
        }
    }

    /// Root of hair `index`. For many, [`roots`](Self::roots) is several times faster.
    pub fn root(&self, index: u64) -> SurfacePoint {
        let (x, y) = self.sequence.sample(index);
        self.place(x, y)
    }

    /// The place that the fraction `x` (of 2^64) and `y` (of 2^32) lead to. Points that
    /// are evenly spread over the unit square come out in proportion to the density.
    pub fn place(&self, x: u64, y: u32) -> SurfacePoint {
        let (piece, [inside, width]) = self.distribution.tables().locate(x);
        self.place_in(piece, inside as f32 / width as f32, y)
    }

    /// The place `along` (0..=1) and `y` (a fraction of 2^32) inside piece `piece`, for
    /// whoever picks pieces in another way.
    ///
    /// Panics where there is no such piece.
    #[inline]
    pub fn place_in(&self, piece: usize, along: f32, y: u32) -> SurfacePoint {
        let (triangle, part) = self.pieces.get(piece);
        let root = along.sqrt();
        SurfacePoint {
            triangle,
            barycentric: part.barycentric(1.0 - root, fraction(y) * root),
        }
    }

    /// Whether the hairs that share the upper `bits` bits of their first number with hair
    /// `index` lie in no more than `most` pieces, more or less.
    #[inline(always)]
    pub(crate) fn are_neighbours(&self, index: u64, bits: u32, most: u32) -> bool {
        let rest = u64::MAX.checked_shr(bits).unwrap_or(0);
        let (x, _) = self.sequence.sample(index);
        self.distribution.tables().between(x & !rest, x | rest) < most
    }

    /// Area of the surface, each part weighed by its density.
    pub fn weighted_area(&self) -> f64 {
        self.distribution.total()
    }

    /// The centre of each piece, as a place on `mesh`: somewhere in every part of the
    /// surface where hair can grow.
    pub fn piece_centres(&self) -> impl Iterator<Item = SurfacePoint> {
        self.pieces.iter().map(|(triangle, part)| SurfacePoint {
            triangle,
            barycentric: part.centre(),
        })
    }

    /// Number of pieces of constant density.
    pub fn piece_count(&self) -> usize {
        self.pieces.len()
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.distribution.bytes() + self.pieces.bytes()
    }

    pub(crate) fn pieces(&self) -> &Pieces {
        &self.pieces
    }

    /// How likely each piece is.
    pub fn distribution(&self) -> &Distribution {
        &self.distribution
    }

    /// The seed of the roots.
    pub(crate) fn seed(&self) -> u64 {
        self.seed
    }

    /// The two numbers of each hair.
    pub fn sequence(&self) -> &RootSequence {
        &self.sequence
    }
}

/// The pieces of `mesh` along the curve, and the sums of their weights; `None` for more than
/// can be named.
fn pieces(mesh: &Mesh, density: &impl DensityField) -> Option<(Pieces, Sums)> {
    let (order, triangles) = (along_curve(mesh), mesh.triangles().len() as u32);
    let plan = Plan::new(mesh, &order, density);
    let deepest = plan.deepest();
    match Pieces::part_bits(triangles, deepest) {
        Some(bits) => {
            let cut = plan.cut(bits);
            Some((Pieces::packed(cut.names, triangles, deepest), cut.sums))
        }
        None => {
            let cut = plan.cut::<Piece>(0);
            Some((Pieces::new(&cut.names, triangles)?, cut.sums))
        }
    }
}

/// The upper bits of `y` that a float can hold, as a number in 0..1.
#[inline(always)]
fn fraction(y: u32) -> f32 {
    (y >> 8) as i32 as f32 * (1.0 / (1 << 24) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::{sheet, spots};
    use crate::{ImageMap, Wrap};

    #[test]
    fn roots_follow_area_times_density() {
        let (mesh, map) = (sheet(9), spots());
        let density = Density {
            value: 2.0,
            map: Some((&map, 0, Wrap::Clamp)),
        };
        let sampler = RootSampler::new(&mesh, &density, 3).unwrap();
        let n = 40_000u64;
        let triangles = mesh.triangles().len();
        let mut counts = vec![0f64; triangles];
        (0..n).for_each(|i| counts[sampler.root(i).triangle as usize] += 1.0);
        let mut expected = vec![0.0; triangles];
        for (piece, (triangle, _)) in sampler.pieces.iter().enumerate() {
            expected[triangle as usize] += sampler.distribution.probability(piece);
        }
        let scale = n as f64 / expected.iter().sum::<f64>();
        let chi_square: f64 = counts
            .iter()
            .zip(&expected)
            .filter(|(_, e)| **e > 0.0)
            .map(|(c, e)| (c - e * scale) * (c - e * scale) / (e * scale))
            .sum();
        // A stratified sequence stays far below the number of degrees of freedom.
        assert!(
            chi_square < triangles as f64,
            "{chi_square} for {triangles} triangles"
        );
        assert!(
            counts
                .iter()
                .zip(&expected)
                .all(|(c, e)| *e > 0.0 || *c == 0.0)
        );
    }

    #[test]
    fn where_the_map_is_black_nothing_grows() {
        let mesh = sheet(3);
        let black = ImageMap::new(2, 2, 1, vec![0.0; 4], false).unwrap();
        let density = Density {
            value: 1.0,
            map: Some((&black, 0, Wrap::Repeat)),
        };
        assert!(RootSampler::new(&mesh, &density, 0).is_none());
    }

    #[test]
    fn constant_maps_cost_one_piece_a_triangle() {
        let mesh = sheet(3);
        let grey = ImageMap::new(64, 64, 1, vec![0.5; 4096], false).unwrap();
        let density = Density {
            value: 1.0,
            map: Some((&grey, 0, Wrap::Repeat)),
        };
        let sampler = RootSampler::new(&mesh, &density, 0).unwrap();
        assert_eq!(sampler.piece_count(), mesh.triangles().len());
    }

    #[test]
    fn barycentrics_are_weights() {
        let (mesh, map) = (sheet(4), spots());
        let density = Density {
            value: 1.0,
            map: Some((&map, 0, Wrap::Repeat)),
        };
        let sampler = RootSampler::new(&mesh, &density, 11).unwrap();
        for i in 0..5000 {
            let b = sampler.root(i).barycentric;
            assert!(b.iter().all(|w| (0.0..=1.0).contains(w)), "{b:?}");
            assert!((b.iter().sum::<f32>() - 1.0).abs() < 1e-6);
        }
    }
}
