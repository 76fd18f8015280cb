//! The points of many curves at once.
//!
//! Along one curve each basis waits for the one before; curves do not wait for each other,
//! so [`LANES`] of them are walked side by side with their numbers in rows. What is done at
//! a vertex is the [`Step`] that serves a single curve, so a curve has the same bits
//! whatever its neighbours and whatever the processor's vectors.

use super::{Apparatus, Frame, Segment, Step};
use fearless_simd::{Level, dispatch};
use glam::DVec3;

/// Curves side by side: two of the widest common vectors.
const LANES: usize = 16;

/// A number of each of the curves that are side by side.
type Row = [f64; LANES];

/// Where each of the curves is: position, tangent, normal and binormal.
struct Walk([[Row; 3]; 4]);

impl Walk {
    #[inline(always)]
    fn get(&self, vector: usize, lane: usize) -> DVec3 {
        let [x, y, z] = &self.0[vector];
        DVec3::new(x[lane], y[lane], z[lane])
    }

    #[inline(always)]
    fn set(&mut self, vector: usize, lane: usize, value: DVec3) {
        let [x, y, z] = &mut self.0[vector];
        (x[lane], y[lane], z[lane]) = value.into();
    }

    #[inline(always)]
    fn go(&mut self, lane: usize, step: impl Fn() -> Step) {
        let [point, tangent, normal, binormal] = [0, 1, 2, 3].map(|v| self.get(v, lane));
        let (step, frame) = (
            step(),
            Frame {
                tangent,
                normal,
                binormal,
            },
        );
        let next = step.frame(&frame);
        self.set(0, lane, point + step.shift(&frame));
        self.set(1, lane, next.tangent);
        self.set(2, lane, next.normal);
        self.set(3, lane, next.binormal);
    }
}

impl Apparatus {
    /// Writes the [`points`](Self::points) of many curves, one after the other, over what is
    /// in `points`: the same, to the bit, several times as fast.
    ///
    /// ```
    /// use pelage_curves::{DVec3, frenet::{Apparatus, Frame, Segment}};
    /// let bend = Segment { length: 0.1, curvature: 2.0, torsion: 0.5 };
    /// let curve = |x| Apparatus { start: DVec3::X * x, frame: Frame::IDENTITY, segments: vec![bend; 9] };
    /// let (curves, mut points) = ([curve(0.0), curve(1.0)], Vec::new());
    /// Apparatus::points_of_many(&curves, &mut points);
    /// assert_eq!(points[10..], curves[1].points());
    /// ```
    pub fn points_of_many(curves: &[Self], points: &mut Vec<DVec3>) {
        let count = curves.iter().map(|curve| curve.segments.len() + 1).sum();
        points.clear();
        points.resize(count, DVec3::ZERO);
        dispatch!(Level::new(), simd => {
            let _ = simd;
            let mut rest = points.as_mut_slice();
            for block in curves.chunks(LANES) {
                let count = block.iter().map(|curve| curve.segments.len() + 1).sum();
                let (own, after) = rest.split_at_mut(count);
                side_by_side(block, own);
                rest = after;
            }
        });
    }
}

/// The points of [`LANES`] curves at most.
#[inline(always)]
fn side_by_side(curves: &[Apparatus], points: &mut [DVec3]) {
    let mut walk = Walk([[[0.0; LANES]; 3]; 4]);
    let (mut starts, mut counts, mut at) = ([0; LANES], [0; LANES], 0);
    for (lane, curve) in curves.iter().enumerate() {
        let Frame {
            tangent,
            normal,
            binormal,
        } = curve.frame;
        let vectors = [curve.start, tangent, normal, binormal];
        (0..).zip(vectors).for_each(|(v, x)| walk.set(v, lane, x));
        (starts[lane], counts[lane]) = (at, curve.segments.len());
        points[at] = curve.start;
        at += counts[lane] + 1;
    }
    let longest = counts.iter().copied().max().unwrap_or(0);
    for i in 0..longest {
        // Curves that have ended make steps without length.
        let mut segments = [[0.0; LANES]; 3];
        for (lane, curve) in curves.iter().enumerate() {
            let own = curve.segments.get(i).copied().unwrap_or_default();
            let [length, curvature, torsion] = &mut segments;
            (length[lane], curvature[lane], torsion[lane]) =
                (own.length, own.curvature, own.torsion);
        }
        all_go(&mut walk, &segments);
        for lane in (0..curves.len()).filter(|&lane| i < counts[lane]) {
            points[starts[lane] + i + 1] = walk.get(0, lane);
        }
    }
}

/// One step of each curve.
#[inline(always)]
fn all_go(walk: &mut Walk, [length, curvature, torsion]: &[Row; 3]) {
    let segment = |lane: usize| Segment {
        length: length[lane],
        curvature: curvature[lane],
        torsion: torsion[lane],
    };
    let mut largest = 0.0;
    for lane in 0..LANES {
        let (k, t) = segment(lane).angles();
        let square = k * k + t * t;
        largest = if square < largest { largest } else { square };
    }
    if largest < Step::SMALL {
        for lane in 0..LANES {
            walk.go(lane, || Step::small(segment(lane)));
        }
    } else {
        for lane in 0..LANES {
            walk.go(lane, || Step::new(segment(lane)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn many_curves_have_the_points_of_each_alone(
            curves in prop::collection::vec(
                prop::collection::vec((0.0f64..1.0, -9.0f64..9.0, -9.0f64..9.0), 0..12), 0..40),
            tangent in prop::array::uniform3(-1.0f64..1.0),
        ) {
            let curves: Vec<Apparatus> = curves
                .iter()
                .enumerate()
                .map(|(i, parts)| Apparatus {
                    start: DVec3::X * i as f64,
                    frame: Frame::new(tangent.into(), DVec3::Y * i as f64),
                    segments: parts
                        .iter()
                        .map(|&(length, curvature, torsion)| Segment { length, curvature, torsion })
                        .collect(),
                })
                .collect();
            // What was there before is gone.
            let mut points = vec![DVec3::NAN; 3];
            Apparatus::points_of_many(&curves, &mut points);
            let alone: Vec<DVec3> = curves.iter().flat_map(Apparatus::points).collect();
            prop_assert_eq!(points, alone);
        }
    }
}
