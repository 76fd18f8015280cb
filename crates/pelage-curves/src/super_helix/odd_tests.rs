//! Targets that are hardly curves.

use super::*;
use crate::frenet::{CatmullRom, FrenetError};
use crate::super_helix::baseline::{floating_tangents, root_to_tip};
use crate::{Chain, DVec3};

const GOALS: [Goal; 2] = [Goal::Elements(3), Goal::RelativeError(0.01)];

fn all_numbers(curve: &SuperHelix) -> bool {
    let good = |e: &crate::super_helix::Element| e.length >= 0.0 && e.rate().is_finite();
    curve.elements().iter().all(good) && curve.points(50).iter().all(|p| p.is_finite())
}

#[test]
fn curves_without_length_are_a_point() {
    for points in [vec![DVec3::ONE], vec![DVec3::ONE; 5]] {
        let target = CatmullRom::new(&points).unwrap();
        for goal in GOALS {
            let found = fit(&target, &Settings::new(goal)).unwrap();
            assert_eq!(found.curve.length(), 0.0);
            assert_eq!(found.curve.at(0.0).position, DVec3::ONE);
            assert!(found.kept && found.worst == 0.0);
        }
        for curve in [root_to_tip(&target, 3), floating_tangents(&target, 3)] {
            assert_eq!(curve.unwrap().at(1.0).position, DVec3::ONE);
        }
    }
}

#[test]
fn a_straight_line_is_one_element_to_rounding() {
    let line = [DVec3::ZERO, DVec3::X, DVec3::X * 3.0];
    for target in [
        Chain::polygon(&line).unwrap(),
        Chain::catmull_rom(&line, 0.0).unwrap(),
    ] {
        let found = fit(&target, &Settings::new(Goal::Error(1e-4))).unwrap();
        assert_eq!(found.curve.elements().len(), 1);
        assert!(found.curve.at(3.0).position.distance(line[2]) < 1e-9);
        let many = fit(&target, &Settings::new(Goal::Elements(6))).unwrap();
        assert_eq!(many.curve.elements().len(), 6);
        assert!(many.worst < 1e-5 && all_numbers(&many.curve));
    }
}

#[test]
fn points_that_coincide_and_lines_that_turn_back_are_fitted() {
    let back = [DVec3::ZERO, DVec3::X, DVec3::X, DVec3::X, DVec3::ZERO];
    let corner = [DVec3::ZERO, DVec3::X, DVec3::X, DVec3::X + DVec3::Y];
    for points in [&back[..], &corner[..]] {
        for target in [
            Chain::polygon(points).unwrap(),
            Chain::catmull_rom(points, 0.5).unwrap(),
        ] {
            for goal in [Goal::Elements(3), Goal::RelativeError(0.02)] {
                let found = fit(&target, &Settings::new(goal)).unwrap();
                assert!(all_numbers(&found.curve) && found.kept, "{goal:?}");
            }
            for curve in [root_to_tip(&target, 9), floating_tangents(&target, 9)] {
                assert!(all_numbers(&curve.unwrap()));
            }
        }
    }
}

#[test]
fn what_is_no_number_is_refused() {
    let bad = SuperHelix::of_parts(DVec3::NAN, DMat3::IDENTITY, vec![Default::default()]);
    let settings = Settings::new(Goal::Elements(2));
    let not = FitError::Target(FrenetError::NotFinite { index: 0 });
    assert_eq!(fit(&bad, &settings).unwrap_err(), not);
    let line = Chain::polygon(&[DVec3::ZERO, DVec3::X]).unwrap();
    for (goal, error) in [
        (Goal::Elements(0), FitError::NoElements),
        (Goal::Error(-1.0), FitError::Bound { found: -1.0 }),
        (Goal::RelativeError(0.0), FitError::Bound { found: 0.0 }),
    ] {
        assert_eq!(fit(&line, &Settings::new(goal)).unwrap_err(), error);
    }
    let settings = Settings {
        orientation: -1.0,
        ..settings
    };
    let error = FitError::Orientation { found: -1.0 };
    assert_eq!(fit(&line, &settings).unwrap_err(), error);
    assert_eq!(root_to_tip(&line, 0), Err(FitError::NoElements));
    assert_eq!(floating_tangents(&line, 0), Err(FitError::NoElements));
}

#[test]
fn a_strand_of_a_hundred_thousand_points_is_fitted() {
    let points: Vec<DVec3> = (0..100_000)
        .map(|i| i as f64 * 1e-4)
        .map(|x| DVec3::new(libm::cos(2.0 * x), libm::sin(2.0 * x), x))
        .collect();
    let target = CatmullRom::new(&points).unwrap();
    let found = fit(&target, &Settings::new(Goal::RelativeError(0.001))).unwrap();
    assert!(found.kept);
    assert_eq!(found.curve.elements().len(), 1);
}

#[test]
fn lengths_far_from_one_are_as_good() {
    for unit in [1e-60, 1e-3, 1e60] {
        let points: Vec<DVec3> = (0..40)
            .map(|i| i as f64 * 0.2)
            .map(|x| DVec3::new(libm::cos(x), libm::sin(x), x) * unit)
            .collect();
        let target = CatmullRom::new(&points).unwrap();
        let found = fit(&target, &Settings::new(Goal::RelativeError(0.01))).unwrap();
        assert!(found.kept && all_numbers(&found.curve), "{unit}");
        assert!(found.curve.elements().len() <= 2, "{unit}");
    }
}
