//! UDIM sets: one image for each unit square of texture space.
//!
//! The tile of (u, v) is 1001 + ⌊u⌋ + 10 ⌊v⌋, with u in 0..10 and v from 0 on. A tile
//! is read as an image of its own, except at its border, where an image of the same
//! size next to it goes on: a set cut out of one image reads as that image does.

use crate::ImageMap;
use crate::bilinear::Around;
use crate::density::DensityField;
use pelage_curves::Vec2;
use std::sync::Arc;

/// The first UDIM tile, over 0..1 in u and v.
const FIRST: u32 = 1001;

/// The last one that four digits can name.
const LAST: u32 = 9999;

/// Tiles in a row.
const COLUMNS: i32 = 10;

/// How far outside a tile a place may lie and still be on its edge, where the tile that
/// it lies in has no image: sums of coordinates near 10 are off by so much.
const EDGE: f32 = 4e-6;

/// Something for each tile of a UDIM set that has an image.
#[derive(Clone, Debug, PartialEq)]
pub struct Tiles<T> {
    /// By number, from [`FIRST`] on.
    tiles: Vec<Option<T>>,
}

/// Column and row of a tile, from the one over 0..1.
type Cell = [i32; 2];

/// The number of the tile that `(u, v)` lies in, if there is one.
pub fn tile_number(u: f32, v: f32) -> Option<u32> {
    let [column, row] = [u, v].map(|c| c.floor() as i32);
    let number = row.checked_mul(COLUMNS)?.checked_add(column)?;
    let named = u.is_finite() && (0..COLUMNS).contains(&column) && v >= 0.0;
    let number = FIRST.checked_add(u32::try_from(number).ok()?)?;
    (named && number <= LAST).then_some(number)
}

impl<T> Tiles<T> {
    /// A set of what `tiles` has for each number, 1001 to 9999; others are left out, and
    /// the last of a number counts.
    pub fn new(tiles: impl IntoIterator<Item = (u32, T)>) -> Self {
        let mut set = Vec::new();
        for (number, tile) in tiles {
            if (FIRST..=LAST).contains(&number) {
                let index = (number - FIRST) as usize;
                if set.len() <= index {
                    set.resize_with(index + 1, || None);
                }
                set[index] = Some(tile);
            }
        }
        Self { tiles: set }
    }

    /// All that there are, with their numbers, ascending.
    pub fn iter(&self) -> impl Iterator<Item = (u32, &T)> {
        let numbered = (FIRST..).zip(&self.tiles);
        numbered.filter_map(|(number, tile)| Some((number, tile.as_ref()?)))
    }

    /// Another set with the same tiles.
    pub fn map<U>(&self, mut f: impl FnMut(&T) -> U) -> Tiles<U> {
        let tiles = self.tiles.iter();
        Tiles {
            tiles: tiles.map(|tile| tile.as_ref().map(&mut f)).collect(),
        }
    }

    /// What the tile of `(u, v)` has, and the coordinates inside it; `None` where there
    /// is no tile. On an edge between two tiles of which one has no image, it is the
    /// other that counts.
    pub fn at(&self, u: f32, v: f32) -> Option<(&T, [f32; 2])> {
        let (tile, _, inside) = self.find(u, v)?;
        Some((tile, inside))
    }

    #[inline]
    fn find(&self, u: f32, v: f32) -> Option<(&T, Cell, [f32; 2])> {
        // A coordinate less its whole part is exact in f32. What is no number, or far
        // outside, saturates to a cell without a tile.
        let in_cell_of = |x: f32, y: f32| {
            let cell = [x, y].map(|c| c.floor() as i32);
            let inside = [u - cell[0] as f32, v - cell[1] as f32];
            Some((self.cell(cell)?, cell, inside))
        };
        if u.is_nan() || v.is_nan() {
            return None;
        }
        in_cell_of(u, v).or_else(|| {
            let around = [-EDGE, 0.0, EDGE].map(|dy| [-EDGE, 0.0, EDGE].map(|dx| [dx, dy]));
            let mut around = around.into_iter().flatten();
            around.find_map(|[dx, dy]| in_cell_of(u + dx, v + dy))
        })
    }

    #[inline]
    fn cell(&self, [column, row]: Cell) -> Option<&T> {
        if !(0..COLUMNS).contains(&column) || row < 0 {
            return None;
        }
        let index = row as usize * COLUMNS as usize + column as usize;
        self.tiles.get(index)?.as_ref()
    }
}

impl Tiles<Arc<ImageMap>> {
    /// Bilinear value of `channel` at `(u, v)`, as [`ImageMap::sample`]; `None` where
    /// there is no tile.
    pub fn sample(&self, u: f32, v: f32, channel: u32) -> Option<f32> {
        self.blend(u, v, |image, x, y| {
            image.texel(x, y, channel.min(image.channels() - 1))
        })
    }

    /// Bilinear colour at `(u, v)`, as [`ImageMap::sample_rgb`]; `None` where there is no
    /// tile. Grey and coloured tiles may stand side by side.
    pub fn sample_rgb(&self, u: f32, v: f32) -> Option<[f32; 3]> {
        let channel = |k| {
            self.blend(u, v, |image, x, y| {
                image.texel(x, y, if image.channels() >= 3 { k } else { 0 })
            })
        };
        Some([channel(0)?, channel(1)?, channel(2)?])
    }

    fn blend(&self, u: f32, v: f32, texel: impl Fn(&ImageMap, u32, u32) -> f32) -> Option<f32> {
        let (tile, [column, row], [u, v]) = self.find(u, v)?;
        let image: &ImageMap = tile;
        let (around, beyond) = image.around_in_tile(u, v);
        Some(around.blend(|i, j| {
            let [across, up] = [beyond[0][i], beyond[1][j]];
            // Where there is no tile to go on in, the texel on this side of its border
            // does.
            let from = |right: i32, above: i32| {
                let next = self.cell([column + right, row + above])?;
                let x = around.columns[if right == across { i } else { 1 - i }];
                let y = around.rows[if above == up { j } else { 1 - j }];
                same_size(next, image).then(|| texel(next, x, y))
            };
            from(across, up)
                .or_else(|| from(across, 0))
                .or_else(|| from(0, up))
                .or_else(|| from(0, 0))
                .unwrap_or(0.0)
        }))
    }
}

fn same_size(a: &ImageMap, b: &ImageMap) -> bool {
    (a.width(), a.height()) == (b.width(), b.height())
}

impl ImageMap {
    /// The texels around `(u, v)` of a tile, repeating, and how many tiles to the right
    /// (of each column) and up (of each row) they lie.
    fn around_in_tile(&self, u: f32, v: f32) -> (Around, [[i32; 2]; 2]) {
        let around = self.around(u, v, crate::Wrap::Repeat);
        // Two that follow each other ascend unless the border is between them.
        let crosses = |[first, second]: [u32; 2]| second <= first;
        let across = match crosses(around.columns) {
            false => [0, 0],
            true if u < 0.5 => [-1, 0],
            true => [0, 1],
        };
        let up = match crosses(around.rows) {
            false => [0, 0],
            true if v > 0.5 => [1, 0],
            true => [0, -1],
        };
        (around, [across, up])
    }
}

/// Hair density over a surface: a number times the first channel of a UDIM set, 0 where
/// that has no tile.
#[derive(Clone, Copy, Debug)]
pub struct TiledDensity<'a> {
    /// The factor, at least 0.
    pub value: f32,
    /// The set.
    pub tiles: &'a Tiles<Arc<ImageMap>>,
}

impl DensityField for TiledDensity<'_> {
    fn value(&self) -> f32 {
        self.value
    }

    /// The finest of the tiles that the box around the triangle touches.
    fn texels(&self, uv: [Vec2; 3]) -> Option<[u32; 2]> {
        let low = uv[0].min(uv[1]).min(uv[2]).floor();
        let high = uv[0].max(uv[1]).max(uv[2]).floor();
        let last = self.tiles.tiles.len() as i32 / COLUMNS;
        let rows = low.y.max(0.0) as i32..=(high.y as i32).min(last);
        let columns = low.x.max(0.0) as i32..=(high.x as i32).min(COLUMNS - 1);
        let cells = rows.flat_map(|row| columns.clone().map(move |column| [column, row]));
        let sizes = cells
            .filter_map(|cell| self.tiles.cell(cell))
            .map(|image| [image.width(), image.height()]);
        sizes.reduce(|a, b| [a[0].max(b[0]), a[1].max(b[1])])
    }

    fn at(&self, uv: Vec2) -> f32 {
        self.tiles.sample(uv.x, uv.y, 0).unwrap_or(0.0)
    }
}
