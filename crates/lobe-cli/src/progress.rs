//! A progress bar for work that turns out to take longer than a second.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Work that takes less is not worth a bar.
const PATIENCE: Duration = Duration::from_secs(1);

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
        let bar = hidden(label, total, template);
        Self { bar, start: Instant::now(), visible: AtomicBool::new(quiet) }
    }

    /// `steps` more are done.
    pub(crate) fn advance(&self, steps: u64) {
        self.bar.inc(steps);
        let late = self.start.elapsed() > PATIENCE;
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

fn hidden(label: &str, total: Option<u64>, template: &str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(total, ProgressDrawTarget::hidden());
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar.set_prefix(label.to_owned());
    bar
}

impl Drop for Progress {
    /// A bar that has done its work, or failed, leaves nothing behind.
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// Says what is being done, and for how long, of work that says nothing while it is done.
#[derive(Debug)]
pub(crate) struct Waiting {
    /// What ends the thread that shows it, and the thread.
    shown: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Waiting {
    /// Never shown if `quiet`, nor in the first second.
    pub(crate) fn new(label: &str, quiet: bool) -> Self {
        if quiet {
            return Self { shown: None };
        }
        let (done, wait) = channel();
        let bar = hidden(label, None, "{prefix:>14} {spinner} {elapsed}");
        Self { shown: Some((done, std::thread::spawn(move || show(&bar, &wait)))) }
    }
}

fn show(bar: &ProgressBar, wait: &Receiver<()>) {
    if wait.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
        bar.set_draw_target(ProgressDrawTarget::stderr());
        bar.enable_steady_tick(Duration::from_millis(200));
        // Nothing is ever sent: the other end is dropped.
        let _ = wait.recv();
    }
    bar.finish_and_clear();
}

impl Drop for Waiting {
    fn drop(&mut self) {
        if let Some((done, thread)) = self.shown.take() {
            drop(done);
            // A bar that could not be drawn is no failure of the work.
            let _ = thread.join();
        }
    }
}
