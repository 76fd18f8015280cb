//! An image read at many places of one triangle of texture space.
//!
//! Where the texels around the triangle lie in the image side by side, coordinates count
//! from the first of them, which leaves few digits to keep (f32 will do), and the
//! arithmetic of many places runs at once.

use crate::image_map::{bilinear, floor, wrapped};
use crate::{ImageMap, Wrap};
use pelage_curves::Vec2;

/// Places that go through the arithmetic together.
const LANES: usize = 16;

/// The place in a triangle of texture space that has the weights `u` and `v` of its second
/// and third corner.
#[inline(always)]
pub(crate) fn place([a, b, c]: [Vec2; 3], [u, v]: [f32; 2]) -> Vec2 {
    a * (1.0 - u - v) + b * u + c * v
}

impl ImageMap {
    /// Appends [`sample`](Self::sample) at places of a triangle of texture space: for each
    /// of `weights`, those of its second and third corner.
    #[inline(always)]
    pub(crate) fn sample_triangle(
        &self,
        corners: [Vec2; 3],
        weights: &[[f32; 2]],
        channel: u32,
        wrap: Wrap,
        values: &mut Vec<f32>,
    ) {
        let Some((window, inside)) = self.window(corners, channel, wrap) else {
            values.extend(weights.iter().map(|&weights| {
                let uv = place(corners, weights);
                self.sample(uv.x, uv.y, channel, wrap)
            }));
            return;
        };
        for row in weights.chunks(LANES) {
            let [mut x, mut y] = [[0.0; LANES]; 2];
            for k in 0..LANES {
                [x[k], y[k]] = place(inside, row[k.min(row.len() - 1)]).to_array();
            }
            values.extend_from_slice(&window.sample(&x, &y)[..row.len()]);
        }
    }

    /// The texels around a triangle, and its corners counted in them, if they lie in the
    /// image side by side.
    #[inline(always)]
    fn window(
        &self,
        corners: [Vec2; 3],
        channel: u32,
        wrap: Wrap,
    ) -> Option<(Window<'_>, [Vec2; 3])> {
        let size = [self.width(), self.height()];
        let texels = corners.map(|uv| self.texels_at(uv.to_array()));
        let (mut first, mut base, mut last) = ([0; 2], [0.0; 2], [0; 2]);
        for k in 0..2 {
            let [a, b, c] = texels.map(|t| t[k]);
            base[k] = floor(a.min(b).min(c));
            let span = floor(a.max(b).max(c)) - base[k];
            first[k] = wrapped(base[k], size[k], wrap);
            // In the mirrored tiles texels run the other way.
            let same = wrapped(base[k] + span + 1.0, size[k], wrap);
            let fits = span < size[k] as f64 && same == first[k] + span as u32 + 1;
            if !fits {
                return None;
            }
            last[k] = span as i32;
        }
        let channels = self.channels() as usize;
        let stride = self.width() as usize * channels;
        let channel = channel.min(self.channels() - 1) as usize;
        let window = Window {
            texels: &self.texels()
                [first[1] as usize * stride + first[0] as usize * channels + channel..],
            channels,
            stride,
            last,
        };
        let inside = |t: [f64; 2]| Vec2::new((t[0] - base[0]) as f32, (t[1] - base[1]) as f32);
        Some((window, texels.map(inside)))
    }
}

/// Texels of one channel that lie side by side in an image.
struct Window<'a> {
    texels: &'a [f32],
    channels: usize,
    stride: usize,
    /// Last column and row that has another beside it.
    last: [i32; 2],
}

impl Window<'_> {
    /// Bilinear values at `(x, y)`, counted from the centre of the first texel.
    #[inline(always)]
    fn sample(&self, x: &[f32; LANES], y: &[f32; LANES]) -> [f32; LANES] {
        let [mut across, mut down, mut values] = [[0.0; LANES]; 3];
        let [mut columns, mut rows] = [[0; LANES]; 2];
        for k in 0..LANES {
            columns[k] = (x[k] as i32).clamp(0, self.last[0]);
            rows[k] = (y[k] as i32).clamp(0, self.last[1]);
            across[k] = x[k] - columns[k] as f32;
            down[k] = y[k] - rows[k] as f32;
        }
        let mut around = [[0.0; LANES]; 4];
        for k in 0..LANES {
            let first = rows[k] as usize * self.stride + columns[k] as usize * self.channels;
            let four = &self.texels[first..first + self.stride + self.channels + 1];
            around[0][k] = four[0];
            around[1][k] = four[self.channels];
            around[2][k] = four[self.stride];
            around[3][k] = four[self.stride + self.channels];
        }
        for k in 0..LANES {
            values[k] = bilinear(around.each_ref().map(|row| row[k]), across[k], down[k]);
        }
        values
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::spots;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_triangle_reads_as_its_places_one_by_one(
            corners in prop::array::uniform3(prop::array::uniform2(-1.5f32..2.5)),
            size in 0.0f32..1.0,
            weights in prop::collection::vec((0.0f32..1.0, 0.0f32..1.0), 1..40),
        ) {
            let map = spots();
            // Small triangles lie inside the image, large ones do not.
            let corners = corners.map(|c| Vec2::from(corners[0]).lerp(c.into(), size));
            let inside = |&(u, v): &(f32, f32)| if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] };
            let weights: Vec<[f32; 2]> = weights.iter().map(inside).collect();
            for wrap in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
                let mut values = Vec::new();
                map.sample_triangle(corners, &weights, 0, wrap, &mut values);
                prop_assert_eq!(values.len(), weights.len());
                for (value, [u, v]) in values.into_iter().zip(&weights) {
                    let at = corners[0] * (1.0 - u - v) + corners[1] * *u + corners[2] * *v;
                    let expected = map.sample(at.x, at.y, 0, wrap);
                    // Texels go up to 10, over 1/64.
                    prop_assert!((value - expected).abs() < 0.01, "{wrap:?} {at} {value} {expected}");
                }
            }
        }
    }
}
