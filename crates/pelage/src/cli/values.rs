//! Values as they are typed.

/// A whole number in which `_` may group digits, as in TOML.
pub fn whole(text: &str) -> Result<u64, String> {
    text.replace('_', "")
        .parse()
        .map_err(|_| "expected a whole number".to_owned())
}

/// Most threads: as many as the largest machines have, and as systems give.
const MOST_THREADS: usize = 1024;

/// A number of threads.
pub fn threads(text: &str) -> Result<usize, String> {
    let count = text.parse().ok().filter(|&n: &usize| n <= MOST_THREADS);
    count.ok_or_else(|| format!("expected 0, which is one a core, to {MOST_THREADS}"))
}

/// A..B, either end of which may be left out.
pub fn open_range(text: &str) -> Result<(Option<u64>, Option<u64>), String> {
    let wrong = || "expected A..B, such as 0..1000 or 500..".to_owned();
    let (first, end) = text.split_once("..").ok_or_else(wrong)?;
    let part = |text: &str| match text {
        "" => Ok(None),
        text => whole(text).map(Some).map_err(|_| wrong()),
    };
    Ok((part(first)?, part(end)?))
}

/// A-B, either of which may be negative.
pub fn frames(text: &str) -> Result<(i64, i64), String> {
    let wrong = || "expected A-B, such as 1-48".to_owned();
    // The first character may be the sign of A.
    let dash = text
        .char_indices()
        .skip(1)
        .find(|(_, c)| *c == '-')
        .ok_or_else(wrong)?
        .0;
    let first: i64 = text[..dash].parse().map_err(|_| wrong())?;
    let last: i64 = text[dash + 1..].parse().map_err(|_| wrong())?;
    if first > last {
        return Err(format!("frame {first} comes after frame {last}"));
    }
    if last.abs_diff(first) >= 1_000_000 {
        return Err("more than a million frames".into());
    }
    Ok((first, last))
}

/// WIDTHxHEIGHT of a picture.
pub fn size(text: &str) -> Result<(u32, u32), String> {
    let parts = text
        .split_once('x')
        .and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
    match parts {
        Some((w @ 1..=16384, h @ 1..=16384)) => Ok((w, h)),
        _ => Err("expected WIDTHxHEIGHT, each 1 to 16384, such as 1280x720".into()),
    }
}

/// X,Y,Z.
pub fn vector(text: &str) -> Result<[f32; 3], String> {
    let wrong = || "expected three numbers, such as 0,1.5,-2".to_owned();
    let parts: Vec<f32> = text
        .split(',')
        .map(|p| p.trim().parse())
        .collect::<Result<_, _>>()
        .map_err(|_| wrong())?;
    let vector: [f32; 3] = parts.try_into().map_err(|_| wrong())?;
    if vector.iter().all(|x: &f32| x.is_finite()) {
        Ok(vector)
    } else {
        Err(wrong())
    }
}

/// A number of 0 or more.
pub fn not_negative(text: &str) -> Result<f32, String> {
    let number: f32 = text.parse().map_err(|_| "expected a number".to_owned())?;
    match number.is_finite() && number >= 0.0 {
        true => Ok(number),
        false => Err("expected a number of 0 or more".into()),
    }
}

/// How far a fit may be from its strand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ErrorBound {
    /// A length, in the unit of the file.
    Length(f64),
    /// A part of each strand's length.
    Part(f64),
}

impl ErrorBound {
    /// What it is for a strand of the length `strand`.
    pub fn length(self, strand: f64) -> f64 {
        match self {
            Self::Length(length) => length,
            Self::Part(part) => part * strand,
        }
    }

    /// Whether an `error` of a strand of the length `strand` is within it.
    pub fn keeps(self, error: f64, strand: f64) -> bool {
        match self {
            Self::Length(length) => error <= length,
            Self::Part(part) => error / strand <= part,
        }
    }
}

/// A length, or a percentage of each strand's length.
pub fn error_bound(text: &str) -> Result<ErrorBound, String> {
    let wrong = "expected a length above 0, such as 0.02, or a part of each strand's, such as 1%";
    let (number, part) = match text.strip_suffix('%') {
        Some(percent) => (percent.trim_end(), true),
        None => (text, false),
    };
    let number: f64 = number.parse().map_err(|_| wrong.to_owned())?;
    match (number > 0.0 && number.is_finite(), part) {
        (true, true) => Ok(ErrorBound::Part(number / 100.0)),
        (true, false) => Ok(ErrorBound::Length(number)),
        (false, _) => Err(wrong.into()),
    }
}

/// An angle between rings, in degrees.
pub fn detail(text: &str) -> Result<f32, String> {
    let degrees = not_negative(text)?;
    match (0.01..=90.0).contains(&degrees) {
        true => Ok(degrees),
        false => Err("expected 0.01 to 90 degrees".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn error_bounds_are_lengths_or_percentages() {
        assert_eq!(error_bound("0.25"), Ok(ErrorBound::Length(0.25)));
        assert_eq!(error_bound("2%"), Ok(ErrorBound::Part(0.02)));
        assert_eq!(error_bound("0.5 %"), Ok(ErrorBound::Part(0.005)));
        for wrong in ["", "%", "0", "-1%", "nan", "inf", "1e999%", "1%%"] {
            assert!(error_bound(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn ranges_and_frames_are_read() {
        assert_eq!(open_range("0..1_000"), Ok((Some(0), Some(1000))));
        assert_eq!(open_range("5.."), Ok((Some(5), None)));
        assert!(open_range("5").is_err());
        assert_eq!(frames("1-48"), Ok((1, 48)));
        assert_eq!(frames("-3--1"), Ok((-3, -1)));
        assert!(frames("4-2").is_err());
        assert_eq!(size("640x480"), Ok((640, 480)));
        assert!(size("640x0").is_err());
        assert_eq!(vector("0, 1.5,-2"), Ok([0.0, 1.5, -2.0]));
        assert_eq!(threads("16"), Ok(16));
        assert!(threads("100000").is_err() && threads("-1").is_err());
    }
}
