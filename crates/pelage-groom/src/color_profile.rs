//! Colours along hairs, over the surface.

use crate::PlanError;
use crate::color::{ColorMix, ColorSpace};
use crate::maps::{ColorField, FieldMaker};
use crate::recipe::{ColorProperty, Coloring};

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

    /// Appends the mixes of a hair with these colours at the places.
    #[inline(always)]
    pub(crate) fn mix(
        &self,
        space: ColorSpace,
        colors: impl Fn(usize) -> [f32; 3],
        mixes: &mut Vec<ColorMix>,
    ) {
        let pieces = 0..self.pieces();
        mixes.extend(pieces.map(|i| ColorMix::new(space, colors(i), colors(i + 1))));
    }

    /// Writes the colours at each of `ts` of a hair with these mixes.
    #[inline(always)]
    pub(crate) fn at<const N: usize>(
        &self,
        mixes: &[ColorMix],
        ts: &[f32; N],
        colors: &mut [[f32; 3]; N],
    ) {
        if let ([mix], [0.0, 1.0]) = (mixes, &self.places[..]) {
            return mix.at(ts, colors);
        }
        for (color, &t) in colors.iter_mut().zip(ts) {
            let inner = &self.places[1..self.pieces()];
            let piece = inner.partition_point(|place| *place <= t);
            let (from, to) = (self.places[piece], self.places[piece + 1]);
            let inside = ((t - from) / (to - from)).clamp(0.0, 1.0);
            mixes[piece].at(&[inside], std::array::from_mut(color));
        }
    }
}
