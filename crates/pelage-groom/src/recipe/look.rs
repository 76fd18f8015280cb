//! `[opacity]` and `[width]`: how hairs look from root to tip, beside colour.

use super::entry::Rule;
use super::property::ScalarProperty;
use super::section::section;

section! {
    /// Opacity of hairs: `(1 - t) root + t tip`.
    pub struct Opacity {
        /// Opacity at the root (document 004: Root_Opacity).
        pub root: ScalarProperty = ScalarProperty::new(1.0) => Rule::between(0.0, 1.0).with_ramp(),
        /// Opacity at the tip (document 004: Tip_Opacity).
        pub tip: ScalarProperty = ScalarProperty::new(1.0) => Rule::between(0.0, 1.0),
    }
}

section! {
    /// Width of hairs: the full diameter, in units of the mesh; `(1 - t) root + t tip`.
    pub struct Width {
        /// Width at the root (document 004: Root_Thickness).
        pub root: ScalarProperty = ScalarProperty::new(0.02)
            => Rule::at_least(0.0).length().with_ramp(),
        /// Width at the tip (document 004: Tip_Thickness).
        pub tip: ScalarProperty = ScalarProperty::new(0.0) => Rule::at_least(0.0).length(),
    }
}
