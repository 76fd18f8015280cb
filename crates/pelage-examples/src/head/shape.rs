//! A stylised human head and neck, life-size in metres, y up, looking along +z,
//! eyes closed.

use crate::polygonise::surface_nets;
use crate::relax::{Triangles, relaxed};
use crate::sdf::{Primitive, Solid, cone, ellipsoid, sphere, turn_x, turn_z};
use glam::DVec3;

/// Parts of the bust.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Skull and face.
    Head,
    /// Ears.
    Ear,
    /// Neck and shoulders.
    Neck,
}

/// Height at which the bust is cut off.
pub const BASE: f64 = -0.030;

/// The bust.
pub fn bust() -> Solid<Part> {
    let mut solid = Solid::new();
    let s = &mut solid;
    s.add(
        Part::Head,
        0.02,
        ellipsoid([0.0, 0.265, -0.020], [0.077, 0.092, 0.098]),
    );
    neck(s);
    face(s);
    features(s);
    for left in [true, false] {
        ear(s, left);
    }
    solid.floor = Some((BASE, 0.020));
    solid
}

fn neck(s: &mut Solid<Part>) {
    s.add(
        Part::Neck,
        0.05,
        cone([0.0, 0.175, -0.030], 0.047, [0.0, 0.040, -0.042], 0.054),
    );
    both(
        s,
        Part::Neck,
        0.05,
        cone([0.02, 0.015, -0.042], 0.048, [0.135, -0.012, -0.042], 0.046),
    );
    s.add(
        Part::Neck,
        0.05,
        ellipsoid([0.0, -0.030, -0.015], [0.125, 0.055, 0.062]),
    );
}

fn face(s: &mut Solid<Part>) {
    let head = Part::Head;
    s.add(
        head,
        0.04,
        ellipsoid([0.0, 0.228, 0.022], [0.064, 0.088, 0.066]),
    );
    both(
        s,
        head,
        0.03,
        cone([0.046, 0.190, 0.002], 0.020, [0.014, 0.147, 0.054], 0.018),
    );
    s.add(
        head,
        0.03,
        cone([0.0, 0.175, 0.035], 0.040, [0.0, 0.144, 0.068], 0.020),
    );
    let jaws = ellipsoid([0.0, 0.178, 0.060], [0.034, 0.032, 0.0295]);
    s.add(head, 0.03, jaws);
    both(s, head, 0.035, sphere([0.040, 0.208, 0.055], 0.024));
}

fn features(s: &mut Solid<Part>) {
    let head = Part::Head;
    both(
        s,
        head,
        0.022,
        cone([0.012, 0.250, 0.078], 0.011, [0.044, 0.249, 0.062], 0.011),
    );
    for side in [1.0, -1.0] {
        s.carve(
            head,
            0.022,
            ellipsoid([side * 0.031, 0.229, 0.103], [0.019, 0.013, 0.020]),
        );
    }
    both(
        s,
        head,
        0.008,
        ellipsoid([0.0305, 0.228, 0.0685], [0.0165, 0.0140, 0.0150]),
    );
    s.add(
        head,
        0.018,
        cone([0.0, 0.244, 0.082], 0.0085, [0.0, 0.205, 0.104], 0.0100),
    );
    both(s, head, 0.012, sphere([0.0105, 0.201, 0.095], 0.0080));
    let lip = |y: f64, z: f64, radii: [f64; 3]| ellipsoid([0.0, y, z], radii);
    s.add(head, 0.012, lip(0.1745, 0.0850, [0.0200, 0.0055, 0.0095]));
    s.add(head, 0.008, lip(0.1648, 0.0840, [0.0170, 0.0065, 0.0095]));
}

fn ear(s: &mut Solid<Part>, left: bool) {
    let side = |p: Primitive| if left { p } else { p.mirrored() };
    let turned = turn_z(10.0) * turn_x(12.0);
    let at = |center: [f64; 3], radii: [f64; 3]| Primitive::Ellipsoid {
        center: center.into(),
        radii: radii.into(),
        local_from_world: turned,
    };
    s.add(
        Part::Ear,
        0.012,
        side(at([0.080, 0.224, -0.018], [0.0105, 0.031, 0.0195])),
    );
    s.carve(
        Part::Ear,
        0.008,
        side(at([0.0915, 0.227, -0.013], [0.0065, 0.019, 0.0105])),
    );
}

fn both(s: &mut Solid<Part>, part: Part, blend: f64, primitive: Primitive) {
    s.add(part, blend, primitive);
    s.add(part, blend, primitive.mirrored());
}

/// The bust's mesh; `step` is the size of the grid's cells.
pub fn mesh(bust: &Solid<Part>, step: f64) -> Triangles {
    let low = DVec3::new(-0.20113, -0.04317, -0.13519);
    let high = DVec3::new(0.202, 0.372, 0.135);
    relaxed(bust, surface_nets(bust, low, high, step), 10)
}
