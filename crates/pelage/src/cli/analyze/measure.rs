//! What is measured of each curve.
//!
//! Source: document 000, section 4.2: curvature and torsion as means over steps of equal
//! arc length of the Catmull-Rom curve through the vertices. Lengths in the unit of the
//! file, curvature and torsion in radians per unit.

use pelage::StrandBuffer;
use pelage::curves::DVec3;
use pelage::curves::frenet::{Apparatus, CatmullRom, Segment};
use rayon::prelude::*;
use serde::Serialize;

/// Strands between two words of how far it is.
const BLOCK: usize = 1 << 14;

/// One curve in numbers.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Measured {
    /// Arc length.
    pub length: f64,
    /// Distance of the ends over the length: 1 is straight.
    pub straightness: f64,
    /// Mean of the curvature without its sign.
    pub curvature: f64,
    /// Largest curvature without its sign.
    pub most_curvature: f64,
    /// Mean of the torsion.
    pub torsion: f64,
    /// Turn of the binormal over that of the tangent; 0 is flat, and beyond 1 a curve
    /// winds up more than it bends. `None` for straight curves.
    pub helicity: Option<f64>,
    /// Bend along the whole curve, without its sign, in degrees.
    pub bend: f64,
}

/// A curve in numbers and, where they are plotted, its parts.
pub struct Taken {
    pub measured: Measured,
    pub segments: Option<Vec<Segment>>,
}

/// The curve through the vertices of strand `strand`.
pub fn points(strands: &StrandBuffer, strand: usize) -> Vec<DVec3> {
    let points = strands.strand_points(strand);
    points.iter().map(|point| point.as_dvec3()).collect()
}

/// Takes every strand apart; `None` for those that are no curve. Every `kept`th keeps its
/// parts. `done` hears of each block of strands.
pub fn measure(
    strands: &StrandBuffer,
    steps: usize,
    kept: usize,
    mut done: impl FnMut(usize),
) -> Vec<Option<Taken>> {
    let mut all = Vec::with_capacity(strands.len());
    while all.len() < strands.len() {
        let end = strands.len().min(all.len() + BLOCK);
        let block = (all.len()..end).into_par_iter();
        all.par_extend(block.map(|strand| {
            let points = points(strands, strand);
            let apparatus = Apparatus::of(&CatmullRom::new(&points).ok()?, steps).ok()?;
            let ends = points.first()?.distance(*points.last()?);
            let measured = of(&apparatus, ends)?;
            let segments = strand.is_multiple_of(kept).then_some(apparatus.segments);
            Some(Taken { measured, segments })
        }));
        done(all.len());
    }
    all
}

fn of(apparatus: &Apparatus, ends: f64) -> Option<Measured> {
    let length = apparatus.length();
    if length <= 0.0 {
        return None;
    }
    let sum = |part: fn(&Segment) -> f64| {
        let parts = apparatus.segments.iter();
        parts
            .map(|segment| part(segment) * segment.length)
            .sum::<f64>()
    };
    let (bend, twist) = (sum(|s| s.curvature.abs()), sum(|s| s.torsion));
    let curvatures = apparatus.segments.iter().map(|s| s.curvature.abs());
    // A thousandth of a degree along the whole curve is rounding of vertices.
    let bends = bend.to_degrees() > 1e-3;
    Some(Measured {
        length,
        straightness: ends / length,
        curvature: bend / length,
        most_curvature: curvatures.fold(0.0, f64::max),
        torsion: twist / length,
        helicity: bends.then(|| twist / bend),
        bend: bend.to_degrees(),
    })
}
