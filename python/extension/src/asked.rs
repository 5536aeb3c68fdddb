//! What Python gives, as jobs take it.

use std::path::PathBuf;

use hammerbeam::{
    InitialState, JobFolders, JobPart, JobPartError, Study,
    attractor::{Effort, Patience},
};
use pyo3::prelude::*;
use serde::Serialize;
use serde_json::json;

use crate::failure::bad_input;

/// What is called with progress or notices.
pub type Callback = Option<Py<PyAny>>;

/// A report as the command gives it with `--json`.
pub fn document(report: &impl Serialize) -> String {
    serde_json::to_string(report).expect("reports are plain data with text keys")
}

/// The folder that a motion starts from, and that it is kept in.
pub fn folders<'a>(results: &'a Option<PathBuf>, out: &'a Option<PathBuf>) -> JobFolders<'a> {
    JobFolders { results: results.as_deref(), out: out.as_deref() }
}

/// A part by its words.
pub fn job_part(py: Python<'_>, text: &str) -> PyResult<JobPart> {
    let refused =
        |error: JobPartError| bad_input(py, "BadInput", error.to_string(), json!({ "found": text }));
    text.parse().map_err(refused)
}

/// A state by the words of `--initial`.
pub fn initial(py: Python<'_>, text: &str, study: &Study) -> PyResult<InitialState> {
    let state = InitialState::parse(text, 2 * study.dof());
    state.map_err(|error| {
        let message = format!("initial: {error}");
        bad_input(py, "InitialStateError", message, json!({ "found": text, "expected": 2 * study.dof() }))
    })
}

/// What is spent on the kind of a motion: periods that are skipped, that it has to repeat in, that a period
/// has at most, and that are averaged over.
pub type EffortNumbers = (u64, u64, usize, u64);

/// Of a job by parts: the part to compute, as `2/4`, or the folders that the whole is put together from.
pub type Parts = (Option<String>, Vec<PathBuf>);

/// How long a forced motion is: frequency [Hz], transient periods, periods, duration [s] which takes
/// precedence, and samples in a period.
pub type ForcedTime = (f64, u64, u64, Option<f64>, u32);

/// What is spent on the kind of a motion.
pub fn effort((skipped, periods, longest, averaged): EffortNumbers) -> Effort {
    Effort { patience: Patience { skipped, periods, longest }, averaged, ..Effort::default() }
}
