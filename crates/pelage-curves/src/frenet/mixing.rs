//! Strands between guides by mixed bases, or by mixed integrals of them.
//!
//! Source: document 000, section 4.3, options 2 and 3, which it names as alternatives to
//! mixing curvature and torsion (option 1: `interpolation.space = "frenet"` of a groom). U
//! carries a guide's first basis to that at s and R = ∫U (section 3.1); mixed are their
//! elements, at equal fractions of the guides' lengths:
//!
//! - [`mix_bases`], option 2: a mean of rotations is none, so its tangent is made a unit,
//!   and its normal perpendicular to it, and the strand turns evenly from basis to basis.
//!   Every step has its length.
//! - [`mix_integrals`], option 3: a mean of paths is too short, so it is stretched to its
//!   length. Steps still differ in length: the whole has its own, a part need not.
//!
//! Both cost some products a vertex and no sine. Both begin with the mean of the guides' first
//! bases, so curls of different phases keep their shape and lean; of curls that wind more or
//! less often the bases come apart along the strand, and what is mixed is flattened as a mean
//! of vertices is. `pelage bench curves` tells how much.

use super::frame::unit;
use super::step::Step;
use super::{Apparatus, Frame, FrenetError};
use glam::DVec3;

/// A guide, ready to be mixed.
#[derive(Clone, Debug, PartialEq)]
pub struct Ordered {
    /// Its first basis.
    frame: Frame,
    /// U at the ends of the segments.
    bases: Vec<Frame>,
    /// The first row of R there.
    points: Vec<DVec3>,
    /// Arc lengths of the segments.
    lengths: Vec<f64>,
}

impl Ordered {
    /// Prepares `guide`.
    pub fn new(guide: &Apparatus) -> Self {
        let local = Apparatus {
            start: DVec3::ZERO,
            frame: Frame::IDENTITY,
            segments: guide.segments.clone(),
        };
        Self {
            frame: guide.frame,
            bases: local.frames(),
            points: local.points(),
            lengths: guide.segments.iter().map(|s| s.length).collect(),
        }
    }

    /// U at the ends of the segments: the bases of the guide if it started with
    /// [`Frame::IDENTITY`].
    pub fn bases(&self) -> &[Frame] {
        &self.bases
    }
}

/// Means shorter than this, of units, have no direction.
const CANCELLED: f64 = 1e-9;

/// The strand from `start` that `guides` share by their weights, by a mean of their bases
/// (option 2): its points and its bases at them.
///
/// Segments should turn by less than half a turn, as what is between their ends is not looked
/// at. Where the tangents of the guides cancel the basis stays what it was. The weights are not
/// negative; what counts is their ratio.
///
/// # Errors
///
/// [`FrenetError::Empty`] for no guides, [`FrenetError::Weights`] for weights that have no
/// mean, and [`FrenetError::Unlike`] naming a guide of another number of segments than the
/// first.
///
/// ```
/// use pelage_curves::DVec3;
/// use pelage_curves::frenet::{Apparatus, Frame, Ordered, Segment, mix_bases};
/// let guide = |curvature| Ordered::new(&Apparatus {
///     start: DVec3::ZERO,
///     frame: Frame::IDENTITY,
///     segments: vec![Segment { length: 0.25, curvature, torsion: 0.0 }; 4],
/// });
/// // Between bends to opposite sides it goes straight on, and is as long as they are.
/// let (points, _) = mix_bases(&[(&guide(1.0), 0.5), (&guide(-1.0), 0.5)], DVec3::ZERO)?;
/// assert!(points[4].distance(DVec3::X) < 1e-15);
/// # Ok::<(), pelage_curves::frenet::FrenetError>(())
/// ```
pub fn mix_bases(
    guides: &[(&Ordered, f64)],
    start: DVec3,
) -> Result<(Vec<DVec3>, Vec<Frame>), FrenetError> {
    let (shares, first) = shares(guides)?;
    let (mut point, mut frame) = (start, first);
    let (mut points, mut frames) = (vec![point], vec![frame]);
    let mut local = Frame::IDENTITY;
    for i in 1..guides[0].0.bases.len() {
        let mean = |of: fn(&Frame) -> DVec3| sum(&shares, |guide| of(&guide.bases[i]));
        let (tangent, normal) = (mean(|f| f.tangent), mean(|f| f.normal));
        if tangent.length() > CANCELLED {
            // Of normals that cancel, the one before is as good as any.
            local = match unit(tangent.cross(normal)) {
                Some(_) => Frame::new(tangent, normal),
                None => Frame::new(tangent, local.normal),
            };
        }
        let next = Frame {
            tangent: first.vector(local.tangent),
            normal: first.vector(local.normal),
            binormal: first.vector(local.binormal),
        };
        let length: f64 = shares.iter().map(|(g, w)| g.lengths[i - 1] * w).sum();
        point += Step::turning(&frame, &next) * length;
        frame = next;
        points.push(point);
        frames.push(frame);
    }
    Ok((points, frames))
}

/// The strand from `start` that `guides` share by their weights, by a mean of the integrals
/// of their bases (option 3): its points, and how many times the mean was stretched to them.
///
/// The polygon through them is as long as the mean of those of the guides. Where the paths
/// cancel altogether it goes straight on, along the mean of the first tangents, and is
/// stretched infinitely.
///
/// # Errors
///
/// As [`mix_bases`].
pub fn mix_integrals(
    guides: &[(&Ordered, f64)],
    start: DVec3,
) -> Result<(Vec<DVec3>, f64), FrenetError> {
    let (shares, first) = shares(guides)?;
    let count = guides[0].0.points.len();
    let mean: Vec<DVec3> = (0..count)
        .map(|i| sum(&shares, |guide| guide.points[i]))
        .collect();
    let wanted: f64 = shares.iter().map(|(g, w)| polygon(&g.points) * w).sum();
    let found = polygon(&mean);
    if found > CANCELLED * wanted {
        let stretch = wanted / found;
        let place = |&p| start + first.vector(p * stretch);
        return Ok((mean.iter().map(place).collect(), stretch));
    }
    // Guides without length have nothing to cancel.
    let stretch = if wanted > 0.0 { f64::INFINITY } else { 1.0 };
    let part = |i: usize| wanted * i as f64 / (count - 1).max(1) as f64;
    let points = (0..count).map(|i| start + first.tangent * part(i));
    Ok((points.collect(), stretch))
}

/// Guides, each with its part of the whole.
type Shares<'a> = Vec<(&'a Ordered, f64)>;

/// The parts of the guides, and the mean of their first bases.
fn shares<'a>(guides: &[(&'a Ordered, f64)]) -> Result<(Shares<'a>, Frame), FrenetError> {
    let expected = guides.first().ok_or(FrenetError::Empty)?.0.lengths.len();
    let unlike = |(g, _): &(&Ordered, f64)| g.lengths.len() != expected;
    if let Some(guide) = guides.iter().position(unlike) {
        let found = guides[guide].0.lengths.len();
        return Err(FrenetError::Unlike {
            guide,
            found,
            expected,
        });
    }
    let whole: f64 = guides.iter().map(|(_, weight)| weight).sum();
    let sound = guides.iter().all(|&(_, weight)| weight >= 0.0);
    if !(sound && whole > 0.0 && whole.is_finite()) {
        return Err(FrenetError::Weights);
    }
    let shares: Shares = guides.iter().map(|&(g, w)| (g, w / whole)).collect();
    let tangent = sum(&shares, |guide| guide.frame.tangent);
    let normal = sum(&shares, |guide| guide.frame.normal);
    Ok((shares, Frame::new(tangent, normal)))
}

fn sum(shares: &Shares, of: impl Fn(&Ordered) -> DVec3) -> DVec3 {
    shares.iter().map(|(guide, share)| of(guide) * *share).sum()
}

fn polygon(points: &[DVec3]) -> f64 {
    points.windows(2).map(|p| p[0].distance(p[1])).sum()
}

#[cfg(test)]
#[path = "mixing_tests.rs"]
mod tests;
