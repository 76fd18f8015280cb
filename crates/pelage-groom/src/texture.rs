//! A map as a property reads it.

use pelage_curves::Vec2;
use pelage_surface::{ImageMap, Tiles, Wrap};
use std::sync::Arc;

/// One image with what lies around it, or the tiles of a UDIM set.
#[derive(Clone, Debug)]
pub enum Texture {
    /// An image, and what lies outside 0..1.
    Image(Arc<ImageMap>, Wrap),
    /// An image for each unit square.
    Tiles(Tiles<Arc<ImageMap>>),
}

impl Texture {
    /// Bilinear value of `channel` at `uv`; `None` where a set has no tile.
    #[inline(always)]
    pub fn sample(&self, uv: Vec2, channel: u32) -> Option<f32> {
        match self {
            Self::Image(image, wrap) => Some(image.sample(uv.x, uv.y, channel, *wrap)),
            Self::Tiles(tiles) => tiles.sample(uv.x, uv.y, channel),
        }
    }

    /// Bilinear colour at `uv`; `None` where a set has no tile.
    #[inline(always)]
    pub fn sample_rgb(&self, uv: Vec2) -> Option<[f32; 3]> {
        match self {
            Self::Image(image, wrap) => Some(image.sample_rgb(uv.x, uv.y, *wrap)),
            Self::Tiles(tiles) => tiles.sample_rgb(uv.x, uv.y),
        }
    }

    /// Writes the bilinear values of `channel` at all of `uvs` to `values`, which has the
    /// same length; 0 where a set has no tile.
    pub(crate) fn sample_all(&self, uvs: &[Vec2], channel: u32, values: &mut [f32]) {
        match self {
            Self::Image(image, wrap) => image.sample_all(uvs, channel, *wrap, values),
            Self::Tiles(tiles) => {
                for (value, uv) in values.iter_mut().zip(uvs) {
                    *value = tiles.sample(uv.x, uv.y, channel).unwrap_or(0.0);
                }
            }
        }
    }

    /// Writes the bilinear colours at all of `uvs` to `colors`, which has the same length;
    /// black where a set has no tile.
    pub(crate) fn sample_rgb_all(&self, uvs: &[Vec2], colors: &mut [[f32; 3]]) {
        match self {
            Self::Image(image, wrap) => image.sample_rgb_all(uvs, *wrap, colors),
            Self::Tiles(tiles) => {
                for (color, uv) in colors.iter_mut().zip(uvs) {
                    *color = tiles.sample_rgb(uv.x, uv.y).unwrap_or_default();
                }
            }
        }
    }

    /// Width and height of a texel at `uv`, in texture space; `None` where a set has no
    /// tile.
    pub fn texel(&self, uv: Vec2) -> Option<Vec2> {
        let image: &ImageMap = match self {
            Self::Image(image, _) => image,
            Self::Tiles(tiles) => tiles.at(uv.x, uv.y)?.0,
        };
        Some(Vec2::new(image.width() as f32, image.height() as f32).recip())
    }

    /// Its images, each with the number of its tile if it is one.
    pub fn images(&self) -> Vec<(Option<u32>, &ImageMap)> {
        match self {
            Self::Image(image, _) => vec![(None, image)],
            Self::Tiles(tiles) => tiles.iter().map(|(n, image)| (Some(n), &**image)).collect(),
        }
    }

    /// The same with other images.
    pub(crate) fn with_images(&self, mut f: impl FnMut(&Arc<ImageMap>) -> Arc<ImageMap>) -> Self {
        match self {
            Self::Image(image, wrap) => Self::Image(f(image), *wrap),
            Self::Tiles(tiles) => Self::Tiles(tiles.map(f)),
        }
    }
}
