//! Hairs of a chunk as their guides shape them.

use crate::blocks::Blocks;
use crate::capture::Capture;
use crate::curves::Curves;
use crate::guide_shapes::GuideShapes;
use crate::lanes::LANES;
use crate::plan::Plan;
use crate::stages::{frenet, interpolate, scale};
use fearless_simd::{Level, dispatch};

/// Memory for hairs that are mixed by their bends. Reused between chunks.
#[derive(Clone, Debug, Default)]
pub(crate) struct MixScratch {
    curves: Curves,
    frenet: frenet::Scratch,
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
            let _ = simd;
            mix_vertices(capture, shapes, hairs)
        });
        if self
            .guides
            .iter()
            .any(|guides| guides.shapes.corners.is_some())
        {
            let parts = |i: usize| {
                let corners = shapes(capture.roots[i].group).corners.as_deref();
                corners.map(|corners| frenet::Parts {
                    corners,
                    shares: capture.shares(i),
                })
            };
            hairs.unroll(&mut scratch.curves);
            let Curves { vertices, starts } = &mut scratch.curves;
            frenet::wind(parts, starts, &mut scratch.frenet, vertices);
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

/// Hairs as the weighted means of the vertices of their guides.
#[inline(always)]
fn mix_vertices<'a>(
    capture: &Capture,
    shapes: impl Fn(u32) -> &'a GuideShapes,
    hairs: &mut Blocks,
) {
    for (i, root) in capture.roots.iter().enumerate() {
        let (block, lane) = (i / LANES, i % LANES);
        let guides = &shapes(root.group).vertices;
        let vertices = hairs.lengths(block)[lane] as usize;
        let rows = hairs.block_mut(block);
        interpolate::interpolate(guides, vertices, capture.shares(i), lane, rows);
    }
}
