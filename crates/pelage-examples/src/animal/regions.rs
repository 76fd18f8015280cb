//! Where on the cub a place is: soft memberships that the comb, the lengths and
//! the colours share.

use super::shape::{EAR_HOLLOW, EYE, NOSE, Part, TAIL};
use crate::hash::smoothstep;
use crate::sdf::Solid;
use glam::DVec3;

/// The point of segment `a`–`b` nearest to `p`.
pub fn segment_nearest(p: DVec3, a: DVec3, b: DVec3) -> DVec3 {
    let ab = b - a;
    a + ab * ((p - a).dot(ab) / ab.length_squared()).clamp(0.0, 1.0)
}

/// How much a place belongs to each part; the numbers sum to 1.
#[derive(Clone, Copy, Debug, Default)]
pub struct Shares {
    /// Chest, back, belly.
    pub torso: f64,
    /// Neck.
    pub neck: f64,
    /// Skull and muzzle.
    pub head: f64,
    /// Ears.
    pub ear: f64,
    /// Legs.
    pub leg: f64,
    /// Tail.
    pub tail: f64,
}

impl Shares {
    /// The sum of one value a part, each times its share.
    pub fn mix<T>(&self, torso: T, neck: T, head: T, ear: T, leg: T, tail: T) -> T
    where
        T: std::ops::Mul<f64, Output = T> + std::ops::Add<Output = T>,
    {
        torso * self.torso
            + neck * self.neck
            + head * self.head
            + ear * self.ear
            + leg * self.leg
            + tail * self.tail
    }
}

/// Width of the transition between parts.
const SOFTNESS: f64 = 0.022;

/// Memberships of a place on or near the surface.
pub fn shares(body: &Solid<Part>, p: DVec3) -> Shares {
    let mut nearest = [f64::MAX; 6];
    for blob in body.blobs.iter().filter(|b| !b.carved) {
        let slot = match blob.part {
            Part::Torso => 0,
            Part::Neck => 1,
            Part::Head => 2,
            Part::Ear(_) => 3,
            Part::Leg(..) => 4,
            Part::Tail => 5,
        };
        nearest[slot] = nearest[slot].min(blob.primitive.distance(p));
    }
    let least = nearest.iter().copied().fold(f64::MAX, f64::min);
    let weights = nearest.map(|d| libm::exp((least - d) / SOFTNESS));
    let sum: f64 = weights.iter().sum();
    let [torso, neck, head, ear, leg, tail] = weights.map(|w| w / sum);
    Shares {
        torso,
        neck,
        head,
        ear,
        leg,
        tail,
    }
}

/// Distance to the nearer eye's centre.
pub fn from_eye(p: DVec3) -> f64 {
    DVec3::new(p.x.abs(), p.y, p.z).distance(EYE.into())
}

/// Distance to the nose's centre.
pub fn from_nose(p: DVec3) -> f64 {
    p.distance(NOSE.into())
}

/// 0 at the nose, 1 where the muzzle ends and the cheeks begin.
pub fn up_the_muzzle(p: DVec3) -> f64 {
    smoothstep(0.03, 0.19, from_nose(p))
}

/// 0 at the root of the tail, 1 at its end, by length.
pub fn along_tail(p: DVec3) -> f64 {
    let mut best = (f64::MAX, 0.0);
    let mut walked = 0.0;
    let total: f64 = TAIL.windows(2).map(length).sum();
    for s in TAIL.windows(2) {
        let (a, b) = (DVec3::from(s[0].0), DVec3::from(s[1].0));
        let q = segment_nearest(p, a, b);
        if q.distance(p) < best.0 {
            best = (q.distance(p), walked + q.distance(a));
        }
        walked += length(s);
    }
    best.1 / total
}

fn length(segment: &[([f64; 3], f64)]) -> f64 {
    DVec3::from(segment[0].0).distance(segment[1].0.into())
}

/// 1 under the torso, 0 on its flanks and back.
pub fn belly(p: DVec3, normal: DVec3) -> f64 {
    smoothstep(0.35, 0.85, -normal.y) * smoothstep(0.36, 0.29, p.y)
}

/// 1 on the front of chest and throat.
pub fn chest(p: DVec3, normal: DVec3) -> f64 {
    smoothstep(0.0, 0.6, normal.z - 0.3 * normal.y) * smoothstep(0.08, 0.20, p.z)
}

/// 1 in the hollow of the ears.
pub fn inner_ear(p: DVec3, normal: DVec3) -> f64 {
    let [low, high] = EAR_HOLLOW.map(|(end, _)| DVec3::from(end));
    let beside = DVec3::new(p.x.abs(), p.y, p.z);
    let nearest = segment_nearest(beside, low, high);
    let taper = 0.022 * (nearest.y - low.y) / (high.y - low.y);
    let ahead = DVec3::new(0.3 * p.x.signum(), -0.1, 1.0);
    smoothstep(0.060 - taper, 0.040 - taper, nearest.distance(beside))
        * smoothstep(-0.1, 0.4, normal.dot(ahead))
}
