//! Space curves, and nothing about hair.
//!
//! A curve here is a slice of control vertices with a [`Basis`] and a [`Wrap`],
//! read as OpenUSD reads `BasisCurves`, with one rule for end points: a curve
//! *through* its vertices is a Catmull-Rom curve whose first and last vertex are
//! duplicated ([`catmull_rom`]).
//!
//! Positions are `f32` ([`Vec3`]); lengths are measured and inverted in `f64`.
//!
//! What needs more than that is `f64` throughout, and any [`SpaceCurve`](frenet::SpaceCurve):
//! [`Chain`] (Bézier, Catmull-Rom of any exponent, whatever a [`Curve`] is) and [`Nurbs`],
//! with three derivatives ([`Jet`]), exact splits, tight bounds, curvature and torsion
//! ([`Bend`]), arc length ([`frenet::Measure`]) and even points ([`resample`]). What bends
//! and winds is in [`frenet`], frames in [`Framing`], generalised cylinders in [`tube`], and
//! curves as few numbers in [`super_helix`].
//!
//! ```
//! use pelage_curves::{Vec3, Curve, Basis, Wrap};
//!
//! let points = [Vec3::ZERO, Vec3::X, Vec3::new(2.0, 1.0, 0.0)];
//! let curve = Curve::new(&points, Basis::CatmullRom, Wrap::Pinned).unwrap();
//! let even = curve.resample(4);
//! assert_eq!(even.len(), 5);
//! assert_eq!(even[0], points[0]);
//! ```

mod arc_length;
mod basis;
pub mod catmull_rom;
mod chain;
mod cubic;
mod curve;
mod frames;
mod framing;
pub mod frenet;
mod jet;
mod many;
mod nurbs;
mod spline_error;
pub mod super_helix;
pub mod tube;

pub use arc_length::ArcLength;
pub use basis::{Basis, Wrap};
pub use chain::Chain;
pub use cubic::{Cubic, CubicBasis};
pub use curve::{Curve, CurveError};
pub use frames::{any_perpendicular, double_reflection};
pub use framing::{Framing, close_frames, twists};
pub use glam;
pub use glam::{DVec3, Vec2, Vec3};
pub use jet::{Bend, Jet, resample};
pub use many::{FrameScratch, untwisted_normals};
pub use nurbs::Nurbs;
pub use spline_error::SplineError;
