//! `[color]`: the colour of hairs from root to tip.

use super::entry::Rule;
use super::property::{ColorProperty, ScalarProperty};
use super::section::section;
use super::word::words;

/// Mid brown in linear RGB, about `#6c4b30`.
const BROWN: [f32; 3] = [0.15, 0.07, 0.03];

/// Mid grey in linear RGB.
const GREY: [f32; 3] = [0.5, 0.5, 0.5];

words! {
    /// Where colours between root and tip are interpolated.
    pub enum ColorSpace {
        /// HSV, the shorter way round the hues (document 004, 2.2.6).
        Hsv = "hsv",
        /// Oklab: even steps to the eye.
        Oklab = "oklab",
        /// Linear RGB.
        Rgb = "rgb",
    }
}

section! {
    /// The colour of hairs: `[r, g, b]` in linear RGB 0..1, or `"#rrggbb"` in sRGB;
    /// `(1 - t) root + t tip` in `space`.
    pub struct Coloring {
        /// Colour at the root (document 004: Root_Color); a map is added.
        pub root: ColorProperty = ColorProperty::new(BROWN) => Rule::ANY.with_ramp(),
        /// Colour at the tip (document 004: Tip_Color); a map is added.
        pub tip: ColorProperty = ColorProperty::new(BROWN) => Rule::ANY,
        /// Where colours between root and tip are interpolated.
        pub space: ColorSpace = ColorSpace::Hsv => Rule::ANY,
        /// Hairs of another colour.
        pub mutant: Mutant = Mutant::default() => Rule::ANY,
        /// Colours that differ at random from hair to hair.
        pub variation: Variation = Variation::default() => Rule::ANY,
    }
}

section! {
    /// Hairs of another colour, such as grey ones: those with `ξ < percent / 100`.
    pub struct Mutant {
        /// How many hairs, in per cent (document 004: Percent_Mutant_Hair).
        pub percent: ScalarProperty = ScalarProperty::new(0.0) => Rule::between(0.0, 100.0).unit("per cent"),
        /// Their colour, the same from root to tip (document 004:
        /// Mutant_Hair_Color).
        pub color: ColorProperty = ColorProperty::new(GREY) => Rule::ANY,
    }
}

section! {
    /// Colours that differ at random from hair to hair: hue, saturation and value (HSV) less
    /// `amount · 2 (ξ - ½)`, with a ξ each.
    pub struct Variation {
        /// Largest shift of the hue, in degrees (document 004: Hue_Variation).
        pub hue: ScalarProperty = ScalarProperty::new(0.0) => Rule::between(0.0, 180.0).degrees(),
        /// Largest shift of the saturation (document 004: Saturation_Variation).
        pub saturation: ScalarProperty = ScalarProperty::new(0.0) => Rule::between(0.0, 1.0),
        /// Largest shift of the value (document 004: Value_Variation).
        pub value: ScalarProperty = ScalarProperty::new(0.0) => Rule::between(0.0, 1.0),
    }
}
