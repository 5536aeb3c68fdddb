//! What the message of an error says, as values: its fields by the names that they have in Rust.

use hammerbeam::{
    Error, InitialStateError, StudyError,
    attractor::AttractorError,
    basins::CoordinateError,
    drawing::DrawingError,
    figure::FigureError,
    motion::{exact::MotionError, general::GeneralError},
    results::{export::ExportError, store::StoreError},
    run::RunError,
    simulate::{DurationTooLong, SimulationTooLarge},
    study_file::{PointStartError, SettingError},
};
use serde_json::{Value, json};

/// Fields of a variant by their names.
macro_rules! fields {
    ($($name:ident),+) => { json!({ $((stringify!($name)): $name),+ }) };
}

/// Those of an error of a job.
pub fn of(error: &Error) -> Value {
    match error {
        Error::Study(error) => of_study(error),
        Error::Store(error) | Error::Run(RunError::Store(error)) => of_store(error),
        Error::Export(ExportError::Store(error)) => of_store(error),
        Error::Export(ExportError::Write(error)) | Error::Write(error) => {
            json!({ "path": error.path.display().to_string() })
        }
        Error::Run(RunError::Walk { start, .. }) => fields!(start),
        Error::Motion(error) => of_attractor(error),
        Error::Initial(error) => of_initial(error),
        Error::FallingFrequencies { from_hz, to_hz } => fields!(from_hz, to_hz),
        Error::Coordinate(error) => of_coordinate(error),
        Error::TooLarge(error) => of_size(error),
        Error::MotionsTooLarge { orbits, numbers, most, most_samples } => {
            fields!(orbits, numbers, most, most_samples)
        }
        Error::NoOutput { name, known } => fields!(name, known),
        Error::NoSpecialPoint { number, count, .. } => fields!(number, count),
        Error::SpecialPointOutside { number, at_hz, range_hz, .. } => fields!(number, at_hz, range_hz),
        Error::Drifts(drift) => json!({ "held_by_stops": drift.held_by_stops }),
        Error::FrequencyNotResolved { high_hz, resolved_hz } => fields!(high_hz, resolved_hz),
        Error::Stopped { source, done } => {
            let mut numbers = of(source);
            numbers["done"] = json!(done);
            numbers
        }
        Error::Interrupted { done, part_s } => fields!(done, part_s),
        _ => json!({}),
    }
}

/// Those of an error of a study: `problems` has its faults as `--json` has them.
fn of_study(error: &StudyError) -> Value {
    match error {
        StudyError::Invalid(report) => json!({ "problems": report.documents() }),
        StudyError::Unreadable { path, .. } => json!({ "path": path.display().to_string() }),
        StudyError::Setting(error) => match error {
            SettingError::NoAssignment { text } => fields!(text),
            SettingError::NoSuchElement { key, path, name, known } => fields!(key, path, name, known),
            SettingError::NotATable { key, path } => fields!(key, path),
            SettingError::NotToml { key } => fields!(key),
            _ => json!({}),
        },
        StudyError::Unforced { name } => fields!(name),
        _ => json!({}),
    }
}

fn of_store(error: &StoreError) -> Value {
    match error {
        StoreError::OtherStudy { differences, .. } => fields!(differences),
        StoreError::OtherVersion { program, what, found, expected, .. } => {
            fields!(program, what, found, expected)
        }
        StoreError::Damaged { what, found, expected } => fields!(what, found, expected),
        StoreError::DamagedSolution { branch, side, number, .. } => fields!(branch, side, number),
        StoreError::MissingSolutions { branch, side, first, last } => fields!(branch, side, first, last),
        StoreError::DamagedMotion { request, found, done } => fields!(request, found, done),
        StoreError::Unknown { what, found } => fields!(what, found),
        StoreError::Impossible { what, found } => fields!(what, found),
        StoreError::OutOfOrder { request, found, expected } => fields!(request, found, expected),
        StoreError::NoResults { folder }
        | StoreError::NoPart { folder }
        | StoreError::NotResults { folder }
        | StoreError::Locked { folder }
        | StoreError::Folder { folder, .. }
        | StoreError::TakenOver { folder } => json!({ "folder": folder.display().to_string() }),
        _ => json!({}),
    }
}

fn of_initial(error: &InitialStateError) -> Value {
    match error {
        InitialStateError::NotInFront { frequency_hz, source } => {
            let mut numbers = of_attractor(source);
            numbers["frequency_hz"] = json!(frequency_hz);
            numbers
        }
        InitialStateError::Length { found, expected } => fields!(found, expected),
        InitialStateError::Points(PointStartError::UnknownPoint { point, known }) => fields!(point, known),
        InitialStateError::Points(PointStartError::Contradiction { point, value, left }) => {
            fields!(point, value, left)
        }
        InitialStateError::NoSuchBranch { last } => fields!(last),
        InitialStateError::NoCrossing { branch, frequency_hz } => fields!(branch, frequency_hz),
        InitialStateError::Orbit(error) => of_motion(error),
        _ => json!({}),
    }
}

fn of_coordinate(error: &CoordinateError) -> Value {
    match error {
        CoordinateError::PointNotMoved { modes, .. } => fields!(modes),
        CoordinateError::Unknown { name, modes, .. } => fields!(name, modes),
        CoordinateError::Same { x, y } => fields!(x, y),
        _ => json!({}),
    }
}

fn of_size(error: &SimulationTooLarge) -> Value {
    match error {
        SimulationTooLarge::Free { numbers, most, sampling_hz } => fields!(numbers, most, sampling_hz),
        SimulationTooLarge::Period { samples, dof, elements, numbers, most, most_samples } => {
            fields!(samples, dof, elements, numbers, most, most_samples)
        }
        SimulationTooLarge::Periods { periods, of_period, numbers, most, most_periods, samples } => {
            fields!(periods, of_period, numbers, most, most_periods, samples)
        }
        _ => json!({}),
    }
}

/// Those of a duration.
pub fn of_duration(error: &DurationTooLong) -> Value {
    json!({ "found": error.found, "most": error.most })
}

fn of_attractor(error: &AttractorError) -> Value {
    match error {
        AttractorError::Motion(error) => of_motion(error),
        AttractorError::General(error) => of_general(error),
        AttractorError::Input { what, found, allowed } => fields!(what, found, allowed),
        AttractorError::StateLength { found, expected } => fields!(found, expected),
        AttractorError::BehindRigidStop { stop, depth } => fields!(stop, depth),
        AttractorError::WithinContact { stop, depth } => fields!(stop, depth),
        AttractorError::NeverOpens { element } => fields!(element),
        AttractorError::TangentsLost { section } => fields!(section),
        _ => json!({}),
    }
}

fn of_motion(error: &MotionError) -> Value {
    match error {
        MotionError::StartsInContact { element, phase } => fields!(element, phase),
        MotionError::PressedWithoutImpact { element, time } => fields!(element, time),
        MotionError::StepTooShort { time, step } => fields!(time, step),
        MotionError::Escapes { element, displacement, time } => fields!(element, displacement, time),
        MotionError::NoForce { element, displacement, time } => fields!(element, displacement, time),
        MotionError::TooManySteps { time, steps } => fields!(time, steps),
        MotionError::StandsStill { time, elements } => fields!(time, elements),
        MotionError::TooManyImpacts { time, impacts } => fields!(time, impacts),
        MotionError::DependentStops { elements } => fields!(elements),
        MotionError::FlightStalled { time } | MotionError::NotFinite { time } => fields!(time),
        _ => json!({}),
    }
}

fn of_general(error: &GeneralError) -> Value {
    match error {
        GeneralError::Tolerance { found } => fields!(found),
        GeneralError::StateLength { found, expected } => fields!(found, expected),
        GeneralError::Input { what, found, allowed } => fields!(what, found, allowed),
        GeneralError::StartsInContact { element } => fields!(element),
        GeneralError::NotFinite { time } => fields!(time),
        GeneralError::StepTooSmall { time, step } => fields!(time, step),
        GeneralError::TooManySteps { steps, time } => fields!(steps, time),
        _ => json!({}),
    }
}

/// Those of a figure that is not drawn.
pub fn of_drawing(error: &DrawingError) -> Value {
    match error {
        DrawingError::Motion(error) => of_motion(error),
        DrawingError::Figure(FigureError::Empty { quantity, curves, points }) => {
            fields!(quantity, curves, points)
        }
        DrawingError::Figure(FigureError::AxisRange { from, to }) => fields!(from, to),
        DrawingError::Figure(FigureError::Resolution { pixels_per_inch }) => fields!(pixels_per_inch),
        DrawingError::Interrupted { written, .. } => fields!(written),
        _ => json!({}),
    }
}
