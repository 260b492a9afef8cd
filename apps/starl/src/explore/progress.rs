//! How far a search is: on a terminal only, on the error stream.

use crate::console::grouped;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use starl_explore::Report;

/// Shows the number of states. The total is unknown.
pub struct Progress(ProgressBar);

impl Progress {
    /// It shows nothing if the error stream is not a terminal.
    pub fn new(shown: bool) -> Progress {
        let spinner = match shown {
            true => ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr_with_hz(10)),
            false => ProgressBar::hidden(),
        };
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}, {elapsed} passed") {
            spinner.set_style(style);
        }
        Progress(spinner)
    }

    /// Shows the progress of the search.
    pub fn advance(&self, report: &Report) {
        if !self.0.is_hidden() {
            let open = report.states - report.expanded;
            self.0.set_message(format!(
                "{} states, {} of them not yet expanded, {} steps deep, {} MiB",
                grouped(report.states.into()),
                grouped(open.into()),
                report.depth,
                report.bytes >> 20,
            ));
            self.0.tick();
        }
    }

    /// Takes it away.
    pub fn clear(&self) {
        self.0.finish_and_clear();
    }
}
