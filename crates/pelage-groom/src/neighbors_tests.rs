use super::*;
use crate::Guide;
use crate::recipe::Interpolation;
use fearless_simd::{Level, dispatch};
use pelage_curves::Vec3;
use pelage_surface::{Mesh, PolygonMesh, SurfacePoint, hash};

/// A number in 0..1 that follows from `n`.
fn random(n: u64) -> f32 {
    (hash(n) >> 40) as f32 / (1u32 << 24) as f32
}

/// The unit square at z = 0.
fn square() -> Mesh {
    let mesh = PolygonMesh {
        positions: vec![[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]],
        face_sizes: vec![4],
        corner_vertices: vec![0, 1, 2, 3],
        ..PolygonMesh::default()
    };
    Mesh::new(mesh).unwrap()
}

/// A place of the square's first triangle, mirrored into the second where it lies beyond.
fn place(u: f32, v: f32) -> SurfacePoint {
    let (triangle, [u, v]) = if u + v > 1.0 {
        (1, [1.0 - u, 1.0 - v])
    } else {
        (0, [u, v])
    };
    SurfacePoint {
        triangle,
        barycentric: [1.0 - u - v, u, v],
    }
}

/// A hundred guides on the square that point anywhere above it, and some below.
fn guides(mesh: &Mesh, sharing: &Sharing) -> GuideSet {
    some_guides(mesh, sharing, 100)
}

fn some_guides(mesh: &Mesh, sharing: &Sharing, count: u64) -> GuideSet {
    let guides: Vec<Guide> = (0..count)
        .map(|i| {
            let [u, v, x, y, z] = [0, 1, 2, 3, 4].map(|k| random(i * 5 + k));
            let along = Vec3::new(x * 2.0 - 1.0, y * 2.0 - 1.0, z * 1.3 - 0.3);
            Guide::new(mesh, place(u, v), &[Vec3::ZERO, along])
        })
        .collect();
    let guides: Vec<(usize, &Guide)> = guides.iter().enumerate().collect();
    let interpolation = Interpolation::default();
    GuideSet::new(mesh, &guides, 3, &interpolation, sharing.nearest())
}

/// A root in the square on a surface that rolls: its normal turns with its place.
fn root(at: Vec3) -> RootFrame {
    let roll = Vec3::new(libm::sinf(5.0 * at.x), libm::cosf(4.0 * at.y), 0.0) * 0.5;
    RootFrame::new(at, Vec3::X, Vec3::Z + roll)
}

fn weights(sharing: &Sharing, guides: &GuideSet, root: &RootFrame) -> Vec<f32> {
    let mut found = Neighbors::default();
    dispatch!(Level::new(), simd => sharing.find(simd, guides, root, &mut found));
    let mut weights = vec![0.0; guides.len()];
    found
        .iter()
        .for_each(|(guide, w)| weights[guide as usize] += w);
    weights
}

/// Every way that gives a continuous field.
fn ways() -> Vec<Sharing> {
    let with = |method, facing| Sharing {
        method,
        wanted: 3,
        facing,
    };
    let distance = Method::InverseDistance;
    vec![
        with(distance, None),
        with(distance, Some(0.0)),
        with(distance, Some(2.0)),
        with(distance, Some(3.5)),
        with(Method::NaturalNeighbor, None),
        with(Method::NaturalNeighbor, Some(2.0)),
    ]
}

/// How much weights differ, and whether some guide has weight in one of them only.
fn difference(a: &[f32], b: &[f32]) -> (f32, bool) {
    let pairs = || a.iter().zip(b);
    let moved = pairs().map(|(a, b)| (a - b).abs()).sum();
    (moved, pairs().any(|(a, b)| (*a > 0.0) != (*b > 0.0)))
}

/// Walks from `start` to `end` in `steps` steps: the largest change of weights with its
/// step, and how often the set of guides changed.
fn walk(find: &dyn Fn(Vec3) -> Vec<f32>, [start, end]: [Vec3; 2], steps: u32) -> (f32, u32, u32) {
    let (mut largest, mut at, mut changes) = (0.0, 0, 0);
    let mut before = find(start);
    for step in 0..steps {
        let now = find(start.lerp(end, (step + 1) as f32 / steps as f32));
        let (moved, other) = difference(&before, &now);
        changes += u32::from(other);
        if moved > largest {
            (largest, at) = (moved, step);
        }
        before = now;
    }
    (largest, at, changes)
}

#[test]
fn weights_do_not_jump_along_a_line_of_roots_where_guides_come_and_go() {
    const STEPS: u32 = 2000;
    let mesh = square();
    for sharing in ways() {
        let guides = guides(&mesh, &sharing);
        let find = |at: Vec3| weights(&sharing, &guides, &root(at));
        let mut all_changes = 0;
        for line in 0..20u64 {
            let ends = [0, 2].map(|k| {
                let [x, y] = [k, k + 1].map(|k| random(1000 + line * 4 + k));
                Vec3::new(x, y, 0.0)
            });
            let (largest, step, changes) = walk(&find, ends, STEPS);
            all_changes += changes;
            // The steepest step, cut finer, must fall apart into small ones; a jump
            // would stay whole. Floats allow no more than some thousand cuts.
            let at = |k: u32| ends[0].lerp(ends[1], k as f32 / STEPS as f32);
            let (finer, ..) = walk(&find, [at(step), at(step + 1)], 64);
            let small = finer < largest / 8.0 || finer < 1e-3;
            assert!(
                small,
                "{sharing:?}, line {line}, step {step}: {finer} of {largest}"
            );
        }
        assert!(all_changes > 100, "{sharing:?}: {all_changes}");
    }
}

#[test]
fn the_few_guides_looked_at_give_what_all_guides_give() {
    let mesh = square();
    for sharing in ways() {
        let few = guides(&mesh, &sharing);
        let mut all = few.clone();
        let roots = all.frames.iter().map(|f| f.position).collect();
        if sharing.nearest() <= 4 {
            continue;
        }
        all.locator = crate::Locator::new(&mesh, roots, 100);
        for i in 0..2000 {
            let at = root(Vec3::new(random(i), random(i + 7000), 0.0));
            let [a, b] = [&few, &all].map(|guides| weights(&sharing, guides, &at));
            assert_eq!(a, b, "{sharing:?}, root {i}");
        }
    }
}

#[test]
fn a_root_on_a_guide_gives_that_guide() {
    let mesh = square();
    for sharing in ways() {
        let guides = guides(&mesh, &sharing);
        for guide in 0..guides.len() {
            let found = weights(&sharing, &guides, &root(guides.frames[guide].position));
            assert_eq!(found[guide], 1.0, "{sharing:?}, guide {guide}");
        }
    }
}

#[test]
fn any_number_of_guides_shares_a_hair_completely() {
    let mesh = square();
    for sharing in ways() {
        for count in (1..12).chain([24, 25, 48, 49]) {
            let guides = some_guides(&mesh, &sharing, count);
            for i in 0..200 {
                let at = root(Vec3::new(random(i), random(i + 7000), 0.0));
                let found = weights(&sharing, &guides, &at);
                let sum: f32 = found.iter().sum();
                assert!(
                    (sum - 1.0).abs() < 1e-5,
                    "{sharing:?}, {count} guides: {sum}"
                );
                assert!(found.iter().all(|w| (0.0..=1.0).contains(w)));
            }
        }
    }
}

#[test]
fn natural_neighbors_give_the_root_back_as_the_mean_of_their_places() {
    let mesh = square();
    let sharing = Sharing {
        method: Method::NaturalNeighbor,
        wanted: 3,
        facing: None,
    };
    let guides = guides(&mesh, &sharing);
    for i in 0..2000 {
        let at = Vec3::new(random(i), random(i + 7000), 0.0) * 0.6 + 0.2 * (Vec3::X + Vec3::Y);
        let found = weights(&sharing, &guides, &RootFrame::new(at, Vec3::X, Vec3::Z));
        let places = guides.frames.iter().zip(&found);
        let mean: Vec3 = places.map(|(frame, &w)| frame.position * w).sum();
        assert!(mean.distance(at) < 1e-5, "{at} {mean}");
    }
}
