//! Maps whose colours are names: what a colour stands for, at each texel.

use crate::texture::Texture;
use pelage_curves::Vec2;
use pelage_surface::{ImageMap, Tiles, Wrap};

/// What the colours of a map stand for, without filtering.
#[derive(Clone, Debug)]
pub(crate) struct CodeMap<T> {
    texels: Extent<T>,
    /// Where a set has no tile.
    elsewhere: T,
}

#[derive(Clone, Debug)]
enum Extent<T> {
    Image(Texels<T>, Wrap),
    Tiles(Tiles<Texels<T>>),
}

#[derive(Clone, Debug)]
struct Texels<T> {
    width: u32,
    height: u32,
    /// Rows from the top.
    values: Vec<T>,
}

impl<T: Copy> CodeMap<T> {
    /// Takes `meaning` of the 8-bit code of each texel of `map`; where a set has no tile
    /// it is that of black.
    pub(crate) fn new(map: &Texture, meaning: impl Fn([u8; 3]) -> T) -> Self {
        let texels = |image: &ImageMap| Texels {
            width: image.width(),
            height: image.height(),
            values: codes(image).map(&meaning).collect(),
        };
        Self {
            texels: match map {
                Texture::Image(image, wrap) => Extent::Image(texels(image), *wrap),
                Texture::Tiles(tiles) => Extent::Tiles(tiles.map(|image| texels(image))),
            },
            elsewhere: meaning([0; 3]),
        }
    }

    /// The meaning of the texel at texture coordinates `uv`.
    #[inline]
    pub(crate) fn at(&self, uv: Vec2) -> T {
        match &self.texels {
            Extent::Image(texels, wrap) => texels.at([uv.x, uv.y], *wrap),
            Extent::Tiles(tiles) => tiles
                .at(uv.x, uv.y)
                .map_or(self.elsewhere, |(texels, uv)| texels.at(uv, Wrap::Clamp)),
        }
    }
}

impl<T: Copy> Texels<T> {
    fn at(&self, uv: [f32; 2], wrap: Wrap) -> T {
        let [x, y] = wrap.texel(uv, [self.width, self.height]);
        self.values[y as usize * self.width as usize + x as usize]
    }
}

/// Colour codes of an image's texels; grey ones have equal parts.
pub(crate) fn codes(map: &ImageMap) -> impl Iterator<Item = [u8; 3]> {
    let channels = map.channels() as usize;
    let texels = map.texels();
    (0..texels.len() / channels).map(move |texel| {
        let number = |k: usize| texels.get(texel * channels + if channels >= 3 { k } else { 0 });
        let code = |k: usize| (number(k) * 255.0 + 0.5) as u8;
        [code(0), code(1), code(2)]
    })
}
