//! Guides that tests of the stages mix, and what they measure of hairs.

use crate::lanes::Rows;
use crate::stages::interpolate::{self, FOUR, Mix, Row, rows};
use crate::stages::weights::Share;
use pelage_curves::Vec3;
use std::f32::consts::TAU;

/// Segments of all of them.
pub const SEGMENTS: usize = 48;

/// A helix about the normal from the origin: `turns` turns of `radius` over a height of 1.
pub fn helix(radius: f32, turns: f32, phase: f32) -> Vec<Vec3> {
    let at = |i: usize| {
        let t = i as f32 / SEGMENTS as f32;
        let angle = TAU * (turns * t + phase);
        Vec3::new(radius * libm::cosf(angle), radius * libm::sinf(angle), t)
    };
    (0..=SEGMENTS).map(|i| at(i) - at(0)).collect()
}

pub fn straight(tip: Vec3) -> Vec<Vec3> {
    (0..=SEGMENTS)
        .map(|i| tip * (i as f32 / SEGMENTS as f32))
        .collect()
}

/// In one plane through the normal, with a bend one way and a bend the other.
pub fn s_shape(size: f32, direction: f32) -> Vec<Vec3> {
    let at = |i: usize| {
        let t = i as f32 / SEGMENTS as f32;
        let aside = size * (1.0 - libm::cosf(TAU * t));
        Vec3::new(
            aside * libm::cosf(direction),
            aside * libm::sinf(direction),
            t,
        )
    };
    (0..=SEGMENTS).map(at).collect()
}

pub fn shares(weights: &[f32]) -> Vec<Share> {
    let shares = (0..).zip(weights).map(|(guide, &weight)| Share {
        guide,
        weight,
        cosine: weight,
        sine: 0.0,
    });
    shares.collect()
}

/// The mean of guides, as vertices one after the other.
pub fn interpolate(guides: &[Row], shares: &[Share], hair: &mut [Vec3]) {
    let mut rows = vec![Rows::default(); hair.len()];
    let mut mixes = [Mix::default(); FOUR];
    mixes[0] = Mix {
        guides,
        vertices: hair.len(),
        shares,
    };
    interpolate::interpolate(mixes, 0, &mut rows);
    for (vertex, row) in hair.iter_mut().zip(&rows) {
        *vertex = row.get(0);
    }
}

pub fn in_rows(guides: &[Vec<Vec3>]) -> Vec<Row> {
    guides.iter().flat_map(|guide| rows(guide)).collect()
}

pub fn length(hair: &[Vec3]) -> f32 {
    hair.windows(2).map(|w| w[0].distance(w[1])).sum()
}

/// Root mean square distance from the axis of whole turns about the normal.
pub fn radius(hair: &[Vec3]) -> f32 {
    let flat = |v: &Vec3| Vec3::new(v.x, v.y, 0.0);
    let turns = &hair[..SEGMENTS];
    let middle = turns.iter().map(flat).sum::<Vec3>() / SEGMENTS as f32;
    let squares = turns.iter().map(|v| flat(v).distance_squared(middle));
    (squares.sum::<f32>() / SEGMENTS as f32).sqrt()
}

pub fn farthest(a: &[Vec3], b: &[Vec3]) -> f32 {
    let apart = a.iter().zip(b).map(|(p, q)| p.distance(*q));
    apart.fold(0.0, f32::max)
}

/// Guides of many kinds that have nothing to do with each other.
pub fn motley() -> Vec<Vec<Vec3>> {
    vec![
        helix(0.1, 4.0, 0.0),
        helix(0.1, 4.0, 0.33),
        helix(0.1, 4.0, 0.67),
        helix(0.15, -3.0, 0.1),
        straight(Vec3::new(0.5, 0.0, 0.8)),
        straight(Vec3::new(-0.9, 0.0, -0.3)),
        s_shape(0.2, 0.5),
        s_shape(-0.2, 0.6),
        straight(Vec3::ZERO),
    ]
}
