//! Progress for Python, and Ctrl-C from it, while a job works without the interpreter's lock.

use std::{
    fmt::Display,
    time::{Duration, Instant},
};

use hammerbeam::{CountedProgress, Observer, Progress, VariedProgress};
use pyo3::prelude::*;

/// How often the interpreter is asked whether someone has pressed Ctrl-C.
const ASKED: Duration = Duration::from_millis(50);
/// How often progress is shown.
const SHOWN: Duration = Duration::from_millis(100);

/// An observer that calls Python.
///
/// `report` is called with the part of the work that is done, or `None`, and where the work is; `notice` with
/// what a user should know. An exception in them, or a signal such as Ctrl-C, stops the job.
pub struct PythonObserver {
    report: Option<Py<PyAny>>,
    notice: Option<Py<PyAny>>,
    raised: Option<PyErr>,
    asked: Instant,
    shown: Option<Instant>,
}

impl PythonObserver {
    /// An observer; `None` for what is not to be called.
    pub fn new(report: Option<Py<PyAny>>, notice: Option<Py<PyAny>>) -> Self {
        Self { report, notice, raised: None, asked: Instant::now(), shown: None }
    }

    /// Runs a job without the interpreter's lock.
    ///
    /// # Errors
    /// What was raised meanwhile comes before what the job says.
    pub fn run<T: Send>(
        py: Python<'_>,
        callbacks: (Option<Py<PyAny>>, Option<Py<PyAny>>),
        job: impl FnOnce(&mut Self) -> T + Send,
    ) -> PyResult<T> {
        let mut observer = Self::new(callbacks.0, callbacks.1);
        let done = py.detach(|| job(&mut observer));
        match observer.raised {
            Some(raised) => Err(raised),
            None => Ok(done),
        }
    }

    fn show(&mut self, fraction: Option<f64>, place: &dyn Display) {
        if self.raised.is_some() || self.shown.is_some_and(|shown| shown.elapsed() < SHOWN) {
            return;
        }
        let Some(report) = &self.report else { return };
        self.shown = Some(Instant::now());
        let called = Python::attach(|py| report.call1(py, (fraction, place.to_string())).map(drop));
        self.raised = called.err();
    }
}

impl Observer for PythonObserver {
    fn progress(&mut self, progress: &Progress) {
        let Progress { frequency_hz, branches_done, solutions, done, .. } = *progress;
        let place = format_args!("{frequency_hz:.4} Hz, {branches_done} branches, {solutions} solutions");
        self.show(Some(done.fraction), &place);
    }

    fn varied(&mut self, progress: &VariedProgress<'_>) {
        let VariedProgress { parameter, value, frequency_hz, fraction, .. } = *progress;
        self.show(Some(fraction), &format_args!("{parameter} = {value:.6e}, {frequency_hz:.4} Hz"));
    }

    fn counted(&mut self, progress: &CountedProgress<'_>) {
        let CountedProgress { done, total, things, place } = *progress;
        let fraction = total.map(|total| done as f64 / total.max(1) as f64);
        self.show(fraction, &format_args!("{done} {things} {place}"));
    }

    fn notice(&mut self, notice: &dyn Display) {
        let Some(callback) = self.notice.as_ref().filter(|_| self.raised.is_none()) else { return };
        let called = Python::attach(|py| callback.call1(py, (notice.to_string(),)).map(drop));
        self.raised = called.err();
    }

    fn interrupted(&mut self) -> bool {
        if self.raised.is_none() && self.asked.elapsed() >= ASKED {
            self.asked = Instant::now();
            self.raised = Python::attach(|py| py.check_signals()).err();
        }
        self.raised.is_some()
    }
}
