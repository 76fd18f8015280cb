//! Numbers and vectors of hairs side by side.

use pelage_curves::Vec3;

/// Hairs side by side: two of the widest common vectors.
pub(super) const LANES: usize = 16;

/// One number of each of the hairs that are side by side.
pub(super) type Row = [f32; LANES];

/// One vector of each.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Rows([Row; 3]);

impl Rows {
    #[inline(always)]
    pub(super) fn get(&self, lane: usize) -> Vec3 {
        Vec3::new(self.0[0][lane], self.0[1][lane], self.0[2][lane])
    }

    #[inline(always)]
    pub(super) fn set(&mut self, lane: usize, vector: Vec3) {
        for (row, x) in self.0.iter_mut().zip(vector.to_array()) {
            row[lane] = x;
        }
    }

    /// A vector of each of the things that are side by side.
    #[inline(always)]
    pub(super) fn of<T>(things: &[T; LANES], vector: impl Fn(&T) -> Vec3) -> Self {
        let mut rows = Self::default();
        for (lane, one) in things.iter().enumerate() {
            rows.set(lane, vector(one));
        }
        rows
    }
}
