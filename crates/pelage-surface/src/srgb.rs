//! Codes of colours in image files, and the light they stand for.

/// Linear value of an sRGB code in 0..=1 (IEC 61966-2-1); values outside are kept
/// on the curve's continuation. `libm`, so the same on every machine.
///
/// ```
/// assert!((pelage_surface::linear_from_srgb(0.5) - 0.21404).abs() < 1e-5);
/// ```
pub fn linear_from_srgb(code: f32) -> f32 {
    if code <= 0.04045 {
        code / 12.92
    } else {
        libm::powf((code + 0.055) / 1.055, 2.4)
    }
}

/// sRGB code of a linear value; the inverse of [`linear_from_srgb`].
pub fn srgb_from_linear(linear: f32) -> f32 {
    if linear <= 0.003_130_8 {
        linear * 12.92
    } else {
        1.055 * libm::powf(linear, 1.0 / 2.4) - 0.055
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_meets_the_values_of_the_standard() {
        assert_eq!(srgb_from_linear(0.0), 0.0);
        assert!((srgb_from_linear(1.0) - 1.0).abs() < 1e-6);
        assert!((srgb_from_linear(0.214_041_14) - 0.5).abs() < 1e-4);
    }

    #[test]
    fn srgb_and_back_is_the_identity() {
        for i in 0..=255 {
            let code = i as f32 / 255.0;
            assert!((srgb_from_linear(linear_from_srgb(code)) - code).abs() < 1e-5);
        }
    }
}
