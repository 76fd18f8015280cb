//! One file a frame: `NAME.####.EXT`.

use crate::drawable::refused;
use std::io;
use std::path::{Path, PathBuf};

/// The path of each frame: the last run of `#` in the file name of `path` becomes
/// the frame's number, filled with zeros to the run's length (frame 2.5 of `####` is
/// `0002.5`). Without frames it is `path` itself.
///
/// Fails where there are frames and no `#`, or `#` and no frames.
pub(crate) fn frame_paths(path: &Path, frames: &[f64]) -> io::Result<Vec<PathBuf>> {
    let name = path
        .file_name()
        .and_then(|name| name.to_str())
        .unwrap_or("");
    let end = name.rfind('#').map(|last| last + 1);
    match (end, frames) {
        (None, []) => Ok(vec![path.into()]),
        (None, _) => Err(refused(
            "this format takes one file a frame: put #### for the frame number into \
             the file name, as in hair.####.rib",
        )),
        (Some(_), []) => Err(refused(
            "#### in a file name stands for a frame number, and there are no frames",
        )),
        (Some(end), _) => {
            let digits = name[..end].chars().rev().take_while(|&c| c == '#').count();
            let (before, after) = (&name[..end - digits], &name[end..]);
            let numbered = |frame: &f64| {
                path.with_file_name(format!("{before}{}{after}", number(*frame, digits)))
            };
            Ok(frames.iter().map(numbered).collect())
        }
    }
}

/// `frame` with at least `digits` digits before the decimal point.
fn number(frame: f64, digits: usize) -> String {
    let plain = frame.abs().to_string();
    let sign = if frame < 0.0 { "-" } else { "" };
    let whole = plain.find('.').unwrap_or(plain.len());
    let zeros = "0".repeat(digits.saturating_sub(whole));
    format!("{sign}{zeros}{plain}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paths(path: &str, frames: &[f64]) -> Option<Vec<String>> {
        let paths = frame_paths(path.as_ref(), frames).ok()?;
        Some(paths.iter().map(|p| p.display().to_string()).collect())
    }

    #[test]
    fn the_last_run_of_marks_becomes_the_frame_number() {
        let found = paths("a#/b.####.rib", &[1.0, 12345.0, 2.5, -3.0]).unwrap();
        assert_eq!(
            found,
            [
                "a#/b.0001.rib",
                "a#/b.12345.rib",
                "a#/b.0002.5.rib",
                "a#/b.-0003.rib"
            ]
        );
        assert_eq!(paths("x.rib", &[]).unwrap(), ["x.rib"]);
    }

    #[test]
    fn marks_and_frames_come_together_or_not_at_all() {
        assert!(paths("x.rib", &[1.0]).is_none());
        assert!(paths("x.####.rib", &[]).is_none());
    }
}
