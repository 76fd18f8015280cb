//! Images as maps: which format it is, how large it may be, and the formats that
//! crate `image` decodes (PNG, JPEG, Radiance HDR).
//!
//! A format is told by its first bytes, not by its name. What an image claims is
//! compared with what its file can hold before any texel is allocated, because an
//! image of 60 bytes may claim billions of texels.

use crate::source::read_bytes;
use crate::{Blame, ReadError};
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};
use pelage_surface::ImageMap;
use std::io::Cursor;
use std::path::Path;

/// The image `path` (PNG, JPEG, TIFF, Radiance HDR or OpenEXR) as a map.
///
/// Codes of 8 and 16 bits are divided by their largest value and nothing else:
/// [`ImageMap::is_eight_bit`] tells whether they may be sRGB. Floating-point texels
/// are kept. Channels are R, RG, RGB or RGBA; grey is one channel, grey with alpha
/// two.
pub fn read_image(path: &Path) -> Result<ImageMap, ReadError> {
    parse_image(&read_bytes(path)?, path)
}

/// Like [`read_image`], of `bytes`; `path` only names them in errors.
pub fn parse_image(bytes: &[u8], path: &Path) -> Result<ImageMap, ReadError> {
    let texels = match Format::of(bytes) {
        Some(Format::Exr) => crate::image_exr::texels(bytes, path),
        Some(Format::Tiff) => crate::image_tiff::texels(bytes, path),
        Some(Format::Other(format)) => decode(bytes, format, path),
        None => Err(ReadError::file(
            path,
            "not an image that is read here: PNG, JPEG, TIFF, HDR or EXR",
        )),
    }?;
    texels.into_map(path)
}

enum Format {
    Exr,
    Tiff,
    Other(ImageFormat),
}

impl Format {
    fn of(bytes: &[u8]) -> Option<Self> {
        let starts = |signature: &[u8]| bytes.starts_with(signature);
        match () {
            _ if starts(b"\x89PNG") => Some(Self::Other(ImageFormat::Png)),
            _ if starts(b"\xFF\xD8\xFF") => Some(Self::Other(ImageFormat::Jpeg)),
            _ if starts(b"#?RADIANCE") || starts(b"#?RGBE") => Some(Self::Other(ImageFormat::Hdr)),
            _ if starts(b"II*\0") || starts(b"MM\0*") => Some(Self::Tiff),
            _ if starts(b"II+\0") || starts(b"MM\0+") => Some(Self::Tiff),
            _ if starts(b"\x76\x2F\x31\x01") => Some(Self::Exr),
            _ => None,
        }
    }
}

/// Decoded texels, not yet known to be finite.
pub(crate) struct Texels {
    pub size: Size,
    /// Rows from the top, channels interleaved.
    pub numbers: pelage_surface::Texels,
    pub eight_bit: bool,
}

impl Texels {
    fn into_map(self, path: &Path) -> Result<ImageMap, ReadError> {
        let Size {
            width,
            height,
            channels,
        } = self.size;
        ImageMap::new(width, height, channels, self.numbers, self.eight_bit)
            .map_err(|error| ReadError::file(path, error.to_string()))
    }
}

/// Columns, rows, channels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Size {
    pub width: u32,
    pub height: u32,
    pub channels: u32,
}

/// Most numbers in an image: 8192 × 8192 texels of four, 1 GiB as f32.
const MOST_NUMBERS: u64 = 1 << 28;

/// Most numbers that one byte of a file can stand for. DEFLATE, the tightest in
/// use, reaches 1,032 bytes; flat LZW and JPEG come near it.
const MOST_NUMBERS_PER_BYTE: u64 = 4096;

impl Size {
    /// Numbers in the image, where a file of `file_bytes` can hold that many.
    pub fn numbers(&self, file_bytes: usize, path: &Path) -> Result<usize, ReadError> {
        let texels = u64::from(self.width) * u64::from(self.height);
        let numbers = texels.saturating_mul(u64::from(self.channels));
        let claim = format!(
            "{} × {} texels of {} channels",
            self.width, self.height, self.channels
        );
        if numbers == 0 {
            return Err(ReadError::file(
                path,
                format!("{claim}: the image is empty"),
            ));
        }
        if numbers > MOST_NUMBERS {
            let message = format!("{claim}; at most {MOST_NUMBERS} numbers are read");
            return Err(ReadError::new(path, Blame::Limit, message)
                .help("make it smaller; 8192 × 8192 texels of 4 channels are allowed"));
        }
        if numbers > (file_bytes as u64).saturating_mul(MOST_NUMBERS_PER_BYTE) {
            let message = format!("{claim} cannot be in a file of {file_bytes} bytes");
            return Err(ReadError::new(path, Blame::Limit, message));
        }
        Ok(numbers as usize)
    }
}

/// An error of one of the decoders as one line of ours.
pub(crate) fn decode_error(path: &Path, error: impl std::fmt::Display) -> ReadError {
    let text = error.to_string();
    ReadError::file(path, text.split_whitespace().collect::<Vec<_>>().join(" "))
}

fn decode(bytes: &[u8], format: ImageFormat, path: &Path) -> Result<Texels, ReadError> {
    let mut limits = Limits::default();
    // Numbers take 4 bytes at most.
    limits.max_alloc = Some(MOST_NUMBERS * 4);
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader.limits(limits);
    let decoder = reader
        .into_decoder()
        .map_err(|error| decode_error(path, error))?;
    let (width, height) = decoder.dimensions();
    let channels = u32::from(decoder.color_type().channel_count());
    let size = Size {
        width,
        height,
        channels,
    };
    size.numbers(bytes.len(), path)?;
    let image = DynamicImage::from_decoder(decoder).map_err(|error| decode_error(path, error))?;
    let eight_bit =
        image.as_bytes().len() as u64 == u64::from(width) * u64::from(height) * u64::from(channels);
    let numbers = numbers_of(image)
        .ok_or_else(|| ReadError::unsupported(path, "texels of an unknown kind"))?;
    Ok(Texels {
        size,
        numbers,
        eight_bit,
    })
}

fn numbers_of(image: DynamicImage) -> Option<pelage_surface::Texels> {
    Some(match image {
        DynamicImage::ImageLuma8(image) => image.into_raw().into(),
        DynamicImage::ImageLumaA8(image) => image.into_raw().into(),
        DynamicImage::ImageRgb8(image) => image.into_raw().into(),
        DynamicImage::ImageRgba8(image) => image.into_raw().into(),
        DynamicImage::ImageLuma16(image) => image.into_raw().into(),
        DynamicImage::ImageLumaA16(image) => image.into_raw().into(),
        DynamicImage::ImageRgb16(image) => image.into_raw().into(),
        DynamicImage::ImageRgba16(image) => image.into_raw().into(),
        DynamicImage::ImageRgb32F(image) => image.into_raw().into(),
        DynamicImage::ImageRgba32F(image) => image.into_raw().into(),
        _ => return None,
    })
}
