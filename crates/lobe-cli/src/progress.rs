//! A progress bar for work that turns out to take longer than a second.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Counts work done; after the first second it also shows it, on standard error if that is a terminal.
#[derive(Debug)]
pub(crate) struct Progress {
    bar: ProgressBar,
    start: Instant,
    visible: AtomicBool,
}

impl Progress {
    /// `total` steps of work; never shown if `quiet`.
    pub(crate) fn new(label: &str, total: u64, quiet: bool) -> Self {
        Self::with_template(label, Some(total), "{prefix:>14} {bar:40} {percent:>3} %  {eta} left", quiet)
    }

    /// Work of which nobody knows how much there is.
    pub(crate) fn counting(label: &str, quiet: bool) -> Self {
        Self::with_template(label, None, "{prefix:>14} {human_pos} in {elapsed}", quiet)
    }

    fn with_template(label: &str, total: Option<u64>, template: &str, quiet: bool) -> Self {
        let bar = ProgressBar::with_draw_target(total, ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        bar.set_prefix(label.to_owned());
        Self { bar, start: Instant::now(), visible: AtomicBool::new(quiet) }
    }

    /// `steps` more are done.
    pub(crate) fn advance(&self, steps: u64) {
        self.bar.inc(steps);
        let late = self.start.elapsed() > Duration::from_secs(1);
        if late && !self.visible.swap(true, Ordering::Relaxed) {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
    }

    /// Prints while the bar is out of the way.
    pub(crate) fn suspend<T>(&self, print: impl FnOnce() -> T) -> T {
        self.bar.suspend(print)
    }

    /// `steps` are done in all.
    pub(crate) fn set(&self, steps: u64) {
        self.advance(steps.saturating_sub(self.bar.position()));
    }
}

impl Drop for Progress {
    /// A bar that has done its work, or failed, leaves nothing behind.
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
