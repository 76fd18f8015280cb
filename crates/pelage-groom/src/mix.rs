//! Hairs of a chunk as their guides shape them.

use crate::capture::Capture;
use crate::curves::Curves;
use crate::guide_shapes::GuideShapes;
use crate::plan::Plan;
use crate::stages::{frenet, interpolate, scale};
use fearless_simd::{Level, dispatch};

impl Plan {
    /// Mixes the hairs of `capture` of their guides: of those at rest unless `posed` has
    /// others, group by group.
    pub(crate) fn mix(
        &self,
        capture: &Capture,
        posed: Option<&[GuideShapes]>,
        scratch: &mut frenet::Scratch,
        hairs: &mut Curves,
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
            frenet::wind(parts, &hairs.starts, scratch, &mut hairs.vertices);
        }
        for (i, &factor) in capture.scale.iter().enumerate() {
            scale::scale(factor, hairs.get_mut(i));
        }
    }
}

/// Hairs as the weighted means of the vertices of their guides.
#[inline(always)]
fn mix_vertices<'a>(
    capture: &Capture,
    shapes: impl Fn(u32) -> &'a GuideShapes,
    hairs: &mut Curves,
) {
    for (i, root) in capture.roots.iter().enumerate() {
        let guides = &shapes(root.group).vertices;
        interpolate::interpolate(guides, capture.shares(i), hairs.get_mut(i));
    }
}
