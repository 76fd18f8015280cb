//! TIFF images: grey, RGB or RGBA of 8, 16 or 32 bits, half, float or double.
//!
//! Why not through `image`: it refuses grey floating-point TIFF, which is what
//! painting programs write for density maps. The decoder below it is the same.

use crate::ReadError;
use crate::image::{Size, Texels, decode_error};
use std::io::Cursor;
use std::path::Path;
use tiff::ColorType;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;

/// Largest allocation for one strip or tile, and for the whole image, in bytes.
const MOST_BYTES: usize = 1 << 31;

/// The first image of the TIFF file `bytes`.
pub(crate) fn texels(bytes: &[u8], path: &Path) -> Result<Texels, ReadError> {
    let fail = |error| decode_error(path, error);
    let mut limits = Limits::default();
    limits.decoding_buffer_size = MOST_BYTES;
    limits.intermediate_buffer_size = MOST_BYTES;
    // Tags other than texels cannot be larger than the file.
    limits.ifd_value_size = bytes.len();
    let mut decoder = Decoder::new(Cursor::new(bytes))
        .map_err(fail)?
        .with_limits(limits);
    let (width, height) = decoder.dimensions().map_err(fail)?;
    let channels = channels(decoder.colortype().map_err(fail)?, path)?;
    let size = Size {
        width,
        height,
        channels,
    };
    let expected = size.numbers(bytes.len(), path)?;
    check_stored_bytes(&mut decoder, expected, path)?;
    let result = decoder.read_image().map_err(fail)?;
    let eight_bit = matches!(result, DecodingResult::U8(_));
    let numbers = numbers_of(result)
        .ok_or_else(|| ReadError::unsupported(path, "texels of signed or 64-bit integers"))?;
    if numbers.len() != expected {
        let message = format!("{} numbers for an image of {expected}", numbers.len());
        return Err(ReadError::file(path, message));
    }
    Ok(Texels {
        size,
        numbers,
        eight_bit,
    })
}

/// Refuses texels without compression that the strips do not hold: the decoder would
/// read on into whatever follows them.
fn check_stored_bytes(
    decoder: &mut Decoder<Cursor<&[u8]>>,
    expected: usize,
    path: &Path,
) -> Result<(), ReadError> {
    let compression = decoder.find_tag_unsigned::<u16>(Tag::Compression);
    if !matches!(compression, Ok(None | Some(1))) {
        return Ok(());
    }
    let bits = decoder
        .colortype()
        .map_or(0, |color| u64::from(color.bit_depth()));
    let needed = expected as u64 * bits / 8;
    for tag in [Tag::StripByteCounts, Tag::TileByteCounts] {
        if let Ok(counts) = decoder.get_tag_u64_vec(tag) {
            let stored = counts.iter().fold(0, |sum: u64, &n| sum.saturating_add(n));
            if stored < needed {
                let message = format!("{stored} bytes stored for an image of {needed}");
                return Err(ReadError::file(path, message));
            }
        }
    }
    Ok(())
}

fn channels(color: ColorType, path: &Path) -> Result<u32, ReadError> {
    let whole_bytes = color.bit_depth().is_multiple_of(8);
    match color {
        ColorType::Gray(_) if whole_bytes => Ok(1),
        ColorType::GrayA(_) if whole_bytes => Ok(2),
        ColorType::RGB(_) if whole_bytes => Ok(3),
        ColorType::RGBA(_) if whole_bytes => Ok(4),
        other => {
            let message = format!("texels of kind {other:?} are not read");
            Err(ReadError::unsupported(path, message)
                .help("save as grey, RGB or RGBA of 8, 16 or 32 bits"))
        }
    }
}

fn numbers_of(result: DecodingResult) -> Option<pelage_surface::Texels> {
    Some(match result {
        DecodingResult::U8(codes) => codes.into(),
        DecodingResult::U16(codes) => codes.into(),
        DecodingResult::U32(codes) => codes
            .iter()
            .map(|&code| (f64::from(code) / f64::from(u32::MAX)) as f32)
            .collect::<Vec<f32>>()
            .into(),
        DecodingResult::F16(numbers) => numbers
            .iter()
            .map(|n| n.to_f32())
            .collect::<Vec<f32>>()
            .into(),
        DecodingResult::F32(numbers) => numbers.into(),
        DecodingResult::F64(numbers) => numbers
            .iter()
            .map(|&n| n as f32)
            .collect::<Vec<f32>>()
            .into(),
        _ => return None,
    })
}
