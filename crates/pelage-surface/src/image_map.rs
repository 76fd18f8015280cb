//! Images that modulate properties over the surface.

use crate::bilinear::{Around, Corners};
use crate::lanes::low_word_f64;
use crate::texels::{Numbers, Texels, with_numbers};
use crate::wrap::{Wrap, wrapped};
use fearless_simd::{Level, dispatch};
use pelage_curves::Vec2;

/// Places that are read together.
const BATCH: usize = 64;

/// Why pixels are no map.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MapError {
    /// No texels at all.
    #[error("the image is {width} × {height} texels; it needs at least 1 × 1")]
    Empty {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// The data do not fill the image.
    #[error("{found} numbers for {width} × {height} texels of {channels} channels")]
    WrongCount {
        /// Numbers given.
        found: usize,
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
        /// Channels a texel.
        channels: u32,
    },
    /// A texel that is NaN or infinite.
    #[error(
        "texel (column {x}, row {y} from the top, channel {channel}, counted from 0) is {value}; \
        maps must be finite: paint over it"
    )]
    NotFinite {
        /// Column.
        x: u32,
        /// Row from the top.
        y: u32,
        /// Channel.
        channel: u32,
        /// What was found, as text.
        value: String,
    },
}

/// Texels of 1 to 4 channels, first row at the top (v = 1).
#[derive(Clone, Debug, PartialEq)]
pub struct ImageMap {
    width: u32,
    height: u32,
    channels: u32,
    texels: Texels,
    /// Whether the texels came from 8-bit codes, which colour maps read as sRGB.
    eight_bit: bool,
}

impl ImageMap {
    /// A map of `width × height` texels of `channels` interleaved numbers, rows
    /// from the top. `eight_bit` tells that the file stored 8-bit codes, not yet decoded
    /// from sRGB, whatever they are kept as here.
    pub fn new(
        width: u32,
        height: u32,
        channels: u32,
        texels: impl Into<Texels>,
        eight_bit: bool,
    ) -> Result<Self, MapError> {
        let texels = texels.into();
        if width == 0 || height == 0 || channels == 0 {
            return Err(MapError::Empty { width, height });
        }
        let expected = width as u64 * height as u64 * channels as u64;
        if texels.len() as u64 != expected {
            return Err(MapError::WrongCount {
                found: texels.len(),
                width,
                height,
                channels,
            });
        }
        if let Some(i) = texels.iter().position(|t: f32| !t.is_finite()) {
            let texel = i / channels as usize;
            return Err(MapError::NotFinite {
                x: (texel % width as usize) as u32,
                y: (texel / width as usize) as u32,
                channel: (i % channels as usize) as u32,
                value: texels.get(i).to_string(),
            });
        }
        Ok(Self {
            width,
            height,
            channels,
            texels,
            eight_bit,
        })
    }

    /// Columns.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Numbers a texel.
    pub fn channels(&self) -> u32 {
        self.channels
    }

    /// Whether the file stored 8-bit codes.
    pub fn is_eight_bit(&self) -> bool {
        self.eight_bit
    }

    /// All texels, rows from the top, channels interleaved.
    pub fn texels(&self) -> &Texels {
        &self.texels
    }

    /// Number `channel` of the texel in column `x`, row `y` from the top.
    ///
    /// Panics where there is none.
    #[inline(always)]
    pub fn texel(&self, x: u32, y: u32, channel: u32) -> f32 {
        let texel = y as usize * self.width as usize + x as usize;
        self.texels
            .get(texel * self.channels as usize + channel as usize)
    }

    /// Bilinear value of `channel` at `(u, v)`, origin lower left: the first row of
    /// the image is v = 1. Texel centres lie at half-integers. A channel the image
    /// does not have reads its last one.
    #[inline(always)]
    pub fn sample(&self, u: f32, v: f32, channel: u32, wrap: Wrap) -> f32 {
        let channel = channel.min(self.channels - 1);
        self.around(u, v, wrap)
            .texels(|x, y| self.texel(x, y, channel))
    }

    /// Bilinear colour at `(u, v)`: the first three channels, or the first alone as
    /// grey where there are fewer than three.
    pub fn sample_rgb(&self, u: f32, v: f32, wrap: Wrap) -> [f32; 3] {
        let around = self.around(u, v, wrap);
        std::array::from_fn(|k| {
            let channel = if self.channels >= 3 { k as u32 } else { 0 };
            around.texels(|x, y| self.texel(x, y, channel))
        })
    }

    /// Writes [`sample`](Self::sample) at all of `uvs` to `values`, of the same length.
    ///
    /// Where the texels of many places lie is known before the first of them is read, and
    /// little is done between two readings: so processors wait for many at once.
    pub fn sample_all(&self, uvs: &[Vec2], channel: u32, wrap: Wrap, values: &mut [f32]) {
        let channel = channel.min(self.channels - 1) as usize;
        with_numbers!(&self.texels, numbers => {
            for (uvs, values) in uvs.chunks(BATCH).zip(values.chunks_mut(BATCH)) {
                let corners = self.corners(uvs, wrap);
                for (value, corners) in values.iter_mut().zip(&corners) {
                    *value = corners.blend(|at| numbers.number(at + channel));
                }
            }
        })
    }

    /// Writes [`sample_rgb`](Self::sample_rgb) at all of `uvs` to `colors`, of the same
    /// length.
    pub fn sample_rgb_all(&self, uvs: &[Vec2], wrap: Wrap, colors: &mut [[f32; 3]]) {
        with_numbers!(&self.texels, numbers => {
            for (uvs, colors) in uvs.chunks(BATCH).zip(colors.chunks_mut(BATCH)) {
                let corners = self.corners(uvs, wrap);
                for (color, corners) in colors.iter_mut().zip(&corners) {
                    *color = if self.channels >= 3 {
                        std::array::from_fn(|k| corners.blend(|at| numbers.number(at + k)))
                    } else {
                        [corners.blend(|at| numbers.number(at)); 3]
                    };
                }
            }
        })
    }

    /// Where the texels around each of up to [`BATCH`] places begin.
    fn corners(&self, uvs: &[Vec2], wrap: Wrap) -> [Corners; BATCH] {
        let mut corners = [Corners::default(); BATCH];
        let mut inside = false;
        dispatch!(Level::new(), simd => {
            let _ = simd;
            inside = self.corners_inside(uvs, &mut corners)
        });
        if !inside {
            for (corners, uv) in corners.iter_mut().zip(uvs) {
                *corners = self.corners_around(uv, wrap);
            }
        }
        corners
    }

    fn corners_around(&self, uv: &Vec2, wrap: Wrap) -> Corners {
        let around = self.around(uv.x, uv.y, wrap);
        let at = |i: usize, j: usize| {
            let row = around.rows[j] as usize * self.width as usize;
            (row + around.columns[i] as usize) * self.channels as usize
        };
        Corners {
            starts: [at(0, 0), at(1, 0), at(0, 1), at(1, 1)],
            across: around.across,
            down: around.down,
        }
    }

    /// The same where no place lies at the border or outside, which it tells: then nothing
    /// wraps, and the arithmetic of many places goes side by side.
    #[inline(always)]
    fn corners_inside(&self, uvs: &[Vec2], corners: &mut [Corners; BATCH]) -> bool {
        let [mut us, mut vs] = [[0.5; BATCH]; 2];
        for (k, uv) in uvs.iter().enumerate() {
            (us[k], vs[k]) = (uv.x, uv.y);
        }
        let [mut columns, mut rows] = [[0u32; BATCH]; 2];
        let [mut across, mut down] = [[0.0; BATCH]; 2];
        let [last_column, last_row] = [self.width, self.height].map(|n| n as f64 - 1.0);
        let mut inside = true;
        for k in 0..BATCH {
            let [x, y] = self.texels_at([us[k], vs[k]]);
            let [x0, y0] = [x, y].map(f64::floor);
            // What is no number is not inside either.
            inside &= (x0 >= 0.0) & (x0 < last_column) & (y0 >= 0.0) & (y0 < last_row);
            (columns[k], rows[k]) = (low_word_f64(x0), low_word_f64(y0));
            (across[k], down[k]) = ((x - x0) as f32, (y - y0) as f32);
        }
        let channels = self.channels as usize;
        let row = self.width as usize * channels;
        for k in 0..BATCH {
            let first = rows[k] as usize * row + columns[k] as usize * channels;
            corners[k] = Corners {
                starts: [first, first + channels, first + row, first + row + channels],
                across: across[k],
                down: down[k],
            };
        }
        inside
    }

    /// A map with the same size whose texels are `f` of this one's.
    pub fn map_texels(&self, f: impl Fn(f32) -> f32) -> Self {
        Self {
            texels: self.texels.map(f),
            ..*self
        }
    }

    /// `uv` in texels to the right and down from the centre of the first. f64: at u = 10
    /// an f32 holds only a sixteenth of a texel of a large map.
    #[inline(always)]
    pub(crate) fn texels_at(&self, uv: [f32; 2]) -> [f64; 2] {
        let [u, v] = uv.map(f64::from);
        let [width, height] = [self.width, self.height].map(f64::from);
        [u * width - 0.5, (1.0 - v) * height - 0.5]
    }

    #[inline(always)]
    pub(crate) fn around(&self, u: f32, v: f32, wrap: Wrap) -> Around {
        let [x, y] = self.texels_at([u, v]);
        let [x0, y0] = [x, y].map(floor);
        Around {
            columns: [x0, x0 + 1.0].map(|x| wrapped(x, self.width, wrap)),
            rows: [y0, y0 + 1.0].map(|y| wrapped(y, self.height, wrap)),
            across: (x - x0) as f32,
            down: (y - y0) as f32,
        }
    }
}

/// The largest integer that is not above `x`: `f64::floor`, which is a call where the
/// processor is only asked for its oldest instructions.
#[inline(always)]
fn floor(x: f64) -> f64 {
    const NO_FRACTIONS: f64 = (1u64 << 52) as f64;
    if x.abs() >= NO_FRACTIONS {
        return x;
    }
    let whole = x as i64 as f64;
    if whole > x { whole - 1.0 } else { whole }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn four() -> ImageMap {
        // Top row 0 1, bottom row 2 3.
        ImageMap::new(2, 2, 1, vec![0.0, 1.0, 2.0, 3.0], false).unwrap()
    }

    #[test]
    fn the_first_row_is_at_the_top() {
        assert_eq!(four().sample(0.25, 0.75, 0, Wrap::Clamp), 0.0);
        assert_eq!(four().sample(0.75, 0.25, 0, Wrap::Clamp), 3.0);
    }

    #[test]
    fn the_middle_is_the_mean_and_repeating_blends_across_the_border() {
        assert_eq!(four().sample(0.5, 0.5, 0, Wrap::Clamp), 1.5);
        assert_eq!(four().sample(0.0, 0.75, 0, Wrap::Repeat), 0.5);
        assert_eq!(four().sample(0.0, 0.75, 0, Wrap::Clamp), 0.0);
        assert_eq!(
            four().sample(5.25, -2.25, 0, Wrap::Repeat),
            four().sample(0.25, 0.75, 0, Wrap::Repeat)
        );
    }

    #[test]
    fn mirroring_turns_every_second_tile_around() {
        let at = |u, v| four().sample(u, v, 0, Wrap::Mirror);
        for (u, v) in [(0.3, 0.6), (0.05, 0.9), (0.0, 1.0)] {
            for (back_u, back_v) in [(-u, v), (2.0 - u, -v), (u + 2.0, 2.0 - v), (u, v - 4.0)] {
                assert!((at(back_u, back_v) - at(u, v)).abs() < 1e-6);
            }
        }
        // No seam: on the border, both sides are the border's texel.
        assert_eq!(at(1.0, 0.75), 1.0);
        assert_eq!(at(0.25, 0.0), 2.0);
    }

    #[test]
    fn many_at_once_are_those_one_by_one() {
        let image = |channels| {
            let codes = (0..35 * channels).map(|i| (i * 37 % 19) as u8);
            let [codes, wide, floats]: [Texels; 3] = [
                codes.clone().collect::<Vec<_>>().into(),
                codes.clone().map(u16::from).collect::<Vec<_>>().into(),
                codes.map(f32::from).collect::<Vec<_>>().into(),
            ];
            [codes, wide, floats].map(|t| ImageMap::new(7, 5, channels, t, false).unwrap())
        };
        let coordinate = |i: u32, step: u32| (i * step % 211) as f32 / 210.0;
        let inside = |i| Vec2::new(coordinate(i, 3), coordinate(i, 50)) * 0.8 + 0.1;
        // More than a batch whose places are all inside, then some at borders and beyond.
        let mut uvs: Vec<Vec2> = (0..150).map(inside).collect();
        uvs.extend([0.0, 1.0, 1e-9, -0.3, 7.2, f32::NAN, f32::INFINITY, -1e30].map(Vec2::splat));
        for wrap in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
            for channels in 1..=4 {
                for image in image(channels) {
                    let mut values = vec![0.0; uvs.len()];
                    image.sample_all(&uvs, channels - 1, wrap, &mut values);
                    let mut colors = vec![[0.0; 3]; uvs.len()];
                    image.sample_rgb_all(&uvs, wrap, &mut colors);
                    let bits = |color: [f32; 3]| color.map(f32::to_bits);
                    for (uv, (value, color)) in uvs.iter().zip(values.iter().zip(colors)) {
                        let alone = image.sample(uv.x, uv.y, channels - 1, wrap);
                        assert_eq!(value.to_bits(), alone.to_bits(), "{uv}");
                        assert_eq!(
                            bits(color),
                            bits(image.sample_rgb(uv.x, uv.y, wrap)),
                            "{uv}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn coordinates_that_are_no_numbers_do_not_panic() {
        for bad in [f32::NAN, f32::INFINITY, -1e30] {
            for wrap in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
                four().sample(bad, bad, 0, wrap);
                wrap.texel([bad, bad], [2, 2]);
            }
        }
    }

    #[test]
    fn a_texel_that_is_no_number_is_named() {
        let error = ImageMap::new(2, 1, 3, vec![0.0, 0.0, 0.0, 0.0, f32::NAN, 0.0], false);
        assert_eq!(
            error.unwrap_err().to_string(),
            "texel (column 1, row 0 from the top, channel 1, counted from 0) is NaN; \
            maps must be finite: paint over it"
        );
    }
}
