//! Clumps and flyaways.

use crate::fixture::{Fixture, along_normals, collect, moved, strands};
use pelage_curves::Vec3;
use pelage_groom::Plan;
use pelage_strands::StrandBuffer;

fn plan(count: u64, more: &str) -> Plan {
    let fixture = Fixture {
        count,
        flat: true,
        more,
        ..Fixture::default()
    };
    fixture.plan()
}

/// So many hairs on the ball without maps, with more lines.
fn hairs(count: u64, more: &str) -> StrandBuffer {
    collect(&plan(count, more), 0..count, 2)
}

fn tip(strands: &StrandBuffer, i: usize) -> Vec3 {
    let points = strands.strand_points(i);
    points[points.len() - 1]
}

/// How far apart tips of one clump may be: hairs a little longer end a little later.
const LOOSE: f32 = 0.05;

/// Places where tips meet, no two nearer than [`LOOSE`].
fn meetings(strands: &StrandBuffer) -> Vec<Vec3> {
    let mut met: Vec<Vec3> = Vec::new();
    for i in 0..strands.len() {
        let tip = tip(strands, i);
        if met.iter().all(|place| place.distance(tip) > LOOSE) {
            met.push(tip);
        }
    }
    met
}

const CLOSED: &str = "[[clump.levels]]\nsize = 0.25";

#[test]
fn hairs_of_a_clump_meet_at_the_tip_of_its_middle_and_there_is_one_on_each_square() {
    let closed = hairs(5000, CLOSED);
    let open = hairs(5000, "");
    // The ball has a radius of about 1.
    let expected = 4.0 * std::f32::consts::PI / (0.25 * 0.25);
    let met = meetings(&closed).len() as f32;
    assert!((0.8..1.2).contains(&(met / expected)), "{met}");
    assert!(meetings(&open).len() as f32 > 5.0 * expected);
    for i in 0..open.len() {
        assert_eq!(open.strand_points(i)[0], closed.strand_points(i)[0]);
        // A middle is less than 0.25 away, and its hair of 0.4 may point otherwise.
        assert!(tip(&open, i).distance(tip(&closed, i)) < 0.25 + 0.8);
    }
}

#[test]
fn clumps_stay_where_they_are_when_there_are_more_hairs_or_they_stand_otherwise() {
    let hairs = |count, more: &str| {
        let plan = along_normals(count, &format!("{CLOSED}\n{more}")).0;
        collect(&plan, 0..count, 2)
    };
    let all = meetings(&hairs(20_000, ""));
    for other in [
        hairs(3000, ""),
        hairs(3000, "[roots]\npattern = 'random'"),
        hairs(3000, "[roots]\ndensity = { map = 'density.png' }"),
    ] {
        for i in 0..other.len() {
            let tip = tip(&other, i);
            let apart = all.iter().map(|place| place.distance(tip));
            assert!(apart.fold(f32::MAX, f32::min) < 1.5 * LOOSE);
        }
    }
}

#[test]
fn a_clump_that_closes_at_rest_closes_on_every_pose() {
    let fixture = Fixture {
        flat: true,
        more: CLOSED,
        ..Fixture::default()
    };
    let plan = fixture.plan();
    let mut bent = fixture.mesh();
    for p in &mut bent.positions {
        let [x, y, z] = *p;
        *p = [x * (1.0 + 0.3 * y), y * 1.2, z + 0.3 * x * x];
    }
    let pose = plan.rest().posed(&bent, true).unwrap();
    let all: Vec<u64> = (0..2000).collect();
    let (rest, posed) = (
        strands(&plan, &all, None),
        strands(&plan, &all, Some(&pose)),
    );
    let mut apart = Vec::new();
    for place in meetings(&rest) {
        let near = |i: &usize| tip(&rest, *i).distance(place) < LOOSE / 4.0;
        let together: Vec<usize> = (0..rest.len()).filter(near).collect();
        for pair in together.windows(2) {
            let [before, after] =
                [&rest, &posed].map(|hair| tip(hair, pair[0]).distance(tip(hair, pair[1])));
            apart.push(after - before);
        }
    }
    assert!(apart.len() > 1000, "{}", apart.len());
    let most = apart.into_iter().fold(0.0, f32::max);
    assert!(most < 0.01, "{most}");
}

#[test]
fn a_level_that_draws_by_nothing_changes_no_bit() {
    let neutral = "[[clump.levels]]\nsize = 0.2\nroot = 0\ntip = 0
        [flyaway]\npercent = 0\nstrength = 3";
    assert!(hairs(2000, "") == hairs(2000, neutral));
    assert!(hairs(2000, "") == hairs(2000, "[flyaway]\npercent = 100\nstrength = 0"));
}

#[test]
fn fine_clumps_gather_in_coarse_ones() {
    let fine = "[[clump.levels]]\nsize = 0.15";
    let both = format!("[[clump.levels]]\nsize = 0.5\ntip = 0.9\n{fine}");
    let median = |strands: &StrandBuffer| {
        let mut apart = Vec::new();
        for i in 0..2000 {
            for j in 0..i {
                let roots = [i, j].map(|k| strands.strand_points(k)[0]);
                if roots[0].distance(roots[1]) < 0.15 {
                    apart.push(tip(strands, i).distance(tip(strands, j)));
                }
            }
        }
        let middle = apart.len() / 2;
        *apart.select_nth_unstable_by(middle, f32::total_cmp).1
    };
    let (one, two) = (median(&hairs(2000, fine)), median(&hairs(2000, &both)));
    assert!(two < 0.5 * one, "{two} with coarse clumps, {one} without");
}

#[test]
fn clumps_form_around_guides_and_in_the_areas_of_a_map() {
    let around = hairs(3000, "[[clump.levels]]\naround = 'guides'");
    assert!((120..=200).contains(&meetings(&around).len()), "200 guides");
    // The map has squares of two colours, which clump as two areas; none is black.
    let areas = hairs(
        3000,
        "[[clump.levels]]\naround = 'map'\nmap = 'density.png'",
    );
    assert_eq!(meetings(&areas).len(), 2);
}

#[test]
fn length_is_preserved_where_it_is_asked_for() {
    let length = |strands: &StrandBuffer, i: usize| -> f32 {
        let points = strands.strand_points(i);
        points.windows(2).map(|w| w[0].distance(w[1])).sum()
    };
    let plain = hairs(1000, "");
    for (more, fibers) in [
        ("frizz = { tip = 0.4, preserve_length = true }", 1),
        (
            "kink = { tip = 0.1, frequency = [9, 9, 9], preserve_length = true }",
            1,
        ),
        ("[[clump.levels]]\nsize = 0.3\npreserve_length = true", 1),
        ("[flyaway]\npercent = 50\nstrength = 0.8", 1),
        (
            "[strand]\ncount = 3\ntwist = 400\nsplay = { tip = 0.1, preserve_length = true }",
            3,
        ),
    ] {
        let bent = hairs(1000, more);
        let loose = hairs(1000, &more.replace("preserve_length = true", ""));
        let (mut most, mut changed) = (0.0f32, 0);
        for i in 0..bent.len() {
            let expected = length(&plain, i / fibers);
            assert!((length(&bent, i) - expected).abs() < 1e-4, "{more}");
            most = most.max((length(&loose, i) - expected).abs());
            changed += usize::from(bent.strand_points(i) != plain.strand_points(i / fibers));
        }
        assert!(changed > 400, "{more}");
        assert!(most > 0.005 || more.contains("flyaway"), "{more}: {most}");
    }
}

#[test]
fn the_share_of_flyaways_is_the_percentage_and_they_leave_their_clump() {
    let calm = hairs(5000, CLOSED);
    let strayed = hairs(
        5000,
        &format!("{CLOSED}\n[flyaway]\npercent = 10\nstrength = 1"),
    );
    let strays = (0..5000).filter(|&i| calm.strand_points(i) != strayed.strand_points(i));
    let strays: Vec<usize> = strays.collect();
    assert!((400..600).contains(&strays.len()), "{}", strays.len());
    let far = strays
        .iter()
        .filter(|&&i| tip(&calm, i).distance(tip(&strayed, i)) > 0.1);
    assert!(far.count() * 10 > strays.len() * 8);
}

#[test]
fn a_rigid_motion_moves_clumps_rigidly() {
    let fixture = Fixture {
        more: CLOSED,
        ..Fixture::default()
    };
    let plan = fixture.plan();
    let (turn, shift) = crate::fixture::motion();
    let pose = plan
        .rest()
        .posed(&moved(&fixture.mesh(), turn, shift), true);
    let all: Vec<u64> = (0..500).collect();
    let (rest, posed) = (
        strands(&plan, &all, None),
        strands(&plan, &all, Some(&pose.unwrap())),
    );
    for (p, q) in rest.points.iter().zip(&posed.points) {
        let expected = turn * Vec3::from(*p) + shift;
        assert!(expected.distance(Vec3::from(*q)) < 1e-4, "{expected} {q:?}");
    }
}
