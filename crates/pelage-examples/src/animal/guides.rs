//! The cub's comb: which way and how long its fur grows.

use super::pattern::Spot;
use super::pelt::label;
use super::regions::{Shares, along_tail, belly, chest, from_eye, segment_nearest, shares};
use super::shape::{NOSE, Part, TAIL};
use crate::grow::{Growth, grow};
use crate::hash::{fractal, mix_between, smoothstep};
use crate::model::Model;
use crate::scatter::{Root, scatter};
use crate::sdf::Solid;
use glam::DVec3;
use pelage_strands::StrandBuffer;

/// Segments of each guide.
pub const SEGMENTS: usize = 7;

/// About `count` combed guides, none on bare skin.
pub fn guides(body: &Solid<Part>, model: &Model, count: usize) -> StrandBuffer {
    // Organs lie inside or upon the body; only the skin itself grows guides.
    let mut furred = model.clone();
    let keep = |t: usize| model.labels[t] < label::SOLE;
    let kept: Vec<usize> = (0..model.labels.len()).filter(|&t| keep(t)).collect();
    furred.mesh.triangles = kept.iter().map(|&t| model.mesh.triangles[t]).collect();
    furred.uvs = kept.iter().map(|&t| model.uvs[t]).collect();
    let mut roots = scatter(&furred, count, 0x0F0C, |p, n| {
        Spot::new(body, p, n, label::PELT).density() > 0.02
    });
    for root in &mut roots {
        root.texel.triangle = kept[root.texel.triangle as usize] as u32;
    }
    grow(body, &roots, |p| flow(body, p), |root| growth(body, root))
}

/// The direction fur is combed at a place, not yet in the tangent plane.
pub fn flow(body: &Solid<Part>, p: DVec3) -> DVec3 {
    let s = shares(body, p);
    let side = p.x.signum() * smoothstep(0.0, 0.05, p.x.abs());
    let front = smoothstep(0.11, 0.25, p.z) * smoothstep(0.52, 0.42, p.y);
    let low = smoothstep(0.42, 0.30, p.y);
    let torso =
        DVec3::new(0.0, -0.20 - 0.45 * low, -1.0).lerp(DVec3::new(0.25 * side, -1.0, -0.15), front);
    let neck = DVec3::new(0.25 * side, -1.0, -0.45);
    let leg = DVec3::new(0.0, -1.0, -0.30 * smoothstep(0.10, 0.30, p.y));
    let ear = DVec3::new(0.30 * p.x.signum(), 1.0, -0.12);
    let unit = |v: DVec3| v.normalize_or(-DVec3::Y);
    let combed = s.mix(
        unit(torso),
        unit(neck),
        unit(head_flow(p, side)),
        unit(ear),
        unit(leg),
        unit(tail_flow(p)),
    );
    // Fur is never combed to perfection.
    let stray = |channel| fractal(channel, p * 14.0) * 0.16;
    combed + DVec3::new(stray(41), stray(44), stray(47))
}

/// Away from the nose over the brow, out and down over the cheeks.
fn head_flow(p: DVec3, side: f64) -> DVec3 {
    let away = (p - DVec3::from(NOSE) - DVec3::Z * 0.02).normalize_or(-DVec3::Z);
    let cheek = smoothstep(0.69, 0.61, p.y) * smoothstep(0.48, 0.38, p.z);
    away + DVec3::new(0.8 * side, -0.45, -0.2) * cheek + DVec3::new(0.0, 0.1, -0.25)
}

fn tail_flow(p: DVec3) -> DVec3 {
    let mut sum = DVec3::ZERO;
    for s in TAIL.windows(2) {
        let (a, b) = (DVec3::from(s[0].0), DVec3::from(s[1].0));
        let near = segment_nearest(p, a, b).distance_squared(p) + 4e-4;
        sum += (b - a).normalize() / (near * near);
    }
    sum
}

/// Length, lift and bend of a guide.
fn growth(body: &Solid<Part>, root: &Root) -> Growth {
    let (p, n) = (root.position, root.normal);
    let s = shares(body, p);
    let length = length(&s, p, n);
    let lift = s.mix(0.48, 0.55, 0.38, 0.32, 0.32, 0.60);
    Growth {
        length: length * (1.0 + 0.12 * fractal(51, p * 30.0)),
        segments: SEGMENTS,
        lift,
        bend: 0.55,
        clearance: 0.20,
    }
}

fn length(s: &Shares, p: DVec3, n: DVec3) -> f64 {
    let torso = 0.058 + 0.022 * belly(p, n) + 0.030 * chest(p, n);
    let muzzle = smoothstep(0.06, 0.22, p.distance(NOSE.into()));
    let cheek = smoothstep(0.06, 0.12, p.x.abs()) * smoothstep(0.70, 0.62, p.y);
    let face = mix_between(0.019, 0.040, muzzle) + 0.034 * cheek;
    let face = face * (0.75 + 0.25 * smoothstep(0.03, 0.08, from_eye(p)));
    let leg = mix_between(0.022, 0.048, smoothstep(0.07, 0.24, p.y));
    let along = along_tail(p);
    let tail = mix_between(0.060, 0.105, smoothstep(0.05, 0.6, along));
    let ear = mix_between(0.034, 0.022, smoothstep(0.82, 0.90, p.y));
    s.mix(torso, 0.078, face, ear, leg, tail)
}
