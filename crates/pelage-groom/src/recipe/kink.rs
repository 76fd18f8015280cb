//! `[kink]`: noise along each hair.

use super::entry::Rule;
use super::property::ScalarProperty;
use super::section::section;

section! {
    /// Noise along each hair (document 004, 2.2.5):
    /// `p += N(frequency · p at rest) · ((1 - t) root + t tip)`.
    pub struct Kink {
        /// Frequencies of the noise along x, y and z (document 004:
        /// Kink_X_Frequency and so on).
        pub frequency: [ScalarProperty; 3] =
            [ScalarProperty::new(1.0), ScalarProperty::new(1.0), ScalarProperty::new(1.0)]
            => Rule::at_least(0.0),
        /// Amount at the root (document 004: Root_Kink).
        pub root: ScalarProperty = ScalarProperty::new(0.0)
            => Rule::at_least(0.0).length().with_ramp(),
        /// Amount at the tip (document 004: Tip_Kink).
        pub tip: ScalarProperty = ScalarProperty::new(0.0) => Rule::at_least(0.0).length(),
        /// Whether hairs keep their length, which kink makes longer.
        pub preserve_length: bool = false => Rule::ANY,
    }
}
