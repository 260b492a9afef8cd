//! The progress bar: on a terminal only, on the error stream, so that it never mixes with output.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use starl_core::{Duration, Time};

/// Shows how much of the simulated time has passed.
pub struct Progress(ProgressBar);

impl Progress {
    /// A bar for a run of at most this long; where the error stream is no terminal it shows nothing.
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

    /// The run has come this far.
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

/// Shows how many of so many things are done.
pub struct Count(ProgressBar);

impl Count {
    /// A bar for so many; where the error stream is no terminal it shows nothing.
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

    /// So many were done before, and say nothing about the time that is left.
    pub fn begin_at(&self, done: u64) {
        self.0.set_position(done);
        self.0.reset_eta();
    }

    /// So many more are done.
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
