//! Clumps over the surface: which one a hair belongs to, and the hairs in their middles.
//!
//! Membership is told at rest, by places: a middle does not move when there are more hairs
//! or their density changes, and a hair's clump is that of the nearest middle which has its
//! interpolation group and faces the same way, or that of the colour it stands on. The
//! hairs in the middles are made by the same pipeline as all others, without chance.

use crate::PlanError;
use crate::capture::Capture;
use crate::clock::Clock;
use crate::clump_middles::Middles;
use crate::code_map::CodeMap;
use crate::curves::Curves;
use crate::locator::{Locator, Near};
use crate::maps::{FieldMaker, ScalarField};
use crate::plan::Plan;
use crate::pose::Moment;
use crate::profile::Profile;
use crate::random::{Channel, uniform, word};
use crate::recipe::ClumpLevel;
use crate::shape::Shapes;
use crate::stages::clump::{self, Member};
use crate::stages::length;
use crate::stages::roots::Root;
use pelage_curves::Vec3;
use pelage_surface::RootFrame;

/// Middles that are looked at to find one that suits a hair.
const NEAREST: usize = 8;

/// How many times as long as the middle hair of its clump a hair may be: one that is next
/// to nothing does not tell where others go.
const FASTEST: f32 = 1e4;

/// A level of clumps.
#[derive(Clone, Debug)]
pub(crate) struct Level {
    drawn: Profile<2>,
    random: ScalarField,
    preserve_length: bool,
    /// Seed of its `random`.
    seed: u64,
    /// The hairs in the middles, members of the levels before.
    pub middles: Capture,
    membership: Membership,
}

#[derive(Clone, Debug)]
enum Membership {
    /// Of the nearest clump that suits.
    Nearest(Locator),
    /// Of the clump of the area a hair stands on, if it has one.
    Areas {
        map: CodeMap<Option<u32>>,
        clumps: Vec<Option<u32>>,
    },
}

impl Membership {
    fn new(plan: &Plan, found: Middles, middles: &Capture) -> Self {
        let Some(areas) = found.areas else {
            let roots = middles.frames.iter().map(|frame| frame.position).collect();
            return Self::Nearest(Locator::new(plan.rest(), roots, NEAREST));
        };
        // Middles are numbered as they were found, and some grow no hair.
        let mut clumps = vec![None; areas.count];
        for (clump, root) in middles.roots.iter().enumerate() {
            let area = areas.of_middles[root.hair as usize];
            clumps[area as usize] = Some(clump as u32);
        }
        Self::Areas {
            map: areas.map,
            clumps,
        }
    }
}

impl Level {
    /// The clump of a hair.
    fn clump(&self, root: &Root, frame: &RootFrame, near: &mut Vec<Near>) -> Option<u32> {
        match &self.membership {
            Membership::Areas { map, clumps } => clumps[map.at(root.uv)? as usize],
            Membership::Nearest(middles) => {
                middles.query(frame.position, near);
                let suits = |clump: usize| {
                    let faces = self.middles.frames[clump].normal.dot(frame.normal) > 0.0;
                    faces && self.middles.roots[clump].group == root.group
                };
                let found = near.iter().find(|near| suits(near.guide as usize));
                found.map(|near| near.guide)
            }
        }
    }

    /// The place of hair number `i` of `capture` in its clump; `values` are those of the
    /// properties at its root.
    fn member(
        &self,
        plan: &Plan,
        capture: &Capture,
        i: usize,
        values: [f32; 3],
        near: &mut Vec<Near>,
    ) -> Member {
        let Some(clump) = self.clump(&capture.roots[i], &capture.frames[i], near) else {
            return Member::NONE;
        };
        let [root, tip, random] = values.map(|value| value.clamp(0.0, 1.0));
        let less = random * uniform(self.seed, clump as u64, Channel::Clump);
        let part = (1.0 - less) * capture.clumped(i);
        let segment = |capture: &Capture, i: usize| {
            let group = capture.roots[i].group as usize;
            capture.lengths[i] / plan.guides[group].segments as f32
        };
        let pace = segment(capture, i) / segment(&self.middles, clump as usize);
        if pace > FASTEST {
            return Member::NONE;
        }
        Member {
            clump: Some(clump),
            drawn: [root, tip].map(|drawn| drawn * part),
            pace,
        }
    }
}

impl Plan {
    /// Adds the next level of clumps.
    pub(crate) fn add_clumps(
        &mut self,
        recipe: &ClumpLevel,
        maker: &mut FieldMaker,
    ) -> Result<(), PlanError> {
        let key = format!("clump.levels[{}]", self.clumps.len());
        let ends = [("root", &recipe.root), ("tip", &recipe.tip)];
        let drawn = Profile::new(&key, ends, maker)?;
        let random = maker.scalar(&format!("{key}.random"), &recipe.random)?;
        let found = self.middles(&key, recipe, maker)?;
        let mut middles = Capture::default();
        self.capture_middles(&found.places, &mut middles);
        self.clumps.push(Level {
            drawn,
            random,
            preserve_length: recipe.preserve_length,
            seed: word(self.seed, self.clumps.len() as u64, Channel::Clump),
            membership: Membership::new(self, found, &middles),
            middles,
        });
        Ok(())
    }

    /// Finds the clumps of the hairs of `capture`, level after level.
    pub(crate) fn clump(&self, capture: &mut Capture) {
        let mut members = std::mem::take(&mut capture.members);
        let mut near = std::mem::take(&mut capture.near);
        let mut columns = std::mem::take(&mut capture.columns);
        members.clear();
        for level in &self.clumps {
            let [root, tip] = level.drawn.fields();
            let values = columns.read([root, tip, &level.random], &capture.uvs);
            let hairs = values.enumerate();
            members
                .extend(hairs.map(|(i, values)| level.member(self, capture, i, values, &mut near)));
        }
        (capture.members, capture.near, capture.columns) = (members, near, columns);
    }

    /// Draws the hairs of `capture`, on the pose of `middles`, to the middles of their
    /// clumps: one set of curves for each level.
    pub(crate) fn draw_together(
        &self,
        capture: &Capture,
        middles: &[Curves],
        before: &mut Vec<Vec3>,
        hairs: &mut Curves,
    ) {
        let levels = self.clumps.iter().zip(middles).enumerate();
        for (number, (level, middles)) in levels {
            let members = &capture.members[number * capture.len()..][..capture.len()];
            for (i, member) in members.iter().enumerate() {
                let Some(clump) = member.clump else { continue };
                let hair = hairs.get_mut(i);
                before.clear();
                before.extend_from_slice(hair);
                clump::draw(&level.drawn, member, middles.get(clump as usize), hair);
                if level.preserve_length {
                    length::preserve(before, 1.0, hair);
                }
            }
        }
    }

    /// The hairs in the middles of the clumps of each level, as `moment` has them.
    pub(crate) fn middle_hairs(&self, moment: &Moment) -> Vec<Curves> {
        let mut levels = Vec::new();
        let mut shapes = Shapes::default();
        let mut posed = Vec::new();
        for level in &self.clumps {
            let moment = Moment {
                middles: &levels,
                ..*moment
            };
            let frames = self.frames(&level.middles, &moment, &mut posed);
            let clock = &mut Clock::default();
            self.hairs(&level.middles, frames, &moment, &mut shapes, clock);
            let hairs = std::mem::take(&mut shapes.curves);
            levels.push(hairs);
        }
        levels
    }
}
