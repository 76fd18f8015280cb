//! The bust's atlas: the scalp flattened from the crown, one chart without a seam
//! under the hair; face and neck around the axis, cut at the nape; ears and base.

use super::shape::{BASE, Part, mesh as bust_mesh};
use crate::charts::{across, smooth_labels};
use crate::flatten::Start;
use crate::model::Model;
use crate::sdf::Solid;
use glam::{DVec2, DVec3};

/// What a triangle belongs to; charts never cross labels.
pub mod label {
    /// Where hair may grow, and a margin.
    pub const SCALP: u8 = 0;
    /// Face, neck and shoulders.
    pub const FACE: u8 = 1;
    /// The outside of an ear; [`EAR`] + 1 is its back.
    pub const EAR: u8 = 2;
    /// Where the bust is cut off.
    pub const BASE: u8 = 4;
}

fn label_of(bust: &Solid<Part>, p: DVec3, normal: DVec3) -> u8 {
    if normal.y < -0.7 && p.y < BASE + 0.005 {
        return label::BASE;
    }
    let ear = bust.part_distance(p, |part| part == Part::Ear);
    let rest = bust.part_distance(p, |part| part != Part::Ear);
    if ear < rest + 0.003 {
        let out = DVec3::new(0.8 * p.x.signum(), 0.0, 0.6);
        return label::EAR + u8::from(normal.dot(out) < 0.0);
    }
    let ahead = p.z + 0.85 * (0.265 - p.y);
    if p.y > 0.105 && ahead < 0.082 {
        label::SCALP
    } else {
        label::FACE
    }
}

/// Distance and direction from the crown, as on a globe's polar map.
fn from_crown(p: DVec3) -> DVec2 {
    let crown = DVec3::new(0.0, 0.8, -0.6);
    let ahead = DVec3::new(0.0, 0.6, 0.8);
    let d = (p - DVec3::new(0.0, 0.245, -0.015)).normalize_or(crown);
    let away = libm::acos(d.dot(crown).clamp(-1.0, 1.0)) * 0.09;
    DVec2::new(-d.x, d.dot(ahead)).normalize_or_zero() * away
}

/// Mesh, labels and atlas.
pub fn model(bust: &Solid<Part>, step: f64) -> Model {
    let mesh = bust_mesh(bust, step);
    let middle = |of: &[DVec3], t: usize| {
        let tri = mesh.triangles[t];
        tri.iter().map(|&v| of[v as usize]).sum::<DVec3>() / 3.0
    };
    let count = mesh.triangles.len();
    let centers: Vec<DVec3> = (0..count).map(|t| middle(&mesh.positions, t)).collect();
    let mut labels: Vec<u8> = (0..count)
        .map(|t| label_of(bust, centers[t], middle(&mesh.normals, t)))
        .collect();
    smooth_labels(&across(&mesh.triangles), &mut labels, 4);
    let at_nape = |t: usize| labels[t] == label::FACE && centers[t].z < -0.03;
    let cuts: Vec<Option<bool>> = (0..count)
        .map(|t| at_nape(t).then_some(centers[t].x > 0.0))
        .collect();
    let cut = |a: usize, b: usize| matches!((cuts[a], cuts[b]), (Some(x), Some(y)) if x != y);
    let around = |p: DVec3, _| DVec3::new(p.z + 0.03, 0.0, -p.x);
    let from_left = |p: DVec3| DVec2::new(-p.z * p.x.signum(), p.y);
    let from_behind = |p: DVec3| DVec2::new(p.z * p.x.signum(), p.y);
    let from_below = |p: DVec3| DVec2::new(p.x, p.z);
    let crown = |p: DVec3| from_crown(p);
    let labels = labels.clone();
    Model::unwrapped(mesh, labels, cut, |l| match l {
        label::SCALP => Start::Map(&crown),
        label::FACE => Start::Along(&around),
        label::BASE => Start::Map(&from_below),
        label::EAR => Start::Map(&from_left),
        _ => Start::Map(&from_behind),
    })
}
