//! Progress bars: drawn on a terminal only, and only for work of over a second.

use super::say::Say;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// Work shorter than this gets no bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// Times between redraws.
const REDRAWS_A_SECOND: u8 = 10;

/// A bar that appears when its work turns out to take long.
pub struct Bar {
    bar: ProgressBar,
    since: Instant,
    wanted: bool,
}

impl Bar {
    /// A bar for `total` of `what` ("hairs", "% of the picture").
    pub fn new(say: &Say, total: u64, what: &str) -> Self {
        let template = format!(
            "  {{bar:32}} {{human_pos}} of {{human_len}} {what}, {{per_sec}}, {{eta}} left"
        );
        let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::hidden());
        // The template is ours; should it be wrong, a plain bar does.
        if let Ok(style) = ProgressStyle::with_template(&template) {
            bar.set_style(style);
        }
        let wanted = !say.is_quiet() && std::io::stderr().is_terminal();
        Self {
            bar,
            since: Instant::now(),
            wanted,
        }
    }

    /// Says how far the work is.
    pub fn set(&self, done: u64) {
        if self.wanted && self.since.elapsed() > PATIENCE && self.bar.is_hidden() {
            self.bar
                .set_draw_target(ProgressDrawTarget::stderr_with_hz(REDRAWS_A_SECOND));
        }
        self.bar.set_position(done);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
