//! Sampling over texture coordinates outside 0..1, against sums over texels.

// Clippy's exception for tests does not reach the helpers of an integration test.
#![allow(clippy::unwrap_used)]

use pelage_surface::{
    Density, ImageMap, Mesh, PolygonMesh, RootPdf, RootSampler, SurfacePoint, Wrap, hash,
};

/// Blocks of one density along each side of the map.
const BLOCKS: i64 = 5;

/// Texels along each side of a block.
const TEXELS: i64 = 16;

/// Least texture coordinate, in u and v.
const LOW: f32 = -2.7;

/// Largest texture coordinate.
const HIGH: f32 = 3.4;

/// Density of a block of the map, by column and row from the top.
fn block(column: i64, row: i64) -> f32 {
    match hash((row * BLOCKS + column) as u64) % 5 {
        0 => 0.0,
        k => k as f32,
    }
}

fn map() -> ImageMap {
    let side = BLOCKS * TEXELS;
    let texel = |i| block(i % side / TEXELS, i / side / TEXELS);
    let texels: Vec<f32> = (0..side * side).map(texel).collect();
    ImageMap::new(side as u32, side as u32, 1, texels, false).unwrap()
}

/// What a wrap says of block `i` of an endless row of blocks, in whole numbers.
fn wrapped(i: i64, wrap: Wrap) -> i64 {
    let inside = i.rem_euclid(BLOCKS);
    match wrap {
        Wrap::Repeat => inside,
        Wrap::Clamp => i.clamp(0, BLOCKS - 1),
        Wrap::Mirror if i.div_euclid(BLOCKS) % 2 == 0 => inside,
        Wrap::Mirror => BLOCKS - 1 - inside,
    }
}

/// Density at `uv`, and whether it is the same `margin` texels around.
fn expected(uv: [f32; 2], wrap: Wrap, margin: f64) -> (f32, bool) {
    let [x, y] = [uv[0] as f64, 1.0 - uv[1] as f64].map(|c| c * BLOCKS as f64);
    let density = |x: f64, y: f64| {
        let [column, row] = [x, y].map(|c| wrapped(c.floor() as i64, wrap));
        block(column, row)
    };
    let here = density(x, y);
    let m = margin / TEXELS as f64;
    let around = [(-m, -m), (-m, m), (m, -m), (m, m)];
    let same = around
        .iter()
        .all(|(dx, dy)| density(x + dx, y + dy) == here);
    (here, same)
}

/// A flat sheet of `n × n` squares whose texture goes from [`LOW`] to [`HIGH`].
fn sheet(n: u32) -> Mesh {
    let mut mesh = PolygonMesh::default();
    let at = |i: u32| i as f32 / n as f32;
    for y in 0..=n {
        for x in 0..=n {
            mesh.positions.push([at(x), at(y), 0.0]);
        }
    }
    for (x, y) in (0..n * n).map(|i| (i % n, i / n)) {
        mesh.face_sizes.push(4);
        for (x, y) in [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)] {
            mesh.corner_vertices.push(y * (n + 1) + x);
            let uv = [x, y].map(|i| LOW + (HIGH - LOW) * at(i));
            mesh.corner_uvs.push(uv);
        }
    }
    Mesh::new(mesh).unwrap()
}

/// The mean density of triangle `t`, summed over a grid several times finer than texels.
fn mean_density(mesh: &Mesh, triangle: u32, wrap: Wrap) -> f64 {
    const STEPS: usize = 400;
    let mut sum = 0.0;
    for i in 0..STEPS {
        for j in 0..STEPS - i {
            let [v, w] = [i, j].map(|k| (k as f32 + 1.0 / 3.0) / STEPS as f32);
            let place = SurfacePoint {
                triangle,
                barycentric: [1.0 - v - w, v, w],
            };
            sum += expected(mesh.uv(&place).to_array(), wrap, 0.0).0 as f64;
        }
    }
    sum / (STEPS * (STEPS + 1) / 2) as f64
}

#[test]
fn with_every_wrap_triangles_weigh_what_their_texels_sum_to_and_roots_are_as_likely_as_theirs() {
    let (mesh, map) = (sheet(5), map());
    for wrap in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
        let density = Density {
            value: 1.0,
            map: Some((&map, 0, wrap)),
        };
        let sampler = RootSampler::new(&mesh, &density, 1).unwrap();
        let triangles = mesh.triangles().len();
        let masses: Vec<f64> = (0..triangles)
            .map(|t| mean_density(&mesh, t as u32, wrap) * mesh.area(t))
            .collect();
        let total: f64 = masses.iter().sum();
        assert!(
            (sampler.weighted_area() / total - 1.0).abs() < 2e-3,
            "{wrap:?}"
        );

        let mut found = vec![0.0; triangles];
        for (i, centre) in sampler.piece_centres().enumerate() {
            found[centre.triangle as usize] += sampler.distribution().probability(i);
        }
        let mean = total / triangles as f64;
        for (t, (found, mass)) in found.iter().zip(&masses).enumerate() {
            assert!((found * total - mass).abs() < 0.01 * mean, "{wrap:?} {t}");
        }

        let pdf = RootPdf::new(&sampler, &mesh);
        let mut checked = 0;
        for i in 0..20_000 {
            let root = sampler.root(i);
            // A piece is at most four texels long and reads one texel around its middle.
            let (density, flat) = expected(mesh.uv(&root).to_array(), wrap, 4.5);
            if flat {
                let likely = density as f64 / sampler.weighted_area();
                assert!(
                    (pdf.density(&root) / likely - 1.0).abs() < 1e-5,
                    "{wrap:?} {root:?}"
                );
                checked += 1;
            }
        }
        assert!(checked > 4000, "{wrap:?}: {checked}");
    }
}
