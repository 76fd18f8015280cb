//! UDIM sets against single images.

// Clippy's exception for tests does not reach the helpers of an integration test.
#![allow(clippy::unwrap_used)]

use pelage_surface::{
    Density, ImageMap, Mesh, PolygonMesh, RootSampler, TiledDensity, Tiles, Wrap, hash, tile_number,
};
use proptest::prelude::*;
use std::sync::Arc;

/// Columns and rows of tiles, powers of two so that scaled coordinates are exact.
const GRID: [u32; 2] = [4, 2];

/// Columns and rows of a tile.
const SIZE: [u32; 2] = [12, 10];

fn image([width, height]: [u32; 2], texel: impl Fn(u32, u32) -> f32) -> ImageMap {
    let texels = (0..width * height).map(|i| texel(i % width, i / width));
    ImageMap::new(width, height, 1, texels.collect::<Vec<f32>>(), false).unwrap()
}

/// Noise over all tiles, a third of it black; rows from the top of the upper tiles.
fn noise(x: u32, y: u32) -> f32 {
    let code = hash(x as u64 | (y as u64) << 32);
    if code.is_multiple_of(3) {
        0.0
    } else {
        (code % 7) as f32
    }
}

fn whole() -> ImageMap {
    image([SIZE[0] * GRID[0], SIZE[1] * GRID[1]], noise)
}

/// [`whole`], cut into the tiles that `kept` takes by number.
fn cut(kept: impl Fn(u32) -> bool) -> Tiles<Arc<ImageMap>> {
    let [width, height] = SIZE;
    let cells = (0..GRID[0] * GRID[1]).map(|i| (i % GRID[0], i / GRID[0]));
    let tiles = cells.map(|(column, row)| {
        let top = (GRID[1] - 1 - row) * height;
        let tile = image(SIZE, |x, y| noise(column * width + x, top + y));
        (1001 + 10 * row + column, Arc::new(tile))
    });
    Tiles::new(tiles.filter(|(number, _)| kept(*number)))
}

/// A flat sheet of `n × n` squares whose texture ends at `[u, v]`.
fn sheet(n: u32, [u, v]: [f32; 2]) -> Mesh {
    let mut mesh = PolygonMesh::default();
    let at = |i: u32| i as f32 / n as f32;
    for (x, y) in (0..(n + 1) * (n + 1)).map(|i| (i % (n + 1), i / (n + 1))) {
        mesh.positions.push([at(x), at(y), 0.0]);
    }
    for (x, y) in (0..n * n).map(|i| (i % n, i / n)) {
        mesh.face_sizes.push(4);
        for (x, y) in [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)] {
            mesh.corner_vertices.push(y * (n + 1) + x);
            mesh.corner_uvs.push([u * at(x), v * at(y)]);
        }
    }
    Mesh::new(mesh).unwrap()
}

proptest! {
    #[test]
    fn a_set_cut_out_of_one_image_reads_as_that_image(u in 0.0f32..4.0, v in 0.0f32..2.0) {
        let [across, up] = GRID.map(|n| n as f32);
        let one = whole().sample(u / across, v / up, 0, Wrap::Clamp);
        prop_assert_eq!(cut(|_| true).sample(u, v, 0), Some(one));
        prop_assert_eq!(cut(|_| true).sample_rgb(u, v), Some([one; 3]));
    }

    #[test]
    fn a_tile_by_itself_reads_as_an_image_that_is_clamped(u in 0.0f32..1.0, v in 0.0f32..1.0) {
        let tiles = cut(|number| number == 1013);
        let (alone, _) = tiles.at(2.5, 1.5).unwrap();
        let expected = alone.sample((u + 2.0) - 2.0, (v + 1.0) - 1.0, 0, Wrap::Clamp);
        prop_assert_eq!(tiles.sample(u + 2.0, v + 1.0, 0), Some(expected));
    }

    #[test]
    fn any_coordinates_are_answered(u: f32, v: f32) {
        let tiles = cut(|_| true);
        let number = tile_number(u, v);
        let inside = (0.0..4.0).contains(&u) && (0.0..2.0).contains(&v);
        prop_assert!(!inside || number.is_some_and(|n| n == 1001 + u as u32 + 10 * v as u32));
        prop_assert_eq!(tiles.sample(u, v, 3).is_some(), tiles.at(u, v).is_some());
    }
}

#[test]
fn roots_on_a_set_cut_out_of_one_image_grow_where_those_on_that_image_do() {
    let (tiles, whole) = (cut(|_| true), whole());
    let tiled = TiledDensity {
        value: 2.0,
        tiles: &tiles,
    };
    let single = Density {
        value: 2.0,
        map: Some((&whole, 0, Wrap::Clamp)),
    };
    for n in [1, 3, 8] {
        let tiled = RootSampler::tiled(&sheet(n, [4.0, 2.0]), &tiled, 5).unwrap();
        let single = RootSampler::new(&sheet(n, [1.0, 1.0]), &single, 5).unwrap();
        // To rounding: an image is read many places at a time, in coordinates that count
        // from the triangle, and so other parts may happen to have one density.
        let [a, b] = [&tiled, &single].map(RootSampler::weighted_area);
        assert!((a - b).abs() < 1e-6 * b, "{n} {a} {b}");
        let elsewhere = (0..5000).filter(|&i| tiled.root(i).triangle != single.root(i).triangle);
        assert!(elsewhere.count() < 5, "{n}");
    }
}

#[test]
fn nothing_grows_where_a_set_has_no_tile() {
    let tiles = cut(|number| number != 1002);
    let density = TiledDensity {
        value: 1.0,
        tiles: &tiles,
    };
    // Triangles of the coarse sheet lie across several tiles.
    for n in [1, 8] {
        let mesh = sheet(n, [4.0, 2.0]);
        let sampler = RootSampler::tiled(&mesh, &density, 5).unwrap();
        let mut least = f32::INFINITY;
        for i in 0..20_000 {
            let uv = mesh.uv(&sampler.root(i));
            let depth = (uv.x - 1.0).min(2.0 - uv.x).min(1.0 - uv.y);
            // Half of a piece may hang over the border.
            assert!(depth < 0.15, "{uv}");
            least = least.min(uv.x);
        }
        assert!(least < 0.1);
    }
    let none = Tiles::new([]);
    let nowhere = TiledDensity {
        value: 1.0,
        tiles: &none,
    };
    assert!(RootSampler::tiled(&sheet(2, [4.0, 2.0]), &nowhere, 0).is_none());
}

#[test]
fn texture_far_outside_the_tiles_grows_nothing() {
    let tiles = cut(|_| true);
    let density = TiledDensity {
        value: 1.0,
        tiles: &tiles,
    };
    for uv in [
        [30.0, 1.0],
        [1.0, 1e30],
        [-1e30, -1e30],
        [f32::MAX, f32::MIN],
    ] {
        let triangle = PolygonMesh {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            face_sizes: vec![3],
            corner_vertices: vec![0, 1, 2],
            corner_uvs: vec![uv; 3],
            ..PolygonMesh::default()
        };
        let mesh = Mesh::new(triangle).unwrap();
        assert!(RootSampler::tiled(&mesh, &density, 0).is_none());
    }
}

#[test]
fn an_edge_belongs_to_the_tile_that_is_there() {
    let tiles = cut(|number| number == 1001);
    for (u, v) in [
        (1.0f32, 0.5f32),
        (1.000_001, 1.0),
        (0.5, -1e-7),
        (0.0, 0.0),
        (-1e-7, 1.0),
    ] {
        let inside = tiles.sample(u.clamp(0.0, 0.999_999), v.clamp(0.0, 0.999_999), 0);
        let [found, inside] = [tiles.sample(u, v, 0), inside].map(Option::unwrap);
        assert!((found - inside).abs() < 1e-3, "{u} {v}");
    }
    assert_eq!(tiles.sample(1.001, 0.5, 0), None);
    assert_eq!(tiles.sample(f32::NAN, 0.5, 0), None);
}

#[test]
fn neighbours_of_other_sizes_keep_to_themselves_and_greys_blend_with_colours() {
    let flat = |size, value| Arc::new(image([size, size], |_, _| value));
    let tiles = Tiles::new([(1001, flat(4, 1.0)), (1002, flat(8, 3.0))]);
    assert_eq!(tiles.sample(0.999, 0.5, 0), Some(1.0));
    assert_eq!(tiles.sample(1.0, 0.5, 0), Some(3.0));
    let color = ImageMap::new(1, 1, 3, vec![1.0, 2.0, 3.0], false).unwrap();
    let tiles = Tiles::new([(1001, flat(1, 2.0)), (1002, Arc::new(color))]);
    assert_eq!(tiles.sample_rgb(1.0, 0.5), Some([1.5, 2.0, 2.5]));
    assert_eq!(tiles.sample_rgb(0.5, 0.5), Some([2.0; 3]));
}
