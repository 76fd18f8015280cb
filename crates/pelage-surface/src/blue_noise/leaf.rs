//! Roots that lie together, in a form in which all are compared with a box at once.

use super::ground::{ROW, Site};
use super::hierarchy::{Bounds, gaps};
use fearless_simd::{Simd, SimdBase, SimdMask};
use pelage_curves::Vec3;

/// Roots in a leaf: as many as processors compare at once.
pub(crate) const LEAF: usize = ROW;

/// Up to [`LEAF`] roots.
#[derive(Clone)]
#[repr(align(64))]
pub(crate) struct Leaf {
    position: [[f32; LEAF]; 3],
    closeness: [f32; LEAF],
    normal: [[f32; LEAF]; 3],
    len: usize,
}

impl Leaf {
    pub(crate) const EMPTY: Leaf = Leaf {
        len: 0,
        position: [[0.0; LEAF]; 3],
        closeness: [0.0; LEAF],
        normal: [[0.0; LEAF]; 3],
    };

    /// Of one root.
    #[inline(always)]
    pub(crate) fn of(site: &Site) -> Self {
        let mut leaf = Self::EMPTY;
        leaf.add(site);
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

    pub(crate) fn len(&self) -> usize {
        self.len
    }

    #[inline(always)]
    pub(crate) fn is_full(&self) -> bool {
        self.len == LEAF
    }

    pub(crate) fn bounds(&self) -> Bounds {
        Bounds::around((0..self.len).map(|k| self.site(k).bounds()))
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
        let positions = [&self.position, &self.position];
        let near = gaps(simd, positions, &self.closeness, bounds).simd_lt(reach);
        near.to_bitmask() & ((1 << self.len) - 1)
    }
}
