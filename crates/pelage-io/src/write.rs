//! Which sink a file name asks for.

use crate::{NpzWriter, PlyRootsWriter, RibWriter, UsdaWriter, UsdcWriter};
use pelage_strands::{Null, Sink, SinkError};
use std::path::Path;

/// What a writer may be told besides its path. Formats ignore what they lack.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WriteOptions {
    /// Write curve normals, by which readers draw flat ribbons instead of tubes.
    pub ribbons: bool,
    /// The program and version that makes the file, for a comment; nothing is
    /// written where it is empty. Leave dates out: the same hair should make the
    /// same bytes.
    pub tool: String,
}

/// What each extension makes, for messages and help texts.
pub const WRITABLE: [(&str, &str); 5] = [
    ("usdc", "USD crate file (also .usd)"),
    ("usda", "USD text"),
    ("npz", "NumPy arrays"),
    ("rib", "RenderMan archive; NAME.####.rib for several frames"),
    ("null", "nothing is written"),
];

/// What each extension makes of roots, for messages and help texts.
pub const ROOTS_WRITABLE: [(&str, &str); 3] = [
    ("npz", "NumPy arrays"),
    ("ply", "point cloud"),
    ("null", "nothing is written"),
];

/// A sink into the file `path`, by its extension; the path `null` takes strands and
/// forgets them.
///
/// Nothing is touched before [`Sink::begin`]. Fails for an extension we do not
/// write, and names those we do.
///
/// ```
/// use pelage_io::{WriteOptions, sink_for};
/// let error = sink_for("hair.doc".as_ref(), &WriteOptions::default()).err().unwrap();
/// assert!(error.to_string().contains("usdc"));
/// ```
pub fn sink_for(path: &Path, options: &WriteOptions) -> Result<Box<dyn Sink>, SinkError> {
    by_extension(path, &WRITABLE, |extension| {
        Some(match extension {
            "usdc" | "usd" => Box::new(UsdcWriter::new(path, options)),
            "usda" => Box::new(UsdaWriter::new(path, options)),
            "npz" => Box::new(NpzWriter::new(path, options)),
            "rib" => Box::new(RibWriter::new(path, options)),
            _ => return None,
        })
    })
}

/// As [`sink_for`], of roots: strands of one vertex, with surface normals for curve
/// normals.
pub fn root_sink_for(path: &Path, options: &WriteOptions) -> Result<Box<dyn Sink>, SinkError> {
    by_extension(path, &ROOTS_WRITABLE, |extension| {
        Some(match extension {
            "npz" => Box::new(NpzWriter::new(path, options)),
            "ply" => Box::new(PlyRootsWriter::new(path, options)),
            _ => return None,
        })
    })
}

/// What `writer` makes of the extension of `path`, of which it knows those of `writable`.
fn by_extension(
    path: &Path,
    writable: &[(&str, &str)],
    writer: impl FnOnce(&str) -> Option<Box<dyn Sink>>,
) -> Result<Box<dyn Sink>, SinkError> {
    if path == Path::new("null") {
        return Ok(Box::new(Null));
    }
    let extension = extension(path);
    let made = extension.as_deref().and_then(writer);
    made.ok_or_else(|| unknown(path, extension.as_deref(), writable))
}

fn extension(path: &Path) -> Option<String> {
    let extension = path.extension().and_then(|extension| extension.to_str());
    extension.map(str::to_ascii_lowercase)
}

fn unknown(path: &Path, extension: Option<&str>, known: &[(&str, &str)]) -> SinkError {
    let found = match extension {
        Some(extension) => format!("no writer for .{extension}"),
        None => "its name has no extension".into(),
    };
    let known: Vec<String> = known
        .iter()
        .map(|(extension, what)| match *extension {
            "null" => format!("the name null ({what})"),
            extension => format!(".{extension} ({what})"),
        })
        .collect();
    SinkError::new(
        path.display().to_string(),
        format!("{found}; known are {}", known.join(", ")),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sink(path: &str) -> Result<Box<dyn Sink>, SinkError> {
        sink_for(path.as_ref(), &WriteOptions::default())
    }

    #[test]
    fn extensions_are_known_in_any_case() {
        for path in ["a.usd", "b/a.USDC", "a.usda", "a.b.npz", "a.rib", "null"] {
            assert!(sink(path).is_ok(), "{path}");
        }
    }

    #[test]
    fn an_unknown_extension_names_those_that_are_known() {
        let error = sink("a.fbx").err().unwrap().to_string();
        assert!(error.starts_with("cannot write a.fbx: no writer for .fbx; known are .usdc"));
        for (extension, _) in WRITABLE {
            assert!(error.contains(extension), "{error}");
        }
        let error = root_sink_for("a.usdc".as_ref(), &WriteOptions::default());
        let error = error.err().unwrap().to_string();
        assert!(
            error.contains("known are .npz (NumPy arrays), .ply"),
            "{error}"
        );
        let error = sink("hair").err().unwrap().to_string();
        assert!(error.contains("no extension"), "{error}");
    }
}
