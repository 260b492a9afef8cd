//! The progress bar: on a terminal only, on the error stream, so that it never mixes with output.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use starl_core::{Duration, Time};

/// Shows how much of the simulated time has passed.
pub struct Progress(ProgressBar);

impl Progress {
    /// A bar for a run of at most this long; it shows nothing if the error stream is not a terminal.
    pub fn new(shown: bool, longest: Duration) -> Progress {
        let millis = longest.0 / 1_000_000;
        let bar = match shown {
            true => {
                ProgressBar::with_draw_target(Some(millis), ProgressDrawTarget::stderr_with_hz(10))
            }
            false => ProgressBar::hidden(),
        };
        let template = "{bar:30} {msg} of at most {prefix} simulated, {elapsed} passed";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        bar.set_prefix(longest.to_string());
        Progress(bar)
    }

    /// Shows the progress of the run.
    pub fn advance(&self, now: Time) {
        if !self.0.is_hidden() {
            self.0.set_position(now.0 / 1_000_000);
            self.0.set_message(format!("{:.1}s", now.seconds()));
        }
    }

    /// Writes lines above the bar.
    pub fn above(&self, write: impl FnOnce()) {
        self.0.suspend(write);
    }

    /// Takes the bar away.
    pub fn clear(&self) {
        self.0.finish_and_clear();
    }
}

/// Shows the number of finished items.
pub struct Count(ProgressBar);

impl Count {
    /// A bar for so many; it shows nothing if the error stream is not a terminal.
    pub fn new(shown: bool, total: u64) -> Count {
        let bar = match shown {
            true => {
                ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr_with_hz(10))
            }
            false => ProgressBar::hidden(),
        };
        let template = "{bar:30} {human_pos} of {human_len} {msg} {per_sec}, {eta} to go";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        bar.set_message("runs,");
        Count(bar)
    }

    /// Sets the number of items that were done before; they do not affect the estimate of the remaining time.
    pub fn begin_at(&self, done: u64) {
        self.0.set_position(done);
        self.0.reset_eta();
    }

    /// Adds finished items.
    pub fn add(&self, more: u64) {
        self.0.inc(more);
    }

    /// Shows the current activity.
    pub fn say(&self, what: impl Into<std::borrow::Cow<'static, str>>) {
        self.0.set_message(what);
    }

    /// Takes the bar away.
    pub fn clear(&self) {
        self.0.finish_and_clear();
    }
}
