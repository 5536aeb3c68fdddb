//! The progress bar of a run; nothing is shown when standard error is not a terminal.

use std::time::{Duration, Instant};

use hammerbeam_study::{
    run::{Observer, Progress},
    store::{JobKind, JobRecord},
};
use indicatif::{HumanCount, HumanDuration, ProgressBar, ProgressStyle};

use crate::interrupt::Interrupt;

/// Time between two changes of the bar.
const CHANGE: Duration = Duration::from_millis(100);

/// Resolution of the bar.
const LENGTH: u64 = 10_000;

/// Shows a run on the terminal and stops it on Ctrl-C.
pub struct Terminal {
    bar: ProgressBar,
    interrupt: Interrupt,
    changed: Instant,
    first: Option<(Instant, f64)>,
}

impl Terminal {
    /// A bar on standard error.
    pub fn new(interrupt: Interrupt) -> Self {
        let bar = ProgressBar::new(LENGTH);
        let style = ProgressStyle::with_template("[{bar:24}] {percent:>3} %  {wide_msg}");
        bar.set_style(style.expect("the template is constant").progress_chars("=> "));
        Self { bar, interrupt, changed: Instant::now(), first: None }
    }

    /// Takes the bar away.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }

    /// Solutions so far, their rate, where, and how long it still takes.
    fn message(&mut self, progress: &Progress) -> String {
        let (begun, first) = *self.first.get_or_insert((Instant::now(), progress.fraction));
        let elapsed = begun.elapsed();
        let rate = progress.new_solutions as f64 / elapsed.as_secs_f64().max(0.1);
        let gained = progress.fraction - first;
        let left = if gained > 1e-3 {
            let left = elapsed.mul_f64(((1.0 - progress.fraction) / gained).min(1e6));
            format!("{} left", HumanDuration(left))
        } else {
            "? left".to_owned()
        };
        format!(
            "{left}  {:.2} Hz  {} solutions, {}/s  {} branches done, {} walks open",
            progress.frequency_hz,
            HumanCount(progress.solutions),
            HumanCount(rate as u64),
            progress.branches_done,
            progress.walks_open,
        )
    }
}

impl Observer for Terminal {
    fn working(&mut self, job: &JobRecord) {
        let what = match job.kind {
            JobKind::Harmonic => "looking for the harmonic branch",
            JobKind::Survey => "looking for branches by simulation",
            JobKind::Doubling => "leaving a flip",
            JobKind::Crossing => "leaving a branch point",
        };
        self.bar.set_message(format!("{what} at {:.4} Hz", job.frequency_hz));
        self.bar.tick();
    }

    fn progress(&mut self, progress: &Progress) {
        if self.bar.is_hidden() || self.changed.elapsed() < CHANGE {
            return;
        }
        self.changed = Instant::now();
        let message = self.message(progress);
        self.bar.set_position((progress.fraction * LENGTH as f64) as u64);
        self.bar.set_message(message);
    }

    fn interrupted(&mut self) -> bool {
        self.interrupt.raised()
    }
}
