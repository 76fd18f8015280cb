//! Mixing two colours in HSV, Oklab or RGB.

use fearless_simd::{Simd, SimdBase, SimdFloat, f32x8};
use std::ops::{Add, Mul, Neg, Sub};

/// The space in which root and tip colours are mixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColorSpace {
    /// Hue, saturation, value; hue on its shorter arc (document 004, 2.2.6).
    Hsv,
    /// Oklab (Ottosson 2020): even steps to the eye.
    Oklab,
    /// Linear RGB.
    Rgb,
}

/// Two colours, ready to be mixed.
#[derive(Clone, Copy, Debug, PartialEq)]
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
        let encode = match space {
            ColorSpace::Hsv => hsv_from_rgb,
            ColorSpace::Oklab => oklab_from_rgb,
            ColorSpace::Rgb => |c| c,
        };
        let (mut from, mut to) = (encode(root), encode(tip));
        if space == ColorSpace::Hsv {
            // Grey has no hue: it takes the other's, so that it does not swing through
            // red.
            if from[1] == 0.0 {
                from[0] = to[0];
            } else if to[1] == 0.0 {
                to[0] = from[0];
            }
        }
        let mut step: [f32; 3] = std::array::from_fn(|k| to[k] - from[k]);
        if space == ColorSpace::Hsv {
            if step[0] > 180.0 {
                step[0] -= 360.0;
            } else if step[0] < -180.0 {
                step[0] += 360.0;
            }
        }
        Self {
            space,
            root: from,
            step,
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

/// A number, or many side by side, that colours are made of.
pub(crate) trait Channel:
    Copy
    + Neg<Output = Self>
    + Add<Output = Self>
    + Add<f32, Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<f32, Output = Self>
{
    fn whole(self) -> Self;
    fn smaller(self, other: Self) -> Self;
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
    fn between_0_and_1(self) -> Self {
        self.max(0.0).min(1.0)
    }
}

/// Hue in degrees 0..360, saturation and value in 0..=1. Everything is computed and the
/// right one chosen, so that many colours go side by side.
#[inline(always)]
pub fn hsv_from_rgb([r, g, b]: [f32; 3]) -> [f32; 3] {
    let value = r.max(g).max(b);
    let chroma = value - r.min(g).min(b);
    let grey = chroma <= 0.0;
    let (apart, of) = if value == r {
        (g - b, 0.0)
    } else if value == g {
        (b - r, 2.0)
    } else {
        (r - g, 4.0)
    };
    let sector = of + apart / chroma;
    let hue = 60.0 * if sector < 0.0 { sector + 6.0 } else { sector };
    if grey {
        [0.0, 0.0, value]
    } else {
        [hue, chroma / value, value]
    }
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
