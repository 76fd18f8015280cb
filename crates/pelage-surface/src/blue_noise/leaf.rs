//! Roots that lie together, in a form in which all are compared with a box at once.

use super::ground::Site;
use super::hierarchy::Bounds;
use fearless_simd::{Simd, SimdBase, SimdMask, f32x16};
use pelage_curves::Vec3;

/// Roots in a leaf: as many as processors compare at once.
pub(crate) const LEAF: usize = 16;

/// Up to [`LEAF`] roots.
#[derive(Clone)]
pub(crate) struct Leaf {
    len: usize,
    position: [[f32; LEAF]; 3],
    closeness: [f32; LEAF],
    normal: [[f32; LEAF]; 3],
}

impl Leaf {
    pub(crate) const EMPTY: Leaf = Leaf {
        len: 0,
        position: [[0.0; LEAF]; 3],
        closeness: [0.0; LEAF],
        normal: [[0.0; LEAF]; 3],
    };

    /// Of [`LEAF`] roots at most.
    pub(crate) fn new(sites: &[Site]) -> Self {
        let mut leaf = Self::EMPTY;
        for site in sites {
            leaf.add(site);
        }
        leaf
    }

    /// Adds a root where there is room.
    #[inline(always)]
    pub(crate) fn add(&mut self, site: &Site) {
        let k = self.len % LEAF;
        for axis in 0..3 {
            self.position[axis][k] = site.position[axis];
            self.normal[axis][k] = site.normal[axis];
        }
        self.closeness[k] = site.closeness;
        self.len = k + 1;
    }

    #[inline(always)]
    pub(crate) fn is_full(&self) -> bool {
        self.len == LEAF
    }

    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        self.len = 0;
    }

    #[inline(always)]
    pub(crate) fn site(&self, k: usize) -> Site {
        let vector = |[x, y, z]: &[[f32; LEAF]; 3]| Vec3::new(x[k], y[k], z[k]);
        Site {
            position: vector(&self.position),
            closeness: self.closeness[k],
            normal: vector(&self.normal),
        }
    }

    /// Which roots have a [gap](Bounds::gap) to `bounds` less than `reach`: a bit each.
    #[inline(always)]
    pub(crate) fn near<S: Simd>(&self, simd: S, bounds: &Bounds, reach: f32) -> u64 {
        let nothing = f32x16::splat(simd, 0.0);
        let mut squares = nothing;
        for (axis, along) in self.position.iter().enumerate() {
            let along = f32x16::load_array_ref(simd, along);
            let (low, high) = (bounds.low[axis], bounds.high[axis]);
            let apart = (along - high).max(low - along).max(nothing);
            squares += apart * apart;
        }
        let closeness = f32x16::load_array_ref(simd, &self.closeness) * bounds.least;
        let near = (squares * closeness).simd_lt(reach);
        near.to_bitmask() & ((1 << self.len) - 1)
    }
}
