//! Bounding volume hierarchies over leaves and triangles, and what rays ask them.
//!
//! The trees are `obvhs` eight-wide compressed ones. Their boxes are padded by
//! more than the rounding of a box test, so which leaves are crossed does not
//! depend on the instructions a machine tests boxes with; and hits are ordered by
//! (depth, index), so nothing depends on the order of traversal.

use crate::leaf::{Ray, cross};
use crate::tessellate::Cuts;
use glam::{UVec2, Vec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh;
use std::time::Duration;

/// Padding of boxes in the unit scene; 16 units in the last place at 1.
const PADDING: f32 = 2e-6;
/// Most hairs that a ray blends; the rest is taken for opaque.
pub(crate) const MOST_LAYERS: usize = 10;
/// Light left below which nothing behind is looked for.
const DARK: f32 = 0.01;

fn build(boxes: &[Aabb]) -> CwBvh {
    let parameters = BvhBuildParams {
        max_prims_per_leaf: 3,
        ..BvhBuildParams::very_fast_build()
    };
    build_cwbvh(boxes, parameters, &mut Duration::default())
}

fn padded(low: Vec3, high: Vec3) -> Aabb {
    let pad = Vec3::splat(PADDING);
    Aabb::new(Vec3A::from(low - pad), Vec3A::from(high + pad))
}

fn boxed_ray(ray: &Ray, near: f32, far: f32) -> obvhs::ray::Ray {
    obvhs::ray::Ray::new(ray.origin.into(), ray.direction.into(), near, far)
}

/// A leaf that a ray crosses.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Layer {
    /// Distance.
    pub t: f32,
    /// First cut of the leaf.
    pub leaf: u32,
    /// Place along the leaf.
    pub s: f32,
    /// Opacity there.
    pub opacity: f32,
}

/// The nearest leaves a ray crosses, nearest first, up to where it is dark.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Layers {
    layers: [Layer; MOST_LAYERS],
    count: usize,
}

impl Layers {
    /// What was found.
    pub fn found(&self) -> &[Layer] {
        &self.layers[..self.count]
    }

    /// Whether more was found than fits.
    pub fn full(&self) -> bool {
        self.count == MOST_LAYERS
    }

    /// Adds a layer; returns the depth behind which nothing matters any more.
    fn insert(&mut self, layer: Layer, far: f32) -> f32 {
        let before = |l: &Layer| (l.t, l.leaf) < (layer.t, layer.leaf);
        let at = self.layers[..self.count]
            .iter()
            .take_while(|l| before(l))
            .count();
        if at == MOST_LAYERS {
            return far;
        }
        self.count = (self.count + 1).min(MOST_LAYERS);
        self.layers.copy_within(at..self.count - 1, at + 1);
        self.layers[at] = layer;
        let mut light = 1.0;
        for (i, l) in self.layers[..self.count].iter().enumerate() {
            light *= 1.0 - l.opacity;
            if light < DARK || i + 1 == MOST_LAYERS {
                self.count = i + 1;
                return far.min(l.t);
            }
        }
        far
    }
}

/// All leaves of the strands.
pub(crate) struct CurveTree {
    bvh: CwBvh,
    /// First cut of each primitive, in the tree's order.
    leaves: Vec<u32>,
    round: bool,
}

impl CurveTree {
    /// A tree over the visible leaves of `cuts`.
    pub fn new(cuts: &Cuts, round: bool) -> Self {
        let leaves = cuts.leaves();
        let boxes: Vec<Aabb> = leaves
            .iter()
            .map(|&i| {
                let i = i as usize;
                let (a, b) = (cuts.position(i), cuts.position(i + 1));
                let (ra, rb) = (cuts.places[i][3], cuts.places[i + 1][3]);
                padded((a - ra).min(b - rb), (a + ra).max(b + rb))
            })
            .collect();
        let bvh = build(&boxes);
        let order = bvh.primitive_indices.iter();
        let leaves = order.map(|&k| leaves[k as usize]).collect();
        Self { bvh, leaves, round }
    }

    /// The leaves that `ray` crosses before `far`.
    pub fn layers(&self, cuts: &Cuts, ray: &Ray, far: f32) -> Layers {
        let mut found = Layers::default();
        if self.leaves.is_empty() {
            return found;
        }
        let mut boxed = boxed_ray(ray, 0.0, far);
        let mut state = self.bvh.new_traversal(boxed.direction);
        let mut node;
        obvhs::traverse!(
            self.bvh,
            node,
            state,
            node.intersect_ray(&boxed, state.oct_inv4),
            {
                let leaf = self.leaves[state.primitive_id as usize];
                let i = leaf as usize;
                if let Some((t, s)) = cross(ray, &cuts.places[i], &cuts.places[i + 1], self.round)
                    && t >= 0.0
                    && t <= boxed.tmax
                {
                    let (a, b) = (cuts.looks[i][3], cuts.looks[i + 1][3]);
                    let opacity = a + (b - a) * s;
                    if opacity > 0.0 {
                        let layer = Layer {
                            t,
                            leaf,
                            s,
                            opacity,
                        };
                        boxed.tmax = found.insert(layer, boxed.tmax);
                    }
                }
            }
        );
        found
    }

    /// What the faster shadows are tested against: how many opaque hairs' worth `ray` crosses after `near`, leaving out the
    /// leaves that start at cuts in `own`; looks no further than `enough` of them.
    #[cfg(test)]
    pub fn crossings(
        &self,
        cuts: &Cuts,
        ray: &Ray,
        near: f32,
        own: std::ops::Range<usize>,
        enough: f32,
    ) -> f32 {
        if self.leaves.is_empty() {
            return 0.0;
        }
        let boxed = boxed_ray(ray, near, f32::INFINITY);
        let mut state = self.bvh.new_traversal(boxed.direction);
        let mut node;
        // Whole 4096ths, so that the sum does not depend on its order.
        let (mut sum, limit) = (0u32, (enough * 4096.0) as u32);
        obvhs::traverse!(
            self.bvh,
            node,
            state,
            node.intersect_ray(&boxed, state.oct_inv4),
            {
                let i = self.leaves[state.primitive_id as usize] as usize;
                if !own.contains(&i)
                    && let Some((t, s)) = cross(ray, &cuts.places[i], &cuts.places[i + 1], false)
                    && t > near
                {
                    let (a, b) = (cuts.looks[i][3], cuts.looks[i + 1][3]);
                    sum += ((a + (b - a) * s) * 4096.0) as u32;
                    if sum >= limit {
                        break;
                    }
                }
            }
        );
        sum.min(limit) as f32 / 4096.0
    }
}

/// Where a ray meets the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SurfaceHit {
    /// Distance.
    pub t: f32,
    /// Index of the triangle.
    pub triangle: u32,
    /// Weights of the triangle's second and third corner.
    pub weights: [f32; 2],
}

/// All triangles of the surface.
#[derive(Default)]
pub(crate) struct SurfaceTree {
    bvh: CwBvh,
    /// Corners in the unit scene, in the order of the tree, with the index.
    triangles: Vec<([Vec3; 3], u32)>,
}

impl SurfaceTree {
    /// A tree over `triangles`; those that are not finite are left out.
    pub fn new(triangles: &[[Vec3; 3]]) -> Self {
        let kept: Vec<([Vec3; 3], u32)> = (0u32..)
            .zip(triangles)
            .filter(|(_, t)| t.iter().all(|p| p.is_finite()))
            .map(|(i, t)| (*t, i))
            .collect();
        if kept.is_empty() {
            return Self::default();
        }
        let boxes: Vec<Aabb> = kept
            .iter()
            .map(|([a, b, c], _)| padded(a.min(*b).min(*c), a.max(*b).max(*c)))
            .collect();
        let bvh = build(&boxes);
        let order = bvh.primitive_indices.iter();
        let triangles = order.map(|&k| kept[k as usize]).collect();
        Self { bvh, triangles }
    }

    /// The nearest triangle before `far`.
    pub fn nearest(&self, ray: &Ray, far: f32) -> Option<SurfaceHit> {
        let mut best: Option<SurfaceHit> = None;
        if self.triangles.is_empty() {
            return best;
        }
        let mut boxed = boxed_ray(ray, 0.0, far);
        let mut state = self.bvh.new_traversal(boxed.direction);
        let mut node;
        obvhs::traverse!(
            self.bvh,
            node,
            state,
            node.intersect_ray(&boxed, state.oct_inv4),
            {
                let (corners, triangle) = self.triangles[state.primitive_id as usize];
                if let Some((t, weights)) = meet(ray, &corners)
                    && t >= 0.0
                    && t <= boxed.tmax
                    && best.is_none_or(|b| (t, triangle) < (b.t, b.triangle))
                {
                    boxed.tmax = t;
                    best = Some(SurfaceHit {
                        t,
                        triangle,
                        weights,
                    });
                }
            }
        );
        best
    }

    /// Whether anything is in the way of `ray` after `near`.
    pub fn blocks(&self, ray: &Ray, near: f32) -> bool {
        if self.triangles.is_empty() {
            return false;
        }
        let boxed = boxed_ray(ray, near, f32::INFINITY);
        !self
            .bvh
            .ray_traverse_miss(boxed, |_, k| match meet(ray, &self.triangles[k].0) {
                Some((t, _)) if t > near => t,
                _ => f32::INFINITY,
            })
    }
}

/// Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection" (1997),
/// with a little overlap at the edges so that no ray slips between triangles.
fn meet(ray: &Ray, [a, b, c]: &[Vec3; 3]) -> Option<(f32, [f32; 2])> {
    const OVERLAP: f32 = 1e-6;
    let (ab, ac) = (*b - *a, *c - *a);
    let p = ray.direction.cross(ac);
    let inverse = 1.0 / ab.dot(p);
    let from_a = ray.origin - *a;
    let u = from_a.dot(p) * inverse;
    let q = from_a.cross(ab);
    let v = ray.direction.dot(q) * inverse;
    // Also refuses the NaN of a triangle without area.
    if u >= -OVERLAP && v >= -OVERLAP && u + v <= 1.0 + OVERLAP {
        let t = ac.dot(q) * inverse;
        t.is_finite().then_some((t, [u, v]))
    } else {
        None
    }
}

#[cfg(test)]
#[path = "accel_tests.rs"]
mod tests;
