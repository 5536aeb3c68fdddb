//! The progress of work whose length is known: a bar after a second, or a line every ten seconds when
//! standard error is not a terminal.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::pace::{Lines, Pace};

/// Time before anything is shown, and between two changes.
const PATIENCE: Duration = Duration::from_secs(1);
const CHANGE: Duration = Duration::from_millis(100);

/// A bar on standard error.
#[derive(Debug)]
pub struct Ticker {
    bar: ProgressBar,
    lines: Lines,
    what: String,
    started: Instant,
    changed: Instant,
    pace: Option<Pace>,
    /// What was shown last.
    shown: String,
}

impl Ticker {
    /// For so many of what is counted.
    pub fn new(total: u64, what: &str) -> Self {
        Self::with("[{bar:24}] {pos} of {len} {prefix}, {msg}", Some(total), what)
    }

    /// For an unknown number of what is counted.
    pub fn counting(what: &str) -> Self {
        Self::with("{spinner} {pos} {prefix}, {elapsed}  {msg}", None, what)
    }

    fn with(template: &str, total: Option<u64>, what: &str) -> Self {
        let style = ProgressStyle::with_template(template);
        let bar = ProgressBar::with_draw_target(total, ProgressDrawTarget::hidden());
        bar.set_style(style.expect("the template is constant").progress_chars("=> "));
        bar.set_prefix(what.to_owned());
        let now = Instant::now();
        Self {
            bar,
            lines: Lines::begin(),
            what: what.to_owned(),
            started: now,
            changed: now,
            pace: None,
            shown: String::new(),
        }
    }

    /// So many are done.
    pub fn at(&mut self, done: u64, message: impl FnOnce() -> String) {
        let total = self.bar.length();
        let fraction = total.map(|total| done as f64 / total.max(1) as f64);
        if let Some(fraction) = fraction {
            self.pace.get_or_insert_with(|| Pace::from(fraction));
        }
        if self.started.elapsed() < PATIENCE || self.changed.elapsed() < CHANGE {
            return;
        }
        self.changed = Instant::now();
        if self.bar.is_hidden() {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        let pace = self.pace.as_mut().zip(fraction);
        let left = pace.map(|(pace, fraction)| pace.left(fraction) + "  ");
        let message = left.unwrap_or_default() + &message();
        if self.bar.is_hidden() {
            let of = total.map(|total| format!(" of {total}")).unwrap_or_default();
            self.shown = format!("{done}{of} {}, {message}", self.what);
            self.say();
        } else {
            self.bar.set_position(done);
            self.bar.set_message(message);
        }
    }

    /// Says every ten seconds where the work is, where no bar can be shown: also while nothing is counted.
    pub fn say(&mut self) {
        let shown = match self.shown.as_str() {
            "" => format!("{} under way", self.what),
            shown => shown.to_owned(),
        };
        if !ProgressDrawTarget::stderr().is_hidden() {
            return;
        }
        self.lines.say(|| shown);
    }

    /// Takes the bar away.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }
}
