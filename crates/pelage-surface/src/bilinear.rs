//! Places between texels.

/// The four texels around a place and how far it lies between them.
pub(crate) struct Around {
    pub columns: [u32; 2],
    pub rows: [u32; 2],
    pub across: f32,
    pub down: f32,
}

impl Around {
    #[inline(always)]
    pub(crate) fn texels(&self, texel: impl Fn(u32, u32) -> f32) -> f32 {
        self.blend(|i, j| texel(self.columns[i], self.rows[j]))
    }

    /// Mixes the four values `at(i, j)` of column `i` and row `j` of these.
    #[inline(always)]
    pub(crate) fn blend(&self, at: impl Fn(usize, usize) -> f32) -> f32 {
        let four = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)];
        bilinear(four, self.across, self.down)
    }
}

/// Where the four texels around a place begin, and how far it lies between them.
#[derive(Clone, Copy, Default)]
pub(crate) struct Corners {
    pub starts: [usize; 4],
    pub across: f32,
    pub down: f32,
}

impl Corners {
    #[inline(always)]
    pub(crate) fn blend(&self, texel: impl Fn(usize) -> f32) -> f32 {
        bilinear(self.starts.map(texel), self.across, self.down)
    }
}

/// Mixes four values, two of a row and two of the row below. Written as differences so
/// that equal values give that very value.
#[inline(always)]
pub(crate) fn bilinear([a, b, c, d]: [f32; 4], across: f32, down: f32) -> f32 {
    let (above, below) = (a + (b - a) * across, c + (d - c) * across);
    above + (below - above) * down
}
