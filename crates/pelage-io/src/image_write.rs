//! Writing PNG and OpenEXR images, whole or not at all.

use crate::AtomicFile;
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, SmallVec, WritableImage,
};
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use pelage_strands::SinkError;
use std::path::Path;

/// Integer codes of an image, rows from the top, channels interleaved.
#[derive(Clone, Copy, Debug)]
pub enum PngCodes<'a> {
    /// 8 bits each.
    Eight(&'a [u8]),
    /// 16 bits each.
    Sixteen(&'a [u16]),
}

/// Writes a PNG of `width × height` texels of `channels` codes (1 grey, 2 grey and
/// alpha, 3 RGB, 4 RGBA).
///
/// ```
/// use pelage_io::{PngCodes, read_image, write_png};
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("stripes.png");
/// write_png(&path, 2, 1, 1, PngCodes::Eight(&[0, 255]))?;
/// assert!(read_image(&path)?.texels().iter().eq([0.0, 1.0]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_png(
    path: &Path,
    width: u32,
    height: u32,
    channels: u32,
    codes: PngCodes<'_>,
) -> Result<(), SinkError> {
    use ExtendedColorType as Kind;
    let (count, bytes) = match codes {
        PngCodes::Eight(codes) => (codes.len(), codes),
        PngCodes::Sixteen(codes) => (codes.len(), bytemuck::cast_slice(codes)),
    };
    check_count(path, width, height, channels, count)?;
    let kind = match (channels, codes) {
        (1, PngCodes::Eight(_)) => Kind::L8,
        (2, PngCodes::Eight(_)) => Kind::La8,
        (3, PngCodes::Eight(_)) => Kind::Rgb8,
        (_, PngCodes::Eight(_)) => Kind::Rgba8,
        (1, PngCodes::Sixteen(_)) => Kind::L16,
        (2, PngCodes::Sixteen(_)) => Kind::La16,
        (3, PngCodes::Sixteen(_)) => Kind::Rgb16,
        (_, PngCodes::Sixteen(_)) => Kind::Rgba16,
    };
    let mut file = create(path)?;
    PngEncoder::new(&mut file)
        .write_image(bytes, width, height, kind)
        .map_err(|error| failed(path, error))?;
    commit(file, path)
}

/// Writes an OpenEXR image of 32-bit floats: `width × height` texels of `channels`
/// numbers (1 Y, 2 Y and A, 3 RGB, 4 RGBA), rows from the top. Compressed, without
/// loss.
pub fn write_exr(
    path: &Path,
    width: u32,
    height: u32,
    channels: u32,
    numbers: &[f32],
) -> Result<(), SinkError> {
    check_count(path, width, height, channels, numbers.len())?;
    let names: &[&str] = match channels {
        1 => &["Y"],
        2 => &["Y", "A"],
        3 => &["R", "G", "B"],
        _ => &["R", "G", "B", "A"],
    };
    let channel = |(offset, &name): (usize, &&str)| {
        let samples = numbers.iter().skip(offset).step_by(names.len());
        AnyChannel::new(name, FlatSamples::F32(samples.copied().collect()))
    };
    let list: SmallVec<[_; 4]> = names.iter().enumerate().map(channel).collect();
    let image = Image::from_encoded_channels(
        (width as usize, height as usize),
        Encoding::SMALL_LOSSLESS,
        AnyChannels::sort(list),
    );
    let mut file = create(path)?;
    image
        .write()
        .to_buffered(&mut file)
        .map_err(|error| failed(path, error))?;
    commit(file, path)
}

fn check_count(
    path: &Path,
    width: u32,
    height: u32,
    channels: u32,
    found: usize,
) -> Result<(), SinkError> {
    let expected = u64::from(width) * u64::from(height) * u64::from(channels);
    if !(1..=4).contains(&channels) || expected == 0 || expected != found as u64 {
        let reason = format!(
            "{found} numbers for {width} × {height} texels of {channels} channels; \
             an image has 1 to 4 channels and at least one texel"
        );
        return Err(SinkError::new(path.display().to_string(), reason));
    }
    Ok(())
}

fn create(path: &Path) -> Result<AtomicFile, SinkError> {
    AtomicFile::create(path).map_err(|error| SinkError::io(path.display().to_string(), error))
}

fn commit(file: AtomicFile, path: &Path) -> Result<(), SinkError> {
    file.commit()
        .map_err(|error| SinkError::io(path.display().to_string(), error))
}

fn failed(path: &Path, error: impl std::fmt::Display) -> SinkError {
    SinkError::new(path.display().to_string(), error.to_string())
}
