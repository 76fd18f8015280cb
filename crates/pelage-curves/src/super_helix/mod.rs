//! Super-Helices: any strand as a few elements of constant twist and curvatures.
//!
//! Source: document 002, "Fitting Super-Helices to NURBS curves" (a poster), with its
//! errata; the curve is that of F. Bertails et al., "Super-Helices for predicting the
//! dynamics of natural hair", 2006, whose simulators take these numbers as they are.
//!
//! - [`SuperHelix`] is the curve, with closed-form derivatives.
//! - [`fit`] goes the poster's three steps: each element from the Frenet–Serret analysis of
//!   the target, all of them by Levenberg–Marquardt, and the cheapest removed one by one.
//! - [`baseline`] has two other ways, to compare with.
//!
//! Errors are distances at equal arc length: harsher than the distance to the nearest
//! point, but what a strand with a colour or a width along it needs.

pub mod baseline;
mod bound;
mod curve;
mod element;
mod error;
mod even;
mod fit;
mod gradients;
mod linear;
mod local;
mod quadratic;
mod reduce;
mod relax;
mod settings;
mod shape;
mod stumpff;
mod sweep;
mod target;

pub use curve::{Derivative, Place, SuperHelix};
pub use element::Element;
pub use error::FitError;
pub use fit::fit;
pub use settings::{Fit, Goal, Reached, Settings, Solver};
