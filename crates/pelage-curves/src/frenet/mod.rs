//! The Frenet–Serret apparatus: a curve as its curvature and torsion, and back.
//!
//! Source: document 000 (J. Tessendorf and D. Weston, "Implementation of Curved Strands
//! I: Frenet-Serret Framework"), with its errata. A curve is, but for its place in space,
//! its curvature κ and its torsion τ along its arc length s.
//!
//! - [`Apparatus::of`] takes a curve apart (section 4.2) and [`Apparatus::points`] puts
//!   it together again by exact helix steps ([`Step`], section 4.1).
//! - [`Helical`] is the closed form for a constant ratio of torsion and curvature
//!   (section 3.2), [`Placed`] the ordered exponentials that place one shape many times
//!   (section 3.1).
//! - [`mix_bases`] and [`mix_integrals`] make strands between guides of these (section 4.3).
//! - [`polygon`] has the same for vertices instead of smooth curves: bends and twists of
//!   a polygon, from which its vertices come back to rounding however coarse it is.
//!
//! Right-handed, f64 throughout, in the unit of the curve: s in that unit, κ and τ in
//! radians per unit. Curvature has a sign: it keeps the normal's direction through
//! inflections and along straight parts, and a curve with -κ and the normal turned round
//! is the same curve.
//!
//! ```
//! use pelage_curves::DVec3;
//! use pelage_curves::frenet::{Apparatus, CatmullRom};
//!
//! // A quarter of a circle of radius 2: curvature ½, no torsion.
//! let circle: Vec<DVec3> = (0..=16)
//!     .map(|i| i as f64 / 16.0 * std::f64::consts::FRAC_PI_2)
//!     .map(|a| 2.0 * DVec3::new(libm::cos(a), libm::sin(a), 0.0))
//!     .collect();
//! let apparatus = Apparatus::of(&CatmullRom::new(&circle)?, 32)?;
//! let middle = apparatus.segments[16];
//! assert!((middle.curvature - 0.5).abs() < 1e-5);
//! assert!(middle.torsion.abs() < 1e-12);
//! let end = apparatus.points()[32];
//! assert!(end.distance(circle[16]) < 1e-2);
//! # Ok::<(), pelage_curves::frenet::FrenetError>(())
//! ```

mod analysis;
mod apparatus;
mod catmull_rom;
mod error;
mod frame;
mod helicity;
mod many;
mod measure;
mod mixing;
mod ordered;
pub mod polygon;
mod step;

pub use analysis::Sample;
pub(crate) use analysis::tangents;
pub use apparatus::{Apparatus, Segment};
pub use catmull_rom::CatmullRom;
pub use error::FrenetError;
pub use frame::Frame;
pub(crate) use frame::{perpendicular, unit};
pub use helicity::Helical;
pub use measure::{Measure, SpaceCurve};
pub use mixing::{Ordered, mix_bases, mix_integrals};
pub use ordered::Placed;
pub use step::Step;
