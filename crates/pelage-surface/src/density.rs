//! How dense hair grows, as cutting triangles asks.

use crate::lanes::LANES;
use crate::window::{Corners, Row, place};
use crate::{ImageMap, Wrap};
use pelage_curves::Vec2;

/// Hair density over a surface: a number, or a number times a channel of a map.
#[derive(Clone, Copy, Debug)]
pub struct Density<'a> {
    /// The factor, at least 0.
    pub value: f32,
    /// Map, channel and wrap.
    pub map: Option<(&'a ImageMap, u32, Wrap)>,
}

/// What cutting asks of a density.
pub(crate) trait DensityField: Sync {
    /// The factor everywhere, at least 0.
    fn value(&self) -> f32;

    /// Columns and rows that the finest image in a triangle with corners at `uv` has in
    /// a unit of texture; `None` where the density is the same all over the triangle.
    fn texels(&self, uv: [Vec2; 3]) -> Option<[u32; 2]>;

    /// What the factor is multiplied by at `uv`.
    fn at(&self, uv: Vec2) -> f32;

    /// Writes [`at`](Self::at) for each of `weights` of the second and third of `corners`
    /// to `values`, of the same length.
    #[inline(always)]
    fn read(&self, corners: [Vec2; 3], weights: &[[f32; 2]], values: &mut [f32]) {
        for (value, &weights) in values.iter_mut().zip(weights) {
            *value = self.at(place(corners, weights));
        }
    }

    /// The same in triangles side by side: for each of `weights` a row of what is there in
    /// each.
    #[inline(always)]
    fn read_all(&self, corners: &Corners, weights: &[[f32; 2]], values: &mut [Row]) {
        for (row, &weights) in values.iter_mut().zip(weights) {
            for (lane, value) in row.iter_mut().enumerate() {
                *value = self.at(place(corners.get(lane), weights));
            }
        }
    }

    /// The same for as many weights as there are lanes: for each triangle a row of what is there
    /// at each.
    #[inline(always)]
    fn read_each(&self, corners: &Corners, weights: &[[f32; 2]; LANES], values: &mut [Row; LANES]) {
        for (lane, row) in values.iter_mut().enumerate() {
            self.read(corners.get(lane), weights, row);
        }
    }
}

impl DensityField for Density<'_> {
    fn value(&self) -> f32 {
        self.value
    }

    #[inline(always)]
    fn texels(&self, _: [Vec2; 3]) -> Option<[u32; 2]> {
        self.map.map(|(map, ..)| [map.width(), map.height()])
    }

    #[inline(always)]
    fn at(&self, uv: Vec2) -> f32 {
        let sample =
            |(map, channel, wrap): (&ImageMap, _, _)| map.sample(uv.x, uv.y, channel, wrap);
        self.map.map_or(1.0, sample)
    }

    #[inline(always)]
    fn read(&self, corners: [Vec2; 3], weights: &[[f32; 2]], values: &mut [f32]) {
        match self.map {
            Some((map, channel, wrap)) => {
                map.sample_triangle(corners, weights, channel, wrap, values)
            }
            None => values.fill(1.0),
        }
    }

    #[inline(always)]
    fn read_all(&self, corners: &Corners, weights: &[[f32; 2]], values: &mut [Row]) {
        match self.map {
            Some((map, channel, wrap)) => {
                map.sample_triangles(corners, weights, channel, wrap, values)
            }
            None => values.fill([1.0; LANES]),
        }
    }

    #[inline(always)]
    fn read_each(&self, corners: &Corners, weights: &[[f32; 2]; LANES], values: &mut [Row; LANES]) {
        match self.map {
            Some((map, channel, wrap)) => map.sample_each(corners, weights, channel, wrap, values),
            None => values.fill([1.0; LANES]),
        }
    }
}
