use super::*;
use crate::frenet::Segment;
use proptest::prelude::*;

fn guide(parts: &[(f64, f64, f64)], frame: Frame) -> Apparatus {
    let segment = |&(length, curvature, torsion): &(f64, f64, f64)| Segment {
        length,
        curvature,
        torsion,
    };
    Apparatus {
        start: DVec3::ZERO,
        frame,
        segments: parts.iter().map(segment).collect(),
    }
}

fn even(curvature: f64, torsion: f64, frame: Frame) -> Apparatus {
    guide(&[(0.1, curvature, torsion); 10], frame)
}

/// Segments without length and without curvature are common; none turns by half.
fn parts() -> impl Strategy<Value = Vec<(f64, f64, f64)>> {
    let whole = |n: i8| n as f64;
    let part = (0i8..4, -3i8..4, -3i8..4);
    prop::collection::vec(
        part.prop_map(move |(l, k, t)| (0.2 * whole(l), whole(k), whole(t))),
        7,
    )
}

fn guides() -> impl Strategy<Value = Vec<(Apparatus, f64)>> {
    let vector = || prop::array::uniform3(-1.0f64..1.0);
    let one = (parts(), vector(), vector(), 0u8..5);
    let guide = one.prop_map(|(parts, tangent, normal, weight)| {
        let frame = Frame::new(tangent.into(), normal.into());
        (guide(&parts, frame), weight as f64)
    });
    prop::collection::vec(guide, 1..5).prop_filter("some weight", |guides| {
        guides.iter().any(|(_, weight)| *weight > 0.0)
    })
}

fn farthest(a: &[DVec3], b: &[DVec3]) -> f64 {
    assert_eq!(a.len(), b.len());
    let apart = a.iter().zip(b).map(|(p, q)| p.distance(*q));
    apart.fold(0.0, f64::max)
}

proptest! {
    #[test]
    fn equal_guides_come_back_whatever_they_are(
        parts in parts(), tangent in prop::array::uniform3(-1.0f64..1.0),
    ) {
        let own = guide(&parts, Frame::new(tangent.into(), DVec3::Y));
        let one = Ordered::new(&own);
        let shares = [(&one, 0.5), (&one, 3.0), (&one, 0.0)];
        let (by_bases, frames) = mix_bases(&shares, DVec3::ZERO).unwrap();
        prop_assert!(farthest(&by_bases, &own.points()) < 1e-12);
        let (by_integrals, stretch) = mix_integrals(&shares, DVec3::ZERO).unwrap();
        prop_assert!(farthest(&by_integrals, &own.points()) < 1e-12);
        prop_assert!((stretch - 1.0).abs() < 1e-12);
        for (found, exact) in frames.iter().zip(own.frames()) {
            prop_assert!(found.normal.distance(exact.normal) < 1e-12);
        }
    }

    #[test]
    fn mixed_bases_are_orthonormal_and_steps_are_no_longer_than_their_length(guides in guides()) {
        let ready: Vec<(Ordered, f64)> =
            guides.iter().map(|(g, w)| (Ordered::new(g), *w)).collect();
        let shares: Vec<(&Ordered, f64)> = ready.iter().map(|(g, w)| (g, *w)).collect();
        let whole: f64 = guides.iter().map(|(_, w)| w).sum();
        let (points, frames) = mix_bases(&shares, DVec3::ONE).unwrap();
        for frame in &frames {
            prop_assert!((frame.tangent.length() - 1.0).abs() < 1e-13);
            prop_assert!(frame.tangent.dot(frame.normal).abs() < 1e-13);
            prop_assert!(frame.tangent.cross(frame.normal).distance(frame.binormal) < 1e-13);
        }
        for (i, step) in points.windows(2).enumerate() {
            let lengths = guides.iter().map(|(g, w)| g.segments[i].length * w / whole);
            let length: f64 = lengths.sum();
            // A step of a half turn is a chord of 2 / π of its arc, a longer one less.
            prop_assert!(step[0].distance(step[1]) < length + 1e-12);
            let turn = frames[i].tangent.dot(frames[i + 1].tangent);
            if turn > 0.9 {
                prop_assert!(step[0].distance(step[1]) >= 0.3 * length);
            }
        }
    }

    #[test]
    fn mixed_integrals_are_as_long_as_the_guides_on_the_mean(guides in guides()) {
        let ready: Vec<(Ordered, f64)> =
            guides.iter().map(|(g, w)| (Ordered::new(g), *w)).collect();
        let shares: Vec<(&Ordered, f64)> = ready.iter().map(|(g, w)| (g, *w)).collect();
        let whole: f64 = guides.iter().map(|(_, w)| w).sum();
        let wanted: f64 = guides.iter().map(|(g, w)| polygon(&g.points()) * w / whole).sum();
        let (points, stretch) = mix_integrals(&shares, DVec3::ONE).unwrap();
        prop_assert!(stretch > 1.0 - 1e-12);
        prop_assert!((polygon(&points) - wanted).abs() < 1e-9 * (1.0 + wanted));
    }
}

#[test]
fn a_mean_of_bases_turns_half_as_far_as_two_plane_bends() {
    let ends = [
        even(1.0, 0.0, Frame::IDENTITY),
        even(3.0, 0.0, Frame::IDENTITY),
    ];
    let ends = ends.each_ref().map(Ordered::new);
    let shares = ends.each_ref().map(|guide| (guide, 0.5));
    let (points, _) = mix_bases(&shares, DVec3::ZERO).unwrap();
    let middle = even(2.0, 0.0, Frame::IDENTITY).points();
    assert!(farthest(&points, &middle) < 1e-14);
}

#[test]
fn guides_that_cancel_give_a_strand_all_the_same() {
    let half = std::f64::consts::PI * 10.0;
    let turned = [half, -half].map(|k| Ordered::new(&even(k, 0.0, Frame::IDENTITY)));
    let back = Frame::new(-DVec3::X, DVec3::Y);
    let apart = [Frame::IDENTITY, back].map(|f| Ordered::new(&even(0.0, 0.0, f)));
    for pair in [turned, apart] {
        let shares = pair.each_ref().map(|guide| (guide, 1.0));
        let (points, frames) = mix_bases(&shares, DVec3::ZERO).unwrap();
        let (straight, stretch) = mix_integrals(&shares, DVec3::ZERO).unwrap();
        assert!(stretch > 1.0 - 1e-12);
        assert!(points.iter().chain(&straight).all(|p| p.is_finite()));
        assert!(
            frames
                .iter()
                .all(|f| (f.normal.length() - 1.0).abs() < 1e-12)
        );
    }
}

#[test]
fn what_cannot_be_mixed_is_told() {
    let one = Ordered::new(&even(1.0, 0.0, Frame::IDENTITY));
    let short = Ordered::new(&guide(&[(1.0, 0.0, 0.0)], Frame::IDENTITY));
    let tell = |guides: &[(&Ordered, f64)]| {
        let errors = [
            mix_bases(guides, DVec3::ZERO).unwrap_err(),
            mix_integrals(guides, DVec3::ZERO).unwrap_err(),
        ];
        assert_eq!(errors[0], errors[1]);
        errors[0]
    };
    assert_eq!(tell(&[]), FrenetError::Empty);
    let unlike = FrenetError::Unlike {
        guide: 1,
        found: 1,
        expected: 10,
    };
    assert_eq!(tell(&[(&one, 1.0), (&short, 1.0)]), unlike);
    for weight in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(tell(&[(&one, weight)]), FrenetError::Weights);
    }
}
