//! The cub's atlas: one pelt, slit along the underside and the inner legs like a
//! hide on the floor, so that no seam crosses fur one looks at and texture u runs
//! from head to tail; ears, soles, snout, eyes and nose are charts of their own.

use super::regions::{along_tail, segment_nearest};
use super::shape::{EYE, EYE_RADIUS, NOSE, NOSE_RADII, Part, TAIL, leg_joints, mesh as body_mesh};
use crate::flatten::Start;
use crate::model::Model;
use crate::polygonise::surface_nets;
use crate::relax::{Triangles, relaxed};
use crate::sdf::{Primitive, Solid, ellipsoid, sphere};
use glam::{DVec2, DVec3};

/// What a triangle belongs to; charts never cross labels.
pub mod label {
    /// Everything furry but the ears.
    pub const PELT: u8 = 0;
    /// Front of an ear.
    pub const EAR_FRONT: u8 = 1;
    /// Back of an ear.
    pub const EAR_BACK: u8 = 2;
    /// The end of the muzzle, under the nose.
    pub const SNOUT: u8 = 3;
    /// A lower leg with its paw.
    pub const LEG: u8 = 4;
    /// The tail.
    pub const TAIL: u8 = 5;
    /// Under a paw.
    pub const SOLE: u8 = 6;
    /// Front of an eye; [`EYE`] + 1 is its back.
    pub const EYE: u8 = 7;
    /// Front of the nose; [`NOSE`] + 1 is its back.
    pub const NOSE: u8 = 9;
}

/// From the muzzle over neck and back to the end of the tail.
fn axis() -> Vec<DVec3> {
    let mut axis = vec![
        DVec3::new(0.0, 0.605, 0.58),
        DVec3::new(0.0, 0.615, 0.44),
        DVec3::new(0.0, 0.645, 0.34),
        DVec3::new(0.0, 0.47, 0.21),
        DVec3::new(0.0, 0.36, 0.11),
    ];
    axis.push(DVec3::new(0.0, 0.36, -0.19));
    axis.extend(TAIL.map(|(p, _)| DVec3::from(p)));
    axis
}

/// Position from the nearest point of the axis, and the axis' direction there.
fn from_axis(axis: &[DVec3], p: DVec3) -> (DVec3, DVec3) {
    let flat = DVec3::new(0.0, p.y, p.z);
    let nearest = axis
        .windows(2)
        .map(|s| (segment_nearest(flat, s[0], s[1]), s[1] - s[0]))
        .min_by(|a, b| {
            let d = |q: &DVec3| DVec2::new(q.y - flat.y, q.z - flat.z).length_squared();
            d(&a.0).total_cmp(&d(&b.0))
        });
    nearest.map_or((DVec3::Y, -DVec3::Z), |(q, d)| (p - q, d.normalize()))
}

/// Whether a place is on the underside of the axis.
fn is_ventral(axis: &[DVec3], p: DVec3) -> bool {
    let (offset, along) = from_axis(axis, p);
    offset.y * -along.z + offset.z * along.y < 0.0
}

/// Depth of the middle of a leg at height `y`.
fn leg_at(front: bool, left: bool, y: f64) -> DVec3 {
    let joints = leg_joints(front, left);
    for pair in joints.windows(2) {
        let (a, b) = (pair[0].0, pair[1].0);
        if y >= b.y {
            return a.lerp(b, ((a.y - y) / (a.y - b.y)).clamp(0.0, 1.0));
        }
    }
    joints[3].0
}

/// Which side of a leg's inner slit a place is on; `None` away from all slits.
fn slit_side(p: DVec3) -> Option<(bool, bool)> {
    let left = p.x > 0.0;
    let front = p.z > -0.04;
    let middle = leg_at(front, left, p.y);
    let near = p.y < 0.33 && p.x.abs() < middle.x.abs() && (p.z - middle.z).abs() < 0.04;
    near.then_some((front, p.z > middle.z))
}

/// The direction texture u follows at a place: to the tail, and around the legs.
fn along(body: &Solid<Part>, axis: &[DVec3], p: DVec3, normal: DVec3) -> DVec3 {
    let mut to_tail = DVec3::ZERO;
    for s in axis.windows(2) {
        let near = segment_nearest(p, s[0], s[1]).distance_squared(p) + 1e-3;
        to_tail += (s[1] - s[0]).normalize() / (near * near);
    }
    let leg = body.part_distance(p, |part| matches!(part, Part::Leg(..)));
    let rest = body.part_distance(p, |part| !matches!(part, Part::Leg(..)));
    let share = crate::hash::smoothstep(-0.02, 0.04, rest - leg);
    let around = normal.cross(-DVec3::Y) * p.x.signum();
    to_tail.normalize() * (1.0 - share) + around * share
}

/// How far the charts of the ears reach onto the head.
const EAR_FOOT: f64 = 0.014;

/// The same for the legs, and the height where their charts end.
const LEG_FOOT: f64 = 0.004;
const LEG_TOP: f64 = 0.235;
const BETWEEN_LEGS: f64 = 0.028;

fn label_of(body: &Solid<Part>, p: DVec3, normal: DVec3) -> u8 {
    let nose = DVec3::from(NOSE) - DVec3::Z * 0.004;
    // The fillet at an ear's foot goes with the ear: it would fold in the pelt.
    let ear = body.part_distance(p, |part| matches!(part, Part::Ear(_)));
    let head = body.part_distance(p, |part| part == Part::Head);
    if p.y > 0.74 && ear < head + EAR_FOOT {
        let ahead = DVec3::new(0.3 * p.x.signum(), -0.1, 1.0);
        return if normal.dot(ahead) > 0.0 {
            label::EAR_FRONT
        } else {
            label::EAR_BACK
        };
    }
    let leg = body.part_distance(p, |part| matches!(part, Part::Leg(..)));
    let rest = body.part_distance(p, |part| !matches!(part, Part::Leg(..)));
    if p.y < LEG_TOP && (p.x.abs() > BETWEEN_LEGS || p.y < 0.17) && leg < rest + LEG_FOOT {
        let sole = normal.y < -0.75 && p.y < 0.02;
        return if sole { label::SOLE } else { label::LEG };
    }
    match body.nearest_part(p) {
        Some(Part::Tail) if along_tail(p) > 0.16 => label::TAIL,
        Some(Part::Head) if p.distance(nose) < 0.036 => label::SNOUT,
        _ => label::PELT,
    }
}

/// The eyes and the nose, each a closed surface of its own.
fn organs(step: f64) -> Vec<(u8, Triangles)> {
    let eye = sphere(EYE, EYE_RADIUS);
    let bodies: [(u8, Primitive); 3] = [
        (label::EYE, eye),
        (label::EYE, eye.mirrored()),
        (label::NOSE, ellipsoid(NOSE, NOSE_RADII)),
    ];
    bodies
        .into_iter()
        .map(|(label, body)| {
            let mut solid = Solid::new();
            solid.add((), 1e-3, body);
            let step = (step * 0.5).min(EYE_RADIUS * 0.3);
            let center = match body {
                Primitive::Ellipsoid { center, .. } => center,
                Primitive::RoundCone { a, .. } | Primitive::Leaf { a, .. } => a,
            };
            let reach = DVec3::splat(EYE_RADIUS + 2.1 * step);
            let net = surface_nets(&solid, center - reach, center + reach, step);
            (label, relaxed(&solid, net, 8))
        })
        .collect()
}

/// Mesh, labels and atlas.
pub fn model(body: &Solid<Part>, step: f64) -> Model {
    let mut mesh = body_mesh(body, step);
    let middle = |mesh: &Triangles, t: usize| {
        let tri = mesh.triangles[t];
        let mean = |of: &[DVec3]| tri.iter().map(|&v| of[v as usize]).sum::<DVec3>() / 3.0;
        (mean(&mesh.positions), mean(&mesh.normals))
    };
    let mut labels: Vec<u8> = (0..mesh.triangles.len())
        .map(|t| {
            let (p, n) = middle(&mesh, t);
            label_of(body, p, n)
        })
        .collect();
    crate::charts::smooth_labels(&crate::charts::across(&mesh.triangles), &mut labels, 4);
    for (label, organ) in organs(step) {
        let front = |t: usize| label + u8::from(middle(&organ, t).1.z < 0.0);
        labels.extend((0..organ.triangles.len()).map(front));
        mesh.append(&organ);
    }
    let axis = axis();
    let centers: Vec<DVec3> = (0..labels.len()).map(|t| middle(&mesh, t).0).collect();
    let below: Vec<bool> = centers.iter().map(|&p| is_ventral(&axis, p)).collect();
    let slits: Vec<_> = centers.iter().map(|&p| slit_side(p)).collect();
    let pelt = labels.clone();
    let cut = |a: usize, b: usize| {
        let furred = matches!(pelt[a], label::PELT | label::LEG | label::TAIL);
        if !(furred && below[a] && below[b]) {
            return false;
        }
        let midline = (centers[a].x > 0.0) != (centers[b].x > 0.0);
        let slit = match (slits[a], slits[b]) {
            (Some((leg, side)), Some((other, beyond))) => {
                pelt[a] == label::LEG && leg == other && side != beyond
            }
            _ => false,
        };
        midline || slit
    };
    let field = |p: DVec3, n: DVec3| along(body, &axis, p, n);
    let upright = |p: DVec3| DVec2::new(p.x, p.y);
    let from_behind = |p: DVec3| DVec2::new(-p.x, p.y);
    let from_below = |p: DVec3| DVec2::new(p.x, p.z);
    Model::unwrapped(mesh, labels, cut, |l| match l {
        label::PELT | label::LEG | label::TAIL => Start::Along(&field),
        label::SOLE => Start::Map(&from_below),
        label::EAR_BACK => Start::Map(&from_behind),
        l if l == label::EYE + 1 || l == label::NOSE + 1 => Start::Map(&from_behind),
        _ => Start::Map(&upright),
    })
}
