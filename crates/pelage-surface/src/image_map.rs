//! Images that modulate properties over the surface.

/// What lies outside 0..1 in texture space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// The image repeats.
    #[default]
    Repeat,
    /// The border texels go on.
    Clamp,
}

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
        "texel (column {x}, row {y} from the top), channel {channel}, is {value}; maps must be finite"
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

/// Linear f32 texels, 1 to 4 channels, first row at the top (v = 1).
#[derive(Clone, Debug, PartialEq)]
pub struct ImageMap {
    width: u32,
    height: u32,
    channels: u32,
    texels: Vec<f32>,
    /// Whether the texels came from 8-bit codes, which colour maps read as sRGB.
    eight_bit: bool,
}

impl ImageMap {
    /// A map of `width × height` texels of `channels` interleaved numbers, rows
    /// from the top. `eight_bit` tells that the file stored 8-bit codes (already
    /// divided by 255 here, but not yet decoded from sRGB).
    pub fn new(
        width: u32,
        height: u32,
        channels: u32,
        texels: Vec<f32>,
        eight_bit: bool,
    ) -> Result<Self, MapError> {
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
        if let Some(i) = texels.iter().position(|t| !t.is_finite()) {
            let texel = i / channels as usize;
            return Err(MapError::NotFinite {
                x: (texel % width as usize) as u32,
                y: (texel / width as usize) as u32,
                channel: (i % channels as usize) as u32,
                value: texels[i].to_string(),
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
    pub fn texels(&self) -> &[f32] {
        &self.texels
    }

    /// The texel in column `x`, row `y` from the top, as a slice of its channels.
    pub fn texel(&self, x: u32, y: u32) -> &[f32] {
        let start = (y as usize * self.width as usize + x as usize) * self.channels as usize;
        &self.texels[start..start + self.channels as usize]
    }
}
