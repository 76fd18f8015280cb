//! An image read at many places of triangles of texture space.
//!
//! Where the texels around a triangle lie in the image side by side, coordinates count
//! from the first of them, which leaves few digits to keep (f32 will do), and the
//! arithmetic of many places runs at once: of the places of one triangle or, where
//! triangles have few each, of one place in each of many.

use crate::bilinear::bilinear;
use crate::lanes::{LANES, low_word};
use crate::texels::{Numbers, Texels, with_numbers};
use crate::wrap::wrapped;
use crate::{ImageMap, Wrap};
use pelage_curves::Vec2;

/// Texels from which on a float could not tell where between two of them a place is.
const WIDEST: f64 = (1 << 22) as f64;

/// A number of each of them.
pub(crate) type Row = [f32; LANES];

/// The place in a triangle of texture space that has the weights `u` and `v` of its second
/// and third corner.
#[inline(always)]
pub(crate) fn place([a, b, c]: [Vec2; 3], [u, v]: [f32; 2]) -> Vec2 {
    a * (1.0 - u - v) + b * u + c * v
}

/// Triangles of texture space side by side: of each corner all u, then all v.
#[derive(Clone, Copy)]
pub(crate) struct Corners<const N: usize = LANES>([[[f32; N]; 2]; 3]);

impl<const N: usize> Corners<N> {
    /// The same triangle in all lanes.
    #[inline(always)]
    pub(crate) fn splat([a, b, c]: [Vec2; 3]) -> Self {
        let [a, b, c] = [a.to_array(), b.to_array(), c.to_array()];
        Self([
            [[a[0]; N], [a[1]; N]],
            [[b[0]; N], [b[1]; N]],
            [[c[0]; N], [c[1]; N]],
        ])
    }

    #[inline(always)]
    pub(crate) fn get(&self, lane: usize) -> [Vec2; 3] {
        let [a, b, c] = &self.0;
        [a, b, c].map(|[u, v]| Vec2::new(u[lane], v[lane]))
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, lane: usize, triangle: [Vec2; 3]) {
        for ([u, v], corner) in self.0.iter_mut().zip(triangle) {
            [u[lane], v[lane]] = corner.to_array();
        }
    }
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
        let windows = self.windows(&Corners::<1>::splat(corners), wrap);
        if !windows.fits[0] {
            return self.sample_one_by_one(corners, weights, channel, wrap, values);
        }
        let window = windows.window(0);
        with_numbers!(self.texels(), numbers => {
            let around = Around::new(self, numbers, channel);
            for (weights, values) in weights.chunks(LANES).zip(values.chunks_mut(LANES)) {
                let mut row = [[0.0; LANES]; 2];
                for (lane, &[u, v]) in weights.iter().enumerate() {
                    (row[0][lane], row[1][lane]) = (u, v);
                }
                values.copy_from_slice(&around.sample(&window, row)[..weights.len()]);
            }
        })
    }

    /// The same for many triangles: for each of `weights` a row of what is there in each.
    #[inline(always)]
    pub(crate) fn sample_triangles(
        &self,
        corners: &Corners,
        weights: &[[f32; 2]],
        channel: u32,
        wrap: Wrap,
        values: &mut [Row],
    ) {
        let windows = self.windows(corners, wrap);
        if windows.fits.contains(&true) {
            with_numbers!(self.texels(), numbers => {
                let around = Around::new(self, numbers, channel);
                for (row, weights) in values.iter_mut().zip(weights) {
                    *row = around.sample(&windows, weights.map(|w| [w; LANES]));
                }
            })
        }
        for lane in 0..LANES {
            if !windows.fits[lane] {
                for (row, &weights) in values.iter_mut().zip(weights) {
                    let uv = place(corners.get(lane), weights);
                    row[lane] = self.sample(uv.x, uv.y, channel, wrap);
                }
            }
        }
    }

    /// The same for as many weights as there are lanes: for each triangle a row of what is there
    /// at each. What is read for a triangle lies together; rows of texels a power of two apart
    /// share the places of the first-level cache, so those of many triangles would not stay.
    #[inline(always)]
    pub(crate) fn sample_each(
        &self,
        corners: &Corners,
        weights: &[[f32; 2]; LANES],
        channel: u32,
        wrap: Wrap,
        values: &mut [Row; LANES],
    ) {
        let windows = self.windows(corners, wrap);
        let row = [weights.map(|w| w[0]), weights.map(|w| w[1])];
        if windows.fits.contains(&true) {
            with_numbers!(self.texels(), numbers => {
                let around = Around::new(self, numbers, channel);
                for (lane, values) in values.iter_mut().enumerate() {
                    *values = around.sample(&windows.window(lane), row);
                }
            })
        }
        for (lane, values) in values.iter_mut().enumerate() {
            if !windows.fits[lane] {
                self.sample_one_by_one(corners.get(lane), weights, channel, wrap, values);
            }
        }
    }

    /// [`sample_triangle`](Self::sample_triangle) where texels do not lie side by side.
    fn sample_one_by_one(
        &self,
        corners: [Vec2; 3],
        weights: &[[f32; 2]],
        channel: u32,
        wrap: Wrap,
        values: &mut [f32],
    ) {
        for (value, &weights) in values.iter_mut().zip(weights) {
            let uv = place(corners, weights);
            *value = self.sample(uv.x, uv.y, channel, wrap);
        }
    }

    /// The texels around triangles.
    #[inline(always)]
    fn windows<const N: usize>(&self, corners: &Corners<N>, wrap: Wrap) -> Windows<N> {
        let mut texels = [[[0.0; N]; 2]; 3];
        for (texels, [us, vs]) in texels.iter_mut().zip(&corners.0) {
            for k in 0..N {
                [texels[0][k], texels[1][k]] = self.texels_at([us[k], vs[k]]);
            }
        }
        let mut windows = Windows {
            fits: [true; N],
            corners: Corners::splat([Vec2::ZERO; 3]),
            starts: [0; N],
            last: [[0.0; N]; 2],
        };
        let channels = self.channels() as usize;
        let strides = [channels, self.width() as usize * channels];
        for (axis, size) in [self.width(), self.height()].into_iter().enumerate() {
            let [a, b, c] = &texels;
            windows.set(
                [&a[axis], &b[axis], &c[axis]],
                axis,
                (size, strides[axis]),
                wrap,
            );
        }
        for k in 0..N {
            if !windows.fits[k] {
                windows.starts[k] = 0;
                [windows.last[0][k], windows.last[1][k]] = [0.0; 2];
            }
        }
        windows
    }
}

/// The texels around triangles side by side.
struct Windows<const N: usize = LANES> {
    /// Whether they lie in the image side by side. Where they do not, the others tell nothing,
    /// but may be read.
    fits: [bool; N],
    /// The triangles, counted from the centre of the first texel.
    corners: Corners<N>,
    /// Where the first texel is.
    starts: [usize; N],
    /// Last column and row, from the first, that has another beside it.
    last: [[f32; N]; 2],
}

/// The texels around one triangle, as [`Windows`] has them.
#[derive(Clone, Copy)]
struct Window {
    corners: [Vec2; 3],
    start: usize,
    last: [f32; 2],
}

/// A window in each lane: those of many triangles, or one again and again.
trait InLanes {
    fn window(&self, lane: usize) -> Window;
}

impl InLanes for Window {
    #[inline(always)]
    fn window(&self, _: usize) -> Window {
        *self
    }
}

impl<const N: usize> InLanes for Windows<N> {
    #[inline(always)]
    fn window(&self, lane: usize) -> Window {
        Window {
            corners: self.corners.get(lane),
            start: self.starts[lane],
            last: [self.last[0][lane], self.last[1][lane]],
        }
    }
}

/// The numbers of an image that are around a texel: of the texel itself, of those on its
/// right and below it, and of the one below on the right.
#[derive(Clone, Copy)]
struct Around<T> {
    numbers: [T; 4],
    channels: u32,
    stride: u32,
}

impl<T: Numbers> Around<T> {
    /// Those of an image of two rows and columns at least.
    #[inline(always)]
    fn new(image: &ImageMap, numbers: T, channel: u32) -> Self {
        let channels = image.channels() as usize;
        let channel = channel.min(image.channels() - 1) as usize;
        let stride = image.width() as usize * channels;
        // All of one length: one test tells for the four whether there is a number.
        let len = numbers.count() - stride - channels - channel;
        Self {
            numbers: [
                numbers.part(channel, len),
                numbers.part(channel + channels, len),
                numbers.part(channel + stride, len),
                numbers.part(channel + stride + channels, len),
            ],
            channels: channels as u32,
            stride: stride as u32,
        }
    }

    /// Bilinear values at places of each lane's triangle, where the second and third corner
    /// have the weights `us` and `vs`.
    #[inline(always)]
    fn sample(self, windows: &impl InLanes, [us, vs]: [Row; 2]) -> Row {
        let [mut across, mut down, mut values] = [[0.0; LANES]; 3];
        let mut first = [0; LANES];
        for k in 0..LANES {
            let Window { corners, last, .. } = windows.window(k);
            let [x, y] = place(corners, [us[k], vs[k]]).to_array();
            // `clamp` would look in each lane whether its bounds are in order.
            let column = x.max(0.0).min(last[0]).floor();
            let row = y.max(0.0).min(last[1]).floor();
            across[k] = x - column;
            down[k] = y - row;
            first[k] = low_word(row) * self.stride + low_word(column) * self.channels;
        }
        let mut around = [[0.0; LANES]; 4];
        let [own, right, below, below_right] = self.numbers;
        for k in 0..LANES {
            let at = windows.window(k).start + first[k] as usize;
            around[3][k] = below_right.number(at);
            around[0][k] = own.number(at);
            around[1][k] = right.number(at);
            around[2][k] = below.number(at);
        }
        for k in 0..LANES {
            values[k] = bilinear(around.each_ref().map(|row| row[k]), across[k], down[k]);
        }
        values
    }
}

impl<const N: usize> Windows<N> {
    /// Takes one axis of corners, in texels, of an image that has `size` texels along it, whose
    /// numbers are `stride` apart.
    #[inline(always)]
    fn set(
        &mut self,
        texels: [&[f64; N]; 3],
        axis: usize,
        (size, stride): (u32, usize),
        wrap: Wrap,
    ) {
        let [a, b, c] = texels;
        let (mut base, mut span) = ([0.0; N], [0.0; N]);
        let mut inside = true;
        for k in 0..N {
            base[k] = a[k].min(b[k]).min(c[k]).floor();
            span[k] = a[k].max(b[k]).max(c[k]).floor() - base[k];
            inside &= (base[k] >= 0.0) & (base[k] + span[k] + 1.0 < size as f64);
        }
        let mut first = [0; N];
        for k in 0..N {
            first[k] = base[k] as i32 as u32;
        }
        // Inside, nothing wraps.
        if !inside {
            for k in 0..N {
                first[k] = wrapped(base[k], size, wrap);
                // In the mirrored tiles texels run the other way.
                let same = wrapped(base[k] + span[k] + 1.0, size, wrap);
                self.fits[k] &= span[k] < size as f64 && same == first[k] + span[k] as u32 + 1;
            }
        }
        for k in 0..N {
            self.fits[k] &= span[k] < WIDEST;
            self.starts[k] += first[k] as usize * stride;
            self.last[axis][k] = span[k] as f32;
            for (inside, texels) in self.corners.0.iter_mut().zip(texels) {
                inside[axis][k] = (texels[k] - base[k]) as f32;
            }
        }
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

        #[test]
        fn triangles_side_by_side_read_as_each_alone(
            first in prop::array::uniform16(prop::array::uniform2(-1.5f32..2.5)),
            others in prop::array::uniform16(prop::array::uniform2(prop::array::uniform2(-0.1f32..0.1))),
            weights in prop::collection::vec(prop::array::uniform2(0.0f32..0.5), 1..17),
        ) {
            let map = spots();
            let (mut corners, mut triangles) = (Corners::splat([Vec2::ZERO; 3]), Vec::new());
            for (lane, (first, others)) in first.into_iter().zip(others).enumerate() {
                let [a, b] = others.map(|apart| Vec2::from(first) + Vec2::from(apart));
                corners.set(lane, [first.into(), a, b]);
                triangles.push(corners.get(lane));
            }
            for wrap in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
                let mut rows = vec![[0.0; LANES]; weights.len()];
                map.sample_triangles(&corners, &weights, 0, wrap, &mut rows);
                let sixteen = std::array::from_fn(|k| weights[k % weights.len()]);
                let mut each = [[0.0; LANES]; LANES];
                map.sample_each(&corners, &sixteen, 0, wrap, &mut each);
                for (lane, &triangle) in triangles.iter().enumerate() {
                    let mut alone = vec![0.0; weights.len()];
                    map.sample_triangle(triangle, &weights, 0, wrap, &mut alone);
                    prop_assert!(alone.iter().zip(&rows).all(|(value, row)| *value == row[lane]));
                    prop_assert!(each[lane].iter().eq(alone.iter().cycle().take(LANES)));
                }
            }
        }
    }
}
