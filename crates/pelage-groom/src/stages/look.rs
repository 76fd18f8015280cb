//! Colour, opacity and width along a hair.
//!
//! Source: document 004, sections 2.2.6 and 2.2.9: values at root and tip, mixed
//! linearly in t = i / segments; colours in HSV with the hue on its shorter arc, or in
//! Oklab or RGB. Colours linear RGB in 0..=1, widths full diameters in the unit of the
//! mesh.

use crate::color::ColorMix;

/// Vertices of a hair that are coloured together.
const ROW: usize = 8;

/// A hair's values at root and tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Colour, root to tip.
    pub color: ColorMix,
    /// Opacity at root and tip.
    pub opacity: [f32; 2],
    /// Width at root and tip.
    pub width: [f32; 2],
}

/// Writes the values at the vertices `numbers` of a hair of `segments` cut at `cut` in
/// 0..=1, the last of which is where it is cut; the three slices have the length of
/// `numbers`.
#[inline(always)]
pub fn along(
    look: &Look,
    numbers: &[u32],
    segments: u32,
    cut: f32,
    colors: &mut [[f32; 3]],
    opacities: &mut [f32],
    widths: &mut [f32],
) {
    let step = 1.0 / segments.max(1) as f32;
    let cut_vertex = if cut < 1.0 {
        numbers.len().saturating_sub(1)
    } else {
        usize::MAX
    };
    let mix = |[root, tip]: [f32; 2], t: f32| root * (1.0 - t) + tip * t;
    for (row, numbers) in numbers.chunks(ROW).enumerate() {
        let first = row * ROW;
        let mut ts = [0.0; ROW];
        for (k, &number) in numbers.iter().enumerate() {
            ts[k] = if first + k == cut_vertex {
                cut
            } else {
                number as f32 * step
            };
        }
        let [reds, greens, blues] = look.color.at(&ts);
        let opacity = ts.map(|t| mix(look.opacity, t));
        let width = ts.map(|t| mix(look.width, t));
        for k in 0..numbers.len() {
            colors[first + k] = [reds[k], greens[k], blues[k]];
            opacities[first + k] = opacity[k];
            widths[first + k] = width[k];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::ColorSpace;

    #[test]
    fn root_and_tip_are_what_was_asked() {
        let (root, tip) = ([0.2, 0.1, 0.05], [0.9, 0.7, 0.4]);
        for space in [ColorSpace::Hsv, ColorSpace::Oklab, ColorSpace::Rgb] {
            let look = Look {
                color: ColorMix::new(space, root, tip),
                opacity: [1.0, 0.25],
                width: [0.02, 0.0],
            };
            let (mut colors, mut opacities, mut widths) =
                (vec![[0.0; 3]; 6], vec![0.0; 6], vec![0.0; 6]);
            along(
                &look,
                &[0, 1, 2, 3, 4, 5],
                5,
                1.0,
                &mut colors,
                &mut opacities,
                &mut widths,
            );
            for k in 0..3 {
                assert!((colors[0][k] - root[k]).abs() < 1e-5, "{space:?}");
                assert!((colors[5][k] - tip[k]).abs() < 1e-5, "{space:?}");
            }
            assert_eq!((opacities[0], opacities[5]), (1.0, 0.25));
            assert_eq!((widths[0], widths[5]), (0.02, 0.0));
        }
    }
}
