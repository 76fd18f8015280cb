//! Images of every format, written by their own libraries and read back.

use crate::{Blame, PngCodes, ReadError, parse_image, read_image, write_exr, write_png};
use pelage_surface::ImageMap;
use std::io::Cursor;
use std::path::Path;
use tiff::encoder::{TiffEncoder, colortype};

fn parse(bytes: &[u8]) -> Result<ImageMap, ReadError> {
    parse_image(bytes, Path::new("a.img"))
}

fn tiff<C: colortype::ColorType>(width: u32, height: u32, codes: &[C::Inner]) -> Vec<u8>
where
    [C::Inner]: tiff::encoder::TiffValue,
{
    let mut bytes = Cursor::new(Vec::new());
    TiffEncoder::new(&mut bytes)
        .unwrap()
        .write_image::<C>(width, height, codes)
        .unwrap();
    bytes.into_inner()
}

#[test]
fn png_codes_come_back_undecoded() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    for channels in 1..=4 {
        let codes: Vec<u8> = (0..6 * channels as u8).collect();
        write_png(&path, 3, 2, channels, PngCodes::Eight(&codes)).unwrap();
        let map = read_image(&path).unwrap();
        assert!(map.is_eight_bit());
        assert_eq!(map.channels(), channels);
        assert_eq!(map.texels().get(5), 5.0 / 255.0);
        let codes: Vec<u16> = (0..6 * channels as u16).map(|c| c * 2000).collect();
        write_png(&path, 3, 2, channels, PngCodes::Sixteen(&codes)).unwrap();
        let map = read_image(&path).unwrap();
        assert!(!map.is_eight_bit());
        assert_eq!(map.texels().get(5), 10000.0 / 65535.0);
    }
}

#[test]
fn exr_floats_come_back_exactly_in_any_channel_count() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    for channels in 1..=4 {
        let numbers: Vec<f32> = (0..6 * channels).map(|i| i as f32 * 1.1 - 3.0).collect();
        write_exr(&path, 2, 3, channels, &numbers).unwrap();
        let map = read_image(&path).unwrap();
        assert_eq!((map.width(), map.height()), (2, 3));
        assert!(map.texels().iter().eq(numbers));
        assert!(!map.is_eight_bit());
    }
}

#[test]
fn a_texel_that_is_not_finite_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("hole.exr");
    write_exr(&path, 2, 2, 1, &[0.0, 0.0, f32::NAN, 0.0]).unwrap();
    let error = read_image(&path).unwrap_err().to_string();
    assert!(error.contains("hole.exr"), "{error}");
    assert!(error.contains("column 0, row 1"), "{error}");
}

#[test]
fn tiff_of_every_depth_is_read() {
    let map = parse(&tiff::<colortype::Gray8>(2, 1, &[0, 51])).unwrap();
    assert!(map.texels().iter().eq([0.0, 0.2]));
    assert!(map.is_eight_bit());
    let map = parse(&tiff::<colortype::RGB16>(1, 1, &[0, 65535, 13107])).unwrap();
    assert!(map.texels().iter().eq([0.0, 1.0, 0.2]));
    assert!(!map.is_eight_bit());
    let map = parse(&tiff::<colortype::Gray32Float>(2, 1, &[-1.5, 7.0])).unwrap();
    assert!(map.texels().iter().eq([-1.5, 7.0]));
    assert_eq!(map.channels(), 1);
}

#[test]
fn jpeg_and_radiance_are_read() {
    let mut jpeg = Vec::new();
    image::codecs::jpeg::JpegEncoder::new(&mut jpeg)
        .encode(&[128; 64 * 3], 8, 8, image::ExtendedColorType::Rgb8)
        .unwrap();
    let map = parse(&jpeg).unwrap();
    assert!(map.is_eight_bit() && map.channels() == 3);
    assert!((map.texels().get(0) - 0.5).abs() < 0.02);
    let mut hdr = Vec::new();
    image::codecs::hdr::HdrEncoder::new(&mut hdr)
        .encode(&[image::Rgb([4.0, 0.5, 0.25]); 16], 8, 2)
        .unwrap();
    let hdr = parse(&hdr).unwrap();
    assert_eq!([0, 1, 2].map(|k| hdr.texel(7, 1, k)), [4.0, 0.5, 0.25]);
}

#[test]
fn a_small_file_cannot_claim_a_large_image() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    write_png(&path, 1, 1, 1, PngCodes::Eight(&[0])).unwrap();
    let mut bytes = std::fs::read(&path).unwrap();
    // Width and height of IHDR, and its checksum.
    bytes[16..24].copy_from_slice(&[0, 0, 0x20, 0, 0, 0, 0x20, 0]);
    let error = parse(&bytes).unwrap_err();
    assert!(matches!(error.blame, Blame::Limit | Blame::File), "{error}");
    let bytes = tiff::<colortype::Gray8>(2, 2, &[0; 4]);
    for cut in 0..bytes.len() {
        let _ = parse(&bytes[..cut]);
    }
}

#[test]
fn what_cannot_be_written_is_refused_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    assert!(write_png(&path, 2, 2, 3, PngCodes::Eight(&[0; 11])).is_err());
    assert!(write_exr(&path, 1, 1, 5, &[0.0; 5]).is_err());
    assert!(write_exr(&path, 0, 1, 1, &[]).is_err());
    assert!(std::fs::read_dir(folder.path()).unwrap().next().is_none());
}
