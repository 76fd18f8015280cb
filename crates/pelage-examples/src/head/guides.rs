//! Long hair: guides leave the parting sideways, lie over the skull and fall to
//! the height of the shoulders, pushed out of the solid on their way.

use super::maps::{density, is_left};
use super::shape::Part;
use super::unwrap::label;
use crate::grow::strands;
use crate::hash::{fractal, smoothstep, unit};
use crate::model::Model;
use crate::scatter::{Root, scatter};
use crate::sdf::Solid;
use glam::DVec3;
use pelage_strands::StrandBuffer;
use rayon::prelude::*;

/// Segments of each guide.
pub const SEGMENTS: usize = 20;

/// Length of a step while falling, metres.
const STEP: f64 = 0.003;

/// Longest guide, metres.
const LONGEST: f64 = 0.36;

/// About `count` guides within the hairline.
pub fn guides(bust: &Solid<Part>, model: &Model, count: usize) -> StrandBuffer {
    let mut scalp = model.clone();
    let kept: Vec<usize> = (0..model.labels.len())
        .filter(|&t| model.labels[t] == label::SCALP)
        .collect();
    scalp.mesh.triangles = kept.iter().map(|&t| model.mesh.triangles[t]).collect();
    scalp.uvs = kept.iter().map(|&t| model.uvs[t]).collect();
    let hairy = |p: DVec3, _| density(p, label::SCALP) > 0.15;
    let mut roots = scatter(&scalp, count, 0x4EAD, hairy);
    for root in &mut roots {
        root.texel.triangle = kept[root.texel.triangle as usize] as u32;
    }
    let guides: Vec<Vec<DVec3>> = (roots.par_iter().enumerate())
        .map(|(i, root)| resampled(&fall(bust, root, i as u64)))
        .collect();
    let mut out = strands(&roots, &guides);
    out.group = roots
        .iter()
        .map(|r| u32::from(!is_left(r.position)))
        .collect();
    out
}

/// Where hair wants to go at `p`, `side` being its side of the parting.
fn pull(p: DVec3, side: f64) -> DVec3 {
    let over = smoothstep(0.085, 0.03, p.x * side) * smoothstep(0.20, 0.30, p.y);
    let behind = smoothstep(-0.04, -0.09, p.z);
    let off_face = smoothstep(-0.02, 0.05, p.z);
    DVec3::new(
        side * (1.1 * over * (1.0 - 0.6 * behind) + 0.5 * off_face),
        -0.55 - 0.9 * (1.0 - over),
        -0.75 * off_face - 0.10,
    )
}

/// The path of one guide in small steps, from its root to the cut.
fn fall(bust: &Solid<Part>, root: &Root, index: u64) -> Vec<DVec3> {
    let side = if is_left(root.position) { 1.0 } else { -1.0 };
    // Hair that starts higher lies on top of hair that starts lower.
    let layer = 0.004 + 0.012 * smoothstep(0.20, 0.35, root.position.y) + 0.003 * unit(91, index);
    let end = 0.075 + 0.012 * unit(92, index);
    let mut p = root.position;
    let mut direction = (root.normal * 0.35 + pull(p, side)).normalize_or(root.normal);
    let mut path = vec![p];
    while path.len() as f64 * STEP < LONGEST && (p.y > end || path.len() < 12) {
        let wave = DVec3::new(
            fractal(93, p * 22.0 + DVec3::X * side),
            0.0,
            fractal(96, p * 22.0),
        );
        let wanted = (pull(p, side) + wave * 0.25).normalize_or(direction);
        direction = direction.lerp(wanted, 0.16).normalize_or(wanted);
        let risen = smoothstep(0.0, 0.05, path.len() as f64 * STEP);
        let mut next = p + direction * STEP;
        for attempt in 0..4 {
            let lacking = 0.0005 + layer * risen - bust.distance(next);
            if lacking <= 0.0 {
                break;
            }
            next += bust.normal(next) * (lacking * 1.05);
            if attempt < 3 {
                next = p + (next - p).normalize_or(root.normal) * STEP;
            }
            direction = (next - p).normalize_or(root.normal);
        }
        p = next;
        path.push(p);
    }
    path
}

/// The path as [`SEGMENTS`] equally long pieces.
fn resampled(path: &[DVec3]) -> Vec<DVec3> {
    let mut lengths = vec![0.0];
    for pair in path.windows(2) {
        lengths.push(lengths[lengths.len() - 1] + pair[0].distance(pair[1]));
    }
    let total = lengths[lengths.len() - 1];
    (0..=SEGMENTS)
        .map(|k| {
            let at = total * k as f64 / SEGMENTS as f64;
            let i = lengths
                .partition_point(|&l| l <= at)
                .clamp(1, path.len() - 1);
            let t = (at - lengths[i - 1]) / (lengths[i] - lengths[i - 1]).max(1e-12);
            path[i - 1].lerp(path[i], t.min(1.0))
        })
        .collect()
}
