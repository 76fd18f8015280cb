//! Rates of frames, NURBS, tubes and Super-Helices on one core: `cargo bench -p pelage-curves`.

use pelage_curves::frenet::{Apparatus, Frame, Measure, Placed, Sample, Segment};
use pelage_curves::super_helix::{Goal, Settings, Solver, fit};
use pelage_curves::tube::{Rings, Section, Tube};
use pelage_curves::{Chain, DVec3, FrameScratch, Framing, Jet, Nurbs, Vec3, untwisted_normals};
use std::hint::black_box;
use std::time::Instant;

/// How often each is measured; the best counts, as other work on the machine only slows.
const ROUNDS: usize = 15;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    synthesis();
    frames();
    nurbs()?;
    tubes()?;
    super_helices()?;
    Ok(())
}

/// Millions a second at best.
fn rate(name: &str, items: usize, mut work: impl FnMut()) {
    let mut best = f64::INFINITY;
    for _ in 0..ROUNDS {
        let started = Instant::now();
        work();
        best = best.min(started.elapsed().as_secs_f64());
    }
    println!("{name:<44} {:>7.1} M/s", items as f64 / best / 1e6);
}

/// Curls that differ in everything, and one curl at many roots.
fn synthesis() {
    for vertices in [8, 32, 1000] {
        let curves: Vec<Apparatus> = (0..32_000 / vertices).map(|i| curl(i, vertices)).collect();
        let mut points = Vec::new();
        let name = format!("synthesis, {vertices} vertices a curve");
        rate(&name, curves.len() * vertices * 10, || {
            for _ in 0..10 {
                Apparatus::points_of_many(black_box(&curves), &mut points);
                black_box(&mut points);
            }
        });
        rate(
            &format!("{name}, one by one"),
            curves.len() * vertices,
            || {
                for curve in &curves {
                    black_box(black_box(curve).points());
                }
            },
        );
        let placed = Placed::new(&curves[0].segments);
        rate(
            &format!("{name}, one shape placed"),
            points.len() * 10,
            || {
                for _ in 0..10 {
                    for (curve, points) in curves.iter().zip(points.chunks_mut(vertices)) {
                        placed.place(curve.start, curve.frame, points);
                    }
                    black_box(&mut points);
                }
            },
        );
    }
}

/// A curl whose curvature and torsion vary.
fn curl(i: usize, vertices: usize) -> Apparatus {
    let at = |j: usize| (i * 7919 + j * 104_729) as f64;
    let segment = |j: usize| Segment {
        length: 0.1,
        curvature: 4.0 + libm::sin(at(j)),
        torsion: libm::cos(at(j)),
    };
    Apparatus {
        start: DVec3::X * i as f64,
        frame: Frame::new(DVec3::new(1.0, libm::sin(at(0)), 0.0), DVec3::Z),
        segments: (1..vertices).map(segment).collect(),
    }
}

/// Curls, whose frames do turn.
fn frames() {
    for vertices in [8, 32, 1000] {
        let curves = 32_000 / vertices;
        let point = |i: usize| {
            let (a, z) = ((i % vertices) as f32 * 0.4, (i / vertices) as f32);
            Vec3::new(libm::cosf(a + z), libm::sinf(a + z), 0.1 * a)
        };
        let points: Vec<Vec3> = (0..curves * vertices).map(point).collect();
        let offsets: Vec<u32> = (0..=curves).map(|i| (i * vertices) as u32).collect();
        let mut normals = vec![Vec3::ZERO; points.len()];
        let mut scratch = FrameScratch::default();
        let name = format!("double reflection, {vertices} vertices a curve");
        rate(&name, points.len() * 20, || {
            for _ in 0..20 {
                let points = black_box(&points[..]);
                untwisted_normals(points, &offsets, |_| Vec3::Z, &mut scratch, &mut normals);
                black_box(&mut normals);
            }
        });
    }
}

fn nurbs() -> Result<(), pelage_curves::SplineError> {
    for (degree, rational) in [(3, false), (3, true), (2, true), (5, true)] {
        let n = 200;
        let at = |i: usize| i as f64 * 0.3;
        let points: Vec<DVec3> = (0..n)
            .map(|i| DVec3::new(libm::cos(at(i)), libm::sin(at(i)), at(i)))
            .collect();
        let even = Nurbs::clamped(degree, &points)?;
        // Uneven knots, so that the search for the piece is paid.
        let knots: Vec<f64> = even.knots().iter().map(|k| k * (1.0 + k / 50.0)).collect();
        let weight = |i: usize| if rational { 1.0 + (i % 3) as f64 } else { 1.0 };
        let weights: Vec<f64> = (0..n).map(weight).collect();
        let curve = Nurbs::new(degree, &points, &weights, &knots)?;
        let high = curve.domain().1;
        let steps = 400_000;
        let kind = if rational { "NURBS" } else { "B-spline" };
        let name = format!("{kind} of degree {degree}, three derivatives");
        rate(&name, steps, || {
            for i in 0..steps {
                // All over the curve, in no order.
                let u = (i * 7919 % steps) as f64 / steps as f64 * high;
                black_box(curve.derivatives(black_box(u)));
            }
        });
        rate(&format!("{name}, in its piece"), steps, || {
            for i in 0..steps {
                let t = (i % 100) as f64 / 100.0;
                black_box(curve.jet(black_box(i % 150), black_box(t)));
            }
        });
        let us: Vec<f64> = (0..4000)
            .map(|i| (i * 7919 % 4000) as f64 / 4000.0 * high)
            .collect();
        let mut jets = vec![[DVec3::ZERO; 4]; us.len()];
        rate(&format!("{name}, many at once"), us.len() * 100, || {
            for _ in 0..100 {
                curve.derivatives_at(black_box(&us), &mut jets);
                black_box(&mut jets);
            }
        });
    }
    Ok(())
}

/// One long curl, in f64.
fn tubes() -> Result<(), Box<dyn std::error::Error>> {
    let at = |i: usize| i as f64 * 0.4;
    let points: Vec<DVec3> = (0..2000)
        .map(|i| DVec3::new(libm::cos(at(i)), libm::sin(at(i)), 0.1 * at(i)))
        .collect();
    let curve = Chain::catmull_rom(&points, 0.5)?;
    let samples = Sample::along(&curve, 20_000)?;
    rate("arc length, pieces", 1999, || {
        black_box(Measure::new(&curve)).ok();
    });
    rate("even samples by arc length", 20_000, || {
        black_box(Sample::along(&curve, 20_000)).ok();
    });
    for rule in [
        Framing::Frenet,
        Framing::UpAxis(DVec3::Z),
        Framing::Propagated,
        Framing::DoubleReflection,
    ] {
        rate(&format!("{rule:?}, f64, one curve"), samples.len(), || {
            black_box(rule.frames(&samples, DVec3::Z)).ok();
        });
    }
    let section = Section::circle(16)?;
    let tube = Tube {
        rings: Rings::Even(20_000),
        ..Tube::default()
    };
    rate("tube, vertices", 20_001 * 17, || {
        black_box(tube.sweep(&curve, &section, |t| 0.1 * (1.0 - t))).ok();
    });
    Ok(())
}

/// Strands of 100 points as Super-Helices, and the two solvers against each other.
fn super_helices() -> Result<(), Box<dyn std::error::Error>> {
    let point = |x: f64, turns: f64| {
        let (size, angle) = (0.05 * (0.3 + x), turns * x);
        DVec3::new(size * libm::cos(angle), size * libm::sin(angle), x)
    };
    for (name, turns) in [("wide", 15.0), ("tight", 60.0)] {
        let points: Vec<DVec3> = (0..100).map(|i| point(i as f64 / 99.0, turns)).collect();
        let curl = Chain::catmull_rom(&points, 0.5)?;
        for goal in [Goal::Elements(10), Goal::RelativeError(0.01)] {
            once(&format!("{name} curl to {goal:?}"), || {
                black_box(fit(black_box(&curl), &Settings::new(goal))).ok();
            });
        }
    }
    for elements in [8, 16, 64, 256] {
        // A wave for every two elements, so that none of them is idle.
        let wave = |i: usize| {
            let x = i as f64 / 8.0;
            DVec3::new(x, 0.5 * libm::sin(x), 0.2 * libm::sin(0.3 * x))
        };
        let points: Vec<DVec3> = (0..25 * elements).map(wave).collect();
        let curve = Chain::catmull_rom(&points, 0.5)?;
        for solver in [Solver::Sweep, Solver::ConjugateGradients] {
            let settings = Settings {
                solver,
                start: Some(elements),
                ..Settings::new(Goal::Elements(elements))
            };
            let found = fit(&curve, &settings)?;
            let name = format!(
                "{elements} elements by {solver:?}, {} steps, error {:.1e}",
                found.steps,
                found.worst / found.curve.length()
            );
            once(&name, || {
                black_box(fit(black_box(&curve), &settings)).ok();
            });
        }
    }
    Ok(())
}

/// Milliseconds at best.
fn once(name: &str, mut work: impl FnMut()) {
    let mut best = f64::INFINITY;
    for _ in 0..ROUNDS {
        let started = Instant::now();
        work();
        best = best.min(started.elapsed().as_secs_f64());
    }
    println!("{name:<64} {:>8.2} ms", best * 1e3);
}
