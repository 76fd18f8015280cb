//! Strands between curled guides, by what of the guides is mixed.
//!
//! Source: document 000, section 4.3: its three options, and the mean of vertices of
//! document 004. Guides are curls about +Z whose phases differ, and then also their turns.

use crate::cli::bench::measure::fastest;
use crate::cli::space::{Panel, Stroke, View, picture};
use anyhow::Result;
use pelage::curves::frenet::{Apparatus, Frame, Ordered, Segment, mix_bases, mix_integrals};
use pelage::curves::{DVec3, Vec3};
use pelage::groom::lanes::{LANES, Rows};
use pelage::groom::random::{Channel, uniform};
use pelage::groom::stages::frenet::{Corner, Parts, Scratch, corners, wind};
use pelage::groom::stages::interpolate::{FOUR, Mix, Row as Packed, interpolate, rows};
use pelage::groom::stages::weights::Share;
use serde::Serialize;
use std::hint::black_box;
use std::time::Instant;

/// Segments of a guide, and its turns: whole ones have so many segments.
const SEGMENTS: usize = 48;
const TURNS: f64 = 4.0;
const A_TURN: usize = 12;

/// Radius of the curls, in heights.
const RADIUS: f64 = 0.1;

/// Guides of a strand.
const SHARED: usize = 3;

/// What is mixed.
const KINDS: [&str; 4] = [
    "vertices (document 004)",
    "κ and τ (1, `space = \"frenet\"`)",
    "bases (2)",
    "integrals (3)",
];

/// One way to mix, over all cases.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// What differs among the guides of a strand.
    pub differ: &'static str,
    pub mixed: &'static str,
    /// Mean of |length - mean length of the guides| over the latter, before and after the
    /// length is mended.
    pub length_error: [f64; 2],
    /// How far bases are from orthonormal, largest entry of M Mᵀ - 1, the mean over vertices:
    /// of the mean of the guides' and of the strand's own; where bases are mixed.
    pub orthogonality: Option<[f64; 2]>,
    /// Mean radius of the curls over that of the guides.
    pub radius: f64,
    /// Mean angle between the strand's axis and that of the guides, in degrees.
    pub lean: f64,
    /// Nanoseconds a vertex, with all made ready for the guides.
    pub nanoseconds: f64,
}

/// Some guides with their weights.
struct Case {
    guides: Vec<Apparatus>,
    weights: [f64; SHARED],
}

impl Case {
    fn new(case: u64, turns_differ: bool) -> Self {
        let random = |k: u64| uniform(case, k, Channel::GuideCurl) as f64;
        let guide = |k: u64| {
            let more = if turns_differ {
                random(k + 6) - 0.5
            } else {
                0.0
            };
            curl(random(k), TURNS + more)
        };
        let weights = [3, 4, 5].map(|k| random(k) + 0.01);
        let whole: f64 = weights.iter().sum();
        Self {
            guides: [0, 1, 2].map(guide).into(),
            weights: weights.map(|w| w / whole),
        }
    }
}

/// A helix about +Z of the height 1 that begins at the origin, at a `phase` in turns.
fn curl(phase: f64, turns: f64) -> Apparatus {
    let (around, angle) = (turns * std::f64::consts::TAU, phase * std::f64::consts::TAU);
    let speed = (RADIUS * RADIUS * around * around + 1.0).sqrt();
    let out = DVec3::new(libm::cos(angle), libm::sin(angle), 0.0);
    let along = DVec3::Z.cross(out) * (RADIUS * around) + DVec3::Z;
    let segment = Segment {
        length: speed / SEGMENTS as f64,
        curvature: RADIUS * around * around / (speed * speed),
        torsion: around / (speed * speed),
    };
    Apparatus {
        start: DVec3::ZERO,
        frame: Frame::new(along, -out),
        segments: vec![segment; SEGMENTS],
    }
}

/// Guides made ready for each way to mix.
struct Ready {
    ordered: Vec<Ordered>,
    weights: [f64; SHARED],
    rows: Vec<Packed>,
    corners: Vec<Corner>,
    shares: Vec<Share>,
}

impl Ready {
    fn new(case: &Case) -> Self {
        let single = |guide: &Apparatus| -> Vec<Vec3> {
            guide.points().iter().map(|p| p.as_vec3()).collect()
        };
        let vertices: Vec<Vec<Vec3>> = case.guides.iter().map(single).collect();
        let share = |(guide, &weight): (u32, &f64)| Share {
            guide,
            weight: weight as f32,
            cosine: weight as f32,
            sine: 0.0,
        };
        Self {
            ordered: case.guides.iter().map(Ordered::new).collect(),
            weights: case.weights,
            rows: vertices.iter().flat_map(|v| rows(v)).collect(),
            corners: vertices.iter().flat_map(|v| corners(v)).collect(),
            shares: (0..).zip(&case.weights).map(share).collect(),
        }
    }

    fn guides(&self) -> Vec<(&Ordered, f64)> {
        self.ordered.iter().zip(self.weights).collect()
    }
}

/// A strand, and how many times it was stretched.
type Strand = (Vec<DVec3>, f64);

/// The strands of all cases by the way `kind` of [`KINDS`].
fn mix(kind: usize, all: &[Ready]) -> Result<Vec<Strand>> {
    let each = all.iter();
    let start = DVec3::ZERO;
    match kind {
        0 => Ok(of_vertices(all, false)),
        1 => Ok(of_vertices(all, true)),
        2 => each
            .map(|ready| Ok((mix_bases(&ready.guides(), start)?.0, 1.0)))
            .collect(),
        _ => each
            .map(|ready| Ok(mix_integrals(&ready.guides(), start)?))
            .collect(),
    }
}

fn of_vertices(all: &[Ready], wound: bool) -> Vec<Strand> {
    let count = SEGMENTS + 1;
    let mut vertices = vec![Vec3::ZERO; count * all.len()];
    let mut side_by_side = vec![Rows::default(); count];
    for (all, hairs) in all.chunks(LANES).zip(vertices.chunks_mut(count * LANES)) {
        for (lane, four) in (0..).step_by(FOUR).zip(all.chunks(FOUR)) {
            let mut mixes = [Mix::default(); FOUR];
            for (mix, ready) in mixes.iter_mut().zip(four) {
                *mix = Mix {
                    guides: &ready.rows,
                    vertices: count,
                    shares: &ready.shares,
                };
            }
            interpolate(mixes, lane, &mut side_by_side);
        }
        for (lane, hair) in hairs.chunks_mut(count).enumerate() {
            for (vertex, row) in hair.iter_mut().zip(&side_by_side) {
                *vertex = row.get(lane);
            }
        }
    }
    if wound {
        let starts: Vec<u32> = (0..=all.len()).map(|i| (i * count) as u32).collect();
        let parts = |i: usize| {
            let (corners, shares) = (&all[i].corners[..], &all[i].shares[..]);
            Some(Parts { corners, shares })
        };
        wind(parts, &starts, &mut Scratch::default(), &mut vertices);
    }
    let double = |hair: &[Vec3]| (hair.iter().map(|p| p.as_dvec3()).collect(), 1.0);
    vertices.chunks(count).map(double).collect()
}

/// All ways, over the guides whose phases differ and those whose turns do too.
pub fn measure(cases: u64, runs: usize) -> Result<Vec<Row>> {
    let mut rows = Vec::new();
    for (differ, turns_differ) in [("phases", false), ("phases and turns", true)] {
        let cases: Vec<Case> = (0..cases).map(|i| Case::new(i, turns_differ)).collect();
        let ready: Vec<Ready> = cases.iter().map(Ready::new).collect();
        for kind in 0..KINDS.len() {
            rows.push(row(differ, kind, &cases, &ready, runs)?);
        }
    }
    Ok(rows)
}

fn row(
    differ: &'static str,
    kind: usize,
    cases: &[Case],
    ready: &[Ready],
    runs: usize,
) -> Result<Row> {
    let strands = mix(kind, ready)?;
    let seconds = fastest(runs, || {
        let started = Instant::now();
        let _ = black_box(mix(kind, black_box(ready)));
        started.elapsed().as_secs_f64()
    });
    let mean = |of: &dyn Fn(&Case, &Strand) -> f64| {
        let all = cases.iter().zip(&strands);
        all.map(|(case, strand)| of(case, strand)).sum::<f64>() / cases.len() as f64
    };
    Ok(Row {
        differ,
        mixed: KINDS[kind],
        length_error: [
            mean(&|case, (points, stretch)| case.length_error(length(points) / stretch)),
            mean(&|case, (points, _)| case.length_error(length(points))),
        ],
        orthogonality: match kind {
            2 => Some(orthogonality(ready)?),
            _ => None,
        },
        radius: mean(&|case, (points, _)| {
            radius(points) / case.mean(|guide| radius(&guide.points()))
        }),
        lean: mean(&|_, (points, _)| lean(points)),
        nanoseconds: seconds * 1e9 / (cases.len() * (SEGMENTS + 1)) as f64,
    })
}

impl Case {
    /// The mean of a measure of the guides, by their weights.
    fn mean(&self, of: impl Fn(&Apparatus) -> f64) -> f64 {
        let parts = self.guides.iter().zip(self.weights);
        parts.map(|(guide, weight)| of(guide) * weight).sum()
    }

    fn length_error(&self, found: f64) -> f64 {
        let wanted = self.mean(|guide| length(&guide.points()));
        (found - wanted).abs() / wanted
    }
}

fn length(points: &[DVec3]) -> f64 {
    points.windows(2).map(|p| p[0].distance(p[1])).sum()
}

/// Root mean square distance from the middle of the turn around.
fn radius(points: &[DVec3]) -> f64 {
    let turns = points.windows(A_TURN + 1);
    let squares = turns.clone().map(|turn| {
        let ends = (turn[0] + turn[A_TURN]) / 2.0;
        let middle = (turn[1..A_TURN].iter().sum::<DVec3>() + ends) / A_TURN as f64;
        turn[A_TURN / 2].distance_squared(middle)
    });
    (squares.sum::<f64>() / turns.len() as f64).sqrt()
}

/// Degrees between +Z and the line from the middle of the first turn to that of the last.
fn lean(points: &[DVec3]) -> f64 {
    let middle = |turn: &[DVec3]| turn.iter().sum::<DVec3>() / A_TURN as f64;
    let axis = middle(&points[points.len() - A_TURN..]) - middle(&points[..A_TURN]);
    libm::atan2(axis.truncate().length(), axis.z).to_degrees()
}

/// Means over all cases and vertices: of the means of bases, and of these mended.
fn orthogonality(all: &[Ready]) -> Result<[f64; 2]> {
    let (mut sums, mut count) = ([0.0; 2], 0.0);
    for ready in all {
        let guides = ready.guides();
        let (_, mended) = mix_bases(&guides, DVec3::ZERO)?;
        for (i, own) in mended.iter().enumerate() {
            let mean = |of: fn(&Frame) -> DVec3| -> DVec3 {
                guides.iter().map(|(g, w)| of(&g.bases()[i]) * *w).sum()
            };
            let mixed = [
                mean(|f| f.tangent),
                mean(|f| f.normal),
                mean(|f| f.binormal),
            ];
            sums[0] += off(mixed);
            sums[1] += off([own.tangent, own.normal, own.binormal]);
            count += 1.0;
        }
    }
    Ok(sums.map(|sum| sum / count))
}

/// The largest entry of M Mᵀ - 1.
fn off(rows: [DVec3; 3]) -> f64 {
    let entries = (0..9).map(|k| {
        let (i, j) = (k / 3, k % 3);
        let one = if i == j { 1.0 } else { 0.0 };
        (rows[i].dot(rows[j]) - one).abs()
    });
    entries.fold(0.0, f64::max)
}

/// Three guides whose phases differ, and what lies evenly between them, by each way.
pub fn kept() -> Result<String> {
    let case = Case {
        guides: [0.0, 0.2, 0.5].map(|phase| curl(phase, TURNS)).into(),
        weights: [1.0 / 3.0; SHARED],
    };
    let all = [Ready::new(&case)];
    let names = [
        "a guide",
        "mean of vertices",
        "κ and τ (1)",
        "bases (2)",
        "integrals (3)",
    ];
    let mut panels = Vec::new();
    for (i, name) in names.into_iter().enumerate() {
        let points = match i {
            0 => case.guides[0].points(),
            _ => mix(i - 1, &all)?.swap_remove(0).0,
        };
        let stroke = Stroke {
            points,
            color: Some(i),
            width: 3.0,
        };
        panels.push(Panel {
            title: name.into(),
            strokes: vec![stroke],
        });
    }
    let view = View {
        right: DVec3::X,
        up: DVec3::Z,
    };
    Ok(picture(&panels, panels.len(), &view))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn profiles_keep_curls_upright_and_wide_where_each_other_way_loses_something() {
        let rows = measure(60, 1).unwrap();
        for rows in rows.chunks(KINDS.len()) {
            let [vertices, profiles, bases, integrals] = rows else {
                panic!("{rows:?}")
            };
            assert!(vertices.radius < 0.7 && profiles.radius > 0.9, "{rows:?}");
            assert!(vertices.length_error[1] > 0.1, "{rows:?}");
            assert!(profiles.length_error[1] < 0.03, "{rows:?}");
            assert!(bases.lean > 10.0 && profiles.lean < 5.0, "{rows:?}");
            assert!(integrals.length_error[1] < 1e-12, "{rows:?}");
            assert!(bases.orthogonality.unwrap()[1] < 1e-13, "{rows:?}");
        }
        assert!(rows[KINDS.len() + 2].orthogonality.unwrap()[0] > 0.1);
        assert!(rows[KINDS.len() + 3].length_error[0] > 0.05);
    }
}
