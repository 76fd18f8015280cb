//! Properties that a map can modulate, ready to be read at a root.
//!
//! A property's map is decoded once, when the plan is made: one channel for numbers,
//! three for colours, sRGB undone. Two properties that read a file the same way share
//! the texels.

use crate::PlanError;
use crate::recipe::{Blend, Channel, ColorProperty, MapSpace, MapUse, ScalarProperty};
use crate::texture::Texture;
use pelage_curves::Vec2;
use pelage_surface::{
    Density, Displacement, ImageMap, Mesh, RootSampler, Texels, TiledDensity, Tiles,
    linear_from_srgb,
};
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

/// The images a groom uses, by the path that opens them. Those of a UDIM set stand there
/// one by one.
pub type Images = HashMap<PathBuf, Arc<ImageMap>>;

/// A number over the surface.
#[derive(Clone, Debug)]
pub struct ScalarField {
    value: f32,
    map: Option<Texture>,
}

impl ScalarField {
    /// 0 everywhere.
    pub(crate) const ZERO: Self = Self {
        value: 0.0,
        map: None,
    };

    /// 1 everywhere.
    pub(crate) const ONE: Self = Self {
        value: 1.0,
        map: None,
    };

    /// The value at texture coordinates `uv`.
    #[inline]
    pub fn at(&self, uv: Vec2) -> f32 {
        match &self.map {
            None => self.value,
            Some(map) => self.value * map.sample(uv, 0).unwrap_or(0.0),
        }
    }

    /// Writes the values at all of `uvs` to `values`, which is emptied first. One property
    /// for many hairs takes less time than many properties for one: see
    /// [`ImageMap::sample_all`].
    pub(crate) fn read(&self, uvs: &[Vec2], values: &mut Vec<f32>) {
        values.clear();
        values.resize(uvs.len(), self.value);
        if let Some(map) = &self.map {
            map.sample_all(uvs, 0, values);
            values.iter_mut().for_each(|v| *v *= self.value);
        }
    }

    /// Whether the value is 0 everywhere because the recipe says 0.
    pub(crate) fn is_zero(&self) -> bool {
        self.value == 0.0
    }

    /// Whether the recipe says 1, without a map.
    pub(crate) fn is_one(&self) -> bool {
        self.value == 1.0 && self.map.is_none()
    }

    /// The value at `uv` as a height of the surface there, with its slopes: differences
    /// over one texel around `uv`. They are continuous, as the slopes of the bilinear
    /// value are not, and lie where the value does, as the document's forward difference
    /// (004, 2.2.3) does not.
    pub(crate) fn displacement(&self, uv: Vec2) -> Displacement {
        let texel = self.map.as_ref().and_then(|map| map.texel(uv));
        let across = |half: Vec2| {
            let (before, after) = (uv - half, uv + half);
            // Not 2 · half: far from 0, coordinates are coarse.
            match (after - before).length() {
                0.0 => 0.0,
                step => (self.at(after) - self.at(before)) / step,
            }
        };
        let slope = |texel: Vec2| {
            let half = texel / 2.0;
            Vec2::new(across(Vec2::X * half.x), across(Vec2::Y * half.y))
        };
        Displacement {
            height: self.at(uv),
            slope: texel.map_or(Vec2::ZERO, slope),
        }
    }

    /// Draws roots on `rest` with this as their density; `None` where no hair can grow.
    pub(crate) fn sampler(&self, rest: &Mesh, seed: u64) -> Option<RootSampler> {
        let value = self.value;
        let map = match &self.map {
            Some(Texture::Tiles(tiles)) => {
                return RootSampler::tiled(rest, &TiledDensity { value, tiles }, seed);
            }
            Some(Texture::Image(image, wrap)) => Some((&**image, 0, *wrap)),
            None => None,
        };
        RootSampler::new(rest, &Density { value, map }, seed)
    }
}

/// A colour over the surface.
#[derive(Clone, Debug)]
pub struct ColorField {
    value: [f32; 3],
    map: Option<(Texture, Blend)>,
}

impl ColorField {
    /// The colour at texture coordinates `uv`, each part in 0..=1.
    #[inline]
    pub fn at(&self, uv: Vec2) -> [f32; 3] {
        let mut color = self.value;
        if let Some((map, blend)) = &self.map {
            let texel = map.sample_rgb(uv).unwrap_or_default();
            color = blended(*blend, color, texel);
        }
        color.map(|c| c.clamp(0.0, 1.0))
    }

    /// Writes the colours at all of `uvs` to `colors`, which is emptied first.
    pub(crate) fn read(&self, uvs: &[Vec2], colors: &mut Vec<[f32; 3]>) {
        colors.clear();
        colors.resize(uvs.len(), self.value.map(|c| c.clamp(0.0, 1.0)));
        if let Some((map, blend)) = &self.map {
            map.sample_rgb_all(uvs, colors);
            for color in colors {
                *color = blended(*blend, self.value, *color).map(|c| c.clamp(0.0, 1.0));
            }
        }
    }
}

#[inline(always)]
fn blended(blend: Blend, value: [f32; 3], texel: [f32; 3]) -> [f32; 3] {
    std::array::from_fn(|k| match blend {
        Blend::Add => value[k] + texel[k],
        Blend::Multiply => value[k] * texel[k],
    })
}

/// A channel of an image, and whether its codes are sRGB.
type OneChannel = (Channel, bool);

/// Turns properties into fields, sharing decoded maps.
pub(crate) struct FieldMaker<'a> {
    pub(crate) images: &'a Images,
    has_uvs: bool,
    /// By the image they were made of, which outlives this, and how.
    decoded: HashMap<(*const ImageMap, Option<OneChannel>), Arc<ImageMap>>,
}

impl<'a> FieldMaker<'a> {
    pub(crate) fn new(images: &'a Images, has_uvs: bool) -> Self {
        Self {
            images,
            has_uvs,
            decoded: HashMap::new(),
        }
    }

    pub(crate) fn scalar(
        &mut self,
        key: &str,
        property: &ScalarProperty,
    ) -> Result<ScalarField, PlanError> {
        let map = property.map.as_ref();
        Ok(ScalarField {
            value: property.value,
            map: map.map(|used| self.channel(key, used)).transpose()?,
        })
    }

    /// A number that must not be below 0 anywhere.
    pub(crate) fn density(
        &mut self,
        key: &str,
        property: &ScalarProperty,
    ) -> Result<ScalarField, PlanError> {
        let field = self.scalar(key, property)?;
        if let (Some(texture), Some(used)) = (&field.map, &property.map) {
            for (number, image) in texture.images() {
                refuse_negative(key, used, number, image)?;
            }
        }
        Ok(field)
    }

    /// The three entries of a list of frequencies.
    pub(crate) fn frequencies(
        &mut self,
        key: &str,
        [x, y, z]: &[ScalarProperty; 3],
    ) -> Result<[ScalarField; 3], PlanError> {
        Ok([
            self.scalar(&format!("{key}[0]"), x)?,
            self.scalar(&format!("{key}[1]"), y)?,
            self.scalar(&format!("{key}[2]"), z)?,
        ])
    }

    pub(crate) fn color(
        &mut self,
        key: &str,
        property: &ColorProperty,
    ) -> Result<ColorField, PlanError> {
        let map = match &property.map {
            None => None,
            Some(used) => {
                let texture = self.texture(key, used)?;
                // 8-bit colour maps hold sRGB codes unless the recipe says otherwise.
                let srgb = |image: &ImageMap| match used.space {
                    None => image.is_eight_bit(),
                    Some(space) => space == MapSpace::Srgb,
                };
                let decoded = texture.with_images(|image| match srgb(image) {
                    true => self.decode(image, None),
                    false => image.clone(),
                });
                Some((decoded, used.blend))
            }
        };
        Ok(ColorField {
            value: property.value,
            map,
        })
    }

    /// The image or images behind a map, refused where the surface has no UVs to read
    /// them at.
    pub(crate) fn texture(&self, key: &str, used: &MapUse) -> Result<Texture, PlanError> {
        if !self.has_uvs {
            return Err(PlanError::NoUvs {
                key: key.into(),
                map: used.path.written.clone(),
            });
        }
        let path = &used.path;
        let found = if path.is_tiled() {
            let numbered = |(file, image): (&PathBuf, &Arc<ImageMap>)| {
                Some((path.tile_number(file)?, image.clone()))
            };
            let tiles = Tiles::new(self.images.iter().filter_map(numbered));
            let any = tiles.iter().next().is_some();
            any.then_some(Texture::Tiles(tiles))
        } else {
            let image = self.images.get(&path.resolved).cloned();
            image.map(|image| Texture::Image(image, used.wrap))
        };
        found.ok_or_else(|| PlanError::MapNotLoaded {
            key: key.into(),
            map: path.resolved.clone(),
        })
    }

    fn channel(&mut self, key: &str, used: &MapUse) -> Result<Texture, PlanError> {
        let texture = self.texture(key, used)?;
        let channel = used.channel.unwrap_or(Channel::Red);
        let srgb = used.space == Some(MapSpace::Srgb);
        Ok(texture.with_images(|image| match (channel, srgb) {
            // What a grey image's only channel says of itself: the image as it is.
            (Channel::Red | Channel::Green | Channel::Blue | Channel::Luminance, false)
                if image.channels() == 1 =>
            {
                image.clone()
            }
            _ => self.decode(image, Some((channel, srgb))),
        }))
    }

    /// An image with one channel of it, or with its sRGB codes undone. Made once.
    fn decode(&mut self, image: &Arc<ImageMap>, one: Option<OneChannel>) -> Arc<ImageMap> {
        let decoded = self.decoded.entry((Arc::as_ptr(image), one));
        let made = decoded.or_insert_with(|| {
            Arc::new(match one {
                Some((channel, srgb)) => one_channel(image, channel, srgb),
                None => image.map_texels(linear_from_srgb),
            })
        });
        made.clone()
    }
}

/// Refuses a decoded image of `used` with a texel below 0.
fn refuse_negative(
    key: &str,
    used: &MapUse,
    tile: Option<u32>,
    image: &ImageMap,
) -> Result<(), PlanError> {
    let Some(texel) = image.texels().iter().position(|t| t < 0.0) else {
        return Ok(());
    };
    let path = &used.path;
    Err(PlanError::NegativeDensity {
        key: key.into(),
        file: tile.map_or(path.resolved.clone(), |number| path.tile(number)),
        x: (texel % image.width() as usize) as u32,
        y: (texel / image.width() as usize) as u32,
        channel: used.channel.unwrap_or(Channel::Red),
        value: image.texels().get(texel),
    })
}

/// One channel of an image (Rec. 709 weights for luminance), decoded.
fn one_channel(image: &ImageMap, channel: Channel, srgb: bool) -> ImageMap {
    let decode = |code: f32| if srgb { linear_from_srgb(code) } else { code };
    let channels = image.channels() as usize;
    let all = image.texels();
    let one = |k: usize| all.every(k, channels);
    let texels: Texels = match channel {
        Channel::Luminance if channels >= 3 => {
            let [red, green, blue] = [0, 1, 2].map(|k| one(k).map(decode));
            let parts = red.iter().zip(green.iter()).zip(blue.iter());
            let luminance = |((r, g), b)| 0.2126 * r + 0.7152 * g + 0.0722 * b;
            parts.map(luminance).collect::<Vec<f32>>().into()
        }
        // A one- or two-channel image is grey, with alpha last.
        Channel::Alpha if channels == 2 || channels == 4 => one(channels - 1),
        Channel::Alpha => one(0).map(|_| 1.0),
        Channel::Green if channels >= 3 => one(1).map(decode),
        Channel::Blue if channels >= 3 => one(2).map(decode),
        _ => one(0).map(decode),
    };
    ImageMap::new(
        image.width(),
        image.height(),
        1,
        texels,
        image.is_eight_bit(),
    )
    .unwrap_or_else(|_| image.clone())
}
