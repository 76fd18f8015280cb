//! Hairs of a chunk as their guides shape them.

use crate::blocks::Blocks;
use crate::capture::Capture;
use crate::curves::Curves;
use crate::guide_set::GuideSet;
use crate::guide_shapes::{GuideShapes, Mixed};
use crate::lanes::LANES;
use crate::plan::Plan;
use crate::stages::interpolate::{FOUR, Mix, interpolate_with};
use crate::stages::{frenet, helix, scale};
use fearless_simd::{Level, Simd, dispatch};

/// Memory for hairs that are put together of bends and twists. Reused between chunks.
#[derive(Clone, Debug, Default)]
pub(crate) struct MixScratch {
    curves: Curves,
    frenet: frenet::Scratch,
    helix: helix::Scratch,
}

impl Plan {
    /// Mixes the hairs of `capture` of their guides: of those at rest unless `posed` has
    /// others, group by group.
    pub(crate) fn mix(
        &self,
        capture: &Capture,
        posed: Option<&[GuideShapes]>,
        scratch: &mut MixScratch,
        hairs: &mut Blocks,
    ) {
        let segments = |group: u32| self.guides[group as usize].segments;
        let shapes = |group: u32| match posed {
            Some(posed) => &posed[group as usize],
            None => &self.guides[group as usize].shapes,
        };
        hairs.lay_out(capture.roots.iter().map(|root| segments(root.group) + 1));
        dispatch!(Level::new(), simd => {
            mix_vertices(simd, capture, shapes, hairs)
        });
        let all_by_vertices = |guides: &GuideSet| matches!(guides.shapes.mixed, Mixed::Vertices);
        if !self.guides.iter().all(all_by_vertices) {
            dispatch!(Level::new(), simd => hairs.unroll(simd, &mut scratch.curves));
            put_together(capture, shapes, scratch);
            hairs.roll(&scratch.curves);
        }
        dispatch!(Level::new(), simd => {
            let _ = simd;
            for block in 0..hairs.blocks() {
                let mut factors = [1.0; LANES];
                let range = hairs.hairs(block);
                factors[..range.len()].copy_from_slice(&capture.scale[range]);
                scale::scale(&factors, hairs.block_mut(block));
            }
        });
    }
}

/// Puts the hairs together of bends and twists, in whichever way their group says.
fn put_together<'a>(
    capture: &Capture,
    shapes: impl Fn(u32) -> &'a GuideShapes,
    scratch: &mut MixScratch,
) {
    let mixed = |i: usize| (&shapes(capture.roots[i].group).mixed, capture.shares(i));
    let Curves { vertices, starts } = &mut scratch.curves;
    let corners = |i: usize| match mixed(i) {
        (Mixed::Frenet(corners), shares) => Some(frenet::Parts { corners, shares }),
        _ => None,
    };
    frenet::wind(corners, starts, &mut scratch.frenet, vertices);
    let helices = |i: usize| match mixed(i) {
        (Mixed::Helix(helices), shares) => Some(helix::Parts { helices, shares }),
        _ => None,
    };
    helix::wind(helices, starts, &mut scratch.helix, vertices);
}

/// Hairs as the weighted means of the vertices of their guides.
#[inline(always)]
fn mix_vertices<'a, S: Simd>(
    simd: S,
    capture: &Capture,
    shapes: impl Fn(u32) -> &'a GuideShapes,
    hairs: &mut Blocks,
) {
    for block in 0..hairs.blocks() {
        let range = hairs.hairs(block);
        for first in range.clone().step_by(FOUR) {
            let mut mixes = [Mix::default(); FOUR];
            for (mix, hair) in mixes.iter_mut().zip(first..range.end) {
                *mix = Mix {
                    guides: &shapes(capture.roots[hair].group).vertices,
                    vertices: hairs.length(hair),
                    shares: capture.shares(hair),
                };
            }
            interpolate_with(simd, mixes, first % LANES, hairs.block_mut(block));
        }
    }
}
