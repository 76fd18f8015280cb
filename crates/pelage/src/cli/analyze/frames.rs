//! The frames of document 003 side by side.
//!
//! Source: document 003, whose pictures compare Frenet frames, those of a fixed up-axis and
//! propagated ones, beside double reflection (document 004, section 2.2.8). A ribbon along the
//! normals shows where a rule jumps or whirls.

use crate::cli::space::{Panel, Stroke, View, picture as panels};
use anyhow::Result;
use pelage::curves::frenet::{Frame, Sample, SpaceCurve};
use pelage::curves::{DVec3, Framing};

/// Steps along the curve, fine enough that what jumps is seen to.
const STEPS: usize = 160;

/// Length of a normal over that of the curve.
const NORMAL: f64 = 0.06;

/// Colours of the lines of frames: normals, their ends, and the curve.
const COLORS: [usize; 3] = [5, 0, 6];

/// The frames of `curve` by each rule.
pub fn picture(curve: &impl SpaceCurve) -> Result<String> {
    let samples = Sample::along(curve, STEPS)?;
    let view = view(&samples);
    let rules = [
        ("Frenet", Framing::Frenet),
        ("up-axis +Y", Framing::UpAxis(DVec3::Y)),
        ("propagated", Framing::Propagated),
        ("double reflection", Framing::DoubleReflection),
    ];
    let mut all = Vec::new();
    for (name, rule) in rules {
        let frames = rule.frames(&samples, view.right)?;
        all.push(Panel {
            title: name.into(),
            strokes: strokes(&samples, &frames),
        });
    }
    Ok(panels(&all, all.len(), &view))
}

fn strokes(samples: &[Sample], frames: &[Frame]) -> Vec<Stroke> {
    let length = samples.last().map_or(0.0, |last| last.s);
    let tip =
        |(sample, frame): (&Sample, &Frame)| sample.position + frame.normal * (NORMAL * length);
    let pairs = || samples.iter().zip(frames);
    let [normals, ends, line] = COLORS;
    let stroke = |points, color, width| Stroke {
        points,
        color: Some(color),
        width,
    };
    let mut strokes: Vec<Stroke> = pairs()
        .map(|pair| stroke(vec![pair.0.position, tip(pair)], normals, 0.6))
        .collect();
    strokes.push(stroke(pairs().map(tip).collect(), ends, 1.5));
    strokes.push(stroke(
        samples.iter().map(|s| s.position).collect(),
        line,
        2.0,
    ));
    strokes
}

/// Looks at the curve from where it is broadest: its longest extent up, the next to the right.
fn view(samples: &[Sample]) -> View {
    let middle = samples.iter().map(|s| s.position).sum::<DVec3>() / samples.len() as f64;
    let away = |s: &Sample| s.position - middle;
    let farthest = |of: &dyn Fn(&Sample) -> DVec3| {
        let vectors = samples.iter().map(of);
        vectors.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))
    };
    let long = farthest(&away).unwrap_or(DVec3::Y);
    let up = if long.length() > 0.0 {
        long.normalize()
    } else {
        DVec3::Y
    };
    // A curve's tip is up.
    let up = if up.dot(samples[samples.len() - 1].position - samples[0].position) < 0.0 {
        -up
    } else {
        up
    };
    let across = |s: &Sample| away(s) - up * away(s).dot(up);
    let wide = farthest(&across).unwrap_or(DVec3::ZERO);
    let right = match wide.length() > 1e-6 * long.length() {
        true => wide.normalize(),
        false => up.any_orthonormal_vector(),
    };
    View { right, up }
}
