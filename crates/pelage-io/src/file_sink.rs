//! What all sinks into files share: they open at `begin`, name the file in every
//! error, and are gone after `finish`.

use crate::drawable::refused;
use crate::write::WriteOptions;
use pelage_strands::{SinkError, StrandBuffer, StreamInfo};
use std::io;
use std::path::{Path, PathBuf};

/// A file of one format being written. Dropped before `finish`, it must leave
/// nothing behind.
pub(crate) trait Stream: Sized + Send {
    /// Starts the file `path`.
    fn begin(path: &Path, options: &WriteOptions, info: &StreamInfo) -> io::Result<Self>;
    /// Opens the next frame.
    fn begin_frame(&mut self) -> io::Result<()>;
    /// Takes strands of the frame.
    fn write(&mut self, strands: &StrandBuffer) -> io::Result<()>;
    /// Closes the frame.
    fn end_frame(&mut self) -> io::Result<()>;
    /// Gives the file its name.
    fn finish(self) -> io::Result<()>;
}

/// A path, and the stream into it while one is open.
#[derive(Debug)]
pub(crate) struct FileSink<S> {
    path: PathBuf,
    options: WriteOptions,
    open: Option<S>,
}

impl<S: Stream> FileSink<S> {
    pub(crate) fn new(path: &Path, options: &WriteOptions) -> Self {
        Self {
            path: path.into(),
            options: options.clone(),
            open: None,
        }
    }

    pub(crate) fn begin(&mut self, info: &StreamInfo) -> Result<(), SinkError> {
        let stream = S::begin(&self.path, &self.options, info).map_err(|e| self.error(e))?;
        self.open = Some(stream);
        Ok(())
    }

    /// Runs `step` on the open stream. A stream that failed once is given up: what
    /// it would write after that is not what was asked for.
    pub(crate) fn step(
        &mut self,
        step: impl FnOnce(&mut S) -> io::Result<()>,
    ) -> Result<(), SinkError> {
        let result = match &mut self.open {
            Some(stream) => step(stream),
            None => Err(not_open()),
        };
        result.map_err(|e| {
            self.open = None;
            self.error(e)
        })
    }

    pub(crate) fn finish(&mut self) -> Result<(), SinkError> {
        let stream = self.open.take().ok_or_else(not_open);
        stream.and_then(S::finish).map_err(|e| self.error(e))
    }

    fn error(&self, error: io::Error) -> SinkError {
        SinkError::io(self.path.display().to_string(), error)
    }
}

fn not_open() -> io::Error {
    refused("the stream has not begun, has failed, or is already finished")
}

/// Declares a public sink around a private [`Stream`].
macro_rules! file_sink {
    ($(#[$doc:meta])* $name:ident, $stream:ty) => {
        $(#[$doc])*
        #[derive(Debug)]
        pub struct $name($crate::file_sink::FileSink<$stream>);

        impl $name {
            /// A sink into the file `path`, which is touched only when the stream
            /// begins and replaced only when it is finished.
            pub fn new(path: &std::path::Path, options: &$crate::WriteOptions) -> Self {
                Self($crate::file_sink::FileSink::new(path, options))
            }
        }

        impl pelage_strands::Sink for $name {
            fn begin(
                &mut self,
                info: &pelage_strands::StreamInfo,
            ) -> Result<(), pelage_strands::SinkError> {
                self.0.begin(info)
            }
            fn begin_frame(&mut self, _index: usize) -> Result<(), pelage_strands::SinkError> {
                self.0.step($crate::file_sink::Stream::begin_frame)
            }
            fn write(
                &mut self,
                strands: &pelage_strands::StrandBuffer,
            ) -> Result<(), pelage_strands::SinkError> {
                self.0.step(|s| $crate::file_sink::Stream::write(s, strands))
            }
            fn end_frame(&mut self) -> Result<(), pelage_strands::SinkError> {
                self.0.step($crate::file_sink::Stream::end_frame)
            }
            fn finish(&mut self) -> Result<(), pelage_strands::SinkError> {
                self.0.finish()
            }
        }
    };
}
pub(crate) use file_sink;
