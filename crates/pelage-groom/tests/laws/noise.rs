//! Frizz and kink.

use crate::fixture::{Fixture, collect};
use pelage_curves::Vec3;
use pelage_groom::{Capture, Clock, Pose, Scratch};
use pelage_strands::StrandBuffer;

#[test]
fn frizz_and_kink_leave_the_root_and_turn_hairs_that_stand_side_by_side_alike() {
    let fixture = Fixture {
        flat: true,
        more: "frizz = { root = 0.2, tip = 0.4 }",
        ..Fixture::default()
    };
    let plain = collect(
        &Fixture {
            more: "",
            ..fixture
        }
        .plan(),
        0..3000,
        2,
    );
    let frizzed = collect(&fixture.plan(), 0..3000, 2);
    let kinked = "kink = { root = 0.05, tip = 0.1, frequency = [9, 9, 9] }";
    let kinked = collect(
        &Fixture {
            more: kinked,
            ..fixture
        }
        .plan(),
        0..3000,
        2,
    );
    let moved = |bent: &StrandBuffer, i: usize, k: usize| {
        bent.strand_points(i)[k] - plain.strand_points(i)[k]
    };
    let last = plain.strand_points(0).len() - 1;
    let (mut most, mut apart) = (0.0f32, 0.0f32);
    for i in 0..plain.len() {
        for bent in [&frizzed, &kinked] {
            assert_eq!(moved(bent, i, 0), Vec3::ZERO);
        }
        // Three noises of at most 1.3, by 0.4 and 0.1.
        most = most.max(moved(&frizzed, i, last).length());
        assert!(moved(&kinked, i, last).length() < 0.1 * 1.3 * 3f32.sqrt());
        for j in i + 1..(i + 40).min(plain.len()) {
            let (p, q) = (plain.root_rest[i], plain.root_rest[j]);
            let distance = Vec3::from(p).distance(Vec3::from(q));
            if distance < 0.05 {
                let difference = moved(&frizzed, i, last).distance(moved(&frizzed, j, last));
                apart = apart.max(difference / distance);
            }
        }
    }
    assert!(most > 0.2 && most < 0.4 * 1.3 * 3f32.sqrt(), "{most}");
    // The noise has a frequency of 1; local frames turn over one radius.
    assert!(apart < 4.0, "{apart}");
}

#[test]
fn animated_frizz_moves_with_time_and_what_does_not_move_stays() {
    let at = |more, time| {
        let plan = Fixture {
            flat: true,
            more,
            ..Fixture::default()
        }
        .plan();
        let (mut capture, mut clock) = (Capture::default(), Clock::default());
        let (mut scratch, mut out) = (Scratch::default(), StrandBuffer::new());
        plan.capture(0..500, &mut capture, &mut clock);
        let pose = Pose {
            time,
            ..Pose::default()
        };
        plan.evaluate(
            &capture,
            &plan.posed(&pose).unwrap(),
            &mut scratch,
            &mut out,
            &mut clock,
        );
        out
    };
    let (still, moving) = (
        "frizz = { tip = 0.3 }",
        "frizz = { tip = 0.3, animation = { amount = 0.5, speed = 0.1, direction = [0, 1, 0] } }",
    );
    assert!(at(still, 0.0) == at(still, 9.0));
    assert!(at(still, 0.0).points != at(moving, 9.0).points);
    let tips = |time| {
        let hair = at(moving, time);
        (0..hair.len())
            .map(|i| hair.strand_points(i)[6])
            .collect::<Vec<_>>()
    };
    let (before, after, later) = (tips(4.0), tips(4.01), tips(8.0));
    let distance = |a: &[Vec3], b: &[Vec3]| {
        let apart = a.iter().zip(b).map(|(p, q)| p.distance(*q));
        apart.fold(0.0, f32::max)
    };
    assert!(distance(&before, &after) < 1e-3);
    assert!(distance(&before, &later) > 0.02);
}
