//! What makes no section and no tube.

use super::*;
use crate::frenet::{Apparatus, FrenetError};
use crate::{Chain, Nurbs};
use glam::DVec2;

fn even(parts: usize) -> Tube {
    Tube {
        rings: Rings::Even(parts),
        ..Tube::default()
    }
}

#[test]
fn sections_that_are_none_are_told() {
    let make = |points: &[[f64; 2]]| {
        let points: Vec<DVec2> = points.iter().map(|&p| p.into()).collect();
        Section::new(&points, 1.0).err()
    };
    let touching = |first, second| Some(TubeError::SelfTouching { first, second });
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    assert_eq!(make(&square), None);
    assert_eq!(make(&square[..2]), Some(TubeError::Points { found: 2 }));
    assert_eq!(
        make(&[[0.0; 2]; 5000]),
        Some(TubeError::Points { found: 5000 })
    );
    assert_eq!(
        make(&[[0.0, 0.0], [1.0, f64::NAN], [1.0, 1.0]]),
        Some(TubeError::Section { index: 1 })
    );
    assert_eq!(
        make(&[square[0], square[2], square[1], square[3]]),
        touching(0, 2)
    );
    assert_eq!(
        make(&[square[0], square[1], square[1], square[2]]),
        touching(0, 1)
    );
    assert_eq!(make(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]), touching(0, 2));
    // Two squares that meet in a point.
    let eight = [
        [0.0, 0.0],
        [1.0, 0.0],
        [1.0, 1.0],
        [2.0, 1.0],
        [2.0, 2.0],
        [1.0, 2.0],
        [1.0, 1.0],
        [0.0, 1.0],
    ];
    assert_eq!(make(&eight), touching(1, 5));
    assert!(Section::circle(2).is_err() && Section::circle(usize::MAX).is_err());
}

#[test]
fn tubes_that_are_none_are_told() {
    let section = Section::circle(5).unwrap();
    let line = Chain::catmull_rom(&[DVec3::ZERO, DVec3::Z], 0.5).unwrap();
    let sweep = |tube: Tube, radius: f64| tube.sweep(&line, &section, |_| radius).err();
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            sweep(even(3), bad),
            Some(TubeError::Radius { at: 0.0, .. })
        ));
    }
    let bends = |angle| Tube {
        rings: Rings::Bends { angle, most: 9 },
        ..Tube::default()
    };
    for bad in [0.0, -1.0, f64::NAN] {
        assert!(matches!(
            sweep(bends(bad), 1.0),
            Some(TubeError::Angle { .. })
        ));
    }
    let closed = Tube {
        closed: true,
        ..even(3)
    };
    assert_eq!(sweep(closed, 1.0), Some(TubeError::NotClosed { gap: 1.0 }));
    assert_eq!(sweep(even(3), 1e90), Some(TubeError::TooFar));
    let many = sweep(even(1_000_000_000), 1.0);
    assert!(matches!(many, Some(TubeError::TooMany { .. })), "{many:?}");
    struct Bad;
    impl SpaceCurve for Bad {
        fn pieces(&self) -> usize {
            1
        }
        fn at(&self, _: usize, _: f64) -> [DVec3; 3] {
            [DVec3::NAN; 3]
        }
    }
    let found = even(3).sweep(&Bad, &section, |_| 1.0).err();
    assert_eq!(
        found,
        Some(TubeError::Curve(FrenetError::NotFinite { index: 0 }))
    );
}

/// Run it by `cargo nextest run --release -p pelage-curves --run-ignored only`.
#[test]
#[ignore = "takes half a minute and 4 GB"]
fn curves_of_ten_million_vertices_are_taken_apart_and_swept() {
    let at = |i: usize| {
        let angle = 0.1 * i as f64;
        DVec3::new(libm::cos(angle), libm::sin(angle), 0.01 * angle)
    };
    let points: Vec<DVec3> = (0..10_000_000).map(at).collect();
    let chain = Chain::catmull_rom(&points, 0.5).unwrap();
    let nurbs = Nurbs::clamped(3, &points).unwrap();
    drop(points);
    let section = Section::circle(3).unwrap();
    let mesh = even(1000).sweep(&chain, &section, |_| 0.1).unwrap();
    assert!(mesh.positions.len() > 3000);
    assert!(mesh.positions.iter().all(|p| p.is_finite()));
    for apparatus in [Apparatus::of(&chain, 999), Apparatus::of(&nurbs, 999)] {
        let length = apparatus.unwrap().length();
        // A B-spline stays inside the helix of its points.
        assert!((length / 1.0e6 - 1.0).abs() < 2e-3, "{length}");
    }
}
