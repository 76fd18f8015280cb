//! Roots without hair: the part of a groom that tells where hairs stand.
//!
//! A [`Plan`](crate::Plan) begins with one of these, so roots that are written by
//! themselves are those of the hairs.

use crate::PlanError;
use crate::groom::Groom;
use crate::groups::Groups;
use crate::maps::{FieldMaker, ScalarField};
use crate::recipe::{Pattern, Recipe, Segments};
use crate::stages::roots::Root;
use pelage_curves::Vec2;
use pelage_surface::{
    AlongSurface, BlueNoise, Mesh, PolygonMesh, RootFrame, RootSampler, Spread, SurfacePoint,
    VoxelRoots,
};
use std::ops::Range;

/// Most roots of blue noise, which is kept in memory: 16 bytes a root, and some 150
/// while it is made.
const MOST_BLUE_NOISE: u64 = 100_000_000;

/// Where the hairs of a groom stand: its surface, density and groups, compiled.
#[derive(Clone, Debug)]
pub struct RootPlan {
    pub(crate) rest: Mesh,
    sampler: Option<RootSampler>,
    /// Takes the sampler's place as the source of roots.
    blue_noise: Option<BlueNoise>,
    /// Where the recipe leaves their segments to the guides, they have one.
    pub(crate) groups: Groups,
    density: ScalarField,
    /// `None` where roots are not displaced.
    displacement: Option<ScalarField>,
    count: u64,
    notes: Vec<String>,
}

impl RootPlan {
    /// Compiles what `groom` says of roots. Its guides are not looked at, and of its
    /// images only those of `roots` and `groups` must be there.
    pub fn new(groom: Groom) -> Result<Self, PlanError> {
        let rest = rest(groom.mesh, groom.keep_file_normals)?;
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
        let displacement = maker.scalar("roots.displacement", &recipe.roots.displacement)?;
        let spread = match recipe.roots.pattern {
            Pattern::Random => Spread::Random,
            Pattern::Stratified | Pattern::BlueNoise => Spread::Stratified,
        };
        let sampler = density
            .sampler(&rest, recipe.hair.seed)
            .map(|sampler| sampler.with_spread(spread));
        let count = sampler.as_ref().map_or(0, |_| recipe.hair.count);
        let mut notes = maker.missing_tiles(recipe, &rest, Self::needs);
        notes.extend(losses(&rest, sampler.is_some()));
        Ok(Self {
            notes,
            groups: groups(recipe, maker)?,
            blue_noise: blue_noise(recipe, &rest, sampler.as_ref())?,
            displacement: Some(displacement).filter(|field| !field.is_zero()),
            rest,
            sampler,
            density,
            count,
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

    /// The groups that hairs fall in.
    pub fn groups(&self) -> &Groups {
        &self.groups
    }

    /// Draws roots by the density; `None` where no hair can grow.
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

    /// Those of `hairs` that have a root: none where no hair can grow, and those of blue
    /// noise that were made with the plan, [`count`](Self::count) of them.
    pub fn rooted(&self, hairs: Range<u64>) -> Range<u64> {
        let end = match (&self.sampler, &self.blue_noise) {
            (None, _) => 0,
            (_, Some(made)) => made.len() as u64,
            (_, None) => u64::MAX,
        };
        hairs.start.min(end)..hairs.end.min(end)
    }

    /// Those of `hairs` that are [`rooted`](Self::rooted), in the order of the surface and in
    /// parts of about `each`; `None` where no hair can grow.
    pub fn along_surface(&self, hairs: Range<u64>, each: u64) -> Option<AlongSurface<'_>> {
        let (sampler, hairs) = (self.sampler.as_ref()?, self.rooted(hairs));
        Some(match &self.blue_noise {
            None => AlongSurface::new(sampler, hairs, each),
            Some(made) => AlongSurface::of_blue_noise(made, hairs, each),
        })
    }

    /// Whether hairs have to be sorted to come along the surface.
    pub(crate) fn is_sorted_along(&self) -> bool {
        let spread = self
            .sampler
            .as_ref()
            .map(|sampler| sampler.sequence().spread());
        self.blue_noise.is_some() || spread == Some(Spread::Random)
    }

    /// Appends the places of `hairs`, all of which are [`rooted`](Self::rooted).
    pub(crate) fn places(&self, hairs: Range<u64>, places: &mut Vec<SurfacePoint>) {
        match (&self.blue_noise, &self.sampler) {
            (Some(made), _) => made.roots(hairs, places),
            (_, Some(sampler)) => sampler.roots(hairs, places),
            (None, None) => {}
        }
    }

    /// The place of `hair`, if it is [`rooted`](Self::rooted).
    pub(crate) fn place(&self, hair: u64) -> Option<SurfacePoint> {
        match &self.blue_noise {
            Some(made) => (hair < made.len() as u64).then(|| made.root(hair)),
            None => self.sampler.as_ref().map(|sampler| sampler.root(hair)),
        }
    }

    /// Position and frame of a root on `surface`, the mesh at rest or posed, displaced as
    /// the recipe says; `uv` are the texture coordinates of `place`.
    pub(crate) fn frame(&self, surface: &Mesh, place: &SurfacePoint, uv: Vec2) -> RootFrame {
        match &self.displacement {
            None => surface.frame(place),
            Some(field) => surface.displaced_frame(place, &field.displacement(uv)),
        }
    }

    /// Appends [`frame`](Self::frame) of each of `roots` to `frames`.
    pub(crate) fn frames(&self, surface: &Mesh, roots: &[Root], frames: &mut Vec<RootFrame>) {
        if self.is_displaced() {
            let frame = |root: &Root| self.frame(surface, &root.place, root.uv);
            frames.extend(roots.iter().map(frame));
        } else {
            surface.frames(roots.iter().map(|root| root.place), frames);
        }
    }

    /// Whether roots stand off the surface.
    pub(crate) fn is_displaced(&self) -> bool {
        self.displacement.is_some()
    }

    /// The hairs of each cell of a grid over the rest bounds (architecture.md, law 3);
    /// `None` where no hair can grow.
    pub fn voxels(&self, resolution: [u32; 3]) -> Option<VoxelRoots<'_>> {
        let sampler = self.sampler.as_ref()?;
        Some(match &self.blue_noise {
            None => VoxelRoots::new(sampler, &self.rest, resolution),
            Some(made) => VoxelRoots::of_blue_noise(made, sampler, &self.rest, resolution),
        })
    }
}

/// The mesh at rest, ready to grow hair.
pub(crate) fn rest(mut polygons: PolygonMesh, keep_file_normals: bool) -> Result<Mesh, PlanError> {
    if !keep_file_normals {
        polygons.corner_normals.clear();
    }
    let rest = Mesh::new(polygons)?;
    if rest.degenerate_triangles() == rest.triangles().len() {
        return Err(PlanError::NoSurface);
    }
    Ok(rest)
}

fn blue_noise(
    recipe: &Recipe,
    rest: &Mesh,
    sampler: Option<&RootSampler>,
) -> Result<Option<BlueNoise>, PlanError> {
    let (Pattern::BlueNoise, Some(sampler)) = (recipe.roots.pattern, sampler) else {
        return Ok(None);
    };
    let found = recipe.hair.count;
    if found > MOST_BLUE_NOISE {
        let limit = MOST_BLUE_NOISE;
        return Err(PlanError::TooMuchBlueNoise { found, limit });
    }
    Ok(Some(BlueNoise::new(rest, sampler, found)))
}

/// What grows no hair and is no error.
fn losses(rest: &Mesh, grows: bool) -> Vec<String> {
    let mut notes = Vec::new();
    let degenerate = rest.degenerate_triangles();
    if degenerate > 0 {
        notes.push(format!("{degenerate} degenerate triangles grow no hair"));
    }
    if !grows {
        notes.push("roots.density is 0 on the whole surface: no hair can grow".into());
    }
    notes
}

/// Groups and their segments, 1 where the recipe leaves them to the guides.
fn groups(recipe: &Recipe, maker: &FieldMaker) -> Result<Groups, PlanError> {
    let Some(used) = &recipe.groups.map else {
        return Ok(Groups::single(match recipe.groups.segments {
            Some(Segments::All(n)) => n,
            _ => 1,
        }));
    };
    let map = maker.texture("groups.map", used)?;
    match &recipe.groups.segments {
        Some(Segments::ByColor(listed)) => {
            let listed: Vec<_> = listed.iter().map(|(&color, &n)| (color, n)).collect();
            Ok(Groups::listed(&map, &listed))
        }
        Some(Segments::All(n)) => Groups::found(&map, *n),
        None => Groups::found(&map, 1),
    }
}
