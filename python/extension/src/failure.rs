//! Errors as exceptions: of the name of the Rust error, with the numbers that it carries.

use std::fmt::Debug;

use hammerbeam::{
    Error, FailureKind, InitialStateError, StudyError,
    attractor::AttractorError,
    drawing::DrawingError,
    results::{StoreError, export::ExportError},
    run::RunError,
};
use pyo3::{IntoPyObjectExt, prelude::*, types::PyDict};
use serde_json::{Value, json};

use crate::numbers;

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
    let (class, numbers) = (class_of(&error), numbers::of(&error));
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
                name: name_of(&other),
                numbers: numbers::of_drawing(&other),
            },
        ),
    }
}

/// The exception of something else that was given and is not right, with its numbers.
pub fn bad_input(py: Python<'_>, class: &'static str, message: String, numbers: Value) -> PyErr {
    let exit_code = FailureKind::BadInput.exit_code();
    raised(py, Raised { class, message, exit_code, name: class.to_owned(), numbers })
}

/// The exception of a word that is none of those that are allowed.
pub fn unknown(py: Python<'_>, what: &str, found: &str, allowed: &[String]) -> PyErr {
    let message = format!("there is no {what} {found:?}; allowed: {}", allowed.join(", "));
    bad_input(py, "BadInput", message, json!({ "found": found, "allowed": allowed }))
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

/// The class of an error.
fn class_of(error: &Error) -> &'static str {
    match error {
        Error::Study(_) => "StudyError",
        Error::Store(_) => "StoreError",
        Error::Export(_) => "ExportError",
        Error::Write(_) => "WriteError",
        Error::Run(_) => "RunError",
        Error::Motion(_) => "AttractorError",
        Error::Initial(_) => "InitialStateError",
        Error::FallingFrequencies { .. } => "FallingFrequencies",
        Error::Coordinate(_) => "CoordinateError",
        Error::TooLarge(_) => "SimulationTooLarge",
        Error::MotionsTooLarge { .. } => "BadInput",
        Error::Drifts(_) => "Drifts",
        Error::FrequencyNotResolved { .. } => "FrequencyNotResolved",
        Error::NoSpecialPoint { .. } | Error::SpecialPointOutside { .. } | Error::SweepWithoutParts => {
            "BadInput"
        }
        Error::NoSearch { .. } => "NoSearch",
        Error::Stopped { source, .. } => class_of(source),
        Error::Interrupted { .. } | Error::TablesInterrupted => "Interrupted",
        _ => "HammerbeamError",
    }
}

/// Name of the innermost variant that an error is made of.
fn variant(error: &Error) -> String {
    match error {
        Error::Study(StudyError::Setting(error)) => name_of(error),
        Error::Study(error) => name_of(error),
        Error::Store(error) | Error::Run(RunError::Store(error)) => name_of(error),
        Error::Export(ExportError::Store(error)) => name_of(error),
        Error::Export(ExportError::Write(error)) => name_of(error),
        Error::Motion(error) => of_attractor(error),
        Error::Initial(InitialStateError::NotInFront { source, .. }) => of_attractor(source),
        Error::Initial(InitialStateError::Points(error)) => name_of(error),
        Error::Initial(InitialStateError::Orbit(error)) => name_of(error),
        Error::Initial(error) => name_of(error),
        Error::Coordinate(error) => name_of(error),
        Error::TooLarge(error) => name_of(error),
        Error::Stopped { source, .. } => variant(source),
        other => name_of(other),
    }
}

fn of_attractor(error: &AttractorError) -> String {
    match error {
        AttractorError::Motion(error) => name_of(error),
        AttractorError::General(error) => name_of(error),
        other => name_of(other),
    }
}

/// The name in front of the fields of what is shown for debugging.
fn name_of(error: &impl Debug) -> String {
    let shown = format!("{error:?}");
    shown.split(|letter: char| !letter.is_alphanumeric()).next().unwrap_or_default().to_owned()
}
