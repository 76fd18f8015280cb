//! Guides as Super-Helices whose elements meet at the same fractions of arc length.
//!
//! Elements are of equal length and stay so: joints that each guide moved to where it bends
//! would mix one guide's curl with the other's straight part. Samples of a guide are whole
//! steps of its length, so joints lie at equal fractions but for half a step; where guides
//! differ in that, all are cut at the joints of all, which leaves constant elements as they
//! are.

use super::Part;
use pelage_curves::frenet::Frame;
use pelage_curves::super_helix::{Goal, Settings, SuperHelix, fit};
use pelage_curves::{Chain, DVec3, Vec3};
use rayon::prelude::*;

/// Exponent of the knots of the curve through a guide's vertices: centripetal, which makes no
/// loops.
const ALPHA: f64 = 0.5;

/// A guide longer than its chord by no more than this part is straight: no vertex is off the
/// chord by more than 1e-4 of it, and what bends there are may be noise of f32.
const EXCESS: f64 = 1e-8;

/// Fractions of the length that are nearer than this are one joint.
const SAME: f64 = 1e-6;

/// Angle per length of the whole guide below which a bend has no plane, in radians: noise of
/// f32 vertices, and no eye sees it.
const STRAIGHT: f64 = 1e-2;

/// Weight of the twist where nothing bends, in radians beside the bend: so small that a
/// curl's winding wins, and not 0, so that there is always a mean.
const LEAST_SAY: f64 = 1e-3;

/// The guides of one group as Super-Helices.
#[derive(Clone, Debug)]
pub struct Helices {
    /// Where elements meet, with both ends, as fractions of the length, ascending.
    pub(super) joints: Vec<f64>,
    /// Length of each guide.
    pub(super) lengths: Vec<f32>,
    /// Elements, one guide after the other.
    pub(super) parts: Vec<Part>,
}

/// One guide: where its elements end, as fractions of its length, and their (q0, q1, q2)
/// times its length.
struct Fitted {
    length: f64,
    ends: Vec<f64>,
    rates: Vec<DVec3>,
}

impl Helices {
    /// Fits guides through these local vertices, the same number each, by `elements` of equal
    /// length, or as many as a guide has segments if these are fewer.
    ///
    /// A guide without length, or that is no curve, is straight.
    pub fn fit(guides: &[Vec<Vec3>], elements: usize) -> Self {
        let fitted = guides.par_iter().map(|guide| Fitted::new(guide, elements));
        let fitted: Vec<Fitted> = fitted.collect();
        let joints = shared_joints(&fitted);
        let parts = fitted.iter().flat_map(|guide| guide.parts(&joints));
        Self {
            parts: parts.collect(),
            lengths: fitted.iter().map(|guide| guide.length as f32).collect(),
            joints,
        }
    }

    /// Number of elements a guide.
    pub(super) fn elements(&self) -> usize {
        self.joints.len() - 1
    }
}

/// Both ends, and where elements of any of the guides meet.
fn shared_joints(guides: &[Fitted]) -> Vec<f64> {
    let ends = guides.iter().flat_map(|guide| &guide.ends).copied();
    let inner = ends.filter(|end| (SAME..=1.0 - SAME).contains(end));
    let mut joints: Vec<f64> = inner.chain([0.0, 1.0]).collect();
    joints.sort_by(f64::total_cmp);
    joints.dedup_by(|b, a| *b - *a < SAME);
    joints
}

impl Fitted {
    fn new(guide: &[Vec3], elements: usize) -> Self {
        let exact: Vec<DVec3> = guide.iter().map(|v| v.as_dvec3()).collect();
        let length: f64 = exact.windows(2).map(|p| p[0].distance(p[1])).sum();
        let Some(exact) = seen_from_itself(&exact) else {
            return Self::straight(0.0);
        };
        let chord = exact.last().map_or(0.0, |tip| tip.length());
        if length <= chord * (1.0 + EXCESS) {
            return Self::straight(length);
        }
        let elements = elements.min(guide.len().saturating_sub(1)).max(1);
        let settings = Settings {
            start: Some(elements),
            move_joints: false,
            // A curve through vertices leaves the first of them along the first edge, which a
            // smooth guide does not; and hairs are laid anyway.
            turn_root: true,
            ..Settings::new(Goal::Elements(elements))
        };
        let curve = Chain::catmull_rom(&exact, ALPHA).ok();
        let found = curve.and_then(|curve| fit(&curve, &settings).ok());
        found.map_or_else(|| Self::straight(0.0), |found| Self::of(&found.curve))
    }

    fn of(curve: &SuperHelix) -> Self {
        let length = curve.length();
        let rates: Vec<DVec3> = curve.elements().iter().map(|e| e.rate() * length).collect();
        let is_curve = length > 0.0 && rates.iter().all(|rate| rate.is_finite());
        if !is_curve {
            return Self::straight(length);
        }
        let mut end = 0.0;
        let ends = curve.elements().iter().map(|element| {
            end += element.length / length;
            end
        });
        let mut fitted = Self {
            length,
            ends: ends.collect(),
            rates,
        };
        fitted.untwist();
        fitted.face();
        fitted
    }

    fn straight(length: f64) -> Self {
        Self {
            length,
            ends: vec![1.0],
            rates: vec![DVec3::ZERO],
        }
    }

    /// Takes the twist, which is noise, out of straight elements; what comes after bends to
    /// where it did.
    fn untwist(&mut self) {
        let (mut start, mut angle) = (0.0, 0.0);
        for (&end, rate) in self.ends.iter().zip(&mut self.rates) {
            *rate = turned(*rate, libm::cos(angle), libm::sin(angle));
            if bend(*rate) < STRAIGHT {
                angle += rate.x * (end - start);
                rate.x = 0.0;
            }
            start = end;
        }
    }

    /// Chooses the frame's first normal: the guide bends to it on the whole, places near the
    /// root counting more. So curls of all phases are alike, and so are S shapes, by what they
    /// bend to first.
    fn face(&mut self) {
        let mut start = 0.0;
        let bends = self.ends.iter().zip(&self.rates).map(|(&end, rate)| {
            let nearness = 1.0 - (start + end) / 2.0;
            let say = nearness * nearness * nearness * nearness * (end - start);
            start = end;
            // A curve bends to q2 of its first normal and -q1 of its second.
            [rate.z * say, -rate.y * say]
        });
        let [x, y] = bends.fold([0.0, 0.0], |[x, y], [a, b]| [x + a, y + b]);
        let size = (x * x + y * y).sqrt();
        if size < STRAIGHT {
            return;
        }
        for rate in &mut self.rates {
            *rate = turned(*rate, x / size, -y / size);
        }
    }

    /// Its elements, cut at `joints`.
    fn parts(&self, joints: &[f64]) -> impl Iterator<Item = Part> {
        joints.windows(2).map(|ends| {
            let middle = (ends[0] + ends[1]) / 2.0;
            let element = self.ends.partition_point(|&end| end <= middle);
            let rate = self.rates[element.min(self.rates.len() - 1)];
            let say = self.length * (bend(rate) + LEAST_SAY);
            Part {
                bend: [rate.y, rate.z].map(|q| (self.length * q) as f32),
                say: say as f32,
                twist: (say * rate.x) as f32,
            }
        })
    }
}

/// Offsets from the first vertex along the chord and to the side the vertices are on: steps of
/// a fit depend on the axes, and the fit shall not depend on how those of the surface lie.
fn seen_from_itself(vertices: &[DVec3]) -> Option<Vec<DVec3>> {
    let (first, last) = (*vertices.first()?, *vertices.last()?);
    let line = (last - first).try_normalize().unwrap_or(DVec3::X);
    let side = vertices.iter().map(|&v| v - first).sum::<DVec3>();
    let axes = Frame::new(line, side);
    let seen = vertices.iter().map(|&v| {
        let offset = v - first;
        DVec3::new(
            offset.dot(axes.tangent),
            offset.dot(axes.normal),
            offset.dot(axes.binormal),
        )
    });
    Some(seen.collect())
}

/// How fast a frame of this (q0, q1, q2) bends.
#[inline(always)]
pub(super) fn bend(rate: DVec3) -> f64 {
    (rate.y * rate.y + rate.z * rate.z).sqrt()
}

/// The same rate in a frame whose normals are turned back by the angle of this cosine and
/// sine.
fn turned(rate: DVec3, cosine: f64, sine: f64) -> DVec3 {
    let (q1, q2) = (rate.y, rate.z);
    DVec3::new(rate.x, cosine * q1 - sine * q2, sine * q1 + cosine * q2)
}
