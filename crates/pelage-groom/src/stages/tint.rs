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
use crate::maps::{ColorField, ScalarField};
use crate::random::{Channel, uniform};
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
    /// Colours at root and tip of hair `hair` with its root at `uv`, from those of all
    /// hairs there. Amounts of 0 give them back bit for bit.
    #[inline]
    pub fn apply(&self, common: [[f32; 3]; 2], uv: Vec2, seed: u64, hair: u64) -> [[f32; 3]; 2] {
        let random = |channel| uniform(seed, hair, channel);
        let share = self.mutant_percent.at(uv) / 100.0;
        let mutant = share > 0.0 && random(Channel::Mutant) < share;
        let colors = if mutant {
            [self.mutant_color.at(uv); 2]
        } else {
            common
        };
        let shift = |field: &ScalarField, most: f32, channel| {
            let amount = field.at(uv).clamp(0.0, most);
            if amount > 0.0 {
                amount * 2.0 * (random(channel) - 0.5)
            } else {
                0.0
            }
        };
        let shifts = [
            shift(&self.hue, 180.0, Channel::Hue),
            shift(&self.saturation, 1.0, Channel::Saturation),
            shift(&self.value, 1.0, Channel::Value),
        ];
        if shifts == [0.0; 3] {
            colors
        } else {
            colors.map(|color| shifted(color, shifts))
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
