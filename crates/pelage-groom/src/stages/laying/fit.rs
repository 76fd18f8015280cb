//! How a hair that is put together lies at its root: fitted to the mean of its guides.
//!
//! Its own line from root to tip comes to lie on that of the mean, and about that line it
//! is rolled such that the tangents agree best, which has a closed form: with a and b for
//! what lies across the lines, the angle of (∫ a·b, ∫ a×b).

use crate::lanes::{LANES, Row, Rows};
use pelage_curves::{Vec3, any_perpendicular};

/// Below this part of full agreement about the roll a hair goes over to the mean: less
/// keeps more of the curls, more lets neighbours there differ less.
const AGREEMENT: f32 = 0.2;

/// Mean square of the sine between a hair and its line below which it counts as straight:
/// some two degrees.
const SLENDER: f32 = 1e-3;

/// Distance from root to tip, as a part of the length, below which it is no line to lie on.
const SHORT: f32 = 0.1;

/// A line with two directions across it; right-handed, orthonormal.
#[derive(Clone, Copy)]
pub(super) struct Axes(pub(super) [Vec3; 3]);

impl Axes {
    fn along(line: Vec3) -> Self {
        let line = line.try_normalize().unwrap_or(Vec3::Z);
        let aside = any_perpendicular(line);
        Self([line, aside, line.cross(aside)])
    }
}

/// Where a hair lies before it is rolled: its own line from root to tip, and that of the
/// mean.
pub(super) struct Lines {
    pub(super) from: Axes,
    pub(super) onto: Axes,
    /// How much they are lines (0..=1).
    share: f32,
}

impl Lines {
    pub(super) fn new(chord: Vec3, whole: Vec3, length: f32) -> Self {
        let short = SHORT * length;
        Self {
            from: Axes::along(chord),
            onto: Axes::along(whole),
            share: smooth(chord.length(), short) * smooth(whole.length(), short),
        }
    }
}

/// Over each hair, of what lies across the lines: ∫ a·b, ∫ a×b, ∫ a·a, and ∫ 1.
#[derive(Default)]
pub(super) struct Sums {
    dot: Row,
    cross: Row,
    size: Row,
    said: Row,
}

impl Sums {
    #[inline(always)]
    pub(super) fn add(
        &mut self,
        lane: usize,
        [x, y]: [f32; 2],
        [u, v]: [f32; 2],
        say: f32,
        length: f32,
    ) {
        // Without length everything else is 0. No branch, so that lanes are vectors.
        let over = say / length.max(f32::MIN_POSITIVE);
        self.dot[lane] += (x * u + y * v) * over;
        self.cross[lane] += (x * v - y * u) * over;
        self.size[lane] += (x * x + y * y) * over;
        self.said[lane] += say * length;
    }
}

/// How a hair lies: axes of its own, those they come to lie on, and how much of it is taken
/// instead of the mean (0..=1).
pub(super) struct Fit {
    pub(super) from: Axes,
    pub(super) onto: Axes,
    pub(super) share: f32,
}

impl Fit {
    pub(super) fn new(lines: &Lines, sums: &Sums, lane: usize) -> Self {
        // f64: their squares overflow where guides are beyond 10^9.
        let (dot, cross) = (sums.dot[lane] as f64, sums.cross[lane] as f64);
        let agreement = (dot * dot + cross * cross).sqrt();
        let mut onto = lines.onto;
        if agreement > 0.0 {
            let (cosine, sine) = ((dot / agreement) as f32, (cross / agreement) as f32);
            let [_, u, v] = onto.0;
            onto.0[1] = u * cosine + v * sine;
            onto.0[2] = v * cosine - u * sine;
        }
        let full = AGREEMENT * sums.size[lane] + SLENDER * sums.said[lane];
        Self {
            from: lines.from,
            onto,
            share: lines.share * smooth(agreement as f32, full),
        }
    }
}

/// 0 at 0, 1 from `full` on, and smooth between; 0 where both are 0.
fn smooth(x: f32, full: f32) -> f32 {
    if x >= full && x > 0.0 {
        return 1.0;
    }
    let t = if x > 0.0 { x / full } else { 0.0 };
    t * t * (3.0 - 2.0 * t)
}

/// The two directions across a line.
#[inline(always)]
pub(super) fn across(lines: &[Lines; LANES], axes: impl Fn(&Lines) -> Axes) -> [Rows; 2] {
    [1, 2].map(|k| Rows::of(lines, |line| axes(line).0[k]))
}
