//! An image read at many places of one triangle of texture space.
//!
//! Where the texels around the triangle lie in the image side by side, coordinates count
//! from the first of them, which leaves few digits to keep (f32 will do), and the
//! arithmetic of many places runs at once.

use crate::image_map::{bilinear, floor, wrapped};
use crate::texels::{Numbers, Texels, with_numbers};
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
    /// Writes [`sample`](Self::sample) at places of a triangle of texture space to `values`:
    /// for each of `weights`, those of its second and third corner.
    #[inline(always)]
    pub(crate) fn sample_triangle(
        &self,
        corners: [Vec2; 3],
        weights: &[[f32; 2]],
        channel: u32,
        wrap: Wrap,
        values: &mut [f32],
    ) {
        with_numbers!(self.texels(), numbers => {
            match self.window(numbers, corners, channel, wrap) {
                Some((window, inside)) => window.sample_all(inside, weights, values),
                None => {
                    for (value, &weights) in values.iter_mut().zip(weights) {
                        let uv = place(corners, weights);
                        *value = self.sample(uv.x, uv.y, channel, wrap);
                    }
                }
            }
        })
    }

    /// The texels around a triangle, and its corners counted in them, if they lie in the
    /// image side by side.
    #[inline(always)]
    fn window<T: Numbers>(
        &self,
        numbers: T,
        corners: [Vec2; 3],
        channel: u32,
        wrap: Wrap,
    ) -> Option<(Window<T>, [Vec2; 3])> {
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
        let start = first[1] as usize * stride + first[0] as usize * channels + channel;
        // Of the last row but one; the same number follows a row below.
        let len = last[1] as usize * stride + (last[0] as usize + 1) * channels + 1;
        let window = Window {
            upper: numbers.part(start, len),
            lower: numbers.part(start + stride, len),
            channels: channels as u32,
            stride: stride as u32,
            last,
        };
        let inside = |t: [f64; 2]| Vec2::new((t[0] - base[0]) as f32, (t[1] - base[1]) as f32);
        Some((window, texels.map(inside)))
    }
}

/// Texels of one channel that lie side by side in an image.
struct Window<T> {
    /// From the first on, without the last row.
    upper: T,
    /// The same from the second row on.
    lower: T,
    channels: u32,
    stride: u32,
    /// Last column and row that has another beside it.
    last: [i32; 2],
}

impl<T: Numbers> Window<T> {
    /// Writes the values at places of a triangle whose corners count from the centre of the
    /// first texel: for each of `weights`, those of its second and third corner.
    #[inline(always)]
    fn sample_all(&self, inside: [Vec2; 3], weights: &[[f32; 2]], values: &mut [f32]) {
        let (rows, rest) = weights.as_chunks::<LANES>();
        let (whole, values) = values.split_at_mut(weights.len() - rest.len());
        for (row, values) in rows.iter().zip(whole.as_chunks_mut().0) {
            *values = self.sample(inside, row);
        }
        if !rest.is_empty() {
            let mut row = [[0.0; 2]; LANES];
            row[..rest.len()].copy_from_slice(rest);
            values.copy_from_slice(&self.sample(inside, &row)[..rest.len()]);
        }
    }

    /// Bilinear values at places of a triangle whose `corners` count from the centre of the
    /// first texel.
    #[inline(always)]
    fn sample(&self, corners: [Vec2; 3], weights: &[[f32; 2]; LANES]) -> [f32; LANES] {
        let [mut across, mut down, mut values] = [[0.0; LANES]; 3];
        let mut first = [0; LANES];
        for k in 0..LANES {
            let [x, y] = place(corners, weights[k]).to_array();
            let column = (x as i32).clamp(0, self.last[0]);
            let row = (y as i32).clamp(0, self.last[1]);
            across[k] = x - column as f32;
            down[k] = y - row as f32;
            first[k] = row as u32 * self.stride + column as u32 * self.channels;
        }
        let mut around = [[0.0; LANES]; 4];
        // The two are of one length, and 64 bits do not overflow: one test is enough.
        let (upper, lower) = (self.upper, self.lower.part(0, self.upper.count()));
        for k in 0..LANES {
            let left = first[k] as usize;
            let right = left + self.channels as usize;
            around[1][k] = upper.number(right);
            around[3][k] = lower.number(right);
            around[0][k] = upper.number(left);
            around[2][k] = lower.number(left);
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
                let mut values = vec![0.0; weights.len()];
                map.sample_triangle(corners, &weights, 0, wrap, &mut values);
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
