//! Surfaces coloured by their density, and by their pieces.

use pelage::RootPlan;
use pelage::render::Paint;
use pelage::surface::{RootPdf, SurfacePoint, hash, linear_from_srgb};

/// sRGB codes from no density to the most, evenly apart and ever darker.
const SCALE: [[u8; 3]; 6] = [
    [250, 244, 228],
    [222, 230, 170],
    [150, 208, 156],
    [78, 170, 170],
    [42, 120, 172],
    [34, 70, 140],
];

/// Where no hair grows, in linear RGB.
pub const BARE: [f32; 3] = [0.78, 0.76, 0.72];

/// `roots.density`, as the recipe gives it.
#[derive(Debug)]
pub struct DensityPaint<'a> {
    plan: &'a RootPlan,
    most: f32,
}

impl<'a> DensityPaint<'a> {
    /// The density of `plan`; its largest value is darkest.
    pub fn new(plan: &'a RootPlan) -> Self {
        let centres = plan.sampler().into_iter().flat_map(|s| s.piece_centres());
        let most = centres.map(|c| plan.density(&c)).fold(0.0, f32::max);
        Self {
            plan,
            most: most.max(f32::MIN_POSITIVE),
        }
    }
}

impl Paint for DensityPaint<'_> {
    fn color(&self, place: &SurfacePoint) -> [f32; 3] {
        let share = (self.plan.density(place) / self.most).clamp(0.0, 1.0);
        let at = share * (SCALE.len() - 1) as f32;
        let step = (at as usize).min(SCALE.len() - 2);
        let t = at - step as f32;
        std::array::from_fn(|k| {
            let [a, b] = [SCALE[step][k], SCALE[step + 1][k]].map(f32::from);
            linear_from_srgb((a + (b - a) * t) / 255.0)
        })
    }
}

/// The pieces of constant density, each in a colour of its own.
#[derive(Debug)]
pub struct PiecePaint<'a> {
    pieces: Option<RootPdf<'a>>,
}

/// How much of a piece its outline takes, as a weight of its corners.
const OUTLINE: f32 = 0.03;

impl<'a> PiecePaint<'a> {
    /// The pieces that `plan` draws from.
    pub fn new(plan: &'a RootPlan) -> Self {
        let pieces = plan.sampler().map(|s| RootPdf::new(s, plan.rest()));
        Self { pieces }
    }
}

impl Paint for PiecePaint<'_> {
    fn color(&self, place: &SurfacePoint) -> [f32; 3] {
        let found = self.pieces.as_ref().and_then(|p| p.piece_at(place));
        let Some((piece, weights)) = found else {
            return BARE;
        };
        let color = piece_color(piece as u64);
        let edge = weights.into_iter().fold(f32::INFINITY, f32::min);
        match edge < OUTLINE {
            true => color.map(|c| 0.4 * c),
            false => color,
        }
    }
}

/// A light, clear colour by the hash of `piece`: any hue, some lightness.
fn piece_color(piece: u64) -> [f32; 3] {
    let word = hash(piece + 1);
    let part = |shift: u32| (word >> shift & 0xffff) as f32 / 65536.0;
    let (hue, light) = (part(0), 0.7 + 0.27 * part(16));
    [0.0, 1.0 / 3.0, 2.0 / 3.0].map(|turn| {
        // One channel of a hue, a trapezoid over the circle.
        let wave = (((hue + turn).fract() * 6.0 - 3.0).abs() - 1.0).clamp(0.0, 1.0);
        linear_from_srgb(light * (0.5 + 0.5 * wave))
    })
}
