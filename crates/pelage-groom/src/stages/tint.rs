//! Colours that differ from hair to hair: mutant hair, and shifts of hue, saturation and
//! value.
//!
//! Source: document 004, section 2.2.6. A hair is a mutant where ξ < percent / 100, and
//! then has one colour from root to tip. Every colour is moved in HSV by
//! -amount · 2 (ξ - ½), from root to tip by the same; the hue goes round, saturation and
//! value end at 0 and 1. Colours linear RGB in 0..=1, hue in degrees. HSV is used for
//! the shifts whatever space mixes root and tip.
//!
//! Limits: grey has no hue of its own, so that a shift of its saturation makes it red
//! (hue 0), as in the document.

use crate::color::{hsv_from_rgb, rgb_from_hsv};
use crate::columns::Columns;
use crate::maps::{ColorField, ScalarField};
use crate::random::{Channel, uniform};
use crate::stages::roots::Root;
use fearless_simd::{Level, dispatch};
use pelage_curves::Vec2;

/// What makes hairs differ in colour, over the surface.
#[derive(Clone, Debug)]
pub struct Tint {
    /// Mutant hairs, in per cent.
    pub mutant_percent: ScalarField,
    /// Their colour.
    pub mutant_color: ColorField,
    /// Largest shift of the hue, in degrees.
    pub hue: ScalarField,
    /// Largest shift of the saturation.
    pub saturation: ScalarField,
    /// Largest shift of the value.
    pub value: ScalarField,
}

impl Tint {
    /// Changes the colours of the hairs at `roots`, whose texture coordinates are `uvs`:
    /// those at the root, and so on to the tip. Amounts of 0 leave them as they are, bit
    /// for bit.
    pub(crate) fn apply(
        &self,
        roots: &[Root],
        uvs: &[Vec2],
        seed: u64,
        columns: &mut Columns,
        colors: &mut [Vec<[f32; 3]>],
    ) {
        dispatch!(Level::new(), simd => {
            let _ = simd;
            self.apply_to_rows(roots, uvs, seed, columns, colors)
        });
    }

    #[inline(always)]
    fn apply_to_rows(
        &self,
        roots: &[Root],
        uvs: &[Vec2],
        seed: u64,
        columns: &mut Columns,
        colors: &mut [Vec<[f32; 3]>],
    ) {
        let fields = [
            &self.mutant_percent,
            &self.hue,
            &self.saturation,
            &self.value,
        ];
        let mut amounts = columns.read(fields, uvs);
        for (number, roots) in roots.chunks(ROW).enumerate() {
            let mut row = Row::default();
            for (k, (root, amounts)) in roots.iter().zip(&mut amounts).enumerate() {
                row.hairs[k] = root.hair;
                for (all, amount) in row.amounts.iter_mut().zip(amounts) {
                    all[k] = amount;
                }
            }
            let (mutants, shifts) = row.draw(seed);
            let first = number * ROW;
            for (k, root) in roots.iter().enumerate().filter(|(k, _)| mutants[*k]) {
                let color = self.mutant_color.at(root.uv);
                colors.iter_mut().for_each(|at| at[first + k] = color);
            }
            for at in &mut *colors {
                shift_row(&mut at[first..first + roots.len()], &shifts);
            }
        }
    }
}

/// Hairs whose colours are changed together.
const ROW: usize = 16;

/// What changes the colours of a row of hairs.
#[derive(Default)]
struct Row {
    hairs: [u64; ROW],
    /// Per cent of mutants, and largest shifts.
    amounts: [[f32; ROW]; 4],
}

impl Row {
    /// Which hairs are mutants, and the shifts of hue, saturation and value.
    #[inline(always)]
    fn draw(&self, seed: u64) -> ([bool; ROW], [[f32; ROW]; 3]) {
        let [percent, hue, saturation, value] = &self.amounts;
        let mut mutants = [false; ROW];
        for k in 0..ROW {
            let share = percent[k] / 100.0;
            mutants[k] = uniform(seed, self.hairs[k], Channel::Mutant) < share;
        }
        let shifts = |amounts: &[f32; ROW], most: f32, channel| {
            let mut shifts = [0.0; ROW];
            for k in 0..ROW {
                let random = uniform(seed, self.hairs[k], channel);
                shifts[k] = amounts[k].clamp(0.0, most) * 2.0 * (random - 0.5);
            }
            shifts
        };
        let shifts = [
            shifts(hue, 180.0, Channel::Hue),
            shifts(saturation, 1.0, Channel::Saturation),
            shifts(value, 1.0, Channel::Value),
        ];
        (mutants, shifts)
    }
}

/// Shifts the colours of a row; those without shifts stay as they are.
#[inline(always)]
fn shift_row(colors: &mut [[f32; 3]], [hue, saturation, value]: &[[f32; ROW]; 3]) {
    let [mut r, mut g, mut b] = [[0.0; ROW]; 3];
    for (k, color) in colors.iter().enumerate() {
        [r[k], g[k], b[k]] = *color;
    }
    for k in 0..ROW {
        let (color, shifts) = ([r[k], g[k], b[k]], [hue[k], saturation[k], value[k]]);
        let moved = shifted(color, shifts);
        let still = shifts == [0.0; 3];
        [r[k], g[k], b[k]] = if still { color } else { moved };
    }
    for (k, color) in colors.iter_mut().enumerate() {
        *color = [r[k], g[k], b[k]];
    }
}

/// `color` with `shifts` (hue in degrees, saturation, value) taken off in HSV.
#[inline(always)]
fn shifted(color: [f32; 3], shifts: [f32; 3]) -> [f32; 3] {
    let [hue, saturation, value] = hsv_from_rgb(color);
    rgb_from_hsv([
        hue - shifts[0],
        (saturation - shifts[1]).clamp(0.0, 1.0),
        (value - shifts[2]).clamp(0.0, 1.0),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_shift_stays_in_range_and_moves_what_it_says(
            hue in 0.0f32..360.0, saturation in 0.3f32..0.7, value in 0.3f32..0.7,
            turn in -180.0f32..180.0, s in -0.25f32..0.25, v in -0.25f32..0.25,
        ) {
            let color = rgb_from_hsv([hue, saturation, value]);
            let [h, t, w] = hsv_from_rgb(shifted(color, [turn, s, v]));
            let expected = hue - turn;
            let apart = (h - expected + 540.0).rem_euclid(360.0) - 180.0;
            prop_assert!(apart.abs() < 0.01, "{h} for {expected}");
            prop_assert!((t - (saturation - s)).abs() < 1e-5);
            prop_assert!((w - (value - v)).abs() < 1e-5);
        }

        #[test]
        fn no_shift_leaves_the_range_of_colours(
            color in prop::array::uniform3(0.0f32..=1.0),
            turn in -180.0f32..180.0, s in -1.0f32..1.0, v in -1.0f32..1.0,
        ) {
            let moved = shifted(color, [turn, s, v]);
            prop_assert!(moved.iter().all(|c| (0.0..=1.0).contains(c)), "{moved:?}");
        }
    }
}
