//! Points a second of everything that makes them.

use crate::cli::bench::measure::fastest;
use anyhow::Result;
use pelage::curves::frenet::{Apparatus, Frame, Placed, Sample, Segment};
use pelage::curves::tube::{Rings, Section, Tube};
use pelage::curves::{Chain, DVec3, FrameScratch, Framing, Nurbs, Vec3, untwisted_normals};
use serde::Serialize;
use std::hint::black_box;
use std::time::Instant;

/// What was measured, as `--json` gives it.
#[derive(Clone, Debug, Serialize)]
pub struct Rate {
    pub what: String,
    /// Millions a second, on one thread.
    pub rate: f64,
}

/// Points of all curves of one measurement.
const POINTS: usize = 32_000;

/// How much to measure.
#[derive(Clone, Copy)]
pub struct Effort {
    pub runs: usize,
    /// How often a run goes over all points.
    pub rounds: usize,
}

/// Everything, in the order of the table.
pub fn measure(effort: Effort) -> Result<Vec<Rate>> {
    let mut all = Vec::new();
    for vertices in [32, 1000] {
        synthesis(vertices, effort, &mut all);
    }
    frames(effort, &mut all);
    splines(effort, &mut all)?;
    analysis(effort, &mut all)?;
    Ok(all)
}

fn rate(what: impl Into<String>, points: usize, effort: Effort, mut work: impl FnMut()) -> Rate {
    let seconds = fastest(effort.runs, || {
        let started = Instant::now();
        (0..effort.rounds).for_each(|_| work());
        started.elapsed().as_secs_f64()
    });
    Rate {
        what: what.into(),
        rate: (points * effort.rounds) as f64 / seconds / 1e6,
    }
}

/// Curls that differ in everything.
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

fn synthesis(vertices: usize, effort: Effort, all: &mut Vec<Rate>) {
    let curves: Vec<Apparatus> = (0..POINTS / vertices).map(|i| curl(i, vertices)).collect();
    let mut points = Vec::new();
    let name = |what: &str| format!("{what}, {vertices} vertices a curve");
    let count = curves.len() * vertices;
    all.push(rate(
        name("synthesis, many curves at once"),
        count,
        effort,
        || {
            Apparatus::points_of_many(black_box(&curves), &mut points);
            black_box(&mut points);
        },
    ));
    all.push(rate(
        name("synthesis, one curve after the other"),
        count,
        effort,
        || {
            for curve in &curves {
                black_box(black_box(curve).points());
            }
        },
    ));
    let placed = Placed::new(&curves[0].segments);
    all.push(rate(
        name("one shape placed many times"),
        count,
        effort,
        || {
            for (curve, points) in curves.iter().zip(points.chunks_mut(vertices)) {
                placed.place(curve.start, curve.frame, points);
            }
            black_box(&mut points);
        },
    ));
}

fn frames(effort: Effort, all: &mut Vec<Rate>) {
    let vertices = 32;
    let curves = POINTS / vertices;
    let point = |i: usize| {
        let (a, z) = ((i % vertices) as f32 * 0.4, (i / vertices) as f32);
        Vec3::new(libm::cosf(a + z), libm::sinf(a + z), 0.1 * a)
    };
    let points: Vec<Vec3> = (0..curves * vertices).map(point).collect();
    let offsets: Vec<u32> = (0..=curves).map(|i| (i * vertices) as u32).collect();
    let mut normals = vec![Vec3::ZERO; points.len()];
    let mut scratch = FrameScratch::default();
    all.push(rate(
        "frames by double reflection, f32, 32 vertices a curve",
        points.len(),
        effort,
        || {
            let points = black_box(&points[..]);
            untwisted_normals(points, &offsets, |_| Vec3::Z, &mut scratch, &mut normals);
            black_box(&mut normals);
        },
    ));
}

/// Control points of the splines, as `peers.py` has them.
fn spiral(count: usize) -> Vec<DVec3> {
    let at = |i: usize| i as f64 * 0.3;
    (0..count)
        .map(|i| DVec3::new(libm::cos(at(i)), libm::sin(at(i)), at(i)))
        .collect()
}

fn splines(effort: Effort, all: &mut Vec<Rate>) -> Result<()> {
    let points = spiral(200);
    let plain = Nurbs::clamped(3, &points)?;
    let weights: Vec<f64> = (0..200).map(|i| 1.0 + (i % 3) as f64).collect();
    let rational = Nurbs::new(3, &points, &weights, plain.knots())?;
    // All over the curve, in no order.
    let count = 4000;
    let part = |i: usize| (i * 7919 % count) as f64 / count as f64;
    let us: Vec<f64> = (0..count).map(|i| part(i) * plain.domain().1).collect();
    let mut jets = vec![[DVec3::ZERO; 4]; count];
    for (name, curve) in [("cubic B-spline", &plain), ("cubic NURBS", &rational)] {
        let name = format!("{name}, value and three derivatives");
        all.push(rate(name, count, effort, || {
            curve.derivatives_at(black_box(&us), &mut jets);
            black_box(&mut jets);
        }));
    }
    Ok(())
}

/// A curve taken apart, and what that needs.
fn analysis(effort: Effort, all: &mut Vec<Rate>) -> Result<()> {
    let count = 20_000;
    let curve = Chain::catmull_rom(&spiral(2000), 0.5)?;
    let samples = Sample::along(&curve, count - 1)?;
    all.push(rate(
        "evaluation at equal arc lengths",
        count,
        effort,
        || {
            black_box(Sample::along(black_box(&curve), count - 1)).ok();
        },
    ));
    all.push(rate(
        "analysis of these into κ and τ",
        count,
        effort,
        || {
            black_box(Apparatus::of_samples(black_box(&samples))).ok();
        },
    ));
    all.push(rate(
        "both, as `pelage analyze` does",
        count,
        effort,
        || {
            black_box(Apparatus::of(black_box(&curve), count - 1)).ok();
        },
    ));
    for (name, rule) in [
        ("Frenet", Framing::Frenet),
        ("up-axis", Framing::UpAxis(DVec3::Z)),
        ("propagated", Framing::Propagated),
        ("double reflection", Framing::DoubleReflection),
    ] {
        let name = format!("frames of one curve, f64, {name}");
        all.push(rate(name, count, effort, || {
            black_box(rule.frames(&samples, DVec3::Z)).ok();
        }));
    }
    let section = Section::circle(16)?;
    let tube = Tube {
        rings: Rings::Even(count),
        ..Tube::default()
    };
    all.push(rate(
        "tube of 16 sides, vertices",
        (count + 1) * 17,
        effort,
        || {
            black_box(tube.sweep(&curve, &section, |t| 0.1 * (1.0 - t))).ok();
        },
    ));
    Ok(())
}
