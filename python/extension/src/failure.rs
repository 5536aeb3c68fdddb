//! Errors as exceptions: of the name of the Rust error, with the numbers that it carries.

use hammerbeam::{
    Error, FailureKind, StudyError, drawing::DrawingError, results::StoreError, study_file::FaultReport,
};
use pyo3::{IntoPyObjectExt, prelude::*, types::PyDict};
use serde_json::{Value, json};

/// What is raised: the name of a class of `hammerbeam._errors`, the message, its exit code and its numbers.
struct Raised {
    class: &'static str,
    message: String,
    exit_code: u8,
    /// Name of the Rust variant.
    name: String,
    numbers: Value,
}

/// The exception of an error.
pub fn exception(py: Python<'_>, error: Error) -> PyErr {
    let exit_code = error.kind().exit_code();
    let (class, numbers) = described(&error);
    raised(py, Raised { class, message: error.to_string(), exit_code, name: variant(&error), numbers })
}

/// The exception of a study with faults.
pub fn study_exception(py: Python<'_>, error: StudyError) -> PyErr {
    exception(py, error.into())
}

/// The exception of a results folder that cannot be used.
pub fn store_exception(py: Python<'_>, error: StoreError) -> PyErr {
    exception(py, error.into())
}

/// The exception of a figure that is not drawn.
pub fn drawing_exception(py: Python<'_>, error: DrawingError) -> PyErr {
    match error {
        DrawingError::Job(error) => exception(py, error),
        DrawingError::Store(error) => exception(py, error.into()),
        DrawingError::Write(error) => exception(py, error.into()),
        other => raised(
            py,
            Raised {
                class: "DrawingError",
                message: other.to_string(),
                exit_code: if matches!(other, DrawingError::Interrupted { .. }) { 130 } else { 1 },
                name: name_of(&format!("{other:?}")),
                numbers: json!({}),
            },
        ),
    }
}

/// The exception of something else that was given and is not right.
pub fn bad_input(py: Python<'_>, class: &'static str, message: String) -> PyErr {
    let exit_code = FailureKind::BadInput.exit_code();
    raised(py, Raised { class, message, exit_code, name: class.to_owned(), numbers: json!({}) })
}

fn raised(py: Python<'_>, raised: Raised) -> PyErr {
    let make = || -> PyResult<Py<PyAny>> {
        let class = py.import("hammerbeam._errors")?.getattr(raised.class)?;
        let numbers = loads(py, &raised.numbers)?;
        let keywords = PyDict::new(py);
        keywords.set_item("exit_code", raised.exit_code)?;
        keywords.set_item("name", raised.name)?;
        keywords.set_item("numbers", numbers)?;
        class.call((raised.message,), Some(&keywords))?.into_py_any(py)
    };
    match make() {
        Ok(value) => PyErr::from_value(value.into_bound(py)),
        Err(error) => error,
    }
}

fn loads<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?.call_method1("loads", (value.to_string(),))
}

/// The class of an error, and its numbers.
fn described(error: &Error) -> (&'static str, Value) {
    match error {
        Error::Study(StudyError::Invalid(report)) => ("StudyError", problems(report)),
        Error::Study(_) => ("StudyError", json!({})),
        Error::Store(StoreError::OtherStudy { differences, .. }) => {
            ("StoreError", json!({ "differences": differences }))
        }
        Error::Store(_) => ("StoreError", json!({})),
        Error::Export(_) => ("ExportError", json!({})),
        Error::Write(_) => ("WriteError", json!({})),
        Error::Run(_) => ("RunError", json!({})),
        Error::Motion(_) => ("AttractorError", json!({})),
        Error::Initial(_) => ("InitialStateError", json!({})),
        Error::FallingFrequencies { from_hz, to_hz } => {
            ("FallingFrequencies", json!({ "from_hz": from_hz, "to_hz": to_hz }))
        }
        Error::Coordinate(_) => ("CoordinateError", json!({})),
        Error::TooLarge(_) => ("SimulationTooLarge", json!({})),
        Error::Drifts(drift) => ("Drifts", json!({ "held_by_stops": drift.held_by_stops })),
        Error::FrequencyNotResolved { high_hz, resolved_hz } => {
            ("FrequencyNotResolved", json!({ "high_hz": high_hz, "resolved_hz": resolved_hz }))
        }
        Error::SweepWithoutParts => ("BadInput", json!({})),
        Error::NoSearch { .. } => ("NoSearch", json!({})),
        Error::Stopped { source, done } => {
            let (class, mut numbers) = described(source);
            numbers["done"] = json!(done);
            (class, numbers)
        }
        Error::Interrupted { done, part_s } => ("Interrupted", json!({ "done": done, "part_s": part_s })),
        Error::TablesInterrupted => ("Interrupted", json!({})),
        _ => ("HammerbeamError", json!({})),
    }
}

/// The faults of a study, as `--json` has them.
fn problems(report: &FaultReport) -> Value {
    let one = |problem: &hammerbeam::study_file::Problem| {
        let position = report.position(problem);
        json!({
            "file": report.name,
            "line": position.map(|(line, _)| line),
            "column": position.map(|(_, column)| column),
            "key": problem.key,
            "message": problem.message,
            "help": problem.help,
        })
    };
    json!({ "problems": report.problems.iter().map(one).collect::<Vec<_>>() })
}

/// Name of the innermost variant that an error is made of.
fn variant(error: &Error) -> String {
    match error {
        Error::Study(error) => name_of(&format!("{error:?}")),
        Error::Store(error) => name_of(&format!("{error:?}")),
        Error::Motion(error) => name_of(&format!("{error:?}")),
        Error::Initial(error) => name_of(&format!("{error:?}")),
        Error::Coordinate(error) => name_of(&format!("{error:?}")),
        Error::TooLarge(error) => name_of(&format!("{error:?}")),
        Error::Stopped { source, .. } => variant(source),
        other => name_of(&format!("{other:?}")),
    }
}

/// The name in front of the fields of what is shown for debugging.
fn name_of(debug: &str) -> String {
    debug.split(|letter: char| !letter.is_alphanumeric()).next().unwrap_or_default().to_owned()
}
