//! Colour, opacity and width along a hair.
//!
//! Source: document 004, sections 2.2.6 and 2.2.9: values at root and tip, mixed linearly in
//! t = i / segments, or those of a ramp; colours in HSV with the hue on its shorter arc, or in
//! Oklab or RGB. Colours linear RGB in 0..=1, widths full diameters in the unit of the mesh.

use crate::color::{ColorMix, ColorSpace};
use crate::color_profile::ColorProfile;
use crate::lanes::turned;
use crate::profile::{Profile, line};
use fearless_simd::{Simd, SimdBase, SimdInt, f32x8, u32x8};

/// Vertices of a hair that are coloured together.
pub(crate) const ROW: usize = 8;

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

/// Where some vertices of a hair are on it.
#[derive(Clone, Copy)]
pub(crate) struct Vertices<'a> {
    /// Numbers of the vertices in the whole hair; behind the last stand others, or none.
    pub numbers: &'a [u32],
    /// How many there are.
    pub count: usize,
    /// Segments of the whole hair.
    pub segments: u32,
    /// Where the hair is cut, 0..=1; there stands the last vertex.
    pub cut: f32,
}

impl Vertices<'_> {
    /// Where the vertices from `first` on are on the hair, 0 at its root, 1 at its tip.
    #[inline(always)]
    fn places<S: Simd>(&self, simd: S, first: usize) -> f32x8<S> {
        let step = 1.0 / self.segments.max(1) as f32;
        let rest = &self.numbers[first..];
        // Read at once: numbers that are put together one by one would be waited for.
        let numbers = rest.first_chunk().copied().unwrap_or_else(|| {
            let mut row = [0; ROW];
            row[..rest.len()].copy_from_slice(rest);
            row
        });
        let numbers: f32x8<S> = u32x8::load_array(simd, numbers).to_float();
        let mut ts = numbers * step;
        if self.cut < 1.0 {
            let last = self.count.wrapping_sub(1 + first);
            let at = ts.as_mut_slice().get_mut(last);
            if let Some(t) = at {
                *t = self.cut;
            }
        }
        ts
    }
}

/// What looks are written to: an entry a vertex, and [`ROW`] more behind the last.
pub(crate) struct Written<'a> {
    pub colors: &'a mut [[f32; 3]],
    pub opacities: &'a mut [f32],
    pub widths: &'a mut [f32],
}

/// Writes the values at `vertices` of a hair of the look `look` and the colours `mixes`, from
/// the entry `start` of `written` on. Rows are written whole: up to [`ROW`] entries behind
/// the last vertex are written too, which is left to the next hair.
#[inline(always)]
pub(crate) fn along<S: Simd>(
    simd: S,
    fields: &LookFields,
    look: &Look,
    mixes: &[ColorMix],
    vertices: Vertices,
    start: usize,
    written: &mut Written,
) {
    let ([o, p], [w, x]) = (look.opacity, look.width);
    let opacity = [f32x8::splat(simd, o), f32x8::splat(simd, p)];
    let width = [f32x8::splat(simd, w), f32x8::splat(simd, x)];
    for first in (0..vertices.count).step_by(ROW) {
        let ts = vertices.places(simd, first);
        let colors = fields.color.at(mixes, ts);
        write_colors(colors, &mut written.colors[start + first..]);
        let row = start + first..start + first + ROW;
        let opacities = fields.opacity.row(opacity, ts, line);
        opacities.store_slice(&mut written.opacities[row.clone()]);
        let widths = fields.width.row(width, ts, line);
        widths.store_slice(&mut written.widths[row]);
    }
}

/// Writes all reds, greens and blues colour by colour to the first of `colors`, of which there
/// is at least one more.
#[inline(always)]
fn write_colors<S: Simd>([r, g, b]: [f32x8<S>; 3], colors: &mut [[f32; 3]]) {
    // Four numbers a colour, the last of which the next one overwrites.
    let numbers = &mut colors.as_flattened_mut()[..3 * ROW + 1];
    for (k, color) in turned([r, g, b, b]).iter().enumerate() {
        color.store_slice(&mut numbers[3 * k..3 * k + 4]);
    }
}
