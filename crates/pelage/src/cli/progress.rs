//! Progress bars, and a sign where nobody knows how much there is to do: drawn on a terminal
//! only, and only for work of over a second.

use super::say::Say;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::{Builder, JoinHandle};
use std::time::{Duration, Instant};

/// Work shorter than this gets no bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// What is done before the first hair.
pub const PREPARING: &str = "reading the recipe's files and preparing roots";

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
        Self {
            bar,
            since: Instant::now(),
            wanted: is_wanted(say),
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

/// A sign, and the time that went by, until it is dropped.
pub struct Wait {
    bar: ProgressBar,
    /// Drops its end to say that the work is done, and the thread that shows the sign.
    shown: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Wait {
    /// A sign that `what` goes on ("preparing roots").
    pub fn new(say: &Say, what: &'static str) -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        // The template is ours; should it be wrong, a plain sign does.
        if let Ok(style) = ProgressStyle::with_template("  {spinner} {msg}, {elapsed}") {
            bar.set_style(style);
        }
        bar.set_message(what);
        let (done, until) = channel();
        let show = {
            let bar = bar.clone();
            move || {
                if let Err(RecvTimeoutError::Timeout) = until.recv_timeout(PATIENCE) {
                    bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(REDRAWS_A_SECOND));
                    bar.enable_steady_tick(Duration::from_secs(1) / REDRAWS_A_SECOND as u32);
                }
            }
        };
        // Without a thread there is no sign.
        let thread = is_wanted(say).then(|| Builder::new().spawn(show).ok());
        Self {
            bar,
            shown: thread.flatten().map(|thread| (done, thread)),
        }
    }
}

impl Drop for Wait {
    fn drop(&mut self) {
        if let Some((done, thread)) = self.shown.take() {
            drop(done);
            // It has nothing that could panic, and nothing to tell.
            let _ = thread.join();
        }
        self.bar.finish_and_clear();
    }
}

/// Whether somebody looks.
fn is_wanted(say: &Say) -> bool {
    !say.is_quiet() && std::io::stderr().is_terminal()
}
