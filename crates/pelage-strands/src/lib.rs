//! The contract between whatever makes strands and whatever takes them.
//!
//! A [`StrandBuffer`] holds a chunk of strands as plain arrays; a [`Sink`] takes
//! chunks in order, frame by frame. Bounds and statistics are sinks like any file
//! format, so that one code path makes hair.
//!
//! Conventions: positions in the unit of the mesh, world space unless the name
//! says `_rest`; widths are full diameters; colours linear RGB; a strand's curve
//! is the Catmull-Rom curve through its vertices with duplicated ends (see
//! [`pelage_curves::catmull_rom`]).

mod bounds;
mod buffer;
mod sink;
mod statistics;
mod validate;

pub use bounds::{Bounds, BoundsSink};
pub use buffer::{StrandBuffer, StrandMeta};
pub use sink::{Amount, Collect, Null, Sink, SinkError, StreamInfo, Tee, UpAxis};
pub use statistics::{Range, Statistics};
pub use validate::{Fault, FaultKind, validate};
