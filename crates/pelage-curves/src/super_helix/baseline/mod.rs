//! Other ways from a curve to a Super-Helix, for comparison: [`fit`](super::fit) is better.

mod floating;
mod naive;

pub use floating::floating_tangents;
pub use naive::root_to_tip;
