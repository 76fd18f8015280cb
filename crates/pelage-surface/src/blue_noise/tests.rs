use super::*;
use crate::fixture::sheet;
use crate::quality::{Sample, radial_power_spectrum, smallest_distance_ratio};
use crate::{Density, ImageMap, PolygonMesh, Wrap};
use pelage_curves::Vec3;
use proptest::prelude::*;

const EVEN: Density = Density {
    value: 1.0,
    map: None,
};

/// From 0.1 to 1 along u, without steps that distances could not be scaled across.
fn slope() -> ImageMap {
    let texels = (0..64 * 64).map(|i| 0.1 + 0.9 * (i % 64) as f32 / 63.0);
    ImageMap::new(64, 64, 1, texels.collect::<Vec<f32>>(), false).unwrap()
}

fn by(map: &ImageMap) -> Density<'_> {
    Density {
        value: 1.0,
        map: Some((map, 0, Wrap::Clamp)),
    }
}

fn triangles(positions: &[[f32; 3]], corners: &[u32]) -> Mesh {
    Mesh::new(PolygonMesh {
        positions: positions.to_vec(),
        face_sizes: vec![3; corners.len() / 3],
        corner_vertices: corners.to_vec(),
        ..Default::default()
    })
    .unwrap()
}

fn samples(mesh: &Mesh, density: &Density, roots: &[SurfacePoint]) -> Vec<Sample> {
    let value = |root: &SurfacePoint| {
        let uv = mesh.uv(root);
        density
            .map
            .map_or(1.0, |(m, k, w)| m.sample(uv.x, uv.y, k, w)) as f64
    };
    let sampler = RootSampler::new(mesh, density, 0).unwrap();
    let mean = sampler.weighted_area() / mesh.surface_area();
    let sample = |root: SurfacePoint| {
        let [a, b, c] = mesh.corners(root.triangle as usize);
        Sample {
            position: mesh.position(&root),
            normal: (b - a).cross(c - a).normalize_or_zero(),
            density: value(&root) / mean,
        }
    };
    roots.iter().copied().map(sample).collect()
}

fn made(mesh: &Mesh, density: &Density, count: u64, seed: u64) -> Vec<SurfacePoint> {
    let sampler = RootSampler::new(mesh, density, seed).unwrap();
    let mut roots = Vec::new();
    BlueNoise::new(mesh, &sampler, count).roots(0..count, &mut roots);
    roots
}

/// The least ratio of all prefixes from 100 roots on, a tenth apart.
fn least_ratio(mesh: &Mesh, density: &Density, roots: &[SurfacePoint]) -> f64 {
    let samples = samples(mesh, density, roots);
    let next = |n: &usize| Some(n + n / 10).filter(|n| *n <= roots.len());
    std::iter::successors(Some(100), next)
        .map(|n| smallest_distance_ratio(&samples[..n], mesh.surface_area()))
        .fold(f64::INFINITY, f64::min)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]
    #[test]
    fn more_roots_keep_the_old_roots(few in 0u64..900, more in 0u64..900, seed: u64) {
        let (mesh, map) = (sheet(4), slope());
        let all = made(&mesh, &by(&map), few + more, seed);
        prop_assert_eq!(all.len() as u64, few + more);
        prop_assert_eq!(&made(&mesh, &by(&map), few, seed)[..], &all[..few as usize]);
    }
}

#[test]
fn any_number_of_threads_makes_the_same_roots() {
    let (mesh, map) = (sheet(12), slope());
    let roots = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build()
            .unwrap()
            .install(|| made(&mesh, &by(&map), 30_000, 5))
    };
    let one = roots(1);
    assert!(one == roots(4) && one == roots(3));
}

#[test]
fn seeds_make_different_roots() {
    let mesh = sheet(3);
    assert_ne!(made(&mesh, &EVEN, 50, 1), made(&mesh, &EVEN, 50, 2));
}

#[test]
fn every_prefix_keeps_its_distance() {
    let mesh = sheet(16);
    let ratio = least_ratio(&mesh, &EVEN, &made(&mesh, &EVEN, 50_000, 3));
    assert!(ratio > 0.63, "{ratio}");
    // The (0,2)-sequence lets the closest pairs be far closer.
    let mut plain = Vec::new();
    RootSampler::new(&mesh, &EVEN, 3)
        .unwrap()
        .roots(0..50_000, &mut plain);
    let plain = least_ratio(&mesh, &EVEN, &plain);
    assert!(plain < 0.1, "{plain}");
}

#[test]
fn every_prefix_keeps_its_distance_scaled_to_the_density() {
    let (mesh, map) = (sheet(16), slope());
    let ratio = least_ratio(&mesh, &by(&map), &made(&mesh, &by(&map), 50_000, 3));
    // Pieces have the density of their centre; the measure takes that of the place.
    assert!(ratio > 0.6, "{ratio}");
}

/// Two squares that are almost in one place and face away from each other.
fn thin_sheet() -> Mesh {
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let at = |z| square.map(|[x, y]| [x, y, z]);
    triangles(
        &[at(0.0), at(1e-4)].concat(),
        &[0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7],
    )
}

#[test]
fn the_two_sides_of_a_sheet_do_not_push_each_other() {
    let mesh = thin_sheet();
    let roots = made(&mesh, &EVEN, 20_000, 1);
    assert!(least_ratio(&mesh, &EVEN, &roots) > 0.63);
    let below = roots.iter().filter(|root| root.triangle < 2).count();
    assert!((9_800..10_200).contains(&below), "{below}");
}

#[test]
fn the_spectrum_is_low_below_the_spacing_of_the_roots() {
    let square = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let mesh = triangles(&square, &[0, 1, 2, 0, 2, 3]);
    let count = 4000;
    let spectrum = |roots: &[SurfacePoint]| {
        let flat = roots.iter().map(|root| mesh.position(root));
        let points: Vec<[f64; 2]> = flat.map(|p| [p.x as f64, p.y as f64]).collect();
        radial_power_spectrum(&points, 90)
    };
    // Means over frequencies relative to that of the spacing, 63.
    let mean = |spectrum: &[(f64, f64)], low: f64, high: f64| {
        let inside = |(frequency, _): &&(f64, f64)| (63.0 * low..63.0 * high).contains(frequency);
        let powers = spectrum.iter().filter(inside).map(|(_, power)| *power);
        powers.clone().sum::<f64>() / powers.count() as f64
    };
    let blue = spectrum(&made(&mesh, &EVEN, count, 3));
    // White noise has 1 everywhere.
    let low = mean(&blue, 0.0, 0.6);
    assert!(low < 0.15, "{low}");
    let peak = mean(&blue, 1.0, 1.2);
    assert!(peak > 1.3, "{peak}");
    let mut plain = Vec::new();
    RootSampler::new(&mesh, &EVEN, 3)
        .unwrap()
        .roots(0..count, &mut plain);
    // Far below, the (0,2)-sequence has less still; nearer the spacing it is white.
    let (blue, plain) = (mean(&blue, 0.25, 0.6), mean(&spectrum(&plain), 0.25, 0.6));
    assert!(blue < plain / 3.0, "{blue}, plain {plain}");
}

#[test]
fn counts_follow_the_density() {
    let (mesh, map) = (sheet(16), slope());
    for count in [1_000, 5_000, 30_000] {
        let mut bins = [0.0; 8];
        let bin = |u: f32| ((u * 8.0) as usize).min(7);
        for root in made(&mesh, &by(&map), count, 9) {
            bins[bin(mesh.uv(&root).x)] += 1.0;
        }
        let mut expected = [0.0; 8];
        let sampler = RootSampler::new(&mesh, &by(&map), 9).unwrap();
        let even = 1 << 16;
        for k in 0..even {
            expected[bin(mesh.uv(&sampler.root(k)).x)] += count as f64 / even as f64;
        }
        for (found, expected) in bins.into_iter().zip(expected) {
            // Within a standard deviation of what white noise would do. What there is, is
            // at the border: nothing pushes roots from outside, so some more keep to it.
            let off: f64 = found - expected;
            assert!(off.abs() < expected.sqrt(), "{found}, not {expected}");
        }
    }
}

#[test]
fn counts_follow_what_a_rough_map_means() {
    // Salt and pepper to the left, its mean to the right.
    let texel = |i: u32| match (i % 256 < 128, crate::hash(i as u64) % 2) {
        (true, 0) => 0.04,
        (true, _) => 1.96,
        (false, _) => 1.0,
    };
    let map = ImageMap::new(
        256,
        256,
        1,
        (0..256 * 256).map(texel).collect::<Vec<f32>>(),
        false,
    )
    .unwrap();
    let mesh = sheet(16);
    let sampler = RootSampler::new(&mesh, &by(&map), 0).unwrap();
    let plain = (0..1 << 16)
        .filter(|&k| mesh.uv(&sampler.root(k)).x < 0.5)
        .count();
    let expected = plain as f64 / (1 << 16) as f64;
    for count in [300, 3000, 300_000] {
        let roots = made(&mesh, &by(&map), count, 1);
        let left = roots.iter().filter(|root| mesh.uv(root).x < 0.5).count();
        let share = left as f64 / count as f64;
        assert!(
            (share - expected).abs() < 0.03,
            "{count}: {share}, not {expected}"
        );
    }
}

#[test]
fn nothing_grows_where_the_density_is_zero() {
    let mesh = sheet(8);
    let texels = (0..64 * 64).map(|i| if i % 64 < 32 { 0.0 } else { 1.0 });
    let map = ImageMap::new(64, 64, 1, texels.collect::<Vec<f32>>(), false).unwrap();
    for root in made(&mesh, &by(&map), 5000, 0) {
        assert!(mesh.uv(&root).x > 0.48);
    }
}

#[test]
fn every_count_is_reached_on_any_surface() {
    let corner = |scale: f32| [[0.0; 3], [scale, 0.0, 0.0], [0.0, scale, 0.0]];
    let one = [0, 1, 2];
    let meshes = [
        ("a triangle", triangles(&corner(1.0), &one)),
        ("a tiny one", triangles(&corner(1e-12), &one)),
        ("a huge one", triangles(&corner(1e12), &one)),
        (
            "a sliver",
            triangles(&[[0.0; 3], [1.0, 0.0, 0.0], [0.5, 1e-7, 0.0]], &one),
        ),
        ("layers", triangles(&corner(1.0), &one.repeat(40))),
        (
            "far away",
            triangles(&corner(1e-3).map(|[x, y, z]| [x + 4096.0, y, z]), &one),
        ),
    ];
    for (name, mesh) in meshes {
        for count in [0, 1, 2, 33, 3000] {
            let roots = made(&mesh, &EVEN, count, 1);
            assert_eq!(roots.len() as u64, count, "{name}");
            for root in roots {
                let weights = root.barycentric;
                assert!(weights.iter().all(|w| (0.0..=1.0).contains(w)), "{name}");
                assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-6, "{name}");
            }
        }
    }
}

#[test]
fn roots_keep_their_distance_at_every_scale_that_a_mesh_may_have() {
    let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let plain = triangles(&corners, &[0, 1, 2]);
    // From the least number that is none on: the root of its area has no inverse.
    for exponent in -45..=17 {
        let scale = libm::exp10(exponent as f64) as f32;
        let mesh = triangles(&corners.map(|p| p.map(|x| x * scale)), &[0, 1, 2]);
        let roots = made(&mesh, &EVEN, 500, 1);
        let ratio = least_ratio(&plain, &EVEN, &roots);
        assert!(ratio > 0.6, "1e{exponent}: {ratio}");
    }
}

#[test]
fn the_piece_of_a_root_is_where_it_lies() {
    let (mesh, map) = (sheet(5), slope());
    let sampler = RootSampler::new(&mesh, &by(&map), 2).unwrap();
    let noise = BlueNoise::new(&mesh, &sampler, 500);
    let centres: Vec<SurfacePoint> = sampler.piece_centres().collect();
    for hair in 0..500 {
        let (root, centre) = (noise.root(hair), centres[noise.piece(hair) as usize]);
        assert_eq!(root.triangle, centre.triangle);
        let apart: Vec3 = mesh.position(&root) - mesh.position(&centre);
        // A piece is at most four texels long.
        assert!(apart.length() < 5.0 / 64.0, "{apart}");
    }
    assert_eq!(
        (noise.len(), noise.is_empty(), noise.bytes()),
        (500, false, 8000)
    );
}

#[test]
fn lists_merge_in_order() {
    let placed = |fractions: &[u64]| -> Vec<Placed> {
        let root = Root {
            piece: 0,
            triangle: 0,
            weights: [0.0; 2],
        };
        let at = |&fraction: &u64| Placed {
            fraction,
            root,
            position: Vec3::ZERO,
        };
        fractions.iter().map(at).collect()
    };
    let all = merged(&placed(&[1, 4, 6]), &placed(&[2, 3, 9]));
    let fractions: Vec<u64> = all.iter().map(|placed| placed.fraction).collect();
    assert_eq!(fractions, [1, 2, 3, 4, 6, 9]);
}
