//! Roots without hair: the part of a groom that tells where hairs stand.
//!
//! A [`Plan`](crate::Plan) begins with one of these, so roots that are written by
//! themselves are those of the hairs.

use crate::PlanError;
use crate::generate::{GenerateError, Request};
use crate::groom::Groom;
use crate::groups::Groups;
use crate::in_order::in_order;
use crate::maps::{FieldMaker, ScalarField};
use crate::plan;
use crate::recipe::Recipe;
use pelage_strands::{Sink, StrandBuffer};
use pelage_surface::{Mesh, RootSampler, SurfacePoint};
use std::ops::Range;

/// Roots in a chunk, a power of two: drawing them is fastest in large aligned blocks,
/// and a chunk (some 5 MB) should not take much memory.
const BLOCK: u64 = 1 << 16;

/// Where the hairs of a groom stand: its surface, density and groups, compiled.
#[derive(Clone, Debug)]
pub struct RootPlan {
    pub(crate) rest: Mesh,
    pub(crate) sampler: Option<RootSampler>,
    /// Where the recipe leaves their segments to the guides, they have one.
    pub(crate) groups: Groups,
    density: ScalarField,
    count: u64,
    notes: Vec<String>,
}

impl RootPlan {
    /// Compiles what `groom` says of roots. Its guides are not looked at, and of its
    /// images only those of `roots` and `groups` must be there.
    pub fn new(groom: Groom) -> Result<Self, PlanError> {
        let rest = plan::rest(groom.mesh, groom.keep_file_normals)?;
        let mut maker = FieldMaker::new(&groom.images, rest.has_uvs());
        Self::on(rest, &groom.recipe, &mut maker)
    }

    /// Whether the map of the property `key` says something of roots.
    pub fn needs(key: &str) -> bool {
        key.starts_with("roots.") || key.starts_with("groups.")
    }

    pub(crate) fn on(
        rest: Mesh,
        recipe: &Recipe,
        maker: &mut FieldMaker,
    ) -> Result<Self, PlanError> {
        let density = maker.density("roots.density", &recipe.roots.density)?;
        let sampler = density.sampler(&rest, recipe.hair.seed);
        let mut notes = maker.missing_tiles(recipe, &rest, Self::needs);
        let degenerate = rest.degenerate_triangles();
        if degenerate > 0 {
            notes.push(format!("{degenerate} degenerate triangles grow no hair"));
        }
        if sampler.is_none() {
            notes.push("roots.density is 0 on the whole surface: no hair can grow".into());
        }
        Ok(Self {
            groups: plan::groups(recipe, maker)?,
            count: sampler.as_ref().map_or(0, |_| recipe.hair.count),
            rest,
            sampler,
            density,
            notes,
        })
    }

    /// Hairs the recipe asks for; 0 where no hair can grow.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// The surface at rest.
    pub fn rest(&self) -> &Mesh {
        &self.rest
    }

    /// Draws roots; `None` where no hair can grow.
    pub fn sampler(&self) -> Option<&RootSampler> {
        self.sampler.as_ref()
    }

    /// What `roots.density` says of `place`, before the surface is cut into pieces.
    pub fn density(&self, place: &SurfacePoint) -> f32 {
        self.density.at(self.rest.uv(place))
    }

    /// Things worth telling that are no errors, in plain words.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// Writes the roots of `hairs` into `out`, which is emptied first: strands of one
    /// vertex on `pose` (or the rest pose) with the surface's normal.
    fn write(
        &self,
        hairs: Range<u64>,
        pose: Option<&Mesh>,
        places: &mut Vec<SurfacePoint>,
        out: &mut StrandBuffer,
    ) {
        out.clear();
        places.clear();
        let Some(sampler) = &self.sampler else {
            return;
        };
        sampler.roots(hairs.clone(), places);
        let (rest, posed) = (&self.rest, pose.unwrap_or(&self.rest));
        // Array by array: neighbours in `places` lie far apart on the surface, and so
        // only one array of the mesh at a time competes for the cache.
        out.offsets.extend(1..=places.len() as u32);
        let point = |place| posed.position(place).to_array();
        out.points.extend(places.iter().map(point));
        let normal = |place| posed.normal(place).to_array();
        out.normals.extend(places.iter().map(normal));
        out.hair_id.extend(hairs);
        let uv = |place| rest.uv(place).to_array();
        out.root_uv.extend(places.iter().map(uv));
        let group = |&uv: &[f32; 2]| self.groups.at(uv.into());
        out.group.extend(out.root_uv.iter().map(group));
        out.triangle.extend(places.iter().map(|p| p.triangle));
        out.barycentric.extend(places.iter().map(|p| p.barycentric));
        let at_rest = |place| rest.position(place).to_array();
        out.root_rest.extend(places.iter().map(at_rest));
    }
}

/// Writes the roots of the hairs of `request` into `sink`, as one frame on `pose` (the
/// rest pose where it is `None`), and gives their number.
///
/// Roots are strands of one vertex: `points` on the posed surface, `normals` of the
/// surface, and what else strands tell of their roots. `progress` is called as by
/// [`generate`](crate::generate).
pub fn write_roots(
    plan: &RootPlan,
    request: &Request,
    pose: Option<&Mesh>,
    sink: &mut dyn Sink,
    progress: &mut dyn FnMut(u64) -> bool,
) -> Result<u64, GenerateError> {
    sink.begin(&request.info)?;
    sink.begin_frame(0)?;
    let hairs = match plan.sampler {
        Some(_) => request.hairs.clone(),
        None => 0..0,
    };
    let mut done = 0;
    in_order(
        blocks(&hairs),
        request.threads,
        |places, number, chunk| plan.write(block(&hairs, number), pose, places, chunk),
        |_, chunk: &StrandBuffer| {
            sink.write(chunk)?;
            done += chunk.len() as u64;
            match progress(done) {
                true => Ok(()),
                false => Err(GenerateError::Stopped),
            }
        },
    )?;
    sink.end_frame()?;
    sink.finish()?;
    Ok(done)
}

/// Number of aligned blocks that `hairs` touch.
fn blocks(hairs: &Range<u64>) -> u64 {
    if hairs.is_empty() {
        return 0;
    }
    (hairs.end - 1) / BLOCK - hairs.start / BLOCK + 1
}

/// What of `hairs` lies in the block `number` of those they touch.
fn block(hairs: &Range<u64>, number: u64) -> Range<u64> {
    let start = (hairs.start / BLOCK + number) * BLOCK;
    start.max(hairs.start)..start.saturating_add(BLOCK).min(hairs.end)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_aligned_and_cover_the_hairs_once() {
        for hairs in [
            0..1,
            0..BLOCK,
            5..3 * BLOCK + 7,
            BLOCK..BLOCK,
            u64::MAX - 3..u64::MAX,
        ] {
            let mut next = hairs.start;
            for number in 0..blocks(&hairs) {
                let block = block(&hairs, number);
                assert_eq!(block.start, next);
                assert!(block.end > block.start && block.end - block.start <= BLOCK);
                next = block.end;
                assert!(next == hairs.end || next % BLOCK == 0);
            }
            assert_eq!(next, hairs.end);
        }
    }
}
