//! Words for people: results on standard output, everything else on standard error.

use std::fmt::{Display, Formatter};
use std::io::Write;
use std::path::Path;
use std::time::Duration;

/// Prints, unless it was asked to be quiet.
#[derive(Clone, Copy, Debug)]
pub struct Say {
    quiet: bool,
    /// Whether standard output is left to what programs read.
    aside: bool,
}

impl Say {
    /// Prints errors only where `quiet`.
    pub fn new(quiet: bool) -> Self {
        Self {
            quiet,
            aside: false,
        }
    }

    /// The same, with all words on standard error where `data` goes to standard output.
    pub fn beside(self, data: bool) -> Self {
        Self {
            aside: data,
            ..self
        }
    }

    /// Whether only errors are printed.
    pub fn is_quiet(self) -> bool {
        self.quiet
    }

    /// A line of what was done. A closed pipe is no reason to fail.
    pub fn line(self, text: impl Display) {
        if self.quiet {
            return;
        }
        let _ = match self.aside {
            true => writeln!(std::io::stderr().lock(), "{text}"),
            false => writeln!(std::io::stdout().lock(), "{text}"),
        };
    }

    /// Something worth knowing that is no error.
    pub fn note(self, text: impl Display) {
        if !self.quiet {
            let _ = writeln!(std::io::stderr().lock(), "note: {text}");
        }
    }

    /// What failed, with the reasons below it.
    pub fn error(self, error: &anyhow::Error) {
        let mut stderr = std::io::stderr().lock();
        let _ = writeln!(stderr, "error: {error}");
        let mut said = error.to_string();
        for cause in error.chain().skip(1).map(|c| c.to_string()) {
            if !said.contains(&cause) {
                let _ = writeln!(stderr, "  because: {cause}");
            }
            said = cause;
        }
    }
}

/// A file that was written and how fast: what was done to make `count` of `what`.
pub struct Made<'a> {
    /// The file.
    pub output: &'a Path,
    /// Time to load what was needed.
    pub load: Duration,
    /// What was done, and the time it took.
    pub done: (&'static str, Duration),
    /// How many were made, and of what.
    pub count: (u64, &'static str),
}

impl Display for Made<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        // Where nothing was written there is no size to tell.
        let size = std::fs::metadata(self.output).map_or(String::new(), |m| bytes(m.len()) + ", ");
        let ((done, time), (count, what)) = (self.done, self.count);
        let rate = count as f64 / time.as_secs_f64().max(1e-9);
        write!(
            f,
            "{} ({size}loaded in {}, {done} in {}, {} {what}/s)",
            self.output.display(),
            spent(self.load),
            spent(time),
            grouped(rate as u64),
        )
    }
}

/// A number with its thousands set apart: 200,000.
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// A duration as a person would say it.
pub fn spent(time: Duration) -> String {
    match time.as_secs_f64() {
        s if s < 0.1 => format!("{:.0} ms", s * 1e3),
        s if s < 100.0 => format!("{s:.1} s"),
        s => format!("{:.0} min {:02.0} s", (s / 60.0).floor(), s % 60.0),
    }
}

/// A number of bytes in the largest fitting unit.
pub fn bytes(count: u64) -> String {
    let mut value = count as f64;
    for unit in ["bytes", "kB", "MB", "GB"] {
        if value < 1000.0 {
            return format!("{value:.0} {unit}");
        }
        value /= 1000.0;
    }
    format!("{value:.1} TB")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_as_people_write_them() {
        assert_eq!(grouped(0), "0");
        assert_eq!(grouped(200_000), "200,000");
        assert_eq!(grouped(1_234_567), "1,234,567");
        assert_eq!(bytes(42_400_000), "42 MB");
        assert_eq!(spent(Duration::from_millis(1234)), "1.2 s");
        assert_eq!(spent(Duration::from_secs(125)), "2 min 05 s");
    }
}
