//! Colours that differ from hair to hair: mutant hair, and shifts of hue, saturation and
//! value.
//!
//! Source: document 004, section 2.2.6. A hair is a mutant where ξ < percent / 100, and
//! then has one colour from root to tip. Every colour is moved in HSV by
//! -amount · 2 (ξ - ½), root and tip by the same; the hue goes round, saturation and
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
    /// Changes the colours at root and tip of the hairs at `roots`, whose texture
    /// coordinates are `uvs`. Amounts of 0 leave them as they are, bit for bit.
    pub(crate) fn apply(
        &self,
        roots: &[Root],
        uvs: &[Vec2],
        seed: u64,
        columns: &mut Columns,
        [from, to]: [&mut [[f32; 3]]; 2],
    ) {
        let fields = [
            &self.mutant_percent,
            &self.hue,
            &self.saturation,
            &self.value,
        ];
        let amounts = columns.read(fields, uvs);
        let colors = from.iter_mut().zip(to);
        for ((root, amounts), (from, to)) in roots.iter().zip(amounts).zip(colors) {
            let random = |channel| uniform(seed, root.hair, channel);
            let share = amounts[0] / 100.0;
            if share > 0.0 && random(Channel::Mutant) < share {
                *from = self.mutant_color.at(root.uv);
                *to = *from;
            }
            let shift = |amount: f32, most: f32, channel| {
                let amount = amount.clamp(0.0, most);
                if amount > 0.0 {
                    amount * 2.0 * (random(channel) - 0.5)
                } else {
                    0.0
                }
            };
            let shifts = [
                shift(amounts[1], 180.0, Channel::Hue),
                shift(amounts[2], 1.0, Channel::Saturation),
                shift(amounts[3], 1.0, Channel::Value),
            ];
            if shifts != [0.0; 3] {
                *from = shifted(*from, shifts);
                *to = shifted(*to, shifts);
            }
        }
    }
}

/// `color` with `shifts` (hue in degrees, saturation, value) taken off in HSV.
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
