//! Colours along hairs, over the surface.

use crate::PlanError;
use crate::color::{ColorMix, ColorSpace};
use crate::lanes::HALF;
use crate::maps::{ColorField, FieldMaker};
use crate::recipe::{ColorProperty, Coloring};
use fearless_simd::{Level, Select, Simd, SimdBase, SimdMask, dispatch, f32x8};

/// Colours at some places of every hair: root and tip, or the points of a ramp.
#[derive(Clone, Debug)]
pub(crate) struct ColorProfile {
    /// One a place.
    pub fields: Vec<ColorField>,
    /// Where they stand on a hair, root 0, tip 1; ascending, at least two.
    pub places: Vec<f32>,
}

impl ColorProfile {
    pub(crate) fn new(coloring: &Coloring, maker: &mut FieldMaker) -> Result<Self, PlanError> {
        let Some(ramp) = &coloring.root.ramp else {
            return Ok(Self {
                fields: vec![
                    maker.color("color.root", &coloring.root)?,
                    maker.color("color.tip", &coloring.tip)?,
                ],
                places: vec![0.0, 1.0],
            });
        };
        let mut points = ramp.points.clone();
        if let [(_, color)] = points[..] {
            points = vec![(0.0, color), (1.0, color)];
        }
        let field = |(_, value): &(f32, [f32; 3])| {
            let property = ColorProperty {
                value: *value,
                ..coloring.root.clone()
            };
            maker.color("color.root", &property)
        };
        Ok(Self {
            fields: points.iter().map(field).collect::<Result<_, _>>()?,
            places: points.iter().map(|(place, _)| *place).collect(),
        })
    }

    /// Mixes that a hair has: one between each place and the next.
    pub(crate) fn pieces(&self) -> usize {
        self.places.len() - 1
    }

    /// Writes the mixes of hairs with these `colors` at each of the places to `mixes`, hair by
    /// hair.
    pub(crate) fn mix(
        &self,
        space: ColorSpace,
        colors: &[Vec<[f32; 3]>],
        mixes: &mut Vec<ColorMix>,
    ) {
        let (pieces, hairs) = (self.pieces(), colors.first().map_or(0, Vec::len));
        mixes.clear();
        mixes.resize(hairs * pieces, ColorMix::default());
        dispatch!(Level::new(), simd => {
            for (piece, pair) in colors.windows(2).enumerate() {
                let halves = pair[0].chunks(HALF).zip(pair[1].chunks(HALF));
                for ((roots, tips), mixes) in halves.zip(mixes.chunks_mut(HALF * pieces)) {
                    let own = mixes.iter_mut().skip(piece).step_by(pieces);
                    if space == ColorSpace::Hsv {
                        ColorMix::write_hsv(simd, roots, tips, own);
                        continue;
                    }
                    for ((root, tip), mix) in roots.iter().zip(tips).zip(own) {
                        *mix = ColorMix::new(space, *root, *tip);
                    }
                }
            }
        });
    }

    /// The colours at each of `ts` of a hair with these mixes: all reds, greens, blues.
    #[inline(always)]
    pub(crate) fn at<S: Simd>(&self, mixes: &[ColorMix], ts: f32x8<S>) -> [f32x8<S>; 3] {
        if let ([mix], [0.0, 1.0]) = (mixes, &self.places[..]) {
            return mix.at(ts);
        }
        // Each piece has the colours behind its place, until one that begins behind.
        let mut colors = self.piece(0, mixes, ts);
        for i in 1..self.pieces() {
            let behind = ts.simd_ge(self.places[i]);
            if !behind.any_true() {
                break;
            }
            let own = self.piece(i, mixes, ts);
            for k in 0..3 {
                colors[k] = behind.select(own[k], colors[k]);
            }
        }
        colors
    }

    /// The colours of piece `i`, and at its ends outside of it.
    #[inline(always)]
    fn piece<S: Simd>(&self, i: usize, mixes: &[ColorMix], ts: f32x8<S>) -> [f32x8<S>; 3] {
        let (from, to) = (self.places[i], self.places[i + 1]);
        mixes[i].at(((ts - from) / (to - from)).max(0.0).min(1.0))
    }
}
