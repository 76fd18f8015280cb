//! The fur: where it grows, how it lies, what colour it has.

use super::shape::{Nearby, nearby, normal};
use pelage_curves::Vec3;
use pelage_strands::{StrandBuffer, StrandMeta};

/// Control vertices of a hair.
const VERTICES: usize = 6;

/// A number in 0..1 that belongs to (`index`, `channel`).
fn random(index: u32, channel: u32) -> f32 {
    let mut x = index ^ channel.wrapping_mul(0x9e37_79b9);
    x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
    ((x ^ (x >> 16)) >> 8) as f32 / 16_777_216.0
}

fn lattice(c: [i32; 3], channel: u32) -> f32 {
    let mixed = (c[0] as u32).wrapping_mul(73_856_093)
        ^ (c[1] as u32).wrapping_mul(19_349_663)
        ^ (c[2] as u32).wrapping_mul(83_492_791);
    random(mixed, channel)
}

/// Smooth noise in −1..1, features about 1 in size.
fn noise(p: Vec3, channel: u32) -> f32 {
    let base = p.floor();
    let f = p - base;
    let f = f * f * (Vec3::splat(3.0) - f * 2.0);
    let mut sum = 0.0;
    for k in 0..8i32 {
        let bit = [k & 1, k >> 1 & 1, k >> 2 & 1];
        let pick = |on: i32, f: f32| if on == 1 { f } else { 1.0 - f };
        let weight = pick(bit[0], f.x) * pick(bit[1], f.y) * pick(bit[2], f.z);
        let corner = [
            base.x as i32 + bit[0],
            base.y as i32 + bit[1],
            base.z as i32 + bit[2],
        ];
        sum += weight * lattice(corner, channel);
    }
    sum * 2.0 - 1.0
}

fn noise3(p: Vec3, channel: u32) -> Vec3 {
    Vec3::new(
        noise(p, channel),
        noise(p, channel + 1),
        noise(p, channel + 2),
    )
}

/// The nearest of scattered points, one to each cube of edge `size`.
fn clump(p: Vec3, size: f32) -> Vec3 {
    let base = (p / size).floor();
    let mut best = (f32::INFINITY, p);
    for k in 0..27 {
        let c = [k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1];
        let cell = [
            base.x as i32 + c[0],
            base.y as i32 + c[1],
            base.z as i32 + c[2],
        ];
        let jitter = Vec3::new(lattice(cell, 91), lattice(cell, 92), lattice(cell, 93));
        let centre = Vec3::new(cell[0] as f32, cell[1] as f32, cell[2] as f32) + jitter;
        let centre = centre * size;
        let d = centre.distance_squared(p);
        if d < best.0 {
            best = (d, centre);
        }
    }
    best.1
}

fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// `count` hairs over the body, evenly by area.
pub fn fur(count: u32) -> StrandBuffer {
    let mut strands = StrandBuffer::new();
    let mut trial = 0u32;
    while (strands.len() as u32) < count {
        trial += 1;
        let in_box = Vec3::new(
            random(trial, 1) * 1.1 - 0.55,
            random(trial, 2) * 2.1 - 0.05,
            random(trial, 3) * 3.2 - 1.7,
        );
        // Points near the surface, dropped onto it, are even over it.
        let d = super::shape::distance(in_box);
        if d.abs() > 0.02 {
            continue;
        }
        let root = in_box - normal(in_box) * d;
        let here = nearby(root);
        if here.fur > 0.0 {
            grow(&mut strands, trial, root, &here);
        }
    }
    strands
}

/// Appends the hair `id` that grows at `root`.
fn grow(strands: &mut StrandBuffer, id: u32, root: Vec3, here: &Nearby) {
    let up = normal(root);
    let guard = random(id, 5) < 0.12;
    let vary = 0.75 + 0.35 * random(id, 6) + 0.22 * noise(root * 9.0, 20);
    let length = here.fur * vary * if guard { 1.22 } else { 1.0 };
    // Down, and with the flow of the body; along the skin, not into it.
    let flow = here.flow + Vec3::NEG_Y * 0.35 + noise3(root * 5.0, 30) * 0.5;
    let flow = (flow - up * flow.dot(up)).normalize_or(Vec3::NEG_Y);
    let lift = 0.42 + 0.2 * noise(root * 7.0, 40);
    let stray = Vec3::new(random(id, 7), random(id, 8), random(id, 9)) - Vec3::splat(0.5);
    let stray = stray * if guard { 0.5 } else { 0.32 };
    let centre = clump(root, 0.045);
    let towards = (centre - root) - up * (centre - root).dot(up);
    let (root_color, tip_color) = colors(id, root, here, guard);
    let width = if guard { 0.0034 } else { 0.0026 };
    let step = length / (VERTICES - 1) as f32;
    let mut p = root - up * 0.004;
    for k in 0..VERTICES {
        let t = k as f32 / (VERTICES - 1) as f32;
        let clumped = p + towards * (0.55 * t * t);
        let wave = noise3(clumped * 13.0, 50) * (0.02 * t * length / 0.15);
        // The ground holds the paws' hair up.
        let place = clumped + wave;
        strands.points.push([place.x, place.y.max(0.002), place.z]);
        strands.widths.push(width * (1.0 - 0.88 * t * t));
        strands.colors.push(
            root_color
                .lerp(tip_color, smoothstep(0.05, 0.6, t))
                .to_array(),
        );
        strands.opacities.push(1.0);
        let lie = (0.25 + 1.1 * t).min(1.0);
        let direction = up * (lift * (1.0 - 0.75 * lie)) + flow * lie + stray;
        let sag = Vec3::NEG_Y * (0.22 * t * (length / 0.15).min(1.4));
        p += (direction + sag).normalize_or(up) * step;
    }
    strands.push_meta(&StrandMeta {
        hair_id: strands.len() as u64,
        ..StrandMeta::default()
    });
}

/// Colours at the root and the tip, linear RGB: a red fox.
fn colors(id: u32, p: Vec3, here: &Nearby, guard: bool) -> (Vec3, Vec3) {
    let rust = Vec3::new(0.56, 0.17, 0.03);
    let honey = Vec3::new(0.74, 0.33, 0.085);
    let cream = Vec3::new(0.90, 0.83, 0.72);
    let sable = Vec3::new(0.022, 0.017, 0.015);
    let wander = 0.035 * noise(p * 14.0, 60) + 0.02 * (random(id, 11) - 0.5);
    let mut white: f32 = 0.0;
    let mut black: f32 = 0.0;
    match here.part.name {
        "chest" | "belly" | "neck" | "rump" => {
            let front = smoothstep(0.55, 0.95, p.z);
            white = smoothstep(0.90 + 0.42 * front, 0.80 + 0.40 * front, p.y + wander);
        }
        "snout" => white = smoothstep(1.475, 1.445, p.y + 0.4 * wander),
        "cheek" | "skull" => white = smoothstep(1.475, 1.42, p.y + wander),
        "foreleg" => black = smoothstep(0.62, 0.46, p.y + wander),
        "thigh" | "shin" => black = smoothstep(0.50, 0.34, p.y + wander),
        "foreshin" | "forepaw" | "hindpaw" => black = 1.0,
        "ear" => {
            black = if p.z < 0.868 + wander * 0.2 {
                0.9
            } else {
                smoothstep(0.62, 0.8, here.along)
            }
        }
        "tail" => white = smoothstep(0.66, 0.80, here.along + wander),
        _ => {}
    }
    let back = smoothstep(0.98, 1.28, p.y + wander);
    let base = honey.lerp(rust, 0.45 + 0.55 * back);
    let color = base.lerp(cream, white).lerp(sable, black);
    let vary = 0.86 + 0.28 * random(id, 12);
    let tip = (color * vary).min(Vec3::splat(0.95));
    let tip = if guard && white < 0.3 && black < 0.3 && random(id, 13) < 0.35 {
        tip * 0.3
    } else {
        tip
    };
    let under = Vec3::new(0.42, 0.33, 0.26);
    let root = tip.lerp(tip * under, 0.75 - 0.35 * white);
    (root, tip)
}
