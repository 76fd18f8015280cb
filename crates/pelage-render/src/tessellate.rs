//! Strands cut into linear leaves, just fine enough for the picture.
//!
//! A Catmull-Rom piece is cut by two measures: how far the chord strays from the
//! curve in pixels, and how far the tangent turns, since the highlight of a fibre
//! is sharp in its direction. Shading happens at the cuts (as REYES shades at
//! micropolygon vertices) and is interpolated between them, so a hair that many
//! rays cross is shaded once.

use crate::stage::{Frame, View};
use crate::{RenderError, Scene, Settings};
use glam::Vec3;
use pelage_curves::catmull_rom;
use pelage_strands::StrandBuffer;
use rayon::prelude::*;

/// Largest turn of the tangent over a leaf, in radians: half of it enters the half
/// angle of the highlight, whose own width is about 0.27.
const TURN: f32 = 0.4;
/// Largest distance between leaf and curve, in pixels.
const STRAY: f32 = 0.35;
/// Largest notch where two leaves of a wide hair meet at an angle, in pixels.
const NOTCH: f32 = 0.4;
/// Most leaves a piece, against memory running out on hairs before the lens.
const MOST_LEAVES: f32 = 24.0;
/// Strands cut by one task.
const CHUNK: usize = 2048;

/// Strands as polylines in the unit scene.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cuts {
    /// Per cut: position and half the width drawn.
    pub places: Vec<[f32; 4]>,
    /// Per cut: linear RGB (of the fibre, later its radiance) and opacity.
    pub looks: Vec<[f32; 4]>,
    /// Where each strand's cuts start; one entry more than strands.
    pub starts: Vec<u32>,
    /// Strands left out: not finite, or fewer than two vertices.
    pub skipped: usize,
}

impl Cuts {
    /// Cuts all strands of `scene` for a picture through `view`.
    pub fn of(
        scene: &Scene,
        frame: &Frame,
        view: &View,
        settings: &Settings,
    ) -> Result<Self, RenderError> {
        let cutter = Cutter {
            frame,
            view,
            settings,
            pixel: view.pixel(settings.height),
        };
        let mut all = Self {
            starts: vec![0],
            ..Self::default()
        };
        for strands in &scene.strands {
            let order = order(strands, frame);
            let parts: Vec<Cuts> = order
                .par_chunks(CHUNK)
                .map(|chunk| {
                    let mut part = Cuts::default();
                    chunk
                        .iter()
                        .for_each(|&s| cutter.cut(strands, s as usize, &mut part));
                    part
                })
                .collect();
            for part in parts {
                all.append(part)?;
            }
        }
        Ok(all)
    }

    fn append(&mut self, mut part: Cuts) -> Result<(), RenderError> {
        let base = self.places.len() as u64;
        let found = base + part.places.len() as u64;
        // The last bit is spared for "nothing here".
        let limit = u64::from(u32::MAX >> 1);
        if found > limit {
            return Err(RenderError::TooLarge { found, limit });
        }
        self.places.append(&mut part.places);
        self.looks.append(&mut part.looks);
        self.starts
            .extend(part.starts.iter().map(|s| base as u32 + s));
        self.skipped += part.skipped;
        Ok(())
    }

    /// First cuts of all leaves that can be seen.
    pub fn leaves(&self) -> Vec<u32> {
        let mut leaves = Vec::with_capacity(self.places.len());
        for w in self.starts.windows(2) {
            for i in w[0]..w[1].saturating_sub(1) {
                let k = i as usize;
                if self.looks[k][3] > 0.0 || self.looks[k + 1][3] > 0.0 {
                    leaves.push(i);
                }
            }
        }
        leaves
    }

    /// Position of cut `i`.
    pub fn position(&self, i: usize) -> Vec3 {
        let [x, y, z, _] = self.places[i];
        Vec3::new(x, y, z)
    }

    /// Unit tangent at cut `i` of a strand with cuts `start..end`.
    pub fn tangent(&self, i: usize, start: usize, end: usize) -> Vec3 {
        let before = self.position(i.saturating_sub(1).max(start));
        let after = self.position((i + 1).min(end - 1));
        (after - before).try_normalize().unwrap_or(Vec3::Z)
    }
}

/// The strands along a space-filling curve through their roots: what is near in
/// space is then near in memory, which every later stage gains from.
fn order(strands: &StrandBuffer, frame: &Frame) -> Vec<u32> {
    let mut keyed: Vec<(u32, u32)> = (0..strands.len())
        .into_par_iter()
        .map(|s| {
            let root = strands.points.get(strands.offsets[s] as usize);
            let key = root.map_or(0, |&p| morton(frame.place(p)));
            (key, s as u32)
        })
        .collect();
    keyed.par_sort_unstable();
    keyed.into_iter().map(|(_, s)| s).collect()
}

/// Ten bits of each coordinate of a point of the unit scene, interleaved.
fn morton(p: Vec3) -> u32 {
    let spread = |x: f32| {
        // NaN becomes 0.
        let x = ((x + 0.5) * 1024.0).clamp(0.0, 1023.0) as u32;
        (0..10).fold(0, |bits, k| bits | (x >> k & 1) << (3 * k))
    };
    spread(p.x) | spread(p.y) << 1 | spread(p.z) << 2
}

struct Cutter<'a> {
    frame: &'a Frame,
    view: &'a View,
    settings: &'a Settings,
    /// Height of a pixel at depth 1.
    pixel: f32,
}

/// What a strand has at one of its vertices.
#[derive(Clone, Copy)]
struct Vertex {
    width: f32,
    color: Vec3,
    opacity: f32,
}

impl Cutter<'_> {
    /// Appends strand `index` of `strands` to `out`, or counts it as skipped.
    fn cut(&self, strands: &StrandBuffer, index: usize, out: &mut Cuts) {
        let range = strands.vertices(index);
        let points = &strands.points[range.clone()];
        let finite = |p: &[f32; 3]| p.iter().all(|x| x.is_finite());
        let widths = strands.widths.get(range.clone()).unwrap_or(&[]);
        if points.len() < 2 || !points.iter().all(finite) || !widths.iter().all(|w| w.is_finite()) {
            out.skipped += 1;
            return;
        }
        let placed: Vec<Vec3> = points.iter().map(|&p| self.frame.place(p)).collect();
        let mut vertex = self.vertex(strands, range.start);
        self.push(placed[0], vertex, out);
        for i in 0..placed.len() - 1 {
            let next = self.vertex(strands, range.start + i + 1);
            let window = catmull_rom::window(&placed, i);
            let width = vertex.width.max(next.width);
            let leaves = self.leaf_count(catmull_rom::to_bezier(window), width);
            for k in 1..=leaves {
                let t = k as f32 / leaves as f32;
                let between = Vertex {
                    width: vertex.width + (next.width - vertex.width) * t,
                    color: vertex.color.lerp(next.color, t),
                    opacity: vertex.opacity + (next.opacity - vertex.opacity) * t,
                };
                self.push(catmull_rom::position(window, t), between, out);
            }
            vertex = next;
        }
        out.starts.push(out.places.len() as u32);
    }

    fn vertex(&self, strands: &StrandBuffer, i: usize) -> Vertex {
        let width = strands.widths.get(i);
        let color = strands.colors.get(i).copied();
        let color = color.unwrap_or(self.settings.hair_color);
        let within = |x: f32| if x > 0.0 { x.min(1.0) } else { 0.0 };
        Vertex {
            width: width.map_or(1.0 / 2000.0, |&w| self.frame.length(w.max(0.0))),
            color: Vec3::from(color.map(within)),
            opacity: within(strands.opacities.get(i).copied().unwrap_or(1.0)),
        }
    }

    /// How many leaves stand for the cubic of `bezier` of a hair of `width`.
    fn leaf_count(&self, bezier: [Vec3; 4], width: f32) -> u32 {
        let [a, b, c, d] = bezier;
        let legs = [b - a, c - b, d - c].map(|leg| leg.try_normalize());
        let turn = |p: Option<Vec3>, q: Option<Vec3>| match (p, q) {
            (Some(p), Some(q)) => p.distance(q),
            _ => 0.0,
        };
        let turns = turn(legs[0], legs[1]) + turn(legs[1], legs[2]);
        let bend = (a - b * 2.0 + c).length().max((b - c * 2.0 + d).length());
        let pixel = self.pixel * self.view.depth(b).max(1e-3);
        // A cubic strays from the chord of an n-th of it by at most 6 bend / 8 n².
        let by_shape = (0.75 * bend / (STRAY * pixel)).sqrt();
        // No leaf needs to be shorter than a pixel.
        let pixels = (d - a).length().max(bend) / pixel;
        let by_turn = turns * (1.0 / TURN).max(0.5 * width / (pixel * NOTCH));
        let count = by_turn.max(by_shape).min(pixels).ceil();
        count.clamp(1.0, MOST_LEAVES) as u32
    }

    fn push(&self, p: Vec3, vertex: Vertex, out: &mut Cuts) {
        let half = vertex.width * 0.5;
        let thinnest = 0.5 * self.settings.thinnest * self.pixel * self.view.depth(p).max(0.0);
        let (drawn, opacity) = if half < thinnest {
            (thinnest, vertex.opacity * half / thinnest)
        } else {
            (half, vertex.opacity)
        };
        let c = vertex.color;
        out.places.push([p.x, p.y, p.z, drawn]);
        out.looks.push([c.x, c.y, c.z, opacity]);
    }
}
