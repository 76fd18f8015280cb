//! `[frizz]`: hairs bent as a whole by noise over the surface.

use super::entry::Rule;
use super::property::ScalarProperty;
use super::section::section;

section! {
    /// Noise that bends a hair as a whole (document 004, 2.2.5):
    /// `p += F · min(4 (t - t²) root + t² tip, max(root, tip))`, where F is
    /// `N(frequency · root at rest)` with its part along the normal turned into the skin.
    pub struct Frizz {
        /// Frequencies of the noise over the rest roots, along x, y and z
        /// (document 004: Frizz_X_Frequency and so on).
        pub frequency: [ScalarProperty; 3] =
            [ScalarProperty::new(1.0), ScalarProperty::new(1.0), ScalarProperty::new(1.0)]
            => Rule::at_least(0.0),
        /// Amount at the root (document 004: Root_Frizz).
        pub root: ScalarProperty = ScalarProperty::new(0.0)
            => Rule::at_least(0.0).length().with_ramp(),
        /// Amount at the tip (document 004: Tip_Frizz).
        pub tip: ScalarProperty = ScalarProperty::new(0.0) => Rule::at_least(0.0).length(),
        /// Whether hairs keep their length, which frizz makes longer.
        pub preserve_length: bool = false => Rule::ANY,
        /// Noise that moves with time.
        pub animation: FrizzAnimation = FrizzAnimation::default() => Rule::ANY,
    }
}

section! {
    /// Frizz that moves with time. Without `frizz.root` or `frizz.tip` there is
    /// nothing to move: `F = (1 - amount) N(x) + amount N(x + speed · time · direction)`,
    /// with the time in frames.
    pub struct FrizzAnimation {
        /// How much of the frizz moves (document 004: Frizz_Anim).
        pub amount: ScalarProperty = ScalarProperty::new(0.0) => Rule::between(0.0, 1.0),
        /// How fast the noise moves, per unit of time (document 004:
        /// Frizz_Anim_Speed).
        pub speed: ScalarProperty = ScalarProperty::new(0.0) => Rule::ANY,
        /// Where the noise moves to (document 004: Frizz_Anim_Direction).
        pub direction: [f32; 3] = [1.0, 0.0, 0.0] => Rule::ANY,
    }
}
