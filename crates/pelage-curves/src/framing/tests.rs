//! The table of the module, cell by cell.

use super::*;
use crate::frenet::SpaceCurve;
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

const RULES: [Framing; 4] = [
    Framing::Frenet,
    Framing::UpAxis(DVec3::Z),
    Framing::Propagated,
    Framing::DoubleReflection,
];

/// Samples of a function of 0..=1 and its two derivatives, with a length that is its own.
fn samples(steps: usize, at: impl Fn(f64) -> [DVec3; 3]) -> Vec<Sample> {
    struct Whole<F>(F);
    impl<F: Fn(f64) -> [DVec3; 3]> SpaceCurve for Whole<F> {
        fn pieces(&self) -> usize {
            1
        }
        fn at(&self, _: usize, t: f64) -> [DVec3; 3] {
            self.0(t)
        }
    }
    Sample::along(&Whole(at), steps).unwrap()
}

/// y = x³ from -1 to 1 in the plane z = 0: an inflection in its middle.
fn inflection(t: f64) -> [DVec3; 3] {
    let x = 2.0 * t - 1.0;
    let at = |x, y| DVec3::new(x, y, 0.0);
    [at(x, x * x * x), at(2.0, 6.0 * x * x), at(0.0, 24.0 * x)]
}

/// A half circle in the plane y = 0 over the top, where it goes along X; along Z at its ends.
fn arch(t: f64) -> [DVec3; 3] {
    let (s, c) = (libm::sin(PI * t), libm::cos(PI * t));
    let at = |x, z| DVec3::new(x, 0.0, z);
    [at(-c, s), at(s, c) * PI, at(c, -s) * (PI * PI)]
}

/// A path that climbs along Z, passing it at a distance of `lean` as an angle.
fn climb(lean: f64) -> impl Fn(f64) -> [DVec3; 3] {
    move |t| {
        let x = 2.0 * t - 1.0;
        let point = DVec3::new(x * x * 0.5, lean * x, x);
        [
            point,
            DVec3::new(2.0 * x, 2.0 * lean, 2.0),
            DVec3::new(4.0, 0.0, 0.0),
        ]
    }
}

fn helix(turns: f64, pitch: f64) -> impl Fn(f64) -> [DVec3; 3] {
    move |t| {
        let w = TAU * turns;
        let (s, c) = (libm::sin(w * t), libm::cos(w * t));
        let z = pitch * w;
        [
            DVec3::new(c, s, z * t),
            DVec3::new(-s * w, c * w, z),
            DVec3::new(-c, -s, 0.0) * (w * w),
        ]
    }
}

fn largest(samples: &[Sample], rule: Framing) -> f64 {
    let frames = rule.frames(samples, DVec3::Z).unwrap();
    twists(samples, &frames)
        .iter()
        .fold(0.0, |a, t| t.abs().max(a))
}

#[test]
fn at_an_inflection_frenet_frames_jump_and_the_others_do_not() {
    let samples = samples(41, inflection);
    assert!((largest(&samples, Framing::Frenet) - PI).abs() < 1e-9);
    for rule in &RULES[1..] {
        assert!(largest(&samples, *rule) < 1e-9, "{rule:?}");
    }
    // The sample on the inflection itself has no normal: it is carried.
    let odd = super::tests::samples(40, inflection);
    assert!((largest(&odd, Framing::Frenet) - PI).abs() < 1e-9);
}

#[test]
fn along_a_straight_part_frenet_frames_have_to_be_carried_and_jump_at_its_end() {
    // Bends to +Y, goes straight, bends to +Z.
    let bend = |t: f64| match t {
        t if t < 0.4 => {
            let x = t - 0.4;
            [
                DVec3::new(t, x * x, 0.0),
                DVec3::new(1.0, 2.0 * x, 0.0),
                DVec3::Y * 2.0,
            ]
        }
        t if t > 0.6 => {
            let x = t - 0.6;
            [
                DVec3::new(t, 0.0, x * x),
                DVec3::new(1.0, 0.0, 2.0 * x),
                DVec3::Z * 2.0,
            ]
        }
        t => [DVec3::X * t, DVec3::X, DVec3::ZERO],
    };
    let samples = samples(50, bend);
    let frames = Framing::Frenet.frames(&samples, DVec3::Z).unwrap();
    assert!(frames[25].normal.distance(DVec3::Y) < 1e-12);
    assert!((largest(&samples, Framing::Frenet) - PI / 2.0).abs() < 1e-9);
    for rule in &RULES[2..] {
        assert!(largest(&samples, *rule) < 1e-9, "{rule:?}");
    }
}

#[test]
fn near_its_axis_the_up_axis_frame_whirls_the_more_the_nearer_and_the_others_do_not() {
    let mut before = 0.0;
    for lean in [0.3, 0.1, 0.03, 0.01] {
        let samples = samples(100, climb(lean));
        let whirl = largest(&samples, Framing::UpAxis(DVec3::Z));
        assert!(whirl > before, "{lean}: {whirl} after {before}");
        assert!(largest(&samples, Framing::DoubleReflection) < 1e-12);
        assert!(largest(&samples, Framing::Propagated) < 0.01);
        before = whirl;
    }
    assert!(before > 1.0);
}

#[test]
fn along_its_axis_the_up_axis_frame_is_carried() {
    let samples = samples(20, |t| [DVec3::Z * t, DVec3::Z, DVec3::ZERO]);
    let frames = Framing::UpAxis(DVec3::Z)
        .frames(&samples, DVec3::X)
        .unwrap();
    assert!(frames.iter().all(|f| f.normal == DVec3::X));
    // At the ends of the arch only; there it takes the nearest normal there is.
    let samples = super::tests::samples(20, arch);
    let frames = Framing::UpAxis(DVec3::Z)
        .frames(&samples, DVec3::X)
        .unwrap();
    assert!(frames.iter().all(|f| f.normal.distance(DVec3::Y) < 1e-9));
}

#[test]
fn at_a_cusp_and_between_opposite_tangents_propagated_frames_keep_their_normal() {
    // (t², t³): stands still at its cusp, where the tangent turns round.
    let cusp = |t: f64| {
        let x = 2.0 * t - 1.0;
        let at = |a, b| DVec3::new(a, b, 0.0);
        [
            at(x * x, x * x * x),
            at(4.0 * x, 6.0 * x * x),
            at(8.0, 24.0 * x),
        ]
    };
    // An even number of samples skips the cusp, an odd one has it.
    for steps in [40, 41] {
        let samples = samples(steps, cusp);
        for rule in [Framing::Propagated, Framing::DoubleReflection] {
            let frames = rule.frames(&samples, DVec3::Z).unwrap();
            assert!(
                frames.iter().all(|f| f.normal.distance(DVec3::Z) < 1e-9),
                "{rule:?}"
            );
        }
        let frames = Framing::UpAxis(DVec3::Z)
            .frames(&samples, DVec3::Z)
            .unwrap();
        assert!(
            frames[19].normal.dot(frames[22].normal) < -0.5,
            "it turns round"
        );
    }
    // There and back on one line.
    let line = [0.0, 1.0, 2.0, 1.0, 0.0].map(|x| DVec3::X * x);
    let sample = |i: usize| Sample {
        s: i as f64,
        position: line[i],
        first: if i < 3 { DVec3::X } else { DVec3::NEG_X },
        second: DVec3::ZERO,
    };
    let samples: Vec<Sample> = (0..5).map(sample).collect();
    for rule in [
        Framing::Frenet,
        Framing::Propagated,
        Framing::DoubleReflection,
    ] {
        let frames = rule.frames(&samples, DVec3::Y).unwrap();
        assert!(frames.iter().all(|f| f.normal == DVec3::Y), "{rule:?}");
    }
}

#[test]
fn coincident_points_turn_a_frame_by_the_smallest_rotation() {
    let sample = |first: DVec3| Sample {
        s: 0.0,
        position: DVec3::ONE,
        first,
        second: DVec3::ZERO,
    };
    let samples = [sample(DVec3::X), sample(DVec3::Y), sample(DVec3::ZERO)];
    for rule in [Framing::Propagated, Framing::DoubleReflection] {
        let normals: Vec<DVec3> = rule
            .frames(&samples, DVec3::Y)
            .unwrap()
            .iter()
            .map(|f| f.normal)
            .collect();
        assert_eq!(normals, [DVec3::Y, DVec3::NEG_X, DVec3::NEG_X]);
    }
}

#[test]
fn on_a_helix_frenet_frames_twist_by_the_torsion_and_propagated_ones_err_more_than_reflected() {
    let (turns, pitch) = (1.3, 0.5f64);
    let torsion_angle = pitch / (1.0 + pitch * pitch).sqrt() * TAU * turns;
    let fine = samples(400, helix(turns, pitch));
    let frenet = Framing::Frenet.frames(&fine, DVec3::Z).unwrap();
    let whole: f64 = twists(&fine, &frenet).iter().sum();
    assert!(
        (whole - torsion_angle).abs() < 1e-7,
        "{whole} {torsion_angle}"
    );
    let error = |rule: Framing, steps: usize| {
        let samples = samples(steps, helix(turns, pitch));
        let frames = rule.frames(&samples, DVec3::new(-1.0, 0.0, 0.0)).unwrap();
        let own = Framing::Frenet.frames(&samples, DVec3::Z).unwrap();
        let end = own[steps];
        let exact = end.normal * libm::cos(torsion_angle) - end.binormal * libm::sin(torsion_angle);
        frames[steps].normal.distance(exact)
    };
    for (rule, order) in [
        (Framing::Propagated, 4.0),
        (Framing::DoubleReflection, 16.0),
    ] {
        for steps in [16, 32, 64, 128] {
            let ratio = error(rule, steps) / error(rule, 2 * steps);
            assert!(
                (ratio / order - 1.0).abs() < 0.2,
                "{rule:?} {steps}: {ratio}"
            );
        }
    }
    assert!(error(Framing::DoubleReflection, 64) < 1e-3 * error(Framing::Propagated, 64));
}

/// A closed curve that winds: around a torus.
fn knot(t: f64) -> [DVec3; 3] {
    let h = 1e-4;
    let at = |t: f64| {
        let (a, b) = (TAU * t * 2.0, TAU * t * 3.0);
        let r = 2.0 + libm::cos(b);
        DVec3::new(r * libm::cos(a), r * libm::sin(a), libm::sin(b))
    };
    let (p, q, r) = (at(t - h), at(t), at(t + h));
    [q, (r - p) / (2.0 * h), (p - q * 2.0 + r) / (h * h)]
}

#[test]
fn closing_spreads_the_angle_evenly_and_makes_the_ends_meet() {
    let samples = samples(600, knot);
    for rule in [Framing::Propagated, Framing::DoubleReflection] {
        let mut frames = rule.frames(&samples, DVec3::Z).unwrap();
        let seam = frames[0].normal.distance(frames[600].normal);
        assert!(seam > 0.1, "nothing to close: {seam}");
        let whole = close_frames(&samples, &mut frames);
        assert_eq!(frames[0], frames[600]);
        let twists = twists(&samples, &frames);
        for twist in &twists {
            assert!((twist - whole / 600.0).abs() < 2e-4, "{twist} of {whole}");
        }
    }
    // Frenet frames of a smooth curve meet by themselves.
    let mut frames = Framing::Frenet.frames(&samples, DVec3::Z).unwrap();
    assert!(close_frames(&samples, &mut frames).abs() < 1e-5);
}

proptest! {
    #[test]
    fn frames_are_orthonormal_and_right_handed_whatever_the_samples(
        numbers in prop::collection::vec(prop::array::uniform9(-1i8..2), 0..12),
        axis in prop::array::uniform3(-1i8..2), first in prop::array::uniform3(-1i8..2),
        exponent in -90i32..90, closed: bool,
    ) {
        let scale = libm::pow(10.0, exponent as f64);
        let vector = |v: &[i8]| DVec3::new(v[0] as f64, v[1] as f64, v[2] as f64);
        let sample = |(i, v): (usize, &[i8; 9])| Sample {
            s: (i / 2) as f64 * scale,
            position: vector(&v[..3]) * scale,
            first: vector(&v[3..6]) * scale,
            second: vector(&v[6..]) * scale,
        };
        let samples: Vec<Sample> = numbers.iter().enumerate().map(sample).collect();
        let up = Framing::UpAxis(vector(&axis));
        for rule in [Framing::Frenet, up, Framing::Propagated, Framing::DoubleReflection] {
            let mut frames = rule.frames(&samples, vector(&first)).unwrap();
            if closed {
                prop_assert!(close_frames(&samples, &mut frames).is_finite());
            }
            prop_assert_eq!(frames.len(), samples.len());
            for f in &frames {
                prop_assert!((f.tangent.length() - 1.0).abs() < 1e-14);
                prop_assert!((f.normal.length() - 1.0).abs() < 1e-14);
                prop_assert!(f.tangent.dot(f.normal).abs() < 1e-14);
                prop_assert!(f.tangent.cross(f.normal).distance(f.binormal) < 1e-14);
            }
            prop_assert!(twists(&samples, &frames).iter().all(|t| t.is_finite()));
        }
    }
}

#[test]
fn a_sample_that_is_no_number_is_told() {
    let sample = |x: f64| Sample {
        s: 0.0,
        position: DVec3::X * x,
        first: DVec3::X,
        second: DVec3::ZERO,
    };
    for rule in RULES {
        let found = rule.frames(&[sample(0.0), sample(f64::NAN)], DVec3::Z);
        assert_eq!(found, Err(FrenetError::NotFinite { index: 1 }));
        assert_eq!(rule.frames(&[], DVec3::Z), Ok(Vec::new()));
        assert_eq!(rule.frames(&[sample(0.0)], DVec3::Z).unwrap().len(), 1);
    }
}
