//! Linear RGB as vectors, and the tone curve.

use glam::Vec3;

/// Linear RGB, Rec. 709 primaries.
pub(crate) type Rgb = Vec3;

/// `exp` of every component.
pub(crate) fn exp(x: Rgb) -> Rgb {
    Rgb::new(libm::expf(x.x), libm::expf(x.y), libm::expf(x.z))
}

/// Rec. 709 luminance.
pub(crate) fn luminance(c: Rgb) -> f32 {
    0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z
}

/// Scene light to display light in 0..=1.
///
/// Straight up to a shoulder, then rolled off towards white, on the largest
/// component so that hues hold; what is over white is faded towards grey, as film
/// does. After the "Khronos PBR Neutral" operator (2024), whose shoulder begins
/// late; ours begins earlier, because back-lit fur is mostly highlight.
pub(crate) fn tone(c: Rgb) -> Rgb {
    const SHOULDER: f32 = 0.62;
    const FADE: f32 = 0.22;
    let c = c.max(Rgb::ZERO);
    let peak = c.max_element();
    if peak <= SHOULDER {
        return c;
    }
    let room = 1.0 - SHOULDER;
    let rolled = 1.0 - room * room / (peak + room - SHOULDER);
    let faded = 1.0 - 1.0 / (FADE * (peak - rolled) + 1.0);
    (c * (rolled / peak)).lerp(Rgb::splat(rolled), faded)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tone_curve_rises_and_stays_under_white() {
        let mut before = -1.0;
        for i in 0..2000 {
            let shown = tone(Rgb::splat(i as f32 * 0.01)).x;
            assert!(shown > before && shown <= 1.0, "at {i}: {shown}");
            before = shown;
        }
    }
}
