//! Mixing two colours in HSV, Oklab or RGB.

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

    /// Writes the linear RGB colours at each of `ts`, root 0, tip 1.
    #[inline(always)]
    pub fn at<const N: usize>(&self, ts: &[f32; N], colors: &mut [[f32; 3]; N]) {
        let mixed =
            |t: f32| -> [f32; 3] { std::array::from_fn(|k| self.root[k] + self.step[k] * t) };
        match self.space {
            ColorSpace::Hsv => fill(colors, ts, |t| rgb_from_hsv(mixed(t))),
            ColorSpace::Oklab => fill(colors, ts, |t| {
                rgb_from_oklab(mixed(t)).map(|c| c.clamp(0.0, 1.0))
            }),
            ColorSpace::Rgb => fill(colors, ts, mixed),
        }
    }
}

/// Writes `color` at each of `ts`, which is done for many at once.
#[inline(always)]
fn fill<const N: usize>(
    colors: &mut [[f32; 3]; N],
    ts: &[f32; N],
    color: impl Fn(f32) -> [f32; 3],
) {
    let mut parts = [[0.0; N]; 3];
    for k in 0..N {
        [parts[0][k], parts[1][k], parts[2][k]] = color(ts[k]);
    }
    *colors = std::array::from_fn(|k| parts.map(|part| part[k]));
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
pub fn rgb_from_hsv([hue, saturation, value]: [f32; 3]) -> [f32; 3] {
    let sector = hue * (1.0 / 60.0);
    let part = |n: f32| {
        let k = n + sector;
        let k = k - (k * (1.0 / 6.0)).floor() * 6.0;
        value - value * saturation * k.min(4.0 - k).clamp(0.0, 1.0)
    };
    [part(5.0), part(3.0), part(1.0)]
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
pub fn rgb_from_oklab([l, a, b]: [f32; 3]) -> [f32; 3] {
    let cube = |x: f32| x * x * x;
    let p = cube(l + 0.396_337_78 * a + 0.215_803_76 * b);
    let q = cube(l - 0.105_561_346 * a - 0.063_854_17 * b);
    let r = cube(l - 0.089_484_18 * a - 1.291_485_5 * b);
    [
        4.076_741_7 * p - 3.307_711_6 * q + 0.230_969_94 * r,
        -1.268_438 * p + 2.609_757_4 * q - 0.341_319_4 * r,
        -0.004_196_086_3 * p - 0.703_418_6 * q + 1.707_614_7 * r,
    ]
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
        let mut middle = [[0.0; 3]];
        ColorMix::new(ColorSpace::Hsv, from, to).at(&[0.5], &mut middle);
        let [middle] = middle;
        assert!(near(middle, [1.0, 0.0, 0.0], 1e-5), "{middle:?}");
    }

    #[test]
    fn white_and_black_are_the_ends_of_oklab() {
        assert!(near(oklab_from_rgb([1.0; 3]), [1.0, 0.0, 0.0], 1e-5));
        assert!(near(oklab_from_rgb([0.0; 3]), [0.0; 3], 1e-6));
    }
}
