//! Guides that are posed frame by frame.

use crate::fixture::{Fixture, along_normals, motion, moved};
use pelage_curves::Vec3;
use pelage_groom::{Capture, Clock, Plan, PlanError, Pose, Scratch};
use pelage_strands::StrandBuffer;
use std::sync::Arc;

fn hairs(plan: &Plan, pose: &Pose) -> StrandBuffer {
    let (mut capture, mut clock) = (Capture::default(), Clock::default());
    let mut out = StrandBuffer::new();
    plan.capture(0..1000, &mut capture, &mut clock);
    let posed = plan.posed(pose).unwrap();
    plan.evaluate(
        &capture,
        &posed,
        &mut Scratch::default(),
        &mut out,
        &mut clock,
    );
    out
}

const NOISY: &str = "frizz.tip = 0.1
    kink = { tip = 0.05, frequency = [9, 9, 9] }
    output.skip_threshold = 0.95
    [[clump.levels]]
    size = 0.4
    tip = 0.5";

#[test]
fn guides_posed_as_they_are_at_rest_change_nothing() {
    let (plan, guides) = along_normals(1000, NOISY);
    let pose = Pose {
        guides: Some(Arc::new(guides)),
        ..Pose::default()
    };
    assert!(hairs(&plan, &Pose::default()) == hairs(&plan, &pose));
}

#[test]
fn hairs_follow_posed_guides_and_keep_their_vertices_and_noise() {
    for more in ["", NOISY] {
        let (plan, guides) = along_normals(1000, more);
        let shift = Vec3::new(0.3, 0.1, -0.2);
        let bent = |guide: &Vec<Vec3>| {
            let along = guide.iter().enumerate();
            along.map(|(i, &p)| p + shift * (i as f32 / 4.0)).collect()
        };
        let pose = Pose {
            guides: Some(Arc::new(guides.iter().map(bent).collect())),
            ..Pose::default()
        };
        let (rest, posed) = (hairs(&plan, &Pose::default()), hairs(&plan, &pose));
        assert_eq!(rest.offsets, posed.offsets);
        for i in 0..rest.len() {
            let ends = |strands: &StrandBuffer| {
                let points = strands.strand_points(i);
                (points[0], points[points.len() - 1])
            };
            let ((root, tip), (same, shifted)) = (ends(&rest), ends(&posed));
            assert_eq!(root, same);
            // Guides are carried to the hair's root, which turns them by some 0.4 radians.
            let found = shifted - tip;
            assert!(
                found.distance(shift) < 0.5 * shift.length(),
                "{more}: {found}"
            );
        }
    }
}

#[test]
fn guides_posed_rigidly_with_the_surface_move_hairs_rigidly() {
    let (plan, guides) = along_normals(1000, NOISY);
    let (turn, shift) = motion();
    let mesh = moved(&Fixture::default().mesh(), turn, shift);
    let surface = Some(Arc::new(plan.rest().posed(&mesh, true).unwrap()));
    let carried = |guide: &Vec<Vec3>| guide.iter().map(|&p| turn * p + shift).collect();
    let with_skin = Pose {
        surface,
        ..Pose::default()
    };
    let by_file = Pose {
        guides: Some(Arc::new(guides.iter().map(carried).collect())),
        ..with_skin.clone()
    };
    let (skin, file) = (hairs(&plan, &with_skin), hairs(&plan, &by_file));
    assert_eq!(skin.offsets, file.offsets);
    for (p, q) in skin.points.iter().zip(&file.points) {
        assert!(Vec3::from(*p).distance(Vec3::from(*q)) < 1e-4);
    }
}

#[test]
fn posed_guides_that_do_not_fit_are_told() {
    let (plan, mut guides) = along_normals(1000, "");
    let pose = |guides| Pose {
        guides: Some(Arc::new(guides)),
        ..Pose::default()
    };
    let error = plan.posed(&pose(guides[1..].to_vec())).unwrap_err();
    let (found, expected) = (guides.len() - 1, guides.len());
    assert_eq!(error, PlanError::PosedGuides { found, expected });
    guides[3][2].y = f32::NAN;
    let error = plan.posed(&pose(guides)).unwrap_err();
    assert_eq!(
        error,
        PlanError::GuideNotFinite {
            index: 3,
            vertex: 2
        }
    );
}
