use super::*;
use crate::frenet::{Measure, SpaceCurve};
use crate::{Bend, Jet};
use proptest::prelude::*;

/// A curve of any degree over uneven knots, some of them multiple, with uneven weights.
fn any_curve() -> impl Strategy<Value = Nurbs> {
    let shape = (1usize..8, 0usize..9);
    shape
        .prop_flat_map(|(degree, more)| {
            let n = degree + 1 + more;
            let point = prop::array::uniform3(-9.0f64..9.0).prop_map(DVec3::from);
            let points = prop::collection::vec(point, n);
            let weights = prop::collection::vec(0.1f64..10.0, n);
            let steps =
                prop::collection::vec((0u8..3).prop_map(|s| [0.0, 0.3, 1.7][s as usize]), more);
            (points, weights, steps, any::<bool>()).prop_map(
                move |(points, weights, steps, rational)| {
                    let mut knots = vec![0.0; degree + 1];
                    for step in steps {
                        knots.push(knots[knots.len() - 1] + step);
                    }
                    knots.extend(vec![knots[knots.len() - 1] + 1.0; degree + 1]);
                    let weights = if rational { weights } else { vec![2.0; n] };
                    Nurbs::new(degree, &points, &weights, &knots)
                },
            )
        })
        .prop_filter_map("a knot that is there too often", Result::ok)
}

/// The definition: Cox and de Boor's recursion over all control points.
fn cox_de_boor(curve: &Nurbs, u: f64) -> DVec3 {
    fn basis(knots: &[f64], i: usize, degree: usize, u: f64) -> f64 {
        if degree == 0 {
            return f64::from(u8::from(knots[i] <= u && u < knots[i + 1]));
        }
        let part = |numerator: f64, denominator: f64, rest: &dyn Fn() -> f64| match denominator {
            0.0 => 0.0,
            _ => numerator / denominator * rest(),
        };
        let (a, b) = (knots[i], knots[i + degree]);
        let (c, d) = (knots[i + 1], knots[i + degree + 1]);
        part(u - a, b - a, &|| basis(knots, i, degree - 1, u))
            + part(d - u, d - c, &|| basis(knots, i + 1, degree - 1, u))
    }
    let weight = |i| basis(&curve.knots, i, curve.degree, u);
    let sum: DVec4 = curve
        .controls
        .iter()
        .enumerate()
        .map(|(i, &c)| c * weight(i))
        .sum();
    sum.truncate() / sum.w
}

proptest! {
    #[test]
    fn positions_are_those_of_cox_and_de_boor(curve in any_curve(), t in 0.0f64..1.0) {
        let (low, high) = curve.domain();
        let u = low + (high - low) * t;
        let (found, exact) = (curve.position(u), cox_de_boor(&curve, u));
        prop_assert!(found.distance(exact) < 1e-11, "{} {}", found, exact);
    }

    #[test]
    fn derivatives_are_limits_of_differences(curve in any_curve(), t in 0.02f64..0.98) {
        for piece in 0..curve.pieces() {
            let h = 1e-5;
            let (before, here) = (curve.jet(piece, t - h), curve.jet(piece, t));
            let after = curve.jet(piece, t + h);
            for order in 0..3 {
                let slope = (after[order] - before[order]) / (2.0 * h);
                let size = here.iter().map(|d| d.length()).fold(1.0, f64::max);
                let miss = slope.distance(here[order + 1]);
                // Rounding of a difference and h² times a fifth derivative at most.
                prop_assert!(miss < 2e-5 * size, "{order}: {miss} of {size}");
            }
        }
    }

    #[test]
    fn another_knot_and_a_split_change_nothing(
        curve in any_curve(), at in 0.01f64..0.99, t in 0.0f64..1.0,
    ) {
        let (low, high) = curve.domain();
        let (cut, u) = (low + (high - low) * at, low + (high - low) * t);
        let exact = curve.position(u);
        let more = curve.with_knot(cut).unwrap();
        prop_assert_eq!(more.points().len(), curve.points().len() + 1);
        prop_assert!(more.position(u).distance(exact) < 1e-11);
        let [left, right] = curve.split(cut).unwrap();
        prop_assert_eq!((left.domain(), right.domain()), ((low, cut), (cut, high)));
        let half = if u < cut { left } else { right };
        prop_assert!(half.position(u).distance(exact) < 1e-11);
    }

    #[test]
    fn a_split_at_a_knot_changes_nothing_either(curve in any_curve(), t in 0.0f64..1.0) {
        for &cut in &curve.breaks[1..curve.breaks.len() - 1] {
            let [left, right] = curve.split(cut).unwrap();
            let u = left.breaks[0] + (cut - left.breaks[0]) * t;
            prop_assert!(left.position(u).distance(curve.position(u)) < 1e-11);
            let u = cut + (right.domain().1 - cut) * t;
            prop_assert!(right.position(u).distance(curve.position(u)) < 1e-11);
        }
    }

    #[test]
    fn bounds_hold_the_curve_and_touch_it(curve in any_curve()) {
        let (low, high) = curve.bounds();
        let mut seen = (curve.position(0.0), curve.position(0.0));
        for piece in 0..curve.pieces() {
            for i in 0..=500 {
                let p = curve.at(piece, i as f64 / 500.0)[0];
                seen = (seen.0.min(p), seen.1.max(p));
            }
        }
        prop_assert!((seen.0 - low).min_element() > -1e-11);
        prop_assert!((high - seen.1).min_element() > -1e-11);
        prop_assert!((seen.0 - low).max_element() < 2e-2);
        prop_assert!((high - seen.1).max_element() < 2e-2);
    }

    #[test]
    fn whatever_the_numbers_nothing_is_nan_and_nothing_panics(
        degree in 0usize..6, exponent in -99i32..99,
        points in prop::collection::vec(prop::array::uniform3(-1i8..2), 0..12),
        weights in prop::collection::vec(-1i8..9, 0..12),
        knots in prop::collection::vec(-3i8..4, 0..20), sorted: bool, u in -9.0f64..9.0,
    ) {
        let scale = libm::pow(10.0, exponent as f64);
        let points: Vec<DVec3> =
            points.iter().map(|p| DVec3::from(p.map(f64::from)) * scale).collect();
        let weights: Vec<f64> = weights.iter().map(|&w| f64::from(w)).collect();
        let mut knots: Vec<f64> = knots.iter().map(|&k| f64::from(k)).collect();
        if sorted {
            knots.sort_by(f64::total_cmp);
        }
        let _ = Nurbs::new(degree, &points, &weights, &knots);
        let ones = vec![1.0; points.len()];
        knots.resize(points.len() + degree + 1, 4.0);
        let curves = [
            Nurbs::new(degree, &points, &ones, &knots),
            Nurbs::clamped(degree, &points),
            Nurbs::closed(degree, &points),
            Nurbs::bezier(&points),
        ];
        for curve in curves.into_iter().flatten() {
            let jet = curve.derivatives(u);
            prop_assert!(jet.iter().all(|d| d.is_finite()), "{jet:?}");
            if let Some(bend) = Bend::of(jet) {
                prop_assert!(bend.curvature.is_finite() && bend.torsion.is_finite());
            }
            prop_assert!(Measure::new(&curve).unwrap().total().is_finite());
            let (low, high) = curve.bounds();
            prop_assert!(low.is_finite() && high.is_finite() && low.cmple(high).all());
            let _ = curve.split(u);
        }
    }
}

/// The circle of `radius` in the xy plane, of nine points.
pub(crate) fn circle(radius: f64) -> Nurbs {
    let corner = std::f64::consts::FRAC_1_SQRT_2;
    let around = [
        [1, 0],
        [1, 1],
        [0, 1],
        [-1, 1],
        [-1, 0],
        [-1, -1],
        [0, -1],
        [1, -1],
        [1, 0],
    ];
    let points = around.map(|[x, y]| DVec3::new(x as f64, y as f64, 0.0) * radius);
    let weights: Vec<f64> = (0..9)
        .map(|i| if i % 2 == 0 { 1.0 } else { corner })
        .collect();
    let knots = [0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0];
    Nurbs::new(2, &points, &weights, &knots).unwrap()
}

#[test]
fn a_circle_has_its_radius_curvature_length_and_box() {
    let circle = circle(1.0);
    for i in 0..100 {
        let jet = circle.derivatives(i as f64 / 25.0);
        assert!((jet[0].length() - 1.0).abs() < 1e-15);
        let bend = Bend::of(jet).unwrap();
        assert!((bend.curvature - 1.0).abs() < 1e-13 && bend.torsion == 0.0);
    }
    let length = Measure::new(&circle).unwrap().total();
    assert!((length / std::f64::consts::TAU - 1.0).abs() < 1e-10);
    let (low, high) = circle.bounds();
    assert!(low.distance(DVec3::new(-1.0, -1.0, 0.0)) < 1e-11);
    assert!(high.distance(DVec3::new(1.0, 1.0, 0.0)) < 1e-11);
}

#[test]
fn a_curve_of_high_degree_is_its_bernstein_polynomial() {
    // x = u, so that all of it lies on the line; y = the product of two such.
    for degree in [3, 4, 7, 40, 255] {
        let n = degree as f64;
        let points: Vec<DVec3> = (0..=degree)
            .map(|i| i as f64)
            .map(|i| DVec3::new(i / n, i * (i - 1.0) / (n * (n - 1.0)), 0.0))
            .collect();
        let curve = Nurbs::bezier(&points).unwrap();
        for i in 0..=20 {
            let u = i as f64 / 20.0;
            let [p, d, e, f] = curve.derivatives(u);
            assert!(
                p.distance(DVec3::new(u, u * u, 0.0)) < 1e-13,
                "{degree} {u}: {p}"
            );
            assert!(
                d.distance(DVec3::new(1.0, 2.0 * u, 0.0)) < 1e-10,
                "{degree}: {d}"
            );
            assert!(e.distance(DVec3::Y * 2.0) < 1e-7, "{degree}: {e}");
            assert!(f.length() < 1e-5 * n, "{degree}: {f}");
        }
    }
}

#[test]
fn a_closed_curve_has_no_seam() {
    let points = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ONE, DVec3::NEG_X];
    let curve = Nurbs::closed(4, &points).unwrap();
    let (start, end) = (curve.jet(0, 0.0), curve.jet(4, 1.0));
    for (a, b) in start.iter().zip(end) {
        assert!(a.distance(b) < 1e-13);
    }
}

#[test]
fn what_is_no_curve_is_told() {
    let p = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let k = [0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0];
    let one = [1.0; 4];
    let make =
        |degree, weights: &[f64], knots: &[f64]| Nurbs::new(degree, &p, weights, knots).err();
    assert_eq!(make(2, &one, &k), None);
    assert_eq!(make(0, &one, &k), Some(SplineError::Degree { found: 0 }));
    assert_eq!(
        make(256, &one, &k),
        Some(SplineError::Degree { found: 256 })
    );
    assert!(matches!(
        make(4, &one, &k),
        Some(SplineError::Points { found: 4, .. })
    ));
    assert_eq!(
        make(2, &one[1..], &k),
        Some(SplineError::WeightCount {
            found: 3,
            points: 4
        })
    );
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let found = make(2, &[1.0, 1.0, bad, 1.0], &k);
        assert!(
            matches!(found, Some(SplineError::Weight { index: 2, .. })),
            "{bad}: {found:?}"
        );
    }
    assert_eq!(
        make(2, &one, &k[1..]),
        Some(SplineError::KnotCount {
            found: 6,
            needed: 7
        })
    );
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        let found = make(2, &one, &[0.0, 0.0, 0.0, bad, 2.0, 2.0, 2.0]);
        assert!(
            matches!(found, Some(SplineError::Knot { index: 3, .. })),
            "{bad}: {found:?}"
        );
    }
    assert_eq!(make(2, &one, &[1.0; 7]), Some(SplineError::NoDomain));
    let near = [0.0, 0.0, 0.0, 1e-70, 2.0, 2.0, 2.0];
    assert_eq!(
        make(2, &one, &near),
        Some(SplineError::CrowdedKnot { index: 3 })
    );
    let broken = make(1, &one, &[0.0, 0.0, 1.0, 1.0, 2.0, 2.0]);
    assert_eq!(broken, Some(SplineError::CrowdedKnot { index: 3 }));
    let curve = Nurbs::new(2, &p, &one, &k).unwrap();
    for u in [0.0, 2.0, -1.0, f64::NAN] {
        assert!(matches!(curve.split(u), Err(SplineError::Parameter { .. })));
    }
}

#[test]
fn a_million_control_points_are_a_curve() {
    let at = |i: usize| i as f64 * 1e-2;
    let points: Vec<DVec3> = (0..1_000_000)
        .map(|i| DVec3::new(libm::cos(at(i)), libm::sin(at(i)), at(i)))
        .collect();
    let curve = Nurbs::clamped(3, &points).unwrap();
    assert_eq!(curve.pieces(), 999_997);
    let length = Measure::new(&curve).unwrap().total();
    let exact = 1e-2 * 999_999.0 * std::f64::consts::SQRT_2;
    assert!((length / exact - 1.0).abs() < 1e-4, "{length} {exact}");
    assert!(curve.bounds().1.z < 1e4);
}
