//! Colour, opacity and width along a hair.
//!
//! Source: document 004, sections 2.2.6 and 2.2.9: values at root and tip, mixed linearly in
//! t = i / segments, or those of a ramp; colours in HSV with the hue on its shorter arc, or in
//! Oklab or RGB. Colours linear RGB in 0..=1, widths full diameters in the unit of the mesh.

use crate::color::{ColorMix, ColorSpace};
use crate::color_profile::ColorProfile;
use crate::profile::{Profile, line};

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
    fn places(&self, first: usize) -> [f32; ROW] {
        let step = 1.0 / self.segments.max(1) as f32;
        let rest = &self.numbers[first..];
        // Read at once: numbers that are put together one by one would be waited for.
        let numbers = rest.first_chunk().copied().unwrap_or_else(|| {
            let mut row = [0; ROW];
            row[..rest.len()].copy_from_slice(rest);
            row
        });
        let mut ts = numbers.map(|number: u32| number as f32 * step);
        if self.cut < 1.0 {
            let last = self.count.wrapping_sub(1 + first);
            ts.get_mut(last).into_iter().for_each(|t| *t = self.cut);
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

impl Written<'_> {
    /// Rows of colours, opacities and widths from the entry `start` on.
    #[inline(always)]
    fn rows(&mut self, start: usize) -> impl Iterator<Item = WrittenRow<'_>> {
        let colors = self.colors[start..].as_chunks_mut().0.iter_mut();
        let opacities = self.opacities[start..].as_chunks_mut().0.iter_mut();
        let widths = self.widths[start..].as_chunks_mut().0.iter_mut();
        colors.zip(opacities).zip(widths).map(|((c, o), w)| (c, o, w))
    }
}

type WrittenRow<'a> = (&'a mut [[f32; 3]; ROW], &'a mut [f32; ROW], &'a mut [f32; ROW]);

/// Writes the values at `vertices` of a hair of the look `look` and the colours `mixes`, from
/// the entry `start` of `written` on. Rows are written whole: less than one row of entries
/// behind the last vertex is written too, which is left to the next hair.
#[inline(always)]
pub(crate) fn along(
    fields: &LookFields,
    look: &Look,
    mixes: &[ColorMix],
    vertices: Vertices,
    start: usize,
    written: &mut Written,
) {
    let rows = written.rows(start).zip((0..vertices.count).step_by(ROW));
    for ((colors, opacities, widths), first) in rows {
        let ts = vertices.places(first);
        fields.color.at(mixes, &ts, colors);
        *opacities = fields.opacity.row(|_| look.opacity, &ts, line);
        *widths = fields.width.row(|_| look.width, &ts, line);
    }
}
