//! The progress bar of a run; nothing is shown when standard error is not a terminal.

use std::time::{Duration, Instant};

use hammerbeam_study::{
    run::{Observer, Progress, VariedProgress},
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
    /// Whether the diagram is done and what comes after it is computed, which has a bar of its own.
    after_diagram: bool,
}

impl Terminal {
    /// A bar on standard error.
    pub fn new(interrupt: Interrupt) -> Self {
        let bar = ProgressBar::new(LENGTH);
        let style = ProgressStyle::with_template("[{bar:8}] {percent:>3} %  {wide_msg}");
        bar.set_style(style.expect("the template is constant").progress_chars("=> "));
        Self { bar, interrupt, changed: Instant::now(), first: None, after_diagram: false }
    }

    /// Takes the bar away.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }

    /// How long it still takes, and new solutions per second.
    fn pace(&mut self, fraction: f64, new_solutions: u64) -> (String, f64) {
        let (begun, first) = *self.first.get_or_insert((Instant::now(), fraction));
        let elapsed = begun.elapsed();
        let rate = new_solutions as f64 / elapsed.as_secs_f64().max(0.1);
        let gained = fraction - first;
        if gained <= 1e-3 {
            return ("? left".to_owned(), rate);
        }
        let left = elapsed.mul_f64(((1.0 - fraction) / gained).min(1e6));
        (format!("{:#} left", HumanDuration(left)), rate)
    }

    /// How long it still takes, branches, solutions so far and their rate, all within 80 columns, and where.
    fn message(&mut self, progress: &Progress) -> String {
        let (left, rate) = self.pace(progress.fraction, progress.new_solutions);
        format!(
            "{left}  {} branches done, {} open  {} solutions, {}/s  {:.2} Hz",
            progress.branches_done,
            progress.walks_open,
            HumanCount(progress.solutions),
            HumanCount(rate as u64),
            progress.frequency_hz,
        )
    }

    /// The same of varied branches and curves.
    fn varied_message(&mut self, progress: &VariedProgress<'_>) -> String {
        let (left, rate) = self.pace(progress.fraction, progress.new_solutions);
        format!(
            "{left}  {} = {:.5e}, {:.2} Hz  {} solutions, {}/s  {} of {} varied branches and curves done",
            progress.parameter,
            progress.value,
            progress.frequency_hz,
            HumanCount(progress.new_solutions),
            HumanCount(rate as u64),
            progress.pieces_done,
            progress.pieces,
        )
    }

    /// Whether it is time to change what is shown.
    fn is_due(&mut self) -> bool {
        let due = !self.bar.is_hidden() && self.changed.elapsed() >= CHANGE;
        if due {
            self.changed = Instant::now();
        }
        due
    }

    fn show(&self, fraction: f64, message: String) {
        self.bar.set_position((fraction * LENGTH as f64) as u64);
        self.bar.set_message(message);
    }
}

impl Observer for Terminal {
    fn working(&mut self, job: &JobRecord) {
        let what = match job.kind {
            JobKind::Harmonic => "looking for the harmonic branch",
            JobKind::Survey | JobKind::Resonance => "looking for branches by simulation",
            JobKind::Met => "following motions that were met",
            JobKind::NoneStable => "looking where no stable solution is known",
            JobKind::Doubling => "leaving a flip",
            JobKind::Crossing => "leaving a branch point",
        };
        self.bar.set_message(format!("{what} at {:.4} Hz", job.frequency_hz));
        self.bar.tick();
    }

    fn progress(&mut self, progress: &Progress) {
        if self.is_due() {
            let message = self.message(progress);
            self.show(progress.fraction, message);
        }
    }

    fn varied(&mut self, progress: &VariedProgress<'_>) {
        if !self.after_diagram {
            (self.after_diagram, self.first) = (true, None);
        }
        if self.is_due() {
            let message = self.varied_message(progress);
            self.show(progress.fraction, message);
        }
    }

    fn interrupted(&mut self) -> bool {
        self.interrupt.raised()
    }
}
