//! Mixing two colours in HSV, Oklab or RGB.

use crate::lanes::HALF;
use fearless_simd::{Select, Simd, SimdBase, SimdFloat, SimdMask, f32x8};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The space in which root and tip colours are mixed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ColorSpace {
    /// Hue, saturation, value; hue on its shorter arc (document 004, 2.2.6).
    Hsv,
    /// Oklab (Ottosson 2020): even steps to the eye.
    Oklab,
    /// Linear RGB.
    #[default]
    Rgb,
}

/// Two colours, ready to be mixed; two black ones at first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ColorMix {
    space: ColorSpace,
    root: [f32; 3],
    /// From root to tip, in `space`.
    step: [f32; 3],
}

impl ColorMix {
    /// Prepares a mix of two linear RGB colours, each part in 0..=1. Equal colours
    /// stay that very colour.
    pub fn new(space: ColorSpace, root: [f32; 3], tip: [f32; 3]) -> Self {
        let space = if root == tip { ColorSpace::Rgb } else { space };
        let [root, step] = match space {
            ColorSpace::Hsv => hsv_steps(root, tip),
            ColorSpace::Oklab => steps(oklab_from_rgb(root), oklab_from_rgb(tip)),
            ColorSpace::Rgb => steps(root, tip),
        };
        Self { space, root, step }
    }

    /// Writes the mixes in HSV of `roots` and `tips`, [`HALF`] at most, to `mixes`: those of
    /// [`new`](Self::new).
    #[inline(always)]
    pub(crate) fn write_hsv<'a, S: Simd>(
        simd: S,
        roots: &[[f32; 3]],
        tips: &[[f32; 3]],
        mixes: impl Iterator<Item = &'a mut Self>,
    ) {
        let (root, tip) = (load(simd, roots), load(simd, tips));
        let [mut from, mut step] = hsv_steps(root, tip);
        let equal = root[0].simd_eq(tip[0]) & root[1].simd_eq(tip[1]) & root[2].simd_eq(tip[2]);
        for k in 0..3 {
            from[k] = equal.select(root[k], from[k]);
            step[k] = equal.select(tip[k] - root[k], step[k]);
        }
        let equal = equal.to_bitmask();
        for (lane, mix) in mixes.take(roots.len()).enumerate() {
            *mix = Self {
                space: match equal >> lane & 1 {
                    0 => ColorSpace::Hsv,
                    _ => ColorSpace::Rgb,
                },
                root: [from[0][lane], from[1][lane], from[2][lane]],
                step: [step[0][lane], step[1][lane], step[2][lane]],
            };
        }
    }

    /// The linear RGB colours at each of `ts`, root 0, tip 1: all reds, all greens, all
    /// blues.
    #[inline(always)]
    pub(crate) fn at<V: Channel>(&self, ts: V) -> [V; 3] {
        // No closures, here and below: those that are called often are not inlined, and then
        // nothing stays in registers.
        let ([a, b, c], [x, y, z]) = (self.root, self.step);
        let mixed = [ts * x + a, ts * y + b, ts * z + c];
        match self.space {
            ColorSpace::Hsv => from_hsv(mixed),
            ColorSpace::Oklab => {
                let [r, g, b] = from_oklab(mixed);
                [
                    r.between_0_and_1(),
                    g.between_0_and_1(),
                    b.between_0_and_1(),
                ]
            }
            ColorSpace::Rgb => mixed,
        }
    }
}

/// All reds, greens and blues of some colours, [`HALF`] at most.
#[inline(always)]
fn load<S: Simd>(simd: S, colors: &[[f32; 3]]) -> [f32x8<S>; 3] {
    let mut rows = [[0.0; HALF]; 3];
    for (k, color) in colors.iter().enumerate() {
        [rows[0][k], rows[1][k], rows[2][k]] = *color;
    }
    let [r, g, b] = rows;
    [
        f32x8::load_array(simd, r),
        f32x8::load_array(simd, g),
        f32x8::load_array(simd, b),
    ]
}

/// Where a mix begins, and how far it goes.
#[inline(always)]
fn steps<V: Channel>(from: [V; 3], to: [V; 3]) -> [[V; 3]; 2] {
    [from, [to[0] - from[0], to[1] - from[1], to[2] - from[2]]]
}

/// The same in HSV, of RGB colours.
#[inline(always)]
fn hsv_steps<V: Channel>(root: [V; 3], tip: [V; 3]) -> [[V; 3]; 2] {
    let (mut from, mut to) = (to_hsv(root), to_hsv(tip));
    // Grey has no hue: it takes the other's, so that it does not swing through red.
    from[0] = from[1].if_positive(from[0], to[0]);
    to[0] = to[1].if_positive(to[0], from[0]);
    let [from, mut step] = steps(from, to);
    let (more, less) = (step[0] + 360.0, step[0] + -360.0);
    let forward = (-step[0] + -180.0).if_positive(more, step[0]);
    step[0] = (step[0] + -180.0).if_positive(less, forward);
    [from, step]
}

/// A number, or many side by side, that colours are made of.
pub(crate) trait Channel:
    Copy
    + Neg<Output = Self>
    + Add<Output = Self>
    + Add<f32, Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<f32, Output = Self>
    + Div<Output = Self>
{
    fn whole(self) -> Self;
    fn smaller(self, other: Self) -> Self;
    fn larger(self, other: Self) -> Self;
    /// `then` where this is above 0.
    fn if_positive(self, then: Self, otherwise: Self) -> Self;
    /// `then` where this is `other`.
    fn if_equal(self, other: Self, then: Self, otherwise: Self) -> Self;
    fn between_0_and_1(self) -> Self;
}

impl Channel for f32 {
    #[inline(always)]
    fn whole(self) -> Self {
        self.floor()
    }

    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        self.min(other)
    }

    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        self.max(other)
    }

    #[inline(always)]
    fn if_positive(self, then: Self, otherwise: Self) -> Self {
        if self > 0.0 { then } else { otherwise }
    }

    #[inline(always)]
    fn if_equal(self, other: Self, then: Self, otherwise: Self) -> Self {
        if self == other { then } else { otherwise }
    }

    #[inline(always)]
    fn between_0_and_1(self) -> Self {
        self.clamp(0.0, 1.0)
    }
}

impl<S: Simd> Channel for f32x8<S> {
    #[inline(always)]
    fn whole(self) -> Self {
        self.floor()
    }

    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        self.min(other)
    }

    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        self.max(other)
    }

    #[inline(always)]
    fn if_positive(self, then: Self, otherwise: Self) -> Self {
        self.simd_gt(0.0).select(then, otherwise)
    }

    #[inline(always)]
    fn if_equal(self, other: Self, then: Self, otherwise: Self) -> Self {
        self.simd_eq(other).select(then, otherwise)
    }

    #[inline(always)]
    fn between_0_and_1(self) -> Self {
        self.max(0.0).min(1.0)
    }
}

/// Hue in degrees 0..360, saturation and value in 0..=1. Everything is computed and the
/// right one chosen, so that many colours go side by side.
#[inline(always)]
pub fn hsv_from_rgb(rgb: [f32; 3]) -> [f32; 3] {
    to_hsv(rgb)
}

#[inline(always)]
fn to_hsv<V: Channel>([r, g, b]: [V; 3]) -> [V; 3] {
    let value = r.larger(g).larger(b);
    let chroma = value - r.smaller(g).smaller(b);
    let (of_red, of_green, of_blue) = (
        (g - b) / chroma + 0.0,
        (b - r) / chroma + 2.0,
        (r - g) / chroma + 4.0,
    );
    let sector = value.if_equal(r, of_red, value.if_equal(g, of_green, of_blue));
    let hue = (-sector).if_positive(sector + 6.0, sector) * 60.0;
    let none = value * 0.0;
    [
        chroma.if_positive(hue, none),
        chroma.if_positive(chroma / value, none),
        value,
    ]
}

/// The inverse of [`hsv_from_rgb`]; any hue, taken modulo 360.
#[inline(always)]
pub fn rgb_from_hsv(hsv: [f32; 3]) -> [f32; 3] {
    from_hsv(hsv)
}

#[inline(always)]
fn from_hsv<V: Channel>([hue, saturation, value]: [V; 3]) -> [V; 3] {
    let (sector, chroma) = (hue * (1.0 / 60.0), value * saturation);
    [
        value - chroma * away(sector + 5.0),
        value - chroma * away(sector + 3.0),
        value - chroma * away(sector + 1.0),
    ]
}

/// What part of the chroma a primary colour lacks, 0..=1, by the sectors of hue from where it
/// begins to.
#[inline(always)]
fn away<V: Channel>(sectors: V) -> V {
    let k = sectors - (sectors * (1.0 / 6.0)).whole() * 6.0;
    k.smaller(-k + 4.0).between_0_and_1()
}

/// Oklab of a linear RGB colour.
pub fn oklab_from_rgb([r, g, b]: [f32; 3]) -> [f32; 3] {
    let l = libm::cbrtf(0.412_221_46 * r + 0.536_332_55 * g + 0.051_445_995 * b);
    let m = libm::cbrtf(0.211_903_5 * r + 0.680_699_5 * g + 0.107_396_96 * b);
    let s = libm::cbrtf(0.088_302_46 * r + 0.281_718_85 * g + 0.629_978_7 * b);
    [
        0.210_454_26 * l + 0.793_617_8 * m - 0.004_072_047 * s,
        1.977_998_5 * l - 2.428_592_2 * m + 0.450_593_7 * s,
        0.025_904_037 * l + 0.782_771_77 * m - 0.808_675_77 * s,
    ]
}

/// The inverse of [`oklab_from_rgb`].
#[inline(always)]
pub fn rgb_from_oklab(lab: [f32; 3]) -> [f32; 3] {
    from_oklab(lab)
}

#[inline(always)]
fn from_oklab<V: Channel>([l, a, b]: [V; 3]) -> [V; 3] {
    let p = cube(l + a * 0.396_337_78 + b * 0.215_803_76);
    let q = cube(l - a * 0.105_561_346 - b * 0.063_854_17);
    let r = cube(l - a * 0.089_484_18 - b * 1.291_485_5);
    [
        p * 4.076_741_7 - q * 3.307_711_6 + r * 0.230_969_94,
        p * -1.268_438 + q * 2.609_757_4 - r * 0.341_319_4,
        p * -0.004_196_086_3 - q * 0.703_418_6 + r * 1.707_614_7,
    ]
}

#[inline(always)]
fn cube<V: Channel>(x: V) -> V {
    x * x * x
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn near(a: [f32; 3], b: [f32; 3], tolerance: f32) -> bool {
        (0..3).all(|k| (a[k] - b[k]).abs() < tolerance)
    }

    proptest! {
        #[test]
        fn every_space_gives_a_colour_back(rgb in prop::array::uniform3(0.0f32..=1.0)) {
            prop_assert!(near(rgb_from_hsv(hsv_from_rgb(rgb)), rgb, 2e-6));
            prop_assert!(near(rgb_from_oklab(oklab_from_rgb(rgb)), rgb, 1e-4));
        }
    }

    #[test]
    fn hue_takes_its_shorter_arc() {
        // Magenta-red (330°) to orange (30°): the middle is red, not cyan.
        let from = rgb_from_hsv([330.0, 1.0, 1.0]);
        let to = rgb_from_hsv([30.0, 1.0, 1.0]);
        let middle = ColorMix::new(ColorSpace::Hsv, from, to).at(0.5);
        assert!(near(middle, [1.0, 0.0, 0.0], 1e-5), "{middle:?}");
    }

    #[test]
    fn white_and_black_are_the_ends_of_oklab() {
        assert!(near(oklab_from_rgb([1.0; 3]), [1.0, 0.0, 0.0], 1e-5));
        assert!(near(oklab_from_rgb([0.0; 3]), [0.0; 3], 1e-6));
    }
}
