//! Properties that a map can modulate, ready to be read at a root.
//!
//! A property's map is decoded once, when the plan is made: one channel for numbers,
//! three for colours, sRGB undone. Two properties that read a file the same way share
//! the texels.

use crate::PlanError;
use crate::recipe::{Blend, Channel, ColorProperty, MapSpace, MapUse, ScalarProperty};
use pelage_curves::Vec2;
use pelage_surface::{Displacement, ImageMap, Wrap, linear_from_srgb};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The images a groom uses, by the path that opens them.
pub type Images = HashMap<PathBuf, Arc<ImageMap>>;

/// A number over the surface.
#[derive(Clone, Debug)]
pub struct ScalarField {
    value: f32,
    map: Option<(Arc<ImageMap>, Wrap)>,
}

impl ScalarField {
    /// The value at texture coordinates `uv`.
    #[inline]
    pub fn at(&self, uv: Vec2) -> f32 {
        match &self.map {
            None => self.value,
            Some((map, wrap)) => self.value * map.sample(uv.x, uv.y, 0, *wrap),
        }
    }

    /// Whether the value is 0 everywhere because the recipe says 0.
    pub(crate) fn is_zero(&self) -> bool {
        self.value == 0.0
    }

    /// The value at `uv` as a height of the surface there, with its slopes: differences
    /// over one texel around `uv`. They are continuous, as the slopes of the bilinear
    /// value are not, and lie where the value does, as the document's forward difference
    /// (004, 2.2.3) does not.
    pub(crate) fn displacement(&self, uv: Vec2) -> Displacement {
        let Some((map, _)) = &self.map else {
            return Displacement {
                height: self.value,
                slope: Vec2::ZERO,
            };
        };
        let across = |half: Vec2| {
            let (before, after) = (uv - half, uv + half);
            // Not 2 · half: far from 0, coordinates are coarse.
            match (after - before).length() {
                0.0 => 0.0,
                step => (self.at(after) - self.at(before)) / step,
            }
        };
        let [half_u, half_v] = [map.width(), map.height()].map(|n| 0.5 / n as f32);
        Displacement {
            height: self.at(uv),
            slope: Vec2::new(across(Vec2::X * half_u), across(Vec2::Y * half_v)),
        }
    }

    /// The factor and the single-channel map, for whoever samples by it.
    pub fn parts(&self) -> (f32, Option<(&ImageMap, Wrap)>) {
        (
            self.value,
            self.map.as_ref().map(|(map, wrap)| (&**map, *wrap)),
        )
    }
}

/// A colour over the surface.
#[derive(Clone, Debug)]
pub struct ColorField {
    value: [f32; 3],
    map: Option<(Arc<ImageMap>, Wrap, Blend)>,
}

impl ColorField {
    /// The colour at texture coordinates `uv`, each part in 0..=1.
    #[inline]
    pub fn at(&self, uv: Vec2) -> [f32; 3] {
        let mut color = self.value;
        if let Some((map, wrap, blend)) = &self.map {
            let texel = map.sample_rgb(uv.x, uv.y, *wrap);
            for (c, t) in color.iter_mut().zip(texel) {
                match blend {
                    Blend::Add => *c += t,
                    Blend::Multiply => *c *= t,
                }
            }
        }
        color.map(|c| c.clamp(0.0, 1.0))
    }
}

/// Turns properties into fields, sharing decoded maps.
pub(crate) struct FieldMaker<'a> {
    images: &'a Images,
    has_uvs: bool,
    decoded: HashMap<(PathBuf, Channel, bool), Arc<ImageMap>>,
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
        let map = match &property.map {
            None => None,
            Some(used) => Some((self.channel(key, used)?, used.wrap)),
        };
        Ok(ScalarField {
            value: property.value,
            map,
        })
    }

    pub(crate) fn color(
        &mut self,
        key: &str,
        property: &ColorProperty,
    ) -> Result<ColorField, PlanError> {
        let map = match &property.map {
            None => None,
            Some(used) => {
                let image = self.image(key, used)?;
                // 8-bit colour maps hold sRGB codes unless the recipe says otherwise.
                let srgb = used
                    .space
                    .map_or(image.is_eight_bit(), |s| s == MapSpace::Srgb);
                let image = if srgb {
                    Arc::new(image.map_texels(linear_from_srgb))
                } else {
                    image
                };
                Some((image, used.wrap, used.blend))
            }
        };
        Ok(ColorField {
            value: property.value,
            map,
        })
    }

    /// The image behind a map, refused where the surface has no UVs to read it at.
    pub(crate) fn image(&self, key: &str, used: &MapUse) -> Result<Arc<ImageMap>, PlanError> {
        if !self.has_uvs {
            return Err(PlanError::NoUvs {
                key: key.into(),
                map: used.path.written.clone(),
            });
        }
        self.images
            .get(&used.path.resolved)
            .cloned()
            .ok_or_else(|| PlanError::MapNotLoaded {
                key: key.into(),
                map: path(used),
            })
    }

    fn channel(&mut self, key: &str, used: &MapUse) -> Result<Arc<ImageMap>, PlanError> {
        let image = self.image(key, used)?;
        let channel = used.channel.unwrap_or(Channel::Red);
        let srgb = used.space == Some(MapSpace::Srgb);
        let at = (used.path.resolved.clone(), channel, srgb);
        if let Some(done) = self.decoded.get(&at) {
            return Ok(done.clone());
        }
        let decoded = Arc::new(one_channel(&image, channel, srgb));
        self.decoded.insert(at, decoded.clone());
        Ok(decoded)
    }
}

fn path(used: &MapUse) -> PathBuf {
    Path::new(&used.path.resolved).to_owned()
}

/// One channel of an image (Rec. 709 weights for luminance), decoded.
fn one_channel(image: &ImageMap, channel: Channel, srgb: bool) -> ImageMap {
    let decode = |code: f32| if srgb { linear_from_srgb(code) } else { code };
    let channels = image.channels() as usize;
    let pick = |texel: &[f32]| match channel {
        Channel::Luminance if channels >= 3 => {
            0.2126 * decode(texel[0]) + 0.7152 * decode(texel[1]) + 0.0722 * decode(texel[2])
        }
        // A one- or two-channel image is grey, with alpha last.
        Channel::Alpha if channels == 2 || channels == 4 => texel[channels - 1],
        Channel::Alpha => 1.0,
        Channel::Green if channels >= 3 => decode(texel[1]),
        Channel::Blue if channels >= 3 => decode(texel[2]),
        _ => decode(texel[0]),
    };
    let texels = image.texels().chunks_exact(channels).map(pick).collect();
    ImageMap::new(
        image.width(),
        image.height(),
        1,
        texels,
        image.is_eight_bit(),
    )
    .unwrap_or_else(|_| image.clone())
}
