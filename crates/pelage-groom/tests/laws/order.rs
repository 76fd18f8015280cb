//! Hairs along the surface are the hairs of their indices.

use crate::fixture::{Fixture, collect, collected, kinds, request};
use pelage_groom::{Order, Plan, Pose, Request, generate, write_roots};
use pelage_strands::{Collect, Sink, SinkError, StrandBuffer};
use std::ops::Range;

fn along(plan: &Plan, hairs: Range<u64>, threads: usize) -> StrandBuffer {
    collected(plan, &along_request(hairs, threads))
}

fn along_request(hairs: Range<u64>, threads: usize) -> Request {
    Request {
        order: Order::Surface,
        ..request(hairs, threads)
    }
}

/// The same strands in the order of their indices.
fn by_index(strands: &StrandBuffer) -> StrandBuffer {
    let mut order: Vec<usize> = (0..strands.len()).collect();
    order.sort_by_key(|&i| (strands.hair_id[i], strands.strand_id.get(i).copied()));
    fn each<T: Copy>(order: &[usize], values: &[T]) -> Vec<T> {
        let kept = order.iter().filter_map(|&i| values.get(i));
        kept.copied().collect()
    }
    let vertices: Vec<usize> = order.iter().flat_map(|&i| strands.vertices(i)).collect();
    let mut offsets = vec![0];
    for &i in &order {
        offsets.push(offsets[offsets.len() - 1] + strands.vertex_count(i) as u32);
    }
    StrandBuffer {
        offsets,
        points: each(&vertices, &strands.points),
        widths: each(&vertices, &strands.widths),
        colors: each(&vertices, &strands.colors),
        opacities: each(&vertices, &strands.opacities),
        normals: each(&vertices, &strands.normals),
        hair_id: each(&order, &strands.hair_id),
        strand_id: each(&order, &strands.strand_id),
        root_uv: each(&order, &strands.root_uv),
        strand_uv: each(&order, &strands.strand_uv),
        group: each(&order, &strands.group),
        triangle: each(&order, &strands.triangle),
        barycentric: each(&order, &strands.barycentric),
        root_rest: each(&order, &strands.root_rest),
    }
}

#[test]
fn hairs_along_the_surface_are_the_hairs_of_their_indices_bit_for_bit() {
    for fixture in kinds() {
        let (plan, more) = (fixture.plan(), fixture.more);
        for hairs in [0..5000, 777..2900, 4999..5000, 5000..5000] {
            let found = along(&plan, hairs.clone(), 1);
            assert!(by_index(&found) == collect(&plan, hairs, 1), "{more}");
        }
    }
}

#[test]
fn neighbours_that_are_weighed_together_are_weighed_as_each_alone() {
    for guides in [1, 2, 3, 4, 5, 6, 30] {
        let more = format!("interpolation.guides = {guides}");
        let fixture = Fixture {
            more: &more,
            count: 30_000,
            ..Fixture::default()
        };
        // Of so few hairs by index no two choose among the same guides.
        let (plan, hairs) = (fixture.plan(), 12_345..12_375);
        let found = by_index(&along(&plan, 0..30_000, 2));
        let alone = collect(&plan, hairs.clone(), 1);
        for (i, hair) in hairs.enumerate() {
            let hair = hair as usize;
            assert_eq!(found.strand_points(hair), alone.strand_points(i), "{more}");
        }
    }
}

#[test]
fn hairs_along_the_surface_are_the_same_bits_for_any_thread_count() {
    for fixture in kinds() {
        let (plan, more) = (fixture.plan(), fixture.more);
        let one = along(&plan, 0..5000, 1);
        for threads in [2, 7] {
            let same = along(&plan, 0..5000, threads) == one;
            assert!(same, "{threads} threads, {more}");
        }
    }
}

#[test]
fn hairs_along_the_surface_follow_their_neighbours() {
    for fixture in kinds() {
        let (plan, more) = (fixture.plan(), fixture.more);
        let step = |strands: &StrandBuffer| {
            let pairs = strands.root_rest.windows(2);
            let apart = pairs.map(|pair| {
                let across = (0..3).map(|k| pair[1][k] - pair[0][k]);
                across.map(|x| x * x).sum::<f32>().sqrt()
            });
            apart.sum::<f32>()
        };
        let (near, far) = (along(&plan, 0..5000, 1), collect(&plan, 0..5000, 1));
        assert!(step(&near) < 0.15 * step(&far), "{more}");
    }
}

/// Collects strands and says that their order is of no matter.
#[derive(Default)]
struct AnyOrder(Collect);

impl Sink for AnyOrder {
    fn takes_any_order(&self) -> bool {
        true
    }

    fn write(&mut self, strands: &StrandBuffer) -> Result<(), SinkError> {
        self.0.write(strands)
    }
}

#[test]
fn sinks_that_take_any_order_get_that_of_the_surface_unless_another_is_asked_for() {
    let plan = Fixture::default().plan();
    let found = |order| {
        let mut sink = AnyOrder::default();
        let request = Request {
            order,
            ..request(0..3000, 1)
        };
        let poses = &mut |_| Ok(Pose::default());
        generate(&plan, &request, poses, &mut sink, &mut |_| true).unwrap();
        sink.0.strands
    };
    assert!(found(Order::Auto) == along(&plan, 0..3000, 1));
    assert!(found(Order::Index) == collect(&plan, 0..3000, 1));
}

#[test]
fn roots_along_the_surface_are_those_of_the_hairs() {
    for fixture in kinds() {
        let plan = fixture.plan();
        let roots = |request: &Request| {
            let mut sink = Collect::default();
            let count = write_roots(plan.roots(), request, None, &mut sink, &mut |_| true);
            assert_eq!(count.unwrap() as usize, sink.strands.len());
            sink.strands
        };
        let along = roots(&along_request(100..4100, 3));
        assert!(by_index(&along) == roots(&request(100..4100, 1)));
    }
}

#[test]
fn more_random_hairs_than_memory_should_hold_are_refused_along_the_surface() {
    let fixture = Fixture {
        more: "roots.pattern = 'random'",
        ..Fixture::default()
    };
    let plan = fixture.plan();
    let mut sink = Collect::default();
    let request = along_request(0..1 << 40, 1);
    let error = write_roots(plan.roots(), &request, None, &mut sink, &mut |_| true);
    let message = error.unwrap_err().to_string();
    assert!(
        message.starts_with("1099511627776 hairs in the order"),
        "{message}"
    );
    assert!(message.contains("250000000 at most"), "{message}");
}

#[test]
fn progress_along_the_surface_ends_at_the_number_of_hairs() {
    let plan = Fixture::default().plan();
    let mut last = 0;
    let progress = &mut |done| {
        assert!(done >= last);
        last = done;
        true
    };
    let poses = &mut |_| Ok(Pose::default());
    let request = along_request(0..5000, 2);
    generate(&plan, &request, poses, &mut Collect::default(), progress).unwrap();
    assert_eq!(last, 5000);
}
