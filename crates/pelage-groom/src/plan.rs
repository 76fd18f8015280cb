//! The compiled groom: immutable, shared between threads, never fails once built.

use crate::clumps::Level;
use crate::color::ColorSpace;
use crate::color_profile::ColorProfile;
use crate::curves::Curves;
use crate::groom::Groom;
use crate::groups::Groups;
use crate::guide::{self, Guide};
use crate::guide_set::GuideSet;
use crate::maps::{FieldMaker, ScalarField};
use crate::neighbors::Sharing;
use crate::noise_fields::NoiseFields;
use crate::pose::Moment;
use crate::profile::Profile;
use crate::random::Channel;
use crate::recipe::{self, GuideSource, Interpolation, Recipe};
use crate::stages::flyaway::FlyawayFields;
use crate::stages::frizz::FrizzFields;
use crate::stages::look::LookFields;
use crate::stages::strand::StrandFields;
use crate::stages::tint::Tint;
use crate::{PlanError, RootPlan, grow, root_plan};
use pelage_surface::Mesh;

/// A groom compiled: everything that can fail has.
#[derive(Clone, Debug)]
pub struct Plan {
    pub(crate) roots: RootPlan,
    pub(crate) guides: Vec<GuideSet>,
    pub(crate) sharing: Sharing,
    pub(crate) fields: Fields,
    pub(crate) clumps: Vec<Level>,
    /// The hairs in the middles of clumps at rest, level by level.
    pub(crate) rest_middles: Vec<Curves>,
    pub(crate) seed: u64,
    pub(crate) normals: bool,
    /// Cosine above which the bend at a vertex is too little to keep it; `None` keeps all.
    pub(crate) thinning: Option<f32>,
    guide_count: usize,
    notes: Vec<String>,
}

/// The properties that are read at each root.
#[derive(Clone, Debug)]
pub(crate) struct Fields {
    pub scale: ScalarField,
    pub scale_random: ScalarField,
    /// `None` where nothing is cut.
    pub cut: Option<ScalarField>,
    pub frizz: Option<FrizzFields>,
    pub kink: Option<NoiseFields>,
    pub preserve: Preserve,
    /// `None` where no hair strays.
    pub flyaway: Option<FlyawayFields>,
    /// `None` where hairs are single.
    pub strand: Option<StrandFields>,
    pub look: LookFields,
    pub tint: Tint,
}

/// Which stages leave hairs their length.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Preserve {
    pub frizz: bool,
    pub kink: bool,
    pub splay: bool,
}

impl Plan {
    /// Compiles a groom. Every error a user can make in it ends here.
    pub fn new(groom: Groom) -> Result<Self, PlanError> {
        let recipe = &groom.recipe;
        let rest = root_plan::rest(groom.mesh, groom.keep_file_normals)?;
        let mut maker = FieldMaker::new(&groom.images, rest.has_uvs());
        let mut roots = RootPlan::on(rest, recipe, &mut maker)?;
        let fields = Fields::new(recipe, &mut maker)?;
        let rest = &roots.rest;
        let mut notes = roots.notes().to_vec();
        notes.extend(maker.missing_tiles(recipe, rest, |key| !RootPlan::needs(key)));
        let all = match (roots.sampler(), recipe.guides.source()) {
            (_, Some(GuideSource::Curves(_))) => {
                guide::bind(rest, &groom.guides, tolerance(recipe, rest))?
            }
            (Some(sampler), Some(GuideSource::Grow(rule))) => {
                grow::grow(rule, rest, sampler, &groom.images)?
            }
            _ => Vec::new(),
        };
        if recipe.groups.segments.is_none() {
            roots.groups = roots.groups.with_segments(segments_of(&all));
        }
        refuse_too_long(&roots.groups)?;
        refuse_too_many(&roots.groups, &fields)?;
        let mut plan = Self {
            roots,
            guides: Vec::new(),
            sharing: Sharing::new(&recipe.interpolation),
            fields,
            clumps: Vec::new(),
            rest_middles: Vec::new(),
            seed: recipe.hair.seed,
            normals: recipe.output.normals,
            thinning: Some(recipe.output.skip_threshold).filter(|&threshold| threshold < 1.0),
            guide_count: all.len(),
            notes,
        };
        plan.share_out(&all, &recipe.interpolation)?;
        for level in &recipe.clump.levels {
            plan.add_clumps(level, &mut maker)?;
        }
        plan.rest_middles = plan.middle_hairs(&Moment::REST);
        Ok(plan)
    }

    /// Gives each group its guides; a group whose hairs would have none is an error.
    fn share_out(&mut self, all: &[Guide], interpolation: &Interpolation) -> Result<(), PlanError> {
        let (groups, rest) = (&self.roots.groups, &self.roots.rest);
        let Some(sampler) = self.roots.sampler() else {
            return Ok(());
        };
        if self.count() > 0 && all.is_empty() {
            return Err(PlanError::NoGuides);
        }
        let nearest = self.sharing.nearest();
        let group_of: Vec<u32> = all.iter().map(|g| groups.at(rest.uv(&g.root))).collect();
        for (index, group) in groups.all().iter().enumerate() {
            let numbered = all.iter().enumerate().zip(&group_of);
            let mine: Vec<(usize, &Guide)> = numbered
                .filter(|(_, g)| **g as usize == index)
                .map(|(guide, _)| guide)
                .collect();
            self.guides.push(GuideSet::new(
                rest,
                &mine,
                group.segments,
                interpolation,
                nearest,
            ));
        }
        let lonely = sampler
            .piece_centres()
            .map(|place| groups.at(rest.uv(&place)))
            .find(|&group| self.guides[group as usize].is_empty());
        match lonely {
            Some(group) if self.count() > 0 => Err(PlanError::GroupWithoutGuides {
                group,
                color: groups.all()[group as usize].name(),
            }),
            _ => Ok(()),
        }
    }

    /// Where the hairs stand.
    pub fn roots(&self) -> &RootPlan {
        &self.roots
    }

    /// Hairs the recipe asks for; 0 where no hair can grow.
    pub fn count(&self) -> u64 {
        self.roots.count()
    }

    /// The surface at rest.
    pub fn rest(&self) -> &Mesh {
        self.roots.rest()
    }

    /// Things worth telling that are no errors, in plain words: those of the roots too.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// Vertices of the longest hairs, with all their fibres.
    pub(crate) fn most_vertices(&self) -> u64 {
        (most_segments(&self.roots.groups) as u64 + 1) * self.fibers() as u64
    }

    /// Number of guides.
    pub fn guide_count(&self) -> usize {
        self.guide_count
    }
}

impl Fields {
    fn new(recipe: &Recipe, maker: &mut FieldMaker) -> Result<Self, PlanError> {
        let r = recipe;
        let cut = maker.scalar("cut.length", &r.cut.length)?;
        Ok(Self {
            cut: Some(cut).filter(|cut| !cut.is_one()),
            scale: maker.scalar("scale.amount", &r.scale.amount)?,
            scale_random: maker.scalar("scale.random", &r.scale.random)?,
            frizz: FrizzFields::new(&r.frizz, maker, r.hair.seed)?,
            kink: NoiseFields::new(
                "kink",
                &r.kink.frequency,
                [&r.kink.root, &r.kink.tip],
                maker,
                (r.hair.seed, Channel::Kink),
            )?,
            preserve: Preserve {
                frizz: r.frizz.preserve_length,
                kink: r.kink.preserve_length,
                splay: r.strand.splay.preserve_length,
            },
            flyaway: FlyawayFields::new(&r.flyaway, maker)?,
            strand: StrandFields::new(&r.strand, maker)?,
            look: look(recipe, maker)?,
            tint: tint(recipe, maker)?,
        })
    }
}

fn look(recipe: &Recipe, maker: &mut FieldMaker) -> Result<LookFields, PlanError> {
    let (opacity, width) = (&recipe.opacity, &recipe.width);
    Ok(LookFields {
        color: ColorProfile::new(&recipe.color, maker)?,
        color_space: match recipe.color.space {
            recipe::ColorSpace::Hsv => ColorSpace::Hsv,
            recipe::ColorSpace::Oklab => ColorSpace::Oklab,
            recipe::ColorSpace::Rgb => ColorSpace::Rgb,
        },
        opacity: Profile::new(
            "opacity",
            [("root", &opacity.root), ("tip", &opacity.tip)],
            maker,
        )?,
        width: Profile::new("width", [("root", &width.root), ("tip", &width.tip)], maker)?,
    })
}

fn tint(recipe: &Recipe, maker: &mut FieldMaker) -> Result<Tint, PlanError> {
    let (mutant, variation) = (&recipe.color.mutant, &recipe.color.variation);
    Ok(Tint {
        mutant_percent: maker.scalar("color.mutant.percent", &mutant.percent)?,
        mutant_color: maker.color("color.mutant.color", &mutant.color)?,
        hue: maker.scalar("color.variation.hue", &variation.hue)?,
        saturation: maker.scalar("color.variation.saturation", &variation.saturation)?,
        value: maker.scalar("color.variation.value", &variation.value)?,
    })
}

/// Most segments of a hair: what the formats that count them in 16 bits can hold.
const MOST_SEGMENTS: u32 = u16::MAX as u32;

fn refuse_too_long(groups: &Groups) -> Result<(), PlanError> {
    let found = most_segments(groups);
    match found <= MOST_SEGMENTS {
        true => Ok(()),
        false => Err(PlanError::TooManySegments {
            found,
            limit: MOST_SEGMENTS,
        }),
    }
}

/// Most vertices of the fibres of one hair, which are made at once: some 300 MB.
const MOST_VERTICES: u32 = 1 << 22;

fn refuse_too_many(groups: &Groups, fields: &Fields) -> Result<(), PlanError> {
    let found = fields.strand.as_ref().map_or(1, |strand| strand.fibers);
    let limit = MOST_VERTICES / (most_segments(groups) + 1);
    match found <= limit {
        true => Ok(()),
        false => Err(PlanError::TooManyFibers { found, limit }),
    }
}

/// Segments of the longest hairs.
fn most_segments(groups: &Groups) -> u32 {
    let segments = groups.all().iter().map(|group| group.segments);
    segments.max().unwrap_or(1)
}

/// A hundredth of the diagonal of the mesh's box, unless the recipe says otherwise.
fn tolerance(recipe: &Recipe, rest: &Mesh) -> f32 {
    let (low, high) = rest.bounds();
    recipe
        .guides
        .tolerance
        .unwrap_or_else(|| low.distance(high) * 0.01)
}

/// Segments of the guide with the most.
fn segments_of(guides: &[Guide]) -> u32 {
    let segments = guides.iter().map(|g| g.local.len().saturating_sub(1));
    segments.max().unwrap_or(1) as u32
}
