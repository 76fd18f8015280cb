//! How far steps along a curve of given curvature and torsion lead astray.
//!
//! Source: document 000, section 4.1. Ours takes a helix of the middle's curvature and
//! torsion for each step, with the exact integral of the tangent; the document turns the
//! basis the same way and takes equation 37 for the integral, as printed; Euler adds
//! derivatives. The reference integrates the Frenet–Serret equations (6–9) by the classic
//! Runge–Kutta method at steps so small that halving them changes nothing above 10^-12.

use pelage::curves::DVec3;
use pelage::curves::frenet::{Apparatus, Frame, Segment};
use serde::Serialize;

/// Length of the curves that are stepped along.
const LENGTH: f64 = 10.0;

/// Steps to try.
const STEPS: [usize; 5] = [32, 64, 128, 256, 512];

/// Steps of the reference between two points that are compared.
const FINE: usize = 262_144 / STEPS[0];

/// Curvature, above 0, and torsion at s.
pub struct Profile {
    name: &'static str,
    at: fn(f64) -> [f64; 2],
}

/// Shapes from plain to free.
pub const PROFILES: [Profile; 4] = [
    Profile {
        name: "circle",
        at: |_| [2.0, 0.0],
    },
    Profile {
        name: "helix",
        at: |_| [2.0, 1.0],
    },
    // Figure 1 of document 000: the radius of curvature grows evenly, the helicity stays.
    Profile {
        name: "cyclone",
        at: |s| {
            let k = 1.0 / (0.1 + 0.09 * s);
            [k, 0.2 * k]
        },
    },
    Profile {
        name: "waves",
        at: |s| [2.0 + libm::sin(3.0 * s), libm::cos(2.0 * s)],
    },
];

/// The errors of the methods on one shape at one number of steps: the largest distance from
/// the reference over the length.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    pub shape: &'static str,
    pub steps: usize,
    pub ours: f64,
    pub document: f64,
    pub euler: f64,
}

/// Everything, and how well the reference agrees with itself at twice the step.
pub fn measure() -> (Vec<Row>, f64) {
    let mut rows = Vec::new();
    let mut doubt: f64 = 0.0;
    for profile in &PROFILES {
        let exact = reference(profile, 1);
        doubt = doubt.max(farthest(&exact, &reference(profile, 2)));
        rows.extend(STEPS.map(|steps| row(profile, steps, &exact)));
    }
    (rows, doubt)
}

fn row(profile: &Profile, steps: usize, exact: &[DVec3]) -> Row {
    let every = steps / STEPS[0];
    let error = |points: Vec<DVec3>| {
        let compared: Vec<DVec3> = points.into_iter().step_by(every).collect();
        farthest(&compared, exact)
    };
    Row {
        shape: profile.name,
        steps,
        ours: error(helices(profile, steps).points()),
        document: error(document(profile, steps)),
        euler: error(euler(profile, steps)),
    }
}

fn farthest(a: &[DVec3], b: &[DVec3]) -> f64 {
    let apart = a.iter().zip(b).map(|(p, q)| p.distance(*q));
    apart.fold(0.0, f64::max) / LENGTH
}

/// Each step with the curvature and torsion of its middle.
fn helices(profile: &Profile, steps: usize) -> Apparatus {
    let length = LENGTH / steps as f64;
    let segment = |i: usize| {
        let [curvature, torsion] = (profile.at)((i as f64 + 0.5) * length);
        Segment {
            length,
            curvature,
            torsion,
        }
    };
    Apparatus {
        start: DVec3::ZERO,
        frame: Frame::IDENTITY,
        segments: (0..steps).map(segment).collect(),
    }
}

/// The same bases, and equation 37 between them.
fn document(profile: &Profile, steps: usize) -> Vec<DVec3> {
    let length = LENGTH / steps as f64;
    let mut point = DVec3::ZERO;
    let mut points = vec![point];
    for (i, pair) in helices(profile, steps).frames().windows(2).enumerate() {
        let [k0, k1] = [i, i + 1].map(|j| (profile.at)(j as f64 * length)[0]);
        let angle = (k0 + k1) / 4.0 * length;
        let sinc = libm::sin(angle) / angle;
        point += (pair[0].tangent + pair[1].tangent) / 2.0 * length * sinc;
        points.push(point);
    }
    points
}

/// Position, tangent, normal and binormal.
type State = [DVec3; 4];

const START: State = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];

/// Equations 6 to 9.
fn derivative(profile: &Profile, s: f64, [_, t, n, b]: State) -> State {
    let [k, w] = (profile.at)(s);
    [t, n * k, b * w - t * k, -n * w]
}

fn add(state: State, rate: State, by: f64) -> State {
    std::array::from_fn(|i| state[i] + rate[i] * by)
}

fn euler(profile: &Profile, steps: usize) -> Vec<DVec3> {
    let h = LENGTH / steps as f64;
    let mut state = START;
    let mut points = vec![state[0]];
    for i in 0..steps {
        state = add(state, derivative(profile, i as f64 * h, state), h);
        points.push(state[0]);
    }
    points
}

/// Points at the coarsest of the steps; `coarser` by so much than the finest.
fn reference(profile: &Profile, coarser: usize) -> Vec<DVec3> {
    let between = FINE / coarser;
    let h = LENGTH / (STEPS[0] * between) as f64;
    let mut state = START;
    let mut points = vec![state[0]];
    for i in 0..STEPS[0] * between {
        let s = i as f64 * h;
        let a = derivative(profile, s, state);
        let b = derivative(profile, s + h / 2.0, add(state, a, h / 2.0));
        let c = derivative(profile, s + h / 2.0, add(state, b, h / 2.0));
        let d = derivative(profile, s + h, add(state, c, h));
        for (rate, part) in [(a, 1.0), (b, 2.0), (c, 2.0), (d, 1.0)] {
            state = add(state, rate, part * h / 6.0);
        }
        if (i + 1) % between == 0 {
            points.push(state[0]);
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ours_is_exact_on_helices_of_the_second_order_elsewhere_and_always_the_best() {
        let (rows, doubt) = measure();
        assert!(doubt < 1e-12, "{doubt}");
        for rows in rows.chunks(STEPS.len()) {
            assert!(
                rows.iter()
                    .all(|r| r.ours < r.document && r.document < r.euler)
            );
            if ["circle", "helix"].contains(&rows[0].shape) {
                assert!(rows.iter().all(|r| r.ours < 1e-12), "{rows:?}");
                assert!(rows.iter().all(|r| r.document > 1e-6), "{rows:?}");
            } else {
                let order = rows[3].ours / rows[4].ours;
                assert!((3.5..4.5).contains(&order), "{} {order}", rows[0].shape);
            }
        }
    }
}
