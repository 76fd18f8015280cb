//! Where finished strands go.

use crate::StrandBuffer;
use std::error::Error;

/// Which axis of world space points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UpAxis {
    /// +Y, the default of most packages.
    #[default]
    Y,
    /// +Z.
    Z,
}

/// How much hair there is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Amount {
    /// Strands.
    pub strands: u64,
    /// Vertices of all of them.
    pub vertices: u64,
}

/// What a sink should know of the stream before its first strand.
#[derive(Clone, Debug, PartialEq)]
pub struct StreamInfo {
    /// Name of the groom; a valid identifier.
    pub name: String,
    /// Up axis of the surface.
    pub up_axis: UpAxis,
    /// Metres in one unit of length.
    pub meters_per_unit: f64,
    /// Frames a second, for formats that store time.
    pub frames_per_second: f64,
    /// The frames that will follow, in order; empty for a still.
    pub frames: Vec<f64>,
    /// What each frame brings at the most, where that is known. Files are laid out
    /// by it: where exactly this much comes, every array is written in its place;
    /// where less comes, arrays are moved in the end. More is an error. A strand of
    /// one vertex counts as one of two.
    pub at_most: Option<Amount>,
}

impl Default for StreamInfo {
    fn default() -> Self {
        Self {
            name: "groom".into(),
            up_axis: UpAxis::Y,
            meters_per_unit: 0.01,
            frames_per_second: 24.0,
            frames: Vec::new(),
            at_most: None,
        }
    }
}

/// A sink could not take what it was given.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {target}: {reason}")]
pub struct SinkError {
    /// What was being written, a file path as a rule.
    pub target: String,
    /// What went wrong, in words.
    pub reason: String,
    /// The error below, where there is one.
    #[source]
    pub source: Option<Box<dyn Error + Send + Sync>>,
}

impl SinkError {
    /// An error of `target` for `reason`.
    pub fn new(target: impl Into<String>, reason: impl Into<String>) -> Self {
        Self {
            target: target.into(),
            reason: reason.into(),
            source: None,
        }
    }

    /// An input/output error of `target`.
    pub fn io(target: impl Into<String>, error: std::io::Error) -> Self {
        Self {
            target: target.into(),
            reason: error.to_string(),
            source: Some(Box::new(error)),
        }
    }
}

/// Takes strands, chunk by chunk in order of hair index, or in another where that was asked for
/// or [does not matter](Self::takes_any_order).
///
/// The order of calls is `begin`, then for each frame (or once, for a still)
/// `begin_frame`, `write` any number of times, `end_frame`; then `finish`. Every
/// frame brings the same strands with the same vertex counts; only positions and
/// normals move. A sink that is dropped before `finish` leaves nothing behind.
pub trait Sink: Send {
    /// Whether the order of strands changes nothing in what becomes of them. Then they come in
    /// the order in which they are made fastest.
    fn takes_any_order(&self) -> bool {
        false
    }

    /// Opens the stream.
    fn begin(&mut self, _info: &StreamInfo) -> Result<(), SinkError> {
        Ok(())
    }

    /// Opens frame number `index` of [`StreamInfo::frames`] (0 for a still).
    fn begin_frame(&mut self, _index: usize) -> Result<(), SinkError> {
        Ok(())
    }

    /// Takes the next strands of the frame.
    fn write(&mut self, strands: &StrandBuffer) -> Result<(), SinkError>;

    /// Closes the frame.
    fn end_frame(&mut self) -> Result<(), SinkError> {
        Ok(())
    }

    /// Closes the stream and makes it visible: a file appears under its name.
    fn finish(&mut self) -> Result<(), SinkError> {
        Ok(())
    }
}

/// Takes strands and forgets them (`-o null`).
#[derive(Debug, Default)]
pub struct Null;

impl Sink for Null {
    fn takes_any_order(&self) -> bool {
        true
    }

    fn write(&mut self, _strands: &StrandBuffer) -> Result<(), SinkError> {
        Ok(())
    }
}

/// Keeps all strands of the last frame in memory.
#[derive(Debug, Default)]
pub struct Collect {
    /// What was written in the last frame.
    pub strands: StrandBuffer,
}

impl Sink for Collect {
    fn begin_frame(&mut self, _index: usize) -> Result<(), SinkError> {
        self.strands.clear();
        Ok(())
    }

    fn write(&mut self, strands: &StrandBuffer) -> Result<(), SinkError> {
        let vertices = self.strands.points.len() + strands.points.len();
        if u32::try_from(vertices).is_err() {
            return Err(SinkError::new(
                "strands in memory",
                format!("{vertices} vertices; a buffer holds at most {}", u32::MAX),
            ));
        }
        self.strands.append(strands);
        Ok(())
    }
}

/// Hands everything to several sinks, in order.
#[derive(Default)]
pub struct Tee<'a> {
    sinks: Vec<&'a mut dyn Sink>,
}

impl<'a> Tee<'a> {
    /// A tee into `sinks`.
    pub fn new(sinks: Vec<&'a mut dyn Sink>) -> Self {
        Self { sinks }
    }
}

impl Sink for Tee<'_> {
    fn takes_any_order(&self) -> bool {
        self.sinks.iter().all(|s| s.takes_any_order())
    }

    fn begin(&mut self, info: &StreamInfo) -> Result<(), SinkError> {
        self.sinks.iter_mut().try_for_each(|s| s.begin(info))
    }

    fn begin_frame(&mut self, index: usize) -> Result<(), SinkError> {
        self.sinks.iter_mut().try_for_each(|s| s.begin_frame(index))
    }

    fn write(&mut self, strands: &StrandBuffer) -> Result<(), SinkError> {
        self.sinks.iter_mut().try_for_each(|s| s.write(strands))
    }

    fn end_frame(&mut self) -> Result<(), SinkError> {
        self.sinks.iter_mut().try_for_each(|s| s.end_frame())
    }

    fn finish(&mut self) -> Result<(), SinkError> {
        self.sinks.iter_mut().try_for_each(|s| s.finish())
    }
}
