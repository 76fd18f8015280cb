//! What a run tells its sink, and what it keeps between calls.

use crate::fixture::{Fixture, collect, request};
use pelage_groom::{Capture, Clock, Pose, Scratch, generate};
use pelage_strands::{Amount, Sink, SinkError, StrandBuffer, StreamInfo};

#[test]
fn a_failing_sink_ends_the_run_with_its_words() {
    struct Full(u64);
    impl Sink for Full {
        fn write(&mut self, strands: &StrandBuffer) -> Result<(), SinkError> {
            self.0 += strands.len() as u64;
            if self.0 > 3000 {
                Err(SinkError::new("the disk", "it is full"))
            } else {
                Ok(())
            }
        }
    }
    for threads in [1, 4] {
        let request = request(0..50_000, threads);
        let plan = Fixture {
            count: 50_000,
            ..Fixture::default()
        }
        .plan();
        let run = generate(
            &plan,
            &request,
            &mut |_| Ok(Pose::default()),
            &mut Full(0),
            &mut |_| true,
        );
        assert_eq!(
            run.unwrap_err().to_string(),
            "cannot write the disk: it is full"
        );
    }
}

#[test]
fn what_a_run_announces_is_what_comes_where_no_hair_is_left_out() {
    #[derive(Default)]
    struct Announced(Option<Amount>);
    impl Sink for Announced {
        fn begin(&mut self, info: &StreamInfo) -> Result<(), SinkError> {
            self.0 = info.at_most;
            Ok(())
        }
        fn write(&mut self, _: &StrandBuffer) -> Result<(), SinkError> {
            Ok(())
        }
    }
    let mut sink = Announced::default();
    let request = request(100..1500, 1);
    let report = generate(
        &Fixture::default().plan(),
        &request,
        &mut |_| Ok(Pose::default()),
        &mut sink,
        &mut |_| true,
    )
    .unwrap();
    assert_eq!(report.dropped.total(), 0);
    let came = Amount {
        strands: report.strands,
        vertices: report.vertices,
    };
    assert_eq!(sink.0, Some(came));
}

#[test]
fn a_reused_capture_gives_what_a_fresh_one_gives() {
    let plan = Fixture::default().plan();
    let (mut capture, mut scratch, mut clock) =
        (Capture::default(), Scratch::default(), Clock::default());
    let mut out = StrandBuffer::new();
    for range in [0..700u64, 100..120, 0..700] {
        plan.capture(range.clone(), &mut capture, &mut clock);
        plan.evaluate(
            &capture,
            &plan.posed(&Pose::default()).unwrap(),
            &mut scratch,
            &mut out,
            &mut clock,
        );
        assert!(out == collect(&plan, range, 1));
    }
}
