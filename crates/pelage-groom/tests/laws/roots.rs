//! Roots by themselves, and where a map lifts them.

use crate::fixture::{self, Fixture, collect, fibers, kinds, request};
use pelage_curves::Vec3;
use pelage_groom::write_roots;
use pelage_strands::Collect;

#[test]
fn roots_by_themselves_are_those_of_the_hairs() {
    for fixture in kinds() {
        let plan = fixture.plan();
        let hairs = collect(&plan, 0..5000, 1);
        let mut roots = Collect::default();
        let request = request(0..5000, 2);
        write_roots(plan.roots(), &request, None, &mut roots, &mut |_| true).unwrap();
        let (roots, fibers) = (roots.strands, fibers(&hairs));
        for (i, root) in roots.points.iter().enumerate() {
            let hair = i * fibers;
            assert_eq!(roots.hair_id[i], hairs.hair_id[hair]);
            assert_eq!(roots.barycentric[i], hairs.barycentric[hair]);
            assert_eq!(roots.root_rest[i], hairs.root_rest[hair]);
            if fibers > 1 {
                continue;
            }
            let first = hairs.strand_points(i)[0];
            assert!(Vec3::from(*root).distance(first) < 1e-6, "{}", fixture.more);
        }
    }
}

#[test]
fn displaced_roots_stand_off_the_surface_by_the_map_and_the_rest_stays() {
    let plain = Fixture::default().plan();
    let fixture = Fixture {
        more: fixture::DISPLACED,
        ..Fixture::default()
    };
    let (flat, bumpy) = (
        collect(&plain, 0..2000, 1),
        collect(&fixture.plan(), 0..2000, 1),
    );
    assert_eq!(flat.root_rest, bumpy.root_rest);
    assert_eq!(flat.barycentric, bumpy.barycentric);
    let mut turned = 0;
    for i in 0..flat.len() {
        let [from, to] = [&flat, &bumpy].map(|hair| hair.strand_points(i)[0]);
        let u = flat.root_uv[i][0];
        // The map rises with u by steps of 1/128, each 1/64 wide, from 0.5.
        let inside = (0.02..0.98).contains(&u);
        let expected = 0.1 * (0.5 + (u * 64.0 - 0.5) / 128.0);
        assert!(!inside || (from.distance(to) - expected).abs() < 1e-5);
        let [before, after] = [&flat, &bumpy].map(|hair| {
            let points = hair.strand_points(i);
            (points[1] - points[0]).normalize()
        });
        turned += usize::from(before.distance(after) > 1e-3);
    }
    assert!(turned > 1000, "{turned}");
}
