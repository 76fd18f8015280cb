//! Tiles of UDIM sets that have no image although the surface lies in them.
//!
//! A map is black there, which may be meant (eyes and claws grow nothing) or an export
//! that went wrong, so it is told and not refused.

use crate::maps::FieldMaker;
use crate::recipe::{MapUse, Recipe};
use pelage_surface::{Mesh, Tiles, tile_number};

impl FieldMaker<'_> {
    /// A note for each property, of those `of` takes by key, whose set leaves out a part
    /// of `rest`.
    pub(crate) fn missing_tiles(
        &self,
        recipe: &Recipe,
        rest: &Mesh,
        of: impl Fn(&str) -> bool,
    ) -> Vec<String> {
        let maps = recipe.maps().into_iter();
        maps.filter(|(key, used)| of(key) && used.path.is_tiled())
            .filter_map(|(key, used)| self.missing(&key, used, rest))
            .collect()
    }

    fn missing(&self, key: &str, used: &MapUse, rest: &Mesh) -> Option<String> {
        let loaded = self.images.keys();
        let tiles = Tiles::new(loaded.filter_map(|file| Some((used.path.tile_number(file)?, ()))));
        let middles = rest.uvs().iter().enumerate();
        let mut missing = middles
            .filter(|&(triangle, _)| rest.area(triangle) > 0.0)
            .map(|(_, [a, b, c])| (*a + *b + *c) / 3.0)
            .filter(|middle| tiles.at(middle.x, middle.y).is_none())
            .peekable();
        let first = missing.peek()?;
        let place = match tile_number(first.x, first.y) {
            Some(number) => format!("in tile {number}"),
            None => format!("at u = {}, v = {}", first.x, first.y),
        };
        let where_to = match missing.count() {
            1 => format!("a triangle {place}"),
            n => format!("{n} triangles, the first of them {place}"),
        };
        Some(format!(
            "{key}: {} has no image for {where_to}; the map is black there",
            used.path
        ))
    }
}
