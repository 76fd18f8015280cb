//! Guides that follow a flow over a solid, bend and stay outside.

use crate::scatter::Root;
use crate::sdf::Solid;
use glam::DVec3;
use pelage_strands::{StrandBuffer, StrandMeta};
use rayon::prelude::*;

/// How one guide grows.
#[derive(Clone, Copy, Debug)]
pub struct Growth {
    /// Its length.
    pub length: f64,
    /// Vertices after the root.
    pub segments: usize,
    /// 0 lies along the flow from the root on, 1 stands upright there.
    pub lift: f64,
    /// How fast the flow (and gravity in it) bends the guide: the part of the
    /// direction replaced over its whole length, 0..1.
    pub bend: f64,
    /// The height of the tip above the skin that guides keep, as a fraction of
    /// their length.
    pub clearance: f64,
}

/// Grows a guide from each root: `flow` gives the combing at a point, `growth`
/// the shape of the guide from a root.
pub fn grow<P: Copy + PartialEq + Sync>(
    solid: &Solid<P>,
    roots: &[Root],
    flow: impl Fn(DVec3) -> DVec3 + Sync,
    growth: impl Fn(&Root) -> Growth + Sync,
) -> StrandBuffer {
    let guides: Vec<Vec<DVec3>> = (roots.par_iter())
        .map(|root| guide(solid, root, &flow, &growth(root)))
        .collect();
    strands(roots, &guides)
}

/// One guide's vertices, the root first.
fn guide<P: Copy + PartialEq>(
    solid: &Solid<P>,
    root: &Root,
    flow: &impl Fn(DVec3) -> DVec3,
    growth: &Growth,
) -> Vec<DVec3> {
    // Substeps keep the path smooth where the flow turns within a segment.
    const SUBSTEPS: usize = 3;
    let steps = growth.segments * SUBSTEPS;
    let step = growth.length / steps as f64;
    let along = |p: DVec3, normal: DVec3| {
        let f = flow(p);
        (f - normal * f.dot(normal)).normalize_or_zero()
    };
    let mut direction = (root.normal * growth.lift
        + along(root.position, root.normal) * (1.0 - growth.lift))
        .normalize_or(root.normal);
    let mut p = root.position;
    let mut points = vec![p];
    for k in 1..=steps {
        let wanted = flow(p).normalize_or(direction);
        let share = growth.bend / steps as f64 * 2.0;
        direction = (direction + (wanted - direction) * share).normalize_or(direction);
        let mut next = p + direction * step;
        let t = k as f64 / steps as f64;
        let height = growth.clearance * growth.length * t * (2.0 - t);
        // Turn away from the skin, keeping the step's length; where the skin curves
        // up all around, leave it by the shortest way.
        for attempt in 0..4 {
            let lacking = height - solid.distance(next);
            if lacking <= 0.0 {
                break;
            }
            next += solid.normal(next) * (lacking * 1.1);
            if attempt < 3 {
                next = p + (next - p).normalize_or(root.normal) * step;
            }
            direction = (next - p).normalize_or(root.normal);
        }
        p = next;
        if k % SUBSTEPS == 0 {
            points.push(p);
        }
    }
    points
}

/// Roots and vertices as strands.
pub fn strands(roots: &[Root], guides: &[Vec<DVec3>]) -> StrandBuffer {
    let mut out = StrandBuffer::new();
    for (i, (root, points)) in roots.iter().zip(guides).enumerate() {
        let f = |p: &DVec3| p.as_vec3().to_array();
        out.points.extend(points.iter().map(f));
        out.push_meta(&StrandMeta {
            hair_id: i as u64,
            root_uv: root.uv.as_vec2().to_array(),
            triangle: root.texel.triangle,
            barycentric: root.texel.weights.map(|w| w as f32),
            root_rest: f(&root.position),
            ..Default::default()
        });
    }
    out
}
