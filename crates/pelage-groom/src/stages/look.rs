//! Colour, opacity and width along a hair.
//!
//! Source: document 004, sections 2.2.6 and 2.2.9: values at root and tip, mixed linearly in
//! t = i / segments, or those of a ramp; colours in HSV with the hue on its shorter arc, or in
//! Oklab or RGB. Colours linear RGB in 0..=1, widths full diameters in the unit of the mesh.

use crate::color::{ColorMix, ColorSpace};
use crate::color_profile::ColorProfile;
use crate::profile::{Profile, line};

/// Vertices of a hair that are coloured together.
const ROW: usize = 8;

/// A hair's values at root and tip; with a ramp, the first multiplies it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Opacity.
    pub opacity: [f32; 2],
    /// Width.
    pub width: [f32; 2],
}

/// How looks go along all hairs.
#[derive(Clone, Debug)]
pub(crate) struct LookFields {
    pub color: ColorProfile,
    pub color_space: ColorSpace,
    pub opacity: Profile<2>,
    pub width: Profile<2>,
}

/// Vertices of a hair by their numbers.
#[derive(Clone, Copy)]
pub(crate) struct Vertices<'a> {
    pub numbers: &'a [u32],
    /// Segments of the whole hair.
    pub segments: u32,
    /// Where the hair is cut, 0..=1; there stands the last vertex.
    pub cut: f32,
}

impl Vertices<'_> {
    /// Where those of row `row` are on the hair.
    #[inline(always)]
    fn places(&self, row: usize, numbers: &[u32]) -> [f32; ROW] {
        let step = 1.0 / self.segments.max(1) as f32;
        let mut ts = [0.0; ROW];
        for (t, &number) in ts.iter_mut().zip(numbers) {
            *t = number as f32 * step;
        }
        let last = self.numbers.len().wrapping_sub(1 + row * ROW);
        if let Some(t) = ts.get_mut(last).filter(|_| self.cut < 1.0) {
            *t = self.cut;
        }
        ts
    }
}

/// Writes the values at `vertices` of a hair of the look `look` and the colours `mixes`;
/// the three slices are as long as there are vertices.
#[inline(always)]
pub(crate) fn along(
    fields: &LookFields,
    look: &Look,
    mixes: &[ColorMix],
    vertices: Vertices,
    colors: &mut [[f32; 3]],
    opacities: &mut [f32],
    widths: &mut [f32],
) {
    for (row, numbers) in vertices.numbers.chunks(ROW).enumerate() {
        let first = row * ROW;
        let ts = vertices.places(row, numbers);
        let [reds, greens, blues] = fields.color.at(mixes, &ts);
        let opacity = fields.opacity.row(|_| look.opacity, &ts, line);
        let width = fields.width.row(|_| look.width, &ts, line);
        for k in 0..numbers.len() {
            colors[first + k] = [reds[k], greens[k], blues[k]];
            opacities[first + k] = opacity[k];
            widths[first + k] = width[k];
        }
    }
}
