use super::*;
use crate::frenet::Measure;
use crate::super_helix::baseline::{floating_tangents, root_to_tip};
use crate::super_helix::{Element, Solver};
use crate::{Chain, DVec3, Nurbs};

/// Wave, curl, coil and knot.
fn strands() -> [Chain; 4] {
    let (sin, cos) = (libm::sin, libm::cos);
    let wave = |t: f64| DVec3::new(0.05 * (0.3 + t) * sin(26.0 * t), 0.2 * t * t, t);
    let curl = |t: f64| DVec3::new(0.06 * cos(22.0 * t), 0.06 * (0.5 + t) * sin(22.0 * t), t);
    let coil = |t: f64| DVec3::new(0.05 * cos(50.0 * t), 0.05 * sin(50.0 * t), t + 0.1 * t * t);
    let knot = |t: f64| {
        let u = 6.0 * t + 0.1;
        DVec3::new(
            sin(u) + 2.0 * sin(2.0 * u),
            cos(u) - 2.0 * cos(2.0 * u),
            -sin(3.0 * u),
        )
    };
    let chain = |at: &dyn Fn(f64) -> DVec3| {
        let points: Vec<DVec3> = (0..100).map(|i| at(i as f64 / 99.0)).collect();
        Chain::catmull_rom(&points, 0.5).unwrap()
    };
    [chain(&wave), chain(&curl), chain(&coil), chain(&knot)]
}

/// Largest distance at equal parts of the lengths, over many places.
fn worst(target: &impl SpaceCurve, curve: &SuperHelix, places: usize) -> f64 {
    let measure = Measure::new(target).unwrap();
    let distance = |i: usize| {
        let part = i as f64 / places as f64;
        let (piece, t) = measure.locate(target, part * measure.total());
        let there = target.at(piece, t)[0];
        there.distance(curve.at(part * curve.length()).position)
    };
    (0..=places).map(distance).fold(0.0, f64::max)
}

#[test]
fn a_super_helix_is_found_again_with_its_own_number_of_elements() {
    let cases: [&[(f64, [f64; 3])]; 4] = [
        &[(2.0, [1.0, 2.0, 0.5])],
        &[
            (1.0, [0.0, 1.0, 1.5]),
            (1.0, [0.5, -1.0, 2.0]),
            (1.0, [3.0, 2.0, 0.0]),
        ],
        &[
            (0.6, [2.0, 3.0, 1.0]),
            (1.1, [-1.0, 0.5, 2.0]),
            (0.8, [0.0, -3.0, 1.0]),
            (1.0, [2.0, 2.0, -2.0]),
        ],
        &[(1.0, [20.0, 9.0, 3.0]), (2.0, [12.0, 2.0, 8.0])],
    ];
    for case in cases {
        let elements = case
            .iter()
            .map(|&(length, q)| Element::new(length, DVec3::from(q)));
        let elements: Vec<Element> = elements.collect();
        let target = SuperHelix::new(DVec3::ONE, Frame::IDENTITY, &elements).unwrap();
        for solver in [Solver::Sweep, Solver::ConjugateGradients] {
            let settings = Settings {
                solver,
                ..Settings::new(Goal::Elements(elements.len()))
            };
            let found = fit(&target, &settings).unwrap();
            let miss = worst(&target, &found.curve, 1000) / target.length();
            assert!(
                miss < 1e-6,
                "{} elements by {solver:?}: {miss}",
                elements.len()
            );
            for (a, b) in found.curve.elements().iter().zip(&elements) {
                assert!((a.length - b.length).abs() < 1e-5 * target.length());
                assert!((a.twist - b.twist).abs() < 1e-3);
            }
        }
    }
}

#[test]
fn the_length_is_kept_to_the_bit() {
    for target in strands() {
        let length = Measure::new(&target).unwrap().total();
        for goal in [
            Goal::Elements(1),
            Goal::Elements(7),
            Goal::RelativeError(0.02),
        ] {
            let found = fit(&target, &Settings::new(goal)).unwrap();
            assert_eq!(found.curve.length(), length, "{goal:?}");
            let lengths = found.curve.elements().iter().map(|e| e.length);
            assert_eq!(lengths.rev().sum::<f64>(), length, "in the other order");
        }
    }
}

#[test]
fn a_bound_is_kept_wherever_one_looks() {
    for target in strands() {
        let length = Measure::new(&target).unwrap().total();
        for bound in [0.05, 0.01, 0.001] {
            for goal in [Goal::RelativeError(bound), Goal::Error(bound * length)] {
                let found = fit(&target, &Settings::new(goal)).unwrap();
                assert!(found.kept && found.worst <= bound * length);
                let seen = worst(&target, &found.curve, 20_000);
                assert!(
                    seen <= found.worst + 1e-9 * length,
                    "{seen} above {}",
                    found.worst
                );
            }
        }
    }
}

#[test]
fn the_error_told_is_an_upper_bound_and_near() {
    for target in strands() {
        let found = fit(&target, &Settings::new(Goal::Elements(6))).unwrap();
        let seen = worst(&target, &found.curve, 20_000);
        let length = found.curve.length();
        assert!(seen <= found.worst + 1e-9 * length);
        assert!(
            found.worst <= 1.02 * seen + 1e-6 * length,
            "{} over {seen}",
            found.worst
        );
    }
}

#[test]
fn the_error_never_rises_as_elements_are_added() {
    for target in strands() {
        let settings = Settings {
            start: Some(24),
            ..Settings::new(Goal::Elements(2))
        };
        let reached = fit(&target, &settings).unwrap().reached;
        assert_eq!(reached.first().unwrap().elements, 2);
        assert_eq!(reached.last().unwrap().elements, 24);
        for pair in reached.windows(2) {
            assert_eq!(pair[0].elements + 1, pair[1].elements);
            assert!(pair[1].worst <= pair[0].worst, "{pair:?}");
        }
    }
}

#[test]
fn no_element_turns_wildly_where_few_cannot_follow() {
    let turning = |curve: &dyn Fn(f64) -> DVec3| -> f64 {
        let tangents: Vec<DVec3> = (0..=2000).map(|i| curve(i as f64 / 2000.0)).collect();
        tangents.windows(2).map(|t| t[0].angle_between(t[1])).sum()
    };
    for target in strands() {
        let measure = Measure::new(&target).unwrap();
        let own = turning(&|part| {
            let (piece, t) = measure.locate(&target, part * measure.total());
            target.at(piece, t)[1]
        });
        for elements in 1..12 {
            for move_joints in [true, false] {
                let settings = Settings {
                    move_joints,
                    ..Settings::new(Goal::Elements(elements))
                };
                let found = fit(&target, &settings).unwrap().curve;
                let fits = turning(&|part| found.at(part * found.length()).frame.tangent);
                assert!(fits < 5.0 * own, "{elements}: {fits} for {own}");
                let turns = found.elements().iter().map(|e| e.twist.abs() * e.length);
                let most = turns.fold(0.0, f64::max);
                assert!(most < 5.0 * own, "{elements}: {most} for {own}");
            }
        }
    }
}

#[test]
fn a_bound_that_few_elements_cannot_keep_is_told() {
    let [wave, ..] = strands();
    let settings = Settings {
        most_elements: 3,
        ..Settings::new(Goal::RelativeError(0.001))
    };
    let found = fit(&wave, &settings).unwrap();
    assert!(!found.kept && found.curve.elements().len() == 3);
    assert!(found.worst > 0.001 * found.curve.length());
}

#[test]
fn another_unit_that_is_a_power_of_two_changes_no_digit() {
    for target in strands() {
        let scaled: Vec<DVec3> = target.points().iter().map(|&p| p * 1024.0).collect();
        let settings = Settings::new(Goal::RelativeError(0.01));
        let found = fit(&target, &settings).unwrap();
        let large = fit(&Chain::bezier(&scaled).unwrap(), &settings).unwrap();
        for (a, b) in found.curve.elements().iter().zip(large.curve.elements()) {
            assert_eq!(a.length * 1024.0, b.length);
            assert_eq!(a.twist, b.twist * 1024.0);
        }
    }
}

#[test]
fn the_root_stands_on_the_target_and_turns_only_if_it_may() {
    for target in strands() {
        let tangent = target.at(0, 0.0)[1].normalize();
        for turn_root in [false, true] {
            let settings = Settings {
                turn_root,
                ..Settings::new(Goal::Elements(5))
            };
            let root = fit(&target, &settings).unwrap().curve.root();
            assert_eq!(root.position, target.points()[0]);
            let kept = root.frame.tangent.distance(tangent) < 1e-12;
            assert_eq!(kept, !turn_root);
        }
    }
}

#[test]
fn tangents_are_nearer_where_they_count() {
    let [wave, ..] = strands();
    let tangents = |orientation: f64| {
        let settings = Settings {
            orientation,
            ..Settings::new(Goal::Elements(9))
        };
        let curve = fit(&wave, &settings).unwrap().curve;
        let measure = Measure::new(&wave).unwrap();
        let miss = |i: usize| {
            let part = i as f64 / 500.0;
            let (piece, t) = measure.locate(&wave, part * measure.total());
            let tangent = wave.at(piece, t)[1].normalize();
            let own = curve.at(part * curve.length()).frame.tangent;
            own.distance_squared(tangent)
        };
        (0..=500).map(miss).sum::<f64>()
    };
    assert!(tangents(0.1) < tangents(0.0));
}

#[test]
fn nurbs_and_polygons_are_targets_too() {
    let points: Vec<DVec3> = (0..30)
        .map(|i| i as f64 * 0.3)
        .map(|x| DVec3::new(x, libm::sin(x), libm::cos(x)))
        .collect();
    let settings = Settings::new(Goal::RelativeError(0.01));
    let smooth = fit(&Nurbs::clamped(3, &points).unwrap(), &settings).unwrap();
    assert!(smooth.kept);
    assert!(smooth.curve.elements().len() <= 4);
    let polygon = fit(&Chain::polygon(&points).unwrap(), &settings).unwrap();
    assert!(polygon.kept);
    assert!(polygon.curve.elements().len() <= 4);
}

#[test]
fn from_the_root_to_the_tip_errors_grow_and_the_global_fit_stays_near() {
    for target in strands() {
        let naive = worst(&target, &root_to_tip(&target, 12).unwrap(), 1000);
        let found = fit(&target, &Settings::new(Goal::Elements(12))).unwrap();
        assert!(found.worst * 3.0 < naive, "{} {naive}", found.worst);
    }
}

#[test]
fn floating_tangents_pass_through_their_points_and_know_a_helix() {
    for target in strands() {
        let curve = floating_tangents(&target, 40).unwrap();
        let measure = Measure::new(&target).unwrap();
        let mut s = 0.0;
        for (i, element) in curve.elements().iter().enumerate() {
            let (piece, t) = measure.locate(&target, measure.total() * i as f64 / 40.0);
            let miss = curve.at(s).position.distance(target.at(piece, t)[0]);
            assert!(miss < 1e-6 * measure.total(), "point {i}: {miss}");
            s += element.length;
        }
    }
    for twist in [-2.0, 0.0, 3.0] {
        let element = Element::new(3.0, DVec3::new(twist, 1.0, 0.5));
        let helix = SuperHelix::new(DVec3::ZERO, Frame::IDENTITY, &[element]).unwrap();
        let found = floating_tangents(&helix, 5).unwrap();
        assert!(worst(&helix, &found, 100) < 1e-8, "{twist}");
    }
}
