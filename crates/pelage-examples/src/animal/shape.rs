//! The fox cub's body: round cones and ellipsoids, y up, looking along +z,
//! standing on y = 0, nearly a unit from nose to rump.

use crate::polygonise::surface_nets;
use crate::relax::{Triangles, relaxed};
use crate::sdf::{Primitive, Solid, cone, ellipsoid, sphere};
use glam::DVec3;

/// Parts of the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Chest, back, belly, haunches.
    Torso,
    /// Between torso and head.
    Neck,
    /// Skull, cheeks and muzzle.
    Head,
    /// An ear; left (x > 0) where true.
    Ear(bool),
    /// A leg: front, left.
    Leg(bool, bool),
    /// The tail.
    Tail,
}

/// How far the paws of the two sides are apart along z: a cub about to walk.
const STRIDE: f64 = 0.035;

/// Joints of a leg from the hip down, with radii; x for the left side.
pub fn leg_joints(front: bool, left: bool) -> [(DVec3, f64); 4] {
    let step = if front == left { STRIDE } else { -STRIDE };
    let (x, joints) = if front {
        (
            0.080,
            [
                (0.29, 0.150, 0.070),
                (0.16, 0.140, 0.052),
                (0.07, 0.155, 0.045),
                (0.04, 0.165, 0.044),
            ],
        )
    } else {
        (
            0.084,
            [
                (0.30, -0.215, 0.105),
                (0.17, -0.175, 0.062),
                (0.10, -0.240, 0.044),
                (0.04, -0.225, 0.042),
            ],
        )
    };
    let side = if left { 1.0 } else { -1.0 };
    let mut k = 0.0;
    joints.map(|(y, z, r)| {
        let forward = step * k / 3.0;
        k += 1.0;
        (DVec3::new(side * x, y, z + forward), r)
    })
}

/// Centre line of the tail with radii, from its root.
pub const TAIL: [([f64; 3], f64); 6] = [
    ([0.0, 0.400, -0.300], 0.056),
    ([0.0, 0.405, -0.380], 0.054),
    ([0.004, 0.425, -0.460], 0.062),
    ([0.012, 0.475, -0.540], 0.068),
    ([0.020, 0.550, -0.595], 0.058),
    ([0.026, 0.625, -0.615], 0.026),
];

/// The round cone that hollows the left ear out: ends and radii.
pub const EAR_HOLLOW: [([f64; 3], f64); 2] = [
    ([0.112, 0.808, 0.384], 0.044),
    ([0.155, 0.905, 0.364], 0.012),
];

/// Centres of the eyes; x for the left side.
pub const EYE: [f64; 3] = [0.062, 0.668, 0.462];
/// Radius of the eyes.
pub const EYE_RADIUS: f64 = 0.0285;
/// Centre of the nose.
pub const NOSE: [f64; 3] = [0.0, 0.618, 0.568];
/// Half axes of the nose.
pub const NOSE_RADII: [f64; 3] = [0.024, 0.018, 0.017];

/// The body without eyes and nose.
pub fn body() -> Solid<Part> {
    let mut solid = Solid::new();
    torso(&mut solid);
    for left in [true, false] {
        leg(&mut solid, true, left);
        leg(&mut solid, false, left);
    }
    for (k, pair) in TAIL.windows(2).enumerate() {
        let [(a, ra), (b, rb)] = [pair[0], pair[1]];
        let blend = if k == 0 { 0.12 } else { 0.06 };
        solid.add(Part::Tail, blend, cone(a, ra, b, rb));
    }
    head(&mut solid);
    solid.floor = Some((0.0, 0.012));
    solid
}

fn torso(solid: &mut Solid<Part>) {
    solid.add(
        Part::Torso,
        0.05,
        cone([0.0, 0.350, 0.11], 0.138, [0.0, 0.345, -0.19], 0.136),
    );
    solid.add(
        Part::Torso,
        0.10,
        ellipsoid([0.0, 0.36, 0.15], [0.128, 0.145, 0.120]),
    );
    solid.add(
        Part::Neck,
        0.12,
        cone([0.0, 0.42, 0.18], 0.115, [0.0, 0.575, 0.285], 0.100),
    );
}

fn leg(solid: &mut Solid<Part>, front: bool, left: bool) {
    let part = Part::Leg(front, left);
    let joints = leg_joints(front, left);
    for (k, pair) in joints.windows(2).enumerate() {
        let [(a, ra), (b, rb)] = [pair[0], pair[1]];
        let blend = if k == 0 { 0.06 } else { 0.035 };
        solid.add(part, blend, cone(a.to_array(), ra, b.to_array(), rb));
    }
    let (ankle, _) = joints[3];
    let paw = [ankle.x, 0.030, ankle.z + 0.026];
    solid.add(part, 0.03, ellipsoid(paw, [0.050, 0.042, 0.064]));
    // Two dents between three toes.
    for side in [-1.0, 1.0] {
        let toe = ankle + DVec3::new(side * 0.017, 0.0, 0.095);
        let (low, high) = ([toe.x, 0.0, toe.z], [toe.x, 0.052, toe.z - 0.012]);
        solid.carve(part, 0.018, cone(low, 0.007, high, 0.004));
    }
}

fn head(solid: &mut Solid<Part>) {
    let head = Part::Head;
    solid.add(
        head,
        0.06,
        ellipsoid([0.0, 0.670, 0.345], [0.152, 0.132, 0.138]),
    );
    both(solid, head, 0.07, sphere([0.085, 0.615, 0.365], 0.074));
    // Muzzle above, jaw below, a cleft between them.
    solid.add(
        head,
        0.07,
        cone([0.0, 0.630, 0.44], 0.064, [0.0, 0.610, 0.536], 0.034),
    );
    solid.add(
        head,
        0.03,
        cone([0.0, 0.585, 0.43], 0.048, [0.0, 0.576, 0.505], 0.024),
    );
    both(
        solid,
        head,
        0.02,
        cone([0.020, 0.590, 0.44], 0.030, [0.014, 0.594, 0.526], 0.026),
    );
    // Lids: a mound of flesh out of which the eye looks.
    let [x, y, z] = EYE;
    both(
        solid,
        head,
        0.03,
        sphere([x, y + 0.006, z - 0.014], EYE_RADIUS + 0.008),
    );
    for left in [true, false] {
        ear(solid, left);
    }
}

fn ear(solid: &mut Solid<Part>, left: bool) {
    let side = |p: Primitive| if left { p } else { p.mirrored() };
    let flat = DVec3::new(0.30, -0.10, 1.0).normalize();
    let leaf = |a: [f64; 3], ra, b: [f64; 3], rb, press| Primitive::Leaf {
        a: a.into(),
        b: b.into(),
        ra,
        rb,
        flat,
        press,
    };
    let part = Part::Ear(left);
    let shell = leaf(
        [0.098, 0.765, 0.330],
        0.070,
        [0.158, 0.925, 0.325],
        0.020,
        1.5,
    );
    solid.add(part, 0.035, side(shell));
    let [(low, wide), (high, narrow)] = EAR_HOLLOW;
    let hollow = leaf(low, wide, high, narrow, 1.5);
    solid.carve(part, 0.02, side(hollow));
}

fn both(solid: &mut Solid<Part>, part: Part, blend: f64, primitive: Primitive) {
    solid.add(part, blend, primitive);
    solid.add(part, blend, primitive.mirrored());
}

/// The body's mesh; `step` is the size of the grid's cells.
pub fn mesh(solid: &Solid<Part>, step: f64) -> Triangles {
    // Odd offsets keep flat and symmetric places off the grid's own planes.
    let low = DVec3::new(-0.25713, -0.03317, -0.68519);
    let high = DVec3::new(0.26, 1.0, 0.62);
    relaxed(solid, surface_nets(solid, low, high, step), 12)
}
