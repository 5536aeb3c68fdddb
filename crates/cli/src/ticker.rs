//! The progress of work whose length is known: shown after a second, on a terminal only.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// Time before anything is shown, and between two changes.
const PATIENCE: Duration = Duration::from_secs(1);
const CHANGE: Duration = Duration::from_millis(100);

/// A bar on standard error.
#[derive(Debug)]
pub struct Ticker {
    bar: ProgressBar,
    begun: Instant,
    changed: Instant,
}

impl Ticker {
    /// For so many of what is counted.
    pub fn new(total: u64, what: &str) -> Self {
        let style = ProgressStyle::with_template("[{bar:24}] {pos} of {len} {prefix}, {eta} left  {msg}");
        let bar = ProgressBar::hidden();
        bar.set_style(style.expect("the template is constant").progress_chars("=> "));
        bar.set_length(total);
        bar.set_prefix(what.to_owned());
        Self { bar, begun: Instant::now(), changed: Instant::now() }
    }

    /// For an unknown number of what is counted.
    pub fn counting(what: &str) -> Self {
        let style = ProgressStyle::with_template("{spinner} {pos} {prefix}, {elapsed}  {msg}");
        let bar = ProgressBar::hidden();
        bar.set_style(style.expect("the template is constant"));
        bar.set_prefix(what.to_owned());
        Self { bar, begun: Instant::now(), changed: Instant::now() }
    }

    /// So many are done.
    pub fn at(&mut self, done: u64, message: impl FnOnce() -> String) {
        if self.begun.elapsed() < PATIENCE || self.changed.elapsed() < CHANGE {
            return;
        }
        if self.bar.is_hidden() {
            self.bar.set_draw_target(indicatif::ProgressDrawTarget::stderr());
        }
        self.changed = Instant::now();
        self.bar.set_position(done);
        self.bar.set_message(message());
    }

    /// Takes the bar away.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }
}
