//! Multi-strands (document 004, section 2.2.7).

use crate::fixture::{Fixture, collect};
use pelage_curves::{Vec3, catmull_rom, double_reflection};
use pelage_strands::StrandBuffer;

/// 1,000 hairs on the ball without maps, with more lines.
fn hairs(more: &str) -> StrandBuffer {
    let fixture = Fixture {
        flat: true,
        more,
        ..Fixture::default()
    };
    collect(&fixture.plan(), 0..1000, 2)
}

#[test]
fn every_fibre_of_a_strand_without_splay_is_the_hair_itself() {
    const BENT: &str = "frizz.tip = 0.2
        kink = { tip = 0.05, frequency = [9, 9, 9] }
        cut.length = 0.8";
    let single = hairs(BENT);
    let bundles = hairs(&format!(
        "{BENT}\nstrand = {{ count = 3, twist = 300, aspect = 2 }}"
    ));
    assert_eq!(bundles.len(), 3 * single.len());
    for i in 0..bundles.len() {
        let (fiber, hair) = (bundles.vertices(i), single.vertices(i / 3));
        assert_eq!(bundles.points[fiber.clone()], single.points[hair.clone()]);
        assert_eq!(bundles.normals[fiber.clone()], single.normals[hair.clone()]);
        assert_eq!(bundles.colors[fiber.clone()], single.colors[hair.clone()]);
        assert_eq!(bundles.widths[fiber.clone()], single.widths[hair.clone()]);
        assert_eq!(bundles.opacities[fiber], single.opacities[hair]);
        assert_eq!(bundles.hair_id[i], single.hair_id[i / 3]);
        assert_eq!(bundles.strand_id[i] as usize, i % 3);
        assert_eq!(bundles.root_uv[i], single.root_uv[i / 3]);
    }
}

#[test]
fn fibres_lie_in_the_planes_of_the_hairs_frames_at_the_place_they_tell() {
    let single = hairs("");
    let bundles = hairs("strand = { count = 4, splay = { root = 0.1, center = 0.1, tip = 0.1 } }");
    for i in 0..bundles.len() {
        let hair = single.strand_points(i / 4);
        let normals = &single.normals[single.vertices(i / 4)];
        let mut tangents = vec![Vec3::ZERO; hair.len()];
        catmull_rom::tangents(hair, &mut tangents);
        let place = bundles.strand_uv[i];
        for (k, vertex) in bundles.strand_points(i).iter().enumerate() {
            let from = *vertex - hair[k];
            let normal = Vec3::from(normals[k]);
            let binormal = tangents[k].cross(normal);
            assert!(from.dot(tangents[k]).abs() < 1e-5);
            assert!((from.dot(normal) - 0.1 * place[0]).abs() < 1e-5);
            assert!((from.dot(binormal) - 0.1 * place[1]).abs() < 1e-5);
        }
    }
}

#[test]
fn the_first_fibres_stay_when_there_are_more_and_each_has_its_own_frame() {
    let strand = |count: u32| {
        hairs(&format!(
            "strand = {{ count = {count}, splay = {{ tip = 0.1 }}, randomize = 0.5, twist = 90 }}"
        ))
    };
    let (few, many) = (strand(2), strand(5));
    for hair in 0..1000 {
        for k in 0..2 {
            assert_eq!(
                few.strand_points(2 * hair + k),
                many.strand_points(5 * hair + k)
            );
        }
    }
    for i in 0..many.len() {
        let points = many.strand_points(i);
        let mut tangents = vec![Vec3::ZERO; points.len()];
        catmull_rom::tangents(points, &mut tangents);
        let found = &many.normals[many.vertices(i)];
        let mut normals = vec![Vec3::ZERO; points.len()];
        double_reflection(points, &tangents, Vec3::from(found[0]), &mut normals);
        for (normal, found) in normals.iter().zip(found) {
            assert!(normal.distance(Vec3::from(*found)) < 1e-4);
        }
    }
}

#[test]
fn randomize_shortens_fibres_about_their_root_and_no_more_than_it_says() {
    let whole = hairs("strand = { count = 5, splay = { tip = 0.1 } }");
    let part = hairs("strand = { count = 5, splay = { tip = 0.1 }, randomize = 0.6 }");
    let mut shares = Vec::new();
    for i in 0..whole.len() {
        let tip = |strands: &StrandBuffer| {
            let points = strands.strand_points(i);
            points[points.len() - 1] - points[0]
        };
        let (all, left) = (tip(&whole), tip(&part));
        let share = left.length() / all.length();
        assert!(left.distance(all * share) < 1e-5);
        shares.push(share);
    }
    let mean = shares.iter().sum::<f32>() / shares.len() as f32;
    assert!(shares.iter().all(|&s| (0.4 - 1e-4..1.0001).contains(&s)));
    assert!((mean - 0.7).abs() < 0.01, "{mean}");
}
