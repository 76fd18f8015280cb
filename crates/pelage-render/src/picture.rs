//! A finished picture, and PNG files.

use crate::RenderError;
use crate::color::{self, Rgb};
use crate::sampling::{hash2, unit};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use pelage_surface::srgb_from_linear;
use std::path::{Path, PathBuf};

/// A finished picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Per pixel, row by row from the top: linear light to be shown, Rec. 709
    /// primaries, 0..=1.
    pub rgb: Vec<[f32; 3]>,
    /// Strands that could not be drawn: NaN or infinite vertices, or fewer than two.
    pub skipped_strands: usize,
}

impl Picture {
    /// Three bytes a pixel, sRGB. Gradients are dithered by less than one step, the
    /// same way each time.
    pub fn to_rgb8(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.rgb.len() * 3);
        for (i, pixel) in self.rgb.iter().enumerate() {
            let dither = unit(hash2(i as u32, 0x51ed));
            let encode = |c: f32| (srgb_from_linear(c.clamp(0.0, 1.0)) * 255.0 + dither) as u8;
            bytes.extend(pixel.map(encode));
        }
        bytes
    }

    /// Three big-endian 16-bit numbers a pixel, sRGB.
    fn to_rgb16(&self) -> Vec<u16> {
        let encode = |c: f32| (srgb_from_linear(c.clamp(0.0, 1.0)) * 65535.0 + 0.5) as u16;
        self.rgb.iter().flat_map(|p| p.map(encode)).collect()
    }

    /// The picture as a PNG file of 8 bits a channel, sRGB.
    ///
    /// Fails where the arrays do not match the size.
    pub fn to_png_bytes(&self) -> Result<Vec<u8>, RenderError> {
        self.encode(&self.to_rgb8(), ExtendedColorType::Rgb8)
    }

    /// The picture as a PNG file of 16 bits a channel, sRGB.
    ///
    /// Fails where the arrays do not match the size.
    pub fn to_png16_bytes(&self) -> Result<Vec<u8>, RenderError> {
        // The encoder takes 16-bit numbers in the machine's own order.
        let bytes: Vec<u8> = self
            .to_rgb16()
            .into_iter()
            .flat_map(u16::to_ne_bytes)
            .collect();
        self.encode(&bytes, ExtendedColorType::Rgb16)
    }

    fn encode(&self, bytes: &[u8], kind: ExtendedColorType) -> Result<Vec<u8>, RenderError> {
        let expected = self.width as usize * self.height as usize;
        if self.rgb.len() != expected {
            return Err(RenderError::WrongCount {
                array: "rgb",
                found: self.rgb.len(),
                expected,
            });
        }
        let mut png = Vec::new();
        PngEncoder::new_with_quality(&mut png, CompressionType::Default, FilterType::Adaptive)
            .write_image(bytes, self.width, self.height, kind)
            .map_err(|e| RenderError::Write {
                path: PathBuf::from("PNG"),
                reason: e.to_string(),
            })?;
        Ok(png)
    }

    /// Writes the picture to `path` as PNG, 8 bits a channel. The file appears whole
    /// or not at all: it is written beside and renamed.
    pub fn write_png(&self, path: impl AsRef<Path>) -> Result<(), RenderError> {
        write_whole(path.as_ref(), &self.to_png_bytes()?)
    }

    /// As [`Picture::write_png`], 16 bits a channel.
    pub fn write_png16(&self, path: impl AsRef<Path>) -> Result<(), RenderError> {
        write_whole(path.as_ref(), &self.to_png16_bytes()?)
    }
}

fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), RenderError> {
    let fail = |reason: String| RenderError::Write {
        path: path.into(),
        reason,
    };
    let Some(name) = path.file_name() else {
        return Err(fail("it names no file".into()));
    };
    let mut beside = std::ffi::OsString::from(".");
    beside.push(name);
    beside.push(format!(".{}.part", std::process::id()));
    let beside = path.with_file_name(beside);
    let written = std::fs::write(&beside, bytes).and_then(|()| std::fs::rename(&beside, path));
    written.map_err(|e| {
        // Best effort: the first error is the one to tell.
        let _ = std::fs::remove_file(&beside);
        fail(e.to_string())
    })
}

/// Light to be shown from scene light.
pub(crate) fn develop(light: Rgb, gain: f32, film_tone: bool) -> [f32; 3] {
    let light = light * gain;
    let shown = if film_tone { color::tone(light) } else { light };
    shown.clamp(Rgb::ZERO, Rgb::ONE).to_array()
}
