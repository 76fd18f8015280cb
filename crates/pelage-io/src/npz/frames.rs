//! One frame of arrays that hold several: `points` and `normals` shaped frames, n, 3
//! as our writer shapes them, next to an array `frames` of their times.

use super::read::{Array, Numbers};
use std::collections::BTreeMap;

/// The arrays that may have a leading axis of frames.
const MOVING: [&str; 2] = ["points", "normals"];

/// Cuts the arrays that have frames down to `time`, and takes `frames` out; gives the
/// times of the frames, ascending, empty for a still.
///
/// Without a time the first frame counts. Between frames numbers are interpolated,
/// before the first and after the last they hold. The error says what is wrong with
/// the frames, in words.
pub(super) fn cut_to(
    arrays: &mut BTreeMap<String, Array>,
    time: Option<f64>,
) -> Result<Vec<f64>, String> {
    let count = arrays.get("points").and_then(frame_count);
    let Some(count) = count else {
        return Ok(Vec::new());
    };
    let times = times(arrays.remove("frames"), count)?;
    let sample = Sample::at(&times, time);
    for name in MOVING {
        if let Some(array) = arrays.get_mut(name)
            && frame_count(array) == Some(count)
        {
            sample.cut(array, count);
        }
    }
    Ok(times)
}

/// Length of the leading axis of an array that has one more than a still's.
fn frame_count(array: &Array) -> Option<usize> {
    (array.shape.len() == 3).then_some(array.shape[0] as usize)
}

/// The times of `count` frames; without an array they are numbered from 0.
fn times(frames: Option<Array>, count: usize) -> Result<Vec<f64>, String> {
    let times: Vec<f64> = match frames.map(|array| (array.shape.len(), array.numbers)) {
        None => (0..count).map(|frame| frame as f64).collect(),
        Some((1, Numbers::Double(times))) => times,
        Some((1, Numbers::Real(times))) => times.into_iter().map(f64::from).collect(),
        Some((1, Numbers::Integer(times))) => times.into_iter().map(|t| t as f64).collect(),
        Some(_) => return Err("frames is no list of numbers".into()),
    };
    if count == 0 {
        return Err("points has a leading axis of frames, but no frame".into());
    }
    if times.len() != count {
        return Err(format!(
            "frames has {} entries, but points has {count} frames",
            times.len()
        ));
    }
    let ascend = times.windows(2).all(|pair| pair[0] < pair[1]);
    if !ascend || !times.iter().all(|time| time.is_finite()) {
        return Err("frames must be finite and ascend".into());
    }
    Ok(times)
}

/// A place between two frames: the first, and how far towards the next.
#[derive(Debug, PartialEq)]
struct Sample {
    frame: usize,
    towards_next: f64,
}

impl Sample {
    /// The place of `time` between `times`, of which there is at least one.
    fn at(times: &[f64], time: Option<f64>) -> Self {
        let next = time.map_or(0, |time| times.partition_point(|t| *t <= time));
        let frame = next.saturating_sub(1);
        let towards_next = match (time, times.get(next)) {
            (Some(time), Some(after)) if next > 0 => (time - times[frame]) / (after - times[frame]),
            _ => 0.0,
        };
        Self {
            frame,
            towards_next,
        }
    }

    /// Leaves of `array`, which has `count` frames, what it holds here.
    fn cut(&self, array: &mut Array, count: usize) {
        array.shape.remove(0);
        match &array.numbers {
            Numbers::Real(all) => array.numbers = Numbers::Real(self.of(all, count)),
            Numbers::Double(all) => array.numbers = Numbers::Real(self.of(all, count)),
            Numbers::Integer(_) | Numbers::Other => {}
        }
    }

    /// The numbers at this place of `all`, which holds `count` frames.
    fn of<T: Copy + Into<f64>>(&self, all: &[T], count: usize) -> Vec<f32> {
        let each = all.len() / count;
        let frame = |index: usize| all[index * each..][..each].iter().map(|&x| x.into());
        if self.towards_next == 0.0 {
            return frame(self.frame).map(|x: f64| x as f32).collect();
        }
        let pairs = frame(self.frame).zip(frame(self.frame + 1));
        let between = |(a, b): (f64, f64)| (a + (b - a) * self.towards_next) as f32;
        pairs.map(between).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_is_a_place_between_two_frames_that_holds_at_the_ends() {
        let at = |time| {
            let sample = Sample::at(&[10.0, 12.0, 20.0], time);
            (sample.frame, sample.towards_next)
        };
        assert_eq!(at(None), (0, 0.0));
        assert_eq!(at(Some(-5.0)), (0, 0.0));
        assert_eq!(at(Some(10.0)), (0, 0.0));
        assert_eq!(at(Some(11.0)), (0, 0.5));
        assert_eq!(at(Some(12.0)), (1, 0.0));
        assert_eq!(at(Some(14.0)), (1, 0.25));
        assert_eq!(at(Some(20.0)), (2, 0.0));
        assert_eq!(at(Some(99.0)), (2, 0.0));
        assert_eq!(at(Some(f64::NAN)), (0, 0.0));
    }
}
