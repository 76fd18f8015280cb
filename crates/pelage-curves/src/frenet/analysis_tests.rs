use super::*;
use crate::frenet::CatmullRom;
use proptest::prelude::*;

/// Curvature and torsion that vary, with an inflection at s = 2.
fn varying(s: f64) -> [f64; 2] {
    [
        1.2 * libm::cos(s * std::f64::consts::FRAC_PI_4),
        0.4 + 0.7 * libm::sin(1.3 * s),
    ]
}

const LENGTH: f64 = 3.0;

/// Position and basis along the curve of [`varying`].
#[derive(Clone, Copy)]
struct State([DVec3; 4]);

impl State {
    const START: Self = Self([DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z]);

    fn slope(&self, s: f64) -> Self {
        let [_, t, n, b] = self.0;
        let [curvature, torsion] = varying(s);
        Self([t, n * curvature, b * torsion - t * curvature, -n * torsion])
    }

    fn plus(&self, slope: &Self, step: f64) -> Self {
        Self(std::array::from_fn(|k| self.0[k] + slope.0[k] * step))
    }

    /// A Runge–Kutta step of the fourth order.
    fn next(&self, s: f64, step: f64) -> Self {
        let a = self.slope(s);
        let b = self.plus(&a, step / 2.0).slope(s + step / 2.0);
        let c = self.plus(&b, step / 2.0).slope(s + step / 2.0);
        let d = self.plus(&c, step).slope(s + step);
        let ends = self.plus(&a, step / 6.0).plus(&d, step / 6.0);
        ends.plus(&b, step / 3.0).plus(&c, step / 3.0)
    }
}

/// The curve at `intervals + 1` places, by `fine` Runge–Kutta steps an interval.
fn reference(intervals: usize, fine: usize) -> Vec<State> {
    let step = LENGTH / (intervals * fine) as f64;
    let mut state = State::START;
    let mut states = vec![state];
    for i in 0..intervals * fine {
        state = state.next(i as f64 * step, step);
        if (i + 1) % fine == 0 {
            states.push(state);
        }
    }
    states
}

/// Samples of the reference; the parameter is s, so the derivatives are T and κN.
fn samples(states: &[State]) -> Vec<Sample> {
    let step = LENGTH / (states.len() - 1) as f64;
    let states = states.iter().enumerate();
    let sample = |(i, state): (usize, &State)| {
        let s = i as f64 * step;
        let [position, first, normal, _] = state.0;
        let second = normal * varying(s)[0];
        Sample {
            s,
            position,
            first,
            second,
        }
    };
    states.map(sample).collect()
}

fn farthest(a: &[DVec3], b: impl Iterator<Item = DVec3>) -> f64 {
    let apart = a.iter().zip(b).map(|(p, q)| p.distance(q));
    apart.fold(0.0, f64::max)
}

/// Errors at halved steps fall by `ratio`, within a tenth or so, until rounding.
fn assert_order(errors: &[f64], ratio: f64) {
    for pair in errors.windows(2) {
        let found = pair[0] / pair[1];
        assert!((0.85..1.18).contains(&(found / ratio)), "{errors:?}");
    }
}

#[test]
fn the_reference_is_right_to_1e_12() {
    let (coarse, fine) = (reference(16, 256), reference(16, 512));
    for (a, b) in coarse.iter().zip(&fine) {
        for k in 0..4 {
            // A step of half the size errs by a sixteenth.
            assert!(a.0[k].distance(b.0[k]) < 1e-12);
        }
    }
}

#[test]
fn helix_steps_of_the_middle_of_each_interval_err_by_the_square_of_the_step() {
    let error = |intervals: usize| {
        let length = LENGTH / intervals as f64;
        let segment = |i: usize| {
            let [curvature, torsion] = varying((i as f64 + 0.5) * length);
            Segment {
                length,
                curvature,
                torsion,
            }
        };
        let apparatus = Apparatus {
            start: DVec3::ZERO,
            frame: Frame::IDENTITY,
            segments: (0..intervals).map(segment).collect(),
        };
        let exact = reference(intervals, 4096 / intervals);
        farthest(&apparatus.points(), exact.iter().map(|state| state.0[0]))
    };
    let errors: Vec<f64> = [16, 32, 64, 128, 256].map(error).to_vec();
    assert_order(&errors, 4.0);
    assert!(errors[4] < 3e-5, "{errors:?}");
}

#[test]
fn a_curve_taken_apart_and_put_together_errs_by_the_square_of_the_step() {
    let errors = [16, 32, 64, 128, 256].map(|intervals| {
        let exact = reference(intervals, 4096 / intervals);
        let apparatus = Apparatus::of_samples(&samples(&exact)).unwrap();
        // Through the inflection too.
        for (i, segment) in apparatus.segments.iter().enumerate() {
            let middle = (i as f64 + 0.5) * LENGTH / intervals as f64;
            let [curvature, torsion] = varying(middle);
            let coarse = 40.0 / (intervals * intervals) as f64;
            assert!((segment.curvature - curvature).abs() < coarse);
            assert!((segment.torsion - torsion).abs() < coarse);
        }
        farthest(&apparatus.points(), exact.iter().map(|state| state.0[0]))
    });
    assert_order(&errors, 4.0);
    assert!(errors[4] < 5e-5, "{errors:?}");
}

/// A helix in one piece, by its angle.
struct Helix {
    pitch: f64,
    end: f64,
}

impl SpaceCurve for Helix {
    fn pieces(&self) -> usize {
        1
    }

    fn at(&self, _: usize, t: f64) -> [DVec3; 3] {
        let (angle, p, w) = (t * self.end, self.pitch, self.end);
        let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
        [
            DVec3::new(cosine, sine, p * angle),
            DVec3::new(-sine, cosine, p) * w,
            DVec3::new(-cosine, -sine, 0.0) * (w * w),
        ]
    }
}

#[test]
fn circles_and_helices_come_back_to_rounding_however_coarse() {
    // Up to 2.6 radians a segment, so that both halves of equations 47 and 48 are used;
    // where the binormal turns by less than a quarter.
    for (pitch, fewest) in [(0.0, 3), (0.4, 3), (-1.5, 5)] {
        for segments in [fewest, 6, 8, 50] {
            let helix = Helix { pitch, end: 7.8 };
            let apparatus = Apparatus::of(&helix, segments).unwrap();
            let square = 1.0 + pitch * pitch;
            for segment in &apparatus.segments {
                assert!((segment.curvature - 1.0 / square).abs() < 1e-12);
                assert!((segment.torsion - pitch / square).abs() < 1e-12);
            }
            let exact = (0..=segments).map(|i| helix.at(0, i as f64 / segments as f64)[0]);
            let error = farthest(&apparatus.points(), exact);
            assert!(error < 1e-11, "{pitch} {segments}: {error}");
        }
    }
}

#[test]
fn a_straight_part_between_bends_keeps_the_normal_and_an_s_bends_both_ways() {
    let s = [0., 1., 2., 3., 4., 5., 6., 7., 8.];
    let heights = [0., 0.5, 0.7, 0.8, 0.8, 0.8, 0.9, 1.1, 1.6];
    let points: Vec<DVec3> = s
        .iter()
        .zip(heights)
        .map(|(&x, y)| DVec3::new(x, y, 0.0))
        .collect();
    let curve = CatmullRom::new(&points).unwrap();
    let apparatus = Apparatus::of(&curve, 64).unwrap();
    assert!(apparatus.segments.iter().all(|s| s.torsion == 0.0));
    let (first, last) = (apparatus.segments[4], apparatus.segments[59]);
    let both = first.curvature * last.curvature;
    assert!(both < -0.0025, "{first:?} {last:?}");
}

#[test]
fn points_on_a_line_have_no_curvature_and_come_back() {
    let points: Vec<DVec3> = (0..5)
        .map(|i| DVec3::new(1.0, 2.0, 2.0) * i as f64)
        .collect();
    let apparatus = Apparatus::of(&CatmullRom::new(&points).unwrap(), 7).unwrap();
    assert!(apparatus.segments.iter().all(|s| s.curvature.abs() < 1e-12));
    assert!(apparatus.points()[7].distance(points[4]) < 1e-12);
}

#[test]
fn a_point_is_a_curve_without_length_and_what_is_no_number_is_told() {
    for points in [vec![DVec3::ONE], vec![DVec3::ONE; 4]] {
        let apparatus = Apparatus::of(&CatmullRom::new(&points).unwrap(), 3).unwrap();
        assert_eq!(apparatus.segments, [Segment::default(); 3]);
        assert_eq!(apparatus.points(), [DVec3::ONE; 4]);
    }
    assert_eq!(CatmullRom::new(&[]).unwrap_err(), FrenetError::Empty);
    assert_eq!(Apparatus::of_samples(&[]), Err(FrenetError::Empty));
    let bad = [DVec3::ZERO, DVec3::new(0.0, f64::NAN, 0.0)];
    let error = CatmullRom::new(&bad).unwrap_err();
    assert_eq!(error, FrenetError::NotFinite { index: 1 });
    let huge = [DVec3::ZERO, DVec3::splat(f64::MAX), DVec3::splat(-f64::MAX)];
    assert!(Apparatus::of(&CatmullRom::new(&huge).unwrap(), 4).is_err());
}

proptest! {
    /// Small integers: vertices that coincide, lines and folds are common.
    #[test]
    fn whatever_the_vertices_all_is_finite_and_its_length_is_kept(
        points in prop::collection::vec(prop::array::uniform3(-1i8..2), 1..9),
        segments in 1usize..40, exponent in -100i32..100,
    ) {
        let unit = libm::pow(10.0, exponent as f64);
        let points: Vec<DVec3> =
            points.iter().map(|p| DVec3::from(p.map(f64::from)) * unit).collect();
        let curve = CatmullRom::new(&points).unwrap();
        let apparatus = Apparatus::of(&curve, segments).unwrap();
        let length = Measure::new(&curve).unwrap().total();
        prop_assert!((apparatus.length() - length).abs() <= 1e-12 * length);
        for point in apparatus.points() {
            prop_assert!(point.is_finite());
            prop_assert!(point.distance(points[0]) <= length * (1.0 + 1e-9) + unit * 1e-14);
        }
    }
}
