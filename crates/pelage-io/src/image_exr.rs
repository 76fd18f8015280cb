//! OpenEXR images: half, float or integer channels in any order.
//!
//! The first flat layer counts. Its channels are R, G, B, A (as many as there are)
//! or Y (with A); a lone channel of any name is taken too. The map is the display
//! window; texels outside the data window are 0, as the format's own tools do.
//!
//! Limits: deep data and subsampled (luminance–chroma) channels are not read.

use crate::ReadError;
use crate::image::{Size, Texels, decode_error};
use exr::meta::MetaData;
use exr::meta::header::Header;
use exr::prelude::{
    AnyChannel, AnyChannels, FlatSamples, IntegerBounds, Layer, ReadChannels, ReadLayers, Vec2,
    read,
};
use std::io::Cursor;
use std::path::Path;

/// The first layer of the EXR file `bytes`.
pub(crate) fn texels(bytes: &[u8], path: &Path) -> Result<Texels, ReadError> {
    let fail = |error| decode_error(path, error);
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(fail)?;
    for header in &meta.headers {
        check_header(header, bytes.len(), path)?;
    }
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(fail)?;
    let layer = &image.layer_data;
    let channels = choose_channels(&layer.channel_data.list, path)?;
    let window = image.attributes.display_window;
    let size = size(window.size, channels.len(), path)?;
    let mut numbers = vec![0.0; size.numbers(bytes.len(), path)?];
    for (c, channel) in channels.iter().enumerate() {
        copy_channel(channel, c, channels.len(), layer, window, &mut numbers);
    }
    Ok(Texels {
        size,
        numbers: numbers.into(),
        eight_bit: false,
    })
}

/// Refuses what the decoder would allocate without asking.
fn check_header(header: &Header, file_bytes: usize, path: &Path) -> Result<(), ReadError> {
    let channels = header.channels.list.len();
    size(header.layer_size, channels, path)?.numbers(file_bytes, path)?;
    let window = header.shared_attributes.display_window;
    size(window.size, 1, path)?.numbers(file_bytes, path)?;
    if let Some(channel) = header
        .channels
        .list
        .iter()
        .find(|channel| channel.sampling != Vec2(1, 1))
    {
        let message = format!("channel {} is subsampled", channel.name);
        return Err(ReadError::unsupported(path, message).help("save it as RGB or Y"));
    }
    Ok(())
}

fn size(size: Vec2<usize>, channels: usize, path: &Path) -> Result<Size, ReadError> {
    let fits = |n: usize| {
        u32::try_from(n).map_err(|_| ReadError::file(path, format!("{n} texels in a row")))
    };
    Ok(Size {
        width: fits(size.0)?,
        height: fits(size.1)?,
        channels: fits(channels)?,
    })
}

/// The channels that make the map, in its order.
fn choose_channels<'a>(
    list: &'a [AnyChannel<FlatSamples>],
    path: &Path,
) -> Result<Vec<&'a AnyChannel<FlatSamples>>, ReadError> {
    let named = |names: &[&str]| -> Vec<_> {
        let find = |name: &&str| list.iter().find(|channel| channel.name == **name);
        names.iter().filter_map(find).collect()
    };
    let color = named(&["R", "G", "B"]);
    if !color.is_empty() {
        return Ok(named(&["R", "G", "B", "A"]));
    }
    if !named(&["Y"]).is_empty() {
        return Ok(named(&["Y", "A"]));
    }
    if let [only] = list {
        return Ok(vec![only]);
    }
    let names: Vec<_> = list.iter().map(|c| c.name.to_string()).take(20).collect();
    let message = format!(
        "neither R, G, B nor Y is among the channels {}",
        names.join(", ")
    );
    Err(ReadError::unsupported(path, message))
}

/// Writes one channel into every `channels`-th number of the display window.
fn copy_channel(
    channel: &AnyChannel<FlatSamples>,
    offset: usize,
    channels: usize,
    layer: &Layer<AnyChannels<FlatSamples>>,
    window: IntegerBounds,
    numbers: &mut [f32],
) {
    let (width, height) = (window.size.0 as i64, window.size.1 as i64);
    let shift = |axis: fn(Vec2<i32>) -> i32| {
        i64::from(axis(layer.attributes.layer_position)) - i64::from(axis(window.position))
    };
    let (shift_x, shift_y) = (shift(|v| v.0), shift(|v| v.1));
    let row_length = layer.size.0.max(1);
    for (i, value) in channel.sample_data.values_as_f32().enumerate() {
        let x = (i % row_length) as i64 + shift_x;
        let y = (i / row_length) as i64 + shift_y;
        if (0..width).contains(&x) && (0..height).contains(&y) {
            numbers[(y * width + x) as usize * channels + offset] = value;
        }
    }
}
