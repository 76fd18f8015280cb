//! What fits came to, in words.

use super::super::args::FitArgs;
use super::super::say::{Say, bytes, grouped, spent};
use super::super::values::ErrorBound;
use super::Wish;
use super::strand::Fitted;
use pelage::StrandBuffer;
use pelage::io::SuperHelices;
use std::path::Path;
use std::time::Duration;

/// Strands that are named before the rest is only counted.
const NAMED: usize = 10;

/// Sizes and errors of all fits.
pub struct Report<'a> {
    args: &'a FitArgs,
    bound: Option<ErrorBound>,
    strands: usize,
    vertices: usize,
    elements: usize,
    numbers: u64,
    points: usize,
    /// Largest error and its strand, as a part of its length, and in the file's unit.
    pub worst_part: (f64, usize),
    worst: (f64, usize),
    /// Mean over the strands of the mean error, as a part of the length.
    mean_part: f64,
    /// Strands that are farther off than the bound.
    pub missed: Vec<usize>,
    /// Whether the strands had more than their shape.
    sheds: bool,
    /// Bytes of the file of curves.
    bytes_before: u64,
}

impl<'a> Report<'a> {
    pub fn new(
        args: &'a FitArgs,
        wish: &Wish,
        strands: &StrandBuffer,
        helices: &SuperHelices,
        fitted: &[Fitted],
        bytes_before: u64,
    ) -> Self {
        let mut report = Self {
            args,
            bound: wish.bound,
            strands: helices.len(),
            vertices: strands.points.len(),
            elements: helices.lengths.len(),
            numbers: helices.numbers(),
            points: 0,
            worst_part: (0.0, 0),
            worst: (0.0, 0),
            mean_part: 0.0,
            missed: Vec::new(),
            sheds: !(strands.widths.is_empty()
                && strands.colors.is_empty()
                && strands.hair_id.is_empty()
                && strands.root_uv.is_empty()
                && strands.group.is_empty()),
            bytes_before,
        };
        for (index, fitted) in fitted.iter().enumerate() {
            match fitted {
                Fitted::Curve(fit) => {
                    let error = f64::from(helices.errors[index]);
                    report.add(index, error, fit.mean, fit.curve.length());
                }
                Fitted::Point => report.points += 1,
            }
        }
        report.mean_part /= (report.strands - report.points).max(1) as f64;
        report
    }

    fn add(&mut self, index: usize, error: f64, mean: f64, length: f64) {
        let part = error / length;
        self.mean_part += mean / length;
        if part > self.worst_part.0 {
            self.worst_part = (part, index);
        }
        if error > self.worst.0 {
            self.worst = (error, index);
        }
        if self.bound.is_some_and(|bound| !bound.keeps(error, length)) {
            self.missed.push(index);
        }
    }

    /// Says everything.
    pub fn say(&self, say: &Say, time: Duration) {
        let (before, after) = (3 * self.vertices as u64, self.numbers);
        say.line(format_args!(
            "{}: {} strands, {} elements, {:.1} a strand ({})",
            self.args.output.display(),
            grouped(self.strands as u64),
            grouped(self.elements as u64),
            self.elements as f64 / (self.strands - self.points).max(1) as f64,
            spent(time)
        ));
        say.line(format_args!(
            "  numbers  {}, 3 a vertex, became {}, 4 an element and 6 a strand: {:.1} times fewer",
            grouped(before),
            grouped(after),
            before as f64 / after.max(1) as f64
        ));
        say.line(format_args!(
            "  file     {} became {}",
            bytes(self.bytes_before),
            bytes(size(&self.args.output))
        ));
        say.line(format_args!(
            "  error    at most {} of the length (strand {}), {:.3e} in the file's unit \
             (strand {}); mean {}",
            percent(self.worst_part.0),
            self.worst_part.1,
            self.worst.0,
            self.worst.1,
            percent(self.mean_part)
        ));
        if let Some(bound) = self.bound {
            say.line(format_args!("  bound    {}", self.bound_words(bound)));
        }
        if self.points > 0 {
            say.note(format_args!(
                "{} strands have no length; they are kept as points of as many vertices",
                grouped(self.points as u64)
            ));
        }
        if self.sheds {
            say.note("only the shape is kept, not widths, colours, ids or other attributes");
        }
    }

    fn bound_words(&self, bound: ErrorBound) -> String {
        let bound = match bound {
            ErrorBound::Length(length) => format!("{length}"),
            ErrorBound::Part(part) => percent(part),
        };
        if self.missed.is_empty() {
            return format!("{bound}: all strands keep it");
        }
        let named = self.missed.iter().take(NAMED).map(usize::to_string);
        let named: Vec<String> = named.collect();
        let more = if self.missed.len() > NAMED {
            ", …"
        } else {
            ""
        };
        format!(
            "{bound}: {} strands miss it: {}{more}",
            grouped(self.missed.len() as u64),
            named.join(", ")
        )
    }
}

/// Bytes of a file, 0 where there is none.
pub fn size(path: &Path) -> u64 {
    std::fs::metadata(path).map_or(0, |m| m.len())
}

/// A part in percent, to three digits.
fn percent(part: f64) -> String {
    let percent = 100.0 * part;
    match percent {
        0.0 => "0 %".into(),
        p if p < 0.001 => format!("{p:.1e} %"),
        p if p < 1.0 => format!("{p:.4} %"),
        p => format!("{p:.3} %"),
    }
}
