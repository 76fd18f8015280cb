//! The trees against looking at everything.

use super::*;
use crate::sampling::{hash2, in_cone, point, unit};

fn random_cuts(count: u32, seed: u32) -> Cuts {
    let mut cuts = Cuts {
        starts: vec![0],
        ..Cuts::default()
    };
    let number = |i: u32, k: u32| unit(hash2(i, hash2(k, seed))) - 0.5;
    for i in 0..count {
        for k in 0..4 {
            let n = |axis: u32| number(i, axis) + 0.2 * number(i, 10 + 3 * k + axis);
            cuts.places.push([n(0), n(1), n(2), 0.01]);
            cuts.looks
                .push([0.5, 0.5, 0.5, if i % 3 == 0 { 1.0 } else { 0.4 }]);
        }
        cuts.starts.push(cuts.places.len() as u32);
    }
    cuts
}

fn random_ray(i: u32) -> Ray {
    let to = in_cone(Vec3::Z, -1.0, point(i, 5));
    let from = in_cone(Vec3::Z, -1.0, point(i, 6)) * 2.0;
    Ray::new(from, (to * 0.4 - from).normalize())
}

fn layers_by_looking(cuts: &Cuts, ray: &Ray, round: bool) -> Vec<Layer> {
    let mut all: Vec<Layer> = cuts
        .leaves()
        .into_iter()
        .filter_map(|leaf| {
            let i = leaf as usize;
            let (t, s) = cross(ray, &cuts.places[i], &cuts.places[i + 1], round)?;
            let (a, b) = (cuts.looks[i][3], cuts.looks[i + 1][3]);
            let opacity = a + (b - a) * s;
            (t >= 0.0).then_some(Layer {
                t,
                leaf,
                s,
                opacity,
            })
        })
        .collect();
    all.sort_by(|a, b| (a.t, a.leaf).partial_cmp(&(b.t, b.leaf)).unwrap());
    let mut light = 1.0;
    let dark = all.iter().position(|l| {
        light *= 1.0 - l.opacity;
        light < DARK
    });
    all.truncate(dark.map_or(all.len(), |d| d + 1).min(MOST_LAYERS));
    all
}

#[test]
fn the_tree_finds_the_layers_that_looking_at_every_leaf_finds() {
    for round in [false, true] {
        for seed in 0..4 {
            let cuts = random_cuts(700, seed);
            let tree = CurveTree::new(&cuts, round);
            let mut crossed = 0;
            for i in 0..400 {
                let ray = random_ray(i);
                let expected = layers_by_looking(&cuts, &ray, round);
                assert_eq!(tree.layers(&cuts, &ray, f32::INFINITY).found(), expected);
                crossed += expected.len();
            }
            assert!(crossed > 400, "the rays must cross hair to prove anything");
        }
    }
}

#[test]
fn crossings_count_every_leaf_but_ones_own() {
    let cuts = random_cuts(700, 9);
    let tree = CurveTree::new(&cuts, false);
    for i in 0..300 {
        let ray = random_ray(i);
        let own = 40..44;
        let by_looking: f32 = cuts
            .leaves()
            .into_iter()
            .map(|leaf| leaf as usize)
            .filter(|leaf| !own.contains(leaf))
            .filter_map(|i| {
                let (t, s) = cross(&ray, &cuts.places[i], &cuts.places[i + 1], false)?;
                let (a, b) = (cuts.looks[i][3], cuts.looks[i + 1][3]);
                (t > 0.1).then_some(a + (b - a) * s)
            })
            .sum();
        let found = tree.crossings(&cuts, &ray, 0.1, own, 100.0);
        assert!(
            (found - by_looking).abs() < 0.02,
            "{found} for {by_looking}"
        );
    }
}

#[test]
fn the_nearest_triangle_is_the_one_that_looking_at_all_finds() {
    let cuts = random_cuts(500, 2);
    let triangles: Vec<[Vec3; 3]> = (0..500)
        .map(|i| std::array::from_fn(|k| cuts.position(i * 4 + k)))
        .collect();
    let tree = SurfaceTree::new(&triangles);
    for i in 0..500 {
        let ray = random_ray(i);
        let by_looking = (0u32..)
            .zip(&triangles)
            .filter_map(|(triangle, t)| meet(&ray, t).map(|(t, _)| (t, triangle)))
            .filter(|hit| hit.0 >= 0.0)
            .min_by(|a, b| a.partial_cmp(b).unwrap());
        let found = tree.nearest(&ray, f32::INFINITY);
        assert_eq!(found.map(|h| (h.t, h.triangle)), by_looking);
        assert_eq!(tree.blocks(&ray, 0.0), by_looking.is_some());
    }
}
