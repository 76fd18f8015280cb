//! Where along a curve the rings of a tube stand.

use super::{Tube, TubeError};
use crate::framing::{close_frames, twists};
use crate::frenet::{Frame, Sample, SpaceCurve};
use glam::DVec3;

/// How many rings a tube has, and where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rings {
    /// So many parts (one at least) of equal arc length.
    Even(usize),
    /// Level of detail: parts that bend by about `angle` radians each, however long they
    /// are, and `most` (1 to 2,097,152) of them at most. What counts as a bend is the turn of
    /// the tangent, that of the outline where the radius changes, and the twist of the
    /// frame.
    Bends {
        /// Radians from ring to ring; positive.
        angle: f64,
        /// Most parts.
        most: usize,
    },
}

/// A ring: a copy of the section.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ring {
    pub center: DVec3,
    pub frame: Frame,
    pub radius: f64,
    /// Length along the tube's side.
    pub s: f64,
    /// In a round cap, radians from the end of the curve to its tip, negative at the start.
    pub cap: Option<f64>,
}

/// Samples per part, so that parts come out nearly even.
const FINER: usize = 8;

/// Most samples looked at to find where a curve bends: some gigabytes.
const MOST: usize = 1 << 24;

/// The rings along `curve`; two at least, and if `tube` closes the last is the first.
pub(super) fn along(
    curve: &impl SpaceCurve,
    tube: &Tube,
    radius: &impl Fn(f64) -> f64,
) -> Result<Vec<Ring>, TubeError> {
    match tube.rings {
        Rings::Even(parts) => even(curve, tube, radius, parts),
        Rings::Bends { angle, most } => {
            if angle.is_nan() || angle <= 0.0 {
                return Err(TubeError::Angle { found: angle });
            }
            let most = most.clamp(1, MOST / FINER);
            let first = (4 * curve.pieces()).clamp(64, FINER * most.max(8));
            let rings = even(curve, tube, radius, first)?;
            let bend = bends(&rings).last().map_or(0.0, |bend| bend / angle);
            let finer = ((bend * FINER as f64) as usize).min(FINER * most);
            match finer > first {
                true => Ok(thinned(&even(curve, tube, radius, finer)?, angle, most)),
                false => Ok(thinned(&rings, angle, most)),
            }
        }
    }
}

fn even(
    curve: &impl SpaceCurve,
    tube: &Tube,
    radius: &impl Fn(f64) -> f64,
    parts: usize,
) -> Result<Vec<Ring>, TubeError> {
    let samples = Sample::along(curve, parts)?;
    let mut frames = tube.framing.frames(&samples, tube.first)?;
    let length = samples.last().map_or(0.0, |last| last.s);
    if tube.closed {
        let gap = samples[0]
            .position
            .distance(samples[samples.len() - 1].position);
        if gap > 1e-6 * length {
            return Err(TubeError::NotClosed { gap });
        }
        close_frames(&samples, &mut frames);
    }
    let mut rings = Vec::with_capacity(samples.len());
    for (i, (sample, frame)) in samples.iter().zip(frames).enumerate() {
        let at = i as f64 / (samples.len() - 1) as f64;
        let radius = radius(at);
        if !radius.is_finite() || radius < 0.0 {
            return Err(TubeError::Radius { at, found: radius });
        }
        rings.push(Ring {
            center: sample.position,
            frame,
            radius,
            s: sample.s,
            cap: None,
        });
    }
    if let (true, [first, .., last]) = (tube.closed, &mut rings[..]) {
        *last = Ring {
            s: last.s,
            ..*first
        };
    }
    Ok(rings)
}

/// How far the tube has bent up to each ring; radians, ascending from 0.
fn bends(rings: &[Ring]) -> Vec<f64> {
    let angle = |a: DVec3, b: DVec3| libm::atan2(a.cross(b).length(), a.dot(b));
    let outline = |r: &[Ring]| libm::atan2(r[1].radius - r[0].radius, r[1].s - r[0].s);
    let as_sample = |ring: &Ring| Sample {
        s: ring.s,
        position: ring.center,
        first: ring.frame.tangent,
        second: DVec3::ZERO,
    };
    let samples: Vec<Sample> = rings.iter().map(as_sample).collect();
    let frames: Vec<Frame> = rings.iter().map(|ring| ring.frame).collect();
    let twists = twists(&samples, &frames);
    let (mut bend, mut before) = (0.0, outline(rings));
    let mut bends = vec![bend];
    for (pair, twist) in rings.windows(2).zip(twists) {
        let now = outline(pair);
        // Less is the rounding of acute angles.
        let turn = angle(pair[0].frame.tangent, pair[1].frame.tangent);
        bend += [turn, now - before, twist]
            .iter()
            .filter(|a| a.abs() > 1e-9)
            .map(|a| a.abs())
            .sum::<f64>();
        before = now;
        bends.push(bend);
    }
    bends
}

/// Of many rings, those that part the bend evenly, ends included.
fn thinned(rings: &[Ring], angle: f64, most: usize) -> Vec<Ring> {
    let bends = bends(rings);
    let last = rings.len() - 1;
    let parts = (bends[last] / angle).ceil().clamp(1.0, most as f64);
    let mut kept = vec![rings[0]];
    let mut next = 1.0;
    for i in 1..last {
        if bends[i] >= bends[last] * next / parts && next < parts {
            kept.push(rings[i]);
            while next < parts && bends[i] >= bends[last] * next / parts {
                next += 1.0;
            }
        }
    }
    kept.push(rings[last]);
    kept
}
