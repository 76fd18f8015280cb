//! Where the middles of clumps are: among the guides, spread over the surface, or in the
//! areas of a map. Told by the surface at rest alone.

use crate::PlanError;
use crate::code_map::{CodeMap, codes};
use crate::maps::{FieldMaker, ScalarField};
use crate::plan::Plan;
use crate::recipe::{ClumpAround, ClumpLevel, MapUse};
use pelage_curves::Vec3;
use pelage_surface::{BlueNoise, SurfacePoint};
use std::collections::BTreeMap;

/// Most clumps of a level: their middle hairs are kept in memory, some 300 bytes each.
const MOST_CLUMPS: u64 = 1 << 22;

/// Points among which the middles of the areas of a map are chosen.
const SEARCHED: u64 = 1 << 18;

/// The middles of a level of clumps.
#[derive(Default)]
pub(crate) struct Middles {
    /// Where they are.
    pub places: Vec<SurfacePoint>,
    /// The area of a map that each stands for, where there is a map.
    pub areas: Option<Areas>,
}

/// The areas of a map.
pub(crate) struct Areas {
    /// Their numbers over the surface.
    pub map: CodeMap<Option<u32>>,
    /// How many there are.
    pub count: usize,
    /// The area of each middle.
    pub of_middles: Vec<u32>,
}

impl Plan {
    /// The middles of the level `recipe`, whose dotted key is `key`.
    pub(crate) fn middles(
        &self,
        key: &str,
        recipe: &ClumpLevel,
        maker: &FieldMaker,
    ) -> Result<Middles, PlanError> {
        let places = match (recipe.around, recipe.size, &recipe.map) {
            (ClumpAround::Map, _, Some(map)) => {
                return self.areas(&format!("{key}.map"), map, maker);
            }
            (ClumpAround::Points, Some(size), _) => {
                self.scattered(&format!("{key}.size"), size as f64)?
            }
            (ClumpAround::Guides, ..) => {
                let roots = self.guides.iter().flat_map(|guides| &guides.roots);
                roots.copied().collect()
            }
            // No recipe that was read lacks what it needs.
            _ => Vec::new(),
        };
        Ok(Middles {
            places,
            areas: None,
        })
    }

    /// Points spread evenly over the surface, one on each `size` × `size` of it.
    fn scattered(&self, key: &str, size: f64) -> Result<Vec<SurfacePoint>, PlanError> {
        let rest = self.rest();
        let wanted = rest.surface_area() / (size * size);
        // A count beyond u64 is refused too.
        refuse_too_many(key, wanted as u64)?;
        let mut places = Vec::new();
        if let Some(sampler) = ScalarField::ONE.sampler(rest, self.seed) {
            let points = BlueNoise::new(rest, &sampler, (wanted as u64).max(1));
            points.roots(0..points.len() as u64, &mut places);
        }
        Ok(places)
    }

    /// The middles of the areas of each colour of a map but black.
    fn areas(&self, key: &str, used: &MapUse, maker: &FieldMaker) -> Result<Middles, PlanError> {
        let texture = maker.texture(key, used)?;
        let mut numbers = BTreeMap::new();
        for (_, image) in texture.images() {
            for code in codes(image).filter(|&code| code != [0; 3]) {
                let next = numbers.len() as u32;
                numbers.entry(code).or_insert(next);
            }
        }
        refuse_too_many(key, numbers.len() as u64)?;
        let map = CodeMap::new(&texture, |code| numbers.get(&code).copied());
        let mut found = Vec::new();
        if let Some(sampler) = ScalarField::ONE.sampler(self.rest(), self.seed) {
            sampler.roots(0..SEARCHED, &mut found);
        }
        let chosen = self.middle_of_each(&map, numbers.len(), &found);
        Ok(Middles {
            places: chosen.iter().map(|(_, place)| *place).collect(),
            areas: Some(Areas {
                map,
                count: numbers.len(),
                of_middles: chosen.iter().map(|(area, _)| *area).collect(),
            }),
        })
    }

    /// Of the places `found` in each of `count` areas, the one nearest to their mean.
    fn middle_of_each(
        &self,
        map: &CodeMap<Option<u32>>,
        count: usize,
        found: &[SurfacePoint],
    ) -> Vec<(u32, SurfacePoint)> {
        let rest = self.rest();
        let in_areas = || {
            let areas = found.iter().map(|place| (map.at(rest.uv(place)), place));
            areas.filter_map(|(area, place)| Some((area? as usize, place)))
        };
        let mut sums = vec![(Vec3::ZERO, 0.0); count];
        for (area, place) in in_areas() {
            sums[area].0 += rest.position(place);
            sums[area].1 += 1.0;
        }
        let mut chosen: Vec<Option<(f32, SurfacePoint)>> = vec![None; count];
        for (area, place) in in_areas() {
            let (sum, number) = sums[area];
            let apart = rest.position(place).distance_squared(sum / number);
            if chosen[area].is_none_or(|(least, _)| apart < least) {
                chosen[area] = Some((apart, *place));
            }
        }
        let numbered = chosen.iter().enumerate();
        numbered
            .filter_map(|(area, chosen)| Some((area as u32, (*chosen)?.1)))
            .collect()
    }
}

fn refuse_too_many(key: &str, found: u64) -> Result<(), PlanError> {
    match found <= MOST_CLUMPS {
        true => Ok(()),
        false => Err(PlanError::TooManyClumps {
            key: key.into(),
            found,
            limit: MOST_CLUMPS,
        }),
    }
}
