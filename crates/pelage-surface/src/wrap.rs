//! What texture coordinates outside an image mean.

/// What lies outside 0..1 in texture space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// The image repeats.
    #[default]
    Repeat,
    /// The border texels go on.
    Clamp,
    /// The image and its mirror image take turns: upright in 0..1 and every second
    /// tile from there, reflected in u, v or both between them.
    Mirror,
}

impl Wrap {
    /// Column and row (from the top) of the texel that `uv` falls in, in an image of
    /// `size` columns and rows.
    pub fn texel(self, [u, v]: [f32; 2], [width, height]: [u32; 2]) -> [u32; 2] {
        let x = (u as f64 * width as f64).floor();
        let y = ((1.0 - v as f64) * height as f64).floor();
        [wrapped(x, width, self), wrapped(y, height, self)]
    }
}

/// Column or row `x` brought into `0..size`. Anything that is no number gives 0.
#[inline(always)]
pub(crate) fn wrapped(x: f64, size: u32, wrap: Wrap) -> u32 {
    let inside = 0.0..size as f64;
    if inside.contains(&x) {
        return x as u32;
    }
    match wrap {
        // A remainder takes as long as all the rest, and most are in the next tile.
        Wrap::Repeat if inside.contains(&(x + inside.end)) => (x + inside.end) as u32,
        Wrap::Repeat if inside.contains(&(x - inside.end)) => (x - inside.end) as u32,
        Wrap::Repeat => (x.rem_euclid(inside.end) as u32).min(size - 1),
        Wrap::Clamp => (x.max(0.0) as u32).min(size - 1),
        Wrap::Mirror => {
            let there_and_back = 2.0 * size as f64;
            let x = x.rem_euclid(there_and_back);
            (x.min(there_and_back - 1.0 - x) as u32).min(size - 1)
        }
    }
}
