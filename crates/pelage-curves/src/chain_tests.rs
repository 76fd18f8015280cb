use super::*;
use crate::frenet::{CatmullRom, Measure};
use crate::{Basis, Bend, CubicBasis, Vec3, Wrap, resample};
use proptest::prelude::*;

fn points(least: usize) -> impl Strategy<Value = Vec<DVec3>> {
    let point = prop::array::uniform3(-9.0f64..9.0).prop_map(DVec3::from);
    prop::collection::vec(point, least..9)
}

/// Small integers: vertices that coincide are common.
fn coarse() -> impl Strategy<Value = Vec<DVec3>> {
    let point = prop::array::uniform3(-1i8..2).prop_map(|p| DVec3::from(p.map(f64::from)));
    prop::collection::vec(point, 1..9)
}

/// Barry and Goldman's pyramid, the definition of the curve.
fn pyramid(window: [DVec3; 4], intervals: [f64; 3], t: f64) -> DVec3 {
    let mut knots = [0.0; 4];
    for i in 0..3 {
        knots[i + 1] = knots[i] + intervals[i];
    }
    let u = knots[1] + intervals[1] * t;
    let mix =
        |p: DVec3, q: DVec3, a: f64, b: f64| p * ((b - u) / (b - a)) + q * ((u - a) / (b - a));
    let [k0, k1, k2, k3] = knots;
    let a = mix(window[0], window[1], k0, k1);
    let b = mix(window[1], window[2], k1, k2);
    let c = mix(window[2], window[3], k2, k3);
    mix(mix(a, b, k0, k2), mix(b, c, k1, k3), k1, k2)
}

proptest! {
    #[test]
    fn inner_pieces_are_barry_and_goldmans(
        p in points(4), alpha in 0.0f64..=1.0, t in 0.0f64..1.0,
    ) {
        for alpha in [0.0, 0.5, 1.0, alpha] {
            let curve = Chain::catmull_rom(&p, alpha).unwrap();
            for i in 1..p.len() - 2 {
                let window = [p[i - 1], p[i], p[i + 1], p[i + 2]];
                let power = |k: usize| libm::pow(window[k].distance(window[k + 1]), alpha);
                let exact = pyramid(window, [0, 1, 2].map(power), t);
                let found = curve.at(i, t)[0];
                prop_assert!(found.distance(exact) < 1e-9, "{alpha} {i}: {found} {exact}");
            }
        }
    }

    #[test]
    fn the_uniform_chain_is_the_catmull_rom_curve(p in coarse(), t in 0.0f64..1.0) {
        let (chain, curve) = (Chain::catmull_rom(&p, 0.0).unwrap(), CatmullRom::new(&p).unwrap());
        prop_assert_eq!(chain.pieces(), curve.pieces());
        for i in 0..chain.pieces() {
            for (a, b) in chain.at(i, t).iter().zip(curve.at(i, t)) {
                prop_assert!(a.distance(b) < 1e-12, "{} {}", a, b);
            }
        }
    }

    #[test]
    fn whatever_the_points_and_the_exponent_nothing_is_nan_and_all_are_passed(
        p in coarse(), alpha in 0.0f64..=1.0, exponent in -90i32..90, closed: bool,
    ) {
        let scale = libm::pow(10.0, exponent as f64);
        let p: Vec<DVec3> = p.iter().map(|p| *p * scale).collect();
        let chain = match closed {
            true => Chain::closed_catmull_rom(&p, alpha),
            false => Chain::catmull_rom(&p, alpha),
        }.unwrap();
        for (i, p) in p.iter().enumerate() {
            prop_assert_eq!(chain.points()[3 * i], *p);
        }
        prop_assert!(chain.points().iter().all(|p| p.is_finite()));
        let length = Measure::new(&chain).unwrap().total();
        prop_assert!(length.is_finite());
        let even = resample(&chain, 7).unwrap();
        prop_assert!(even.iter().all(|p| p.is_finite()));
        for i in 0..chain.pieces() {
            if let Some(bend) = Bend::of(chain.jet(i, 0.5)) {
                prop_assert!(bend.curvature >= 0.0 && bend.torsion.is_finite());
            }
        }
    }

    #[test]
    fn parts_and_bounds_are_those_of_the_whole(p in points(2), at in 0.0f64..1.0, t in 0.0f64..1.0) {
        let chain = Chain::catmull_rom(&p, 0.5).unwrap();
        let piece = chain.pieces() / 2;
        let [left, right] = chain.split(piece, at);
        prop_assert_eq!(left.pieces() + right.pieces(), chain.pieces() + 1);
        prop_assert!(left.at(piece, t)[0].distance(chain.at(piece, at * t)[0]) < 1e-12);
        let along = at + (1.0 - at) * t;
        prop_assert!(right.at(0, t)[0].distance(chain.at(piece, along)[0]) < 1e-12);
        let (l, h) = (left.bounds(), right.bounds());
        let whole = chain.bounds();
        prop_assert!(l.0.min(h.0).distance(whole.0) < 1e-12);
        prop_assert!(l.1.max(h.1).distance(whole.1) < 1e-12);
    }
}

proptest! {
    /// Cusps, and pieces of very unequal length among the coarse ones.
    #[test]
    fn what_is_cut_off_at_a_length_has_that_length_to_1e_10(
        coarse in coarse(), fine in points(2), alpha in 0.0f64..=1.0, at in 0.0f64..1.0,
    ) {
        for p in [coarse, fine] {
            let chain = Chain::catmull_rom(&p, alpha).unwrap();
            let measure = Measure::new(&chain).unwrap();
            let total = measure.total();
            let (piece, t) = measure.locate(&chain, total * at);
            let [left, right] = chain.split(piece, t).map(|c| Measure::new(&c).unwrap().total());
            prop_assert!((left + right - total).abs() <= 1e-10 * total);
            prop_assert!((left - total * at).abs() <= 1e-10 * total, "{left} {}", total * at);
        }
    }
}

#[test]
fn curvature_and_torsion_of_a_piece_of_a_helix_come_out_to_the_second_order() {
    let mut before = f64::INFINITY;
    for step in [0.8, 0.4, 0.2, 0.1] {
        let at = |a: f64| DVec3::new(libm::cos(a), libm::sin(a), a);
        let slope = |a: f64| DVec3::new(-libm::sin(a), libm::cos(a), 1.0) * step;
        let ends = [at(0.0), at(step), slope(0.0), slope(step)];
        let bend = Bend::of(CubicBasis::Hermite.to_cubic(ends).jet(0.5)).unwrap();
        let error = (bend.curvature - 0.5).abs() + (bend.torsion - 0.5).abs();
        assert!(error < before / 3.5, "{step}: {error}");
        before = error;
    }
    assert!(before < 1e-3);
}

#[test]
fn the_centripetal_curve_overshoots_a_short_edge_less_than_the_uniform_one() {
    let p = [[0.0, 0.0], [10.0, 0.0], [10.0, 0.5], [0.0, 0.5]].map(|[x, y]| DVec3::new(x, y, 0.0));
    let widest = |alpha| Chain::catmull_rom(&p, alpha).unwrap().bounds().1.x;
    assert!(widest(0.5) < widest(0.0), "{} {}", widest(0.5), widest(0.0));
}

#[test]
fn doubled_vertices_are_ends_unless_the_curve_is_uniform() {
    let [a, b, c] = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0)];
    let joined = Chain::catmull_rom(&[a, b, b, c], 0.5).unwrap();
    let alone = Chain::catmull_rom(&[a, b], 0.5).unwrap();
    assert_eq!(joined.piece(0), alone.piece(0));
    assert_eq!(joined.piece(1), Cubic([b; 4]));
}

#[test]
fn a_curve_becomes_the_chain_it_is() {
    let p = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::ONE];
    for basis in [Basis::Linear, Basis::BSpline, Basis::CatmullRom] {
        for wrap in [Wrap::Periodic, Wrap::Pinned] {
            let curve = Curve::new(&p, basis, wrap).unwrap();
            let chain = Chain::of_curve(&curve).unwrap();
            for i in 0..curve.segments() {
                let (found, exact) = (chain.at(i, 0.3)[0], curve.position(i, 0.3).as_dvec3());
                assert!(found.distance(exact) < 1e-6, "{basis:?} {wrap:?}");
            }
        }
    }
}

#[test]
fn what_is_no_chain_is_told() {
    let p = [DVec3::X, DVec3::NAN];
    let not_finite = Err(SplineError::NotFinite { index: 1 });
    assert_eq!(Chain::catmull_rom(&p, 0.5), not_finite);
    assert_eq!(
        Chain::closed_catmull_rom(&[DVec3::X, DVec3::X * 1e200], 0.5),
        not_finite
    );
    assert!(matches!(
        Chain::catmull_rom(&[], 0.5),
        Err(SplineError::Points { found: 0, .. })
    ));
    assert!(matches!(
        Chain::catmull_rom(&p, f64::NAN),
        Err(SplineError::Alpha { .. })
    ));
    assert!(matches!(
        Chain::bezier(&[DVec3::X; 6]),
        Err(SplineError::Points { found: 6, .. })
    ));
}

#[test]
fn ten_million_vertices_are_a_curve() {
    let at = |i: usize| (i % 1000) as f64;
    let p: Vec<DVec3> = (0..10_000_000)
        .map(|i| DVec3::new(at(i), at(i / 1000), 0.0))
        .collect();
    let chain = Chain::catmull_rom(&p, 0.5).unwrap();
    assert_eq!(chain.pieces(), p.len() - 1);
    assert!(chain.points().iter().all(|p| p.is_finite()));
    let (low, high) = chain.bounds();
    assert!(low.min_element() > -9.0 && high.x < 1009.0 && high.y < 10_009.0);
}

#[test]
fn a_line_that_folds_has_the_length_of_all_its_ways_to_1e_10() {
    for i in 0..2000 {
        let fold = 8.0 + i as f64 * 1e-2;
        let points = [0.0, fold, 1.0 - fold * 1.1, 1.0].map(|x| DVec3::new(x, x, 0.0));
        let chain = Chain::bezier(&points).unwrap();
        // There to the highest, back to the lowest, there to the end.
        let (low, high) = chain.bounds();
        let exact = (high.x + (high.x - low.x) + (1.0 - low.x)) * std::f64::consts::SQRT_2;
        let total = Measure::new(&chain).unwrap().total();
        assert!(
            (total / exact - 1.0).abs() < 1e-10,
            "{fold}: {total} {exact}"
        );
    }
}
