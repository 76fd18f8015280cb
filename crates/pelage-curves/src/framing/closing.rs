//! How far frames twist, and making those of a closed curve meet.

use super::carry;
use crate::frenet::{Frame, Sample, perpendicular};
use glam::DVec3;

/// How far each frame is turned about its tangent against the one before, carried without
/// twist (double reflection): radians in -π..=π, positive for a right-handed screw; one
/// less than frames. `samples` are those of the frames.
///
/// On a smooth curve their sum is the whole twist, for Frenet frames the integral of the
/// torsion.
pub fn twists(samples: &[Sample], frames: &[Frame]) -> Vec<f64> {
    let pairs = samples.windows(2).zip(frames.windows(2));
    pairs
        .map(|(s, f)| {
            let step = s[1].position - s[0].position;
            let carried = carry::reflected_twice(&f[0], step, f[1].tangent);
            angle(&Frame::new(f[1].tangent, carried), f[1].normal)
        })
        .collect()
}

/// Turns the frames of a closed curve about their tangents, each by an angle in proportion
/// to its arc length, such that the last has the normal of the first; returns the whole
/// angle that was spread, -π..=π. The last sample is the first one again.
///
/// A closed curve that winds (but for special ones) brings an untwisted frame back turned.
/// Spread evenly, that angle costs the least twist; left alone it would be a seam. Nothing
/// happens to fewer than two frames, or to a curve without length but that its last frame
/// becomes the first.
pub fn close_frames(samples: &[Sample], frames: &mut [Frame]) -> f64 {
    let (&[first, .., last], &[start, .., end]) = (&*frames, samples) else {
        return 0.0;
    };
    // Where the curve has a corner at its seam, as if it went round it.
    let arriving = Frame::new(first.tangent, carry::turned(&last, first.tangent));
    let whole = angle(&arriving, first.normal);
    let length = end.s - start.s;
    for (frame, sample) in frames.iter_mut().zip(samples) {
        let part = (sample.s - start.s) / length;
        if length > 0.0 {
            *frame = turned(frame, whole * part);
        }
    }
    if let Some(end) = frames
        .last_mut()
        .filter(|end| end.tangent.dot(first.tangent) > 0.999)
    {
        // The same bits, so that what is built on the two meets.
        *end = first;
    }
    whole
}

/// Angle about the tangent of `frame` from its normal to `normal`.
fn angle(frame: &Frame, normal: DVec3) -> f64 {
    let normal = perpendicular(normal, frame.tangent).unwrap_or(frame.normal);
    libm::atan2(frame.binormal.dot(normal), frame.normal.dot(normal))
}

/// `frame` turned about its tangent.
fn turned(frame: &Frame, angle: f64) -> Frame {
    let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
    Frame::new(frame.tangent, frame.normal * cosine + frame.binormal * sine)
}
