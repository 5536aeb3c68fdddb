//! The progress of a run: a bar, or a line every ten seconds when standard error is not a terminal.

use std::{
    fmt::Display,
    time::{Duration, Instant},
};

use hammerbeam_jobs::{DoneShare, Observer, Progress, VariedProgress, counted};
use hammerbeam_results::store::{JobKind, JobRecord};
use indicatif::{HumanCount, ProgressBar, ProgressStyle};

use crate::{
    interrupt::Interrupt,
    output::notify,
    pace::{Lines, Pace},
};

/// Time between two changes of the bar.
const CHANGE: Duration = Duration::from_millis(100);

/// Resolution of the bar.
const LENGTH: u64 = 10_000;

/// Shows a run on the terminal and stops it on Ctrl-C.
pub struct Terminal {
    bar: ProgressBar,
    lines: Lines,
    interrupt: Interrupt,
    changed: Instant,
    /// Of what is computed now: the diagram, or the branches and curves that come after it.
    pace: Option<Pace>,
    /// The part of the bar that is the diagram's, and whether that is done.
    diagram: f64,
    after_diagram: bool,
    /// What was shown last.
    shown: (f64, String),
}

impl Terminal {
    /// A bar on standard error.
    ///
    /// * `pieces`: varied branches and curves that come after the diagram, which have a share of the bar.
    pub fn new(interrupt: Interrupt, pieces: usize) -> Self {
        let bar = ProgressBar::new(LENGTH);
        let style = ProgressStyle::with_template("[{bar:8}] {percent:>3} %  {wide_msg}");
        bar.set_style(style.expect("the template is constant").progress_chars("=> "));
        Self {
            bar,
            lines: Lines::begin(),
            interrupt,
            changed: Instant::now(),
            pace: None,
            diagram: if pieces == 0 { 1.0 } else { 0.5 },
            after_diagram: false,
            shown: (0.0, "started".to_owned()),
        }
    }

    /// Takes the bar away.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }

    /// How long the diagram still takes. Its estimate is of what this command does.
    fn diagram_left(&mut self, done: DoneShare) -> String {
        let left = self.pace.get_or_insert_with(|| Pace::from(0.0)).left(done.of_this_run);
        if self.diagram < 1.0 { format!("diagram: {left}") } else { left }
    }

    /// New solutions per second.
    fn rate(&self, new_solutions: u64) -> HumanCount {
        let elapsed = self.pace.as_ref().map_or(0.0, |pace| pace.elapsed().as_secs_f64());
        HumanCount((new_solutions as f64 / elapsed.max(0.1)) as u64)
    }

    /// How long it still takes, branches, solutions so far and their rate, all within 80 columns, and where.
    fn message(&mut self, progress: &Progress) -> String {
        let left = self.diagram_left(progress.done);
        format!(
            "{left}  {} done, {} open  {} solutions, {}/s  {:.2} Hz",
            counted(progress.branches_done as u64, "branch"),
            progress.walks_open,
            HumanCount(progress.solutions),
            self.rate(progress.new_solutions),
            progress.frequency_hz,
        )
    }

    /// The same of varied branches and curves.
    fn varied_message(&mut self, progress: &VariedProgress<'_>) -> String {
        let left = self.pace.get_or_insert_with(|| Pace::from(progress.fraction)).left(progress.fraction);
        format!(
            "{left}  {} = {:.5e}, {:.2} Hz  {} solutions, {}/s  {} of {} varied branches and curves done",
            progress.parameter,
            progress.value,
            progress.frequency_hz,
            HumanCount(progress.new_solutions),
            self.rate(progress.new_solutions),
            progress.pieces_done,
            progress.pieces,
        )
    }

    /// Whether it is time to change what is shown.
    fn is_due(&mut self) -> bool {
        let due = self.changed.elapsed() >= CHANGE;
        if due {
            self.changed = Instant::now();
        }
        due
    }

    fn show(&mut self, fraction: f64, message: String) {
        self.bar.set_position((fraction * LENGTH as f64) as u64);
        self.bar.set_message(message.clone());
        self.shown = (fraction, message);
    }
}

impl Observer for Terminal {
    fn working(&mut self, job: &JobRecord, done: DoneShare) {
        let what = match job.kind {
            JobKind::Harmonic => "looking for the harmonic branch",
            JobKind::Survey | JobKind::Resonance => "looking for branches by simulation",
            JobKind::Met => "following motions that were met",
            JobKind::NoneStable => "looking where no stable solution is known",
            JobKind::ContactChange => "looking where contacts change",
            JobKind::Doubling => "leaving a flip",
            JobKind::Crossing => "leaving a branch point",
        };
        let left = self.diagram_left(done);
        self.show(self.diagram * done.fraction, format!("{left}  {what} at {:.4} Hz", job.frequency_hz));
        self.bar.tick();
    }

    fn progress(&mut self, progress: &Progress) {
        if self.is_due() {
            let message = self.message(progress);
            self.show(self.diagram * progress.done.fraction, message);
        }
    }

    fn varied(&mut self, progress: &VariedProgress<'_>) {
        if !self.after_diagram {
            (self.after_diagram, self.pace) = (true, None);
        }
        if self.is_due() {
            let message = self.varied_message(progress);
            self.show(self.diagram + (1.0 - self.diagram) * progress.fraction, message);
        }
    }

    fn notice(&mut self, notice: &dyn Display) {
        notify(&notice.to_string());
    }

    fn finishing(&mut self) {
        self.clear();
        self.interrupt.is_in_order();
    }

    fn interrupted(&mut self) -> bool {
        if self.bar.is_hidden() {
            let (fraction, message) = &self.shown;
            self.lines.say(|| format!("{:.0} %, {message}", 100.0 * fraction));
        }
        self.interrupt.raised()
    }
}
