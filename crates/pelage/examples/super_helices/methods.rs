//! Ways from a target to fewer numbers, each as "so many parts give this error".

use pelage::curves::frenet::{Measure, SpaceCurve};
use pelage::curves::super_helix::baseline::{floating_tangents, root_to_tip};
use pelage::curves::super_helix::{Goal, Settings, SuperHelix, fit};
use pelage::curves::{Chain, DVec3};

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Curves through vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spline {
    /// Centripetal.
    CatmullRom,
    /// Straight edges.
    Polygon,
}

/// Places along a curve where errors are looked for.
const PLACES: usize = 400;

/// Parts of the length to either side in which the nearest point is looked for.
const NEAR: f64 = 0.05;

/// A target with its places at equal steps of arc length.
pub struct Target {
    pub curve: Chain,
    pub length: f64,
    /// `PLACES + 1`.
    pub places: Vec<DVec3>,
}

impl Target {
    /// The centripetal Catmull-Rom curve through the points of a strand.
    pub fn new(points: &[DVec3]) -> Result<Self> {
        let curve = Chain::catmull_rom(points, 0.5)?;
        let measure = Measure::new(&curve)?;
        Ok(Self {
            places: even(&curve, &measure, PLACES),
            length: measure.total(),
            curve,
        })
    }

    /// Largest distance from a Super-Helix at equal parts of the lengths, as a part of the
    /// length.
    pub fn miss(&self, other: &SuperHelix) -> f64 {
        let points = other.points(PLACES);
        let pairs = points.iter().zip(&self.places);
        pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max) / self.length
    }

    /// The same from a curve through `spans + 1` of its points at equal steps of arc length,
    /// and the largest distance from its places to the nearest of that curve.
    pub fn spline_misses(&self, spline: Spline, spans: usize) -> Result<[f64; 2]> {
        let measure = Measure::new(&self.curve)?;
        let through = even(&self.curve, &measure, spans);
        let curve = match spline {
            Spline::CatmullRom => Chain::catmull_rom(&through, 0.5)?,
            Spline::Polygon => Chain::polygon(&through)?,
        };
        let points = even(&curve, &Measure::new(&curve)?, 2 * PLACES);
        let near = (NEAR * points.len() as f64) as usize;
        let mut worst = [0.0f64; 2];
        for (i, place) in self.places.iter().enumerate() {
            let window = &points[(2 * i).saturating_sub(near)..points.len().min(2 * i + near)];
            let nearest = window.iter().map(|p| p.distance(*place));
            worst[0] = worst[0].max(points[2 * i].distance(*place));
            worst[1] = worst[1].max(nearest.fold(f64::INFINITY, f64::min));
        }
        Ok(worst.map(|w| w / self.length))
    }
}

fn even(curve: &impl SpaceCurve, measure: &Measure, steps: usize) -> Vec<DVec3> {
    let point = |i: usize| {
        let (piece, t) = measure.locate(curve, measure.total() * i as f64 / steps as f64);
        curve.at(piece, t)[0]
    };
    (0..=steps).map(point).collect()
}

/// Ways to a Super-Helix of a number of elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Our fit.
    Fit,
    /// Our fit with the joints where the reduction leaves them, as document 002 has it.
    Still,
    /// Helices through points, their tangents floating.
    Floating,
    /// Element after element from the root.
    Naive,
}

impl Method {
    pub const ALL: [Self; 4] = [Self::Fit, Self::Still, Self::Floating, Self::Naive];

    pub fn name(self) -> &'static str {
        match self {
            Self::Fit => "fit",
            Self::Still => "fit, joints not moved",
            Self::Floating => "floating tangents",
            Self::Naive => "root to tip",
        }
    }

    fn settings(self, goal: Goal) -> Settings {
        Settings {
            move_joints: self == Self::Fit,
            ..Settings::new(goal)
        }
    }

    /// The curve of so many elements.
    pub fn elements(self, target: &Target, elements: usize) -> Result<SuperHelix> {
        match self {
            Self::Fit | Self::Still => {
                let settings = self.settings(Goal::Elements(elements));
                Ok(fit(&target.curve, &settings)?.curve)
            }
            Self::Floating => Ok(floating_tangents(&target.curve, elements)?),
            Self::Naive => Ok(root_to_tip(&target.curve, elements)?),
        }
    }

    /// The curve of the fewest elements, `most` at most, whose error is within `bound`.
    pub fn within(self, target: &Target, bound: f64, most: usize) -> Result<Option<SuperHelix>> {
        match self {
            Self::Fit | Self::Still => {
                let settings = self.settings(Goal::RelativeError(bound));
                let found = fit(&target.curve, &settings)?;
                Ok(found.kept.then_some(found.curve))
            }
            Self::Floating | Self::Naive => {
                for elements in 1..=most {
                    let curve = self.elements(target, elements)?;
                    if target.miss(&curve) <= bound {
                        return Ok(Some(curve));
                    }
                }
                Ok(None)
            }
        }
    }
}
