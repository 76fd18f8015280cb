//! Interpolation groups: which guides a hair may follow and how many segments it has.
//!
//! Source: document 004, section 2.2.4. A texel belongs to the listed colour nearest
//! to it, so that a soft brush or a lossy file makes no groups of its own.

use crate::PlanError;
use crate::code_map::{CodeMap, codes};
use crate::texture::Texture;
use pelage_curves::Vec2;

/// Most groups that a map may hold without its colours being listed.
const MOST_GROUPS: usize = 256;

/// One interpolation group.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// Colour codes of the group in the map, `None` where there is no map.
    pub color: Option<[u8; 3]>,
    /// Segments of its hairs; at least 1.
    pub segments: u32,
}

impl Group {
    /// The colour as `#rrggbb`, or what stands for it without a map.
    pub fn name(&self) -> String {
        match self.color {
            Some([r, g, b]) => format!("#{r:02x}{g:02x}{b:02x}"),
            None => "the only group".into(),
        }
    }
}

/// The groups of a groom and where they lie.
#[derive(Clone, Debug)]
pub struct Groups {
    groups: Vec<Group>,
    map: Option<CodeMap<u16>>,
}

impl Groups {
    /// One group of `segments` everywhere.
    pub fn single(segments: u32) -> Self {
        Self {
            groups: vec![Group {
                color: None,
                segments: segments.max(1),
            }],
            map: None,
        }
    }

    /// Groups by the colours of `map`, each with its number of segments.
    pub fn listed(map: &Texture, segments: &[([u8; 3], u32)]) -> Self {
        let groups: Vec<Group> = segments
            .iter()
            .map(|&(color, segments)| Group {
                color: Some(color),
                segments: segments.max(1),
            })
            .collect();
        Self {
            map: Some(CodeMap::new(map, |code| nearest(code, &groups))),
            groups,
        }
    }

    /// A group for each colour found in `map`, all of `segments`.
    pub fn found(map: &Texture, segments: u32) -> Result<Self, PlanError> {
        let mut colors: Vec<[u8; 3]> = Vec::new();
        let images = map.images();
        for texel in images.iter().flat_map(|(_, image)| codes(image)) {
            if let Err(at) = colors.binary_search(&texel) {
                if colors.len() == MOST_GROUPS {
                    return Err(PlanError::TooManyGroups { limit: MOST_GROUPS });
                }
                colors.insert(at, texel);
            }
        }
        let listed: Vec<_> = colors.into_iter().map(|color| (color, segments)).collect();
        Ok(Self::listed(map, &listed))
    }

    /// The same groups, each of `segments`; at least 1.
    pub fn with_segments(mut self, segments: u32) -> Self {
        for group in &mut self.groups {
            group.segments = segments.max(1);
        }
        self
    }

    /// All groups.
    pub fn all(&self) -> &[Group] {
        &self.groups
    }

    /// The group at texture coordinates `uv`.
    #[inline]
    pub fn at(&self, uv: Vec2) -> u32 {
        self.map.as_ref().map_or(0, |map| map.at(uv) as u32)
    }
}

/// The group whose colour is nearest to `code`.
fn nearest(code: [u8; 3], groups: &[Group]) -> u16 {
    let distance = |a: [u8; 3], b: [u8; 3]| -> u32 {
        (0..3).map(|k| (a[k].abs_diff(b[k]) as u32).pow(2)).sum()
    };
    let colors = groups
        .iter()
        .map(|g| distance(code, g.color.unwrap_or([0; 3])));
    colors
        .enumerate()
        .min_by_key(|&(_, d)| d)
        .map_or(0, |(i, _)| i as u16)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pelage_surface::{ImageMap, Wrap};
    use std::sync::Arc;

    fn clamped(width: u32, channels: u32, texels: Vec<f32>) -> Texture {
        let image = ImageMap::new(width, 1, channels, texels, true).unwrap();
        Texture::Image(Arc::new(image), Wrap::Clamp)
    }

    fn halves() -> Texture {
        // Left texel almost red, right one blue.
        clamped(2, 3, vec![0.95, 0.02, 0.0, 0.0, 0.0, 1.0])
    }

    #[test]
    fn a_texel_belongs_to_the_nearest_listed_colour() {
        let groups = Groups::listed(&halves(), &[([0, 0, 255], 6), ([255, 0, 0], 12)]);
        assert_eq!(groups.at(Vec2::new(0.25, 0.5)), 1);
        assert_eq!(groups.at(Vec2::new(0.75, 0.5)), 0);
        assert_eq!(groups.all()[1].segments, 12);
    }

    #[test]
    fn colours_are_found_in_order() {
        let groups = Groups::found(&halves(), 4).unwrap();
        assert_eq!(groups.all().len(), 2);
        assert_eq!(groups.all()[0].name(), "#0000ff");
    }

    #[test]
    fn a_photograph_is_no_map_of_groups() {
        let texels = (0..512).map(|i| (i % 300) as f32 / 300.0).collect();
        let noise = clamped(512, 1, texels);
        let few = Groups::found(&noise, 4);
        assert!(few.is_ok(), "256 grey codes at most");
        let texels = (0..3 * 512)
            .map(|i| (i * 37 % 256) as f32 / 255.0)
            .collect();
        let noise = clamped(512, 3, texels);
        assert!(Groups::found(&noise, 4).is_ok_and(|g| g.all().len() <= 256));
    }
}
