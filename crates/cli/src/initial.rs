//! The state at which a motion begins, as `--initial` has it.

use hammerbeam_jobs::{InitialState, InitialStateError, JobError};
use hammerbeam_study::{PointStart, PointStartKind};

use crate::{failure::Failure, motion_args::MOST_OF_A_STATE};

/// What `--initial` means.
///
/// * `size`: entries of a modal state.
pub fn meant(text: &str, size: usize) -> Result<InitialState, Failure> {
    if let Some(branch) = text.strip_prefix("branch:") {
        // No branch has the number 0.
        return Ok(InitialState::Branch(branch.parse().unwrap_or(0)));
    }
    match text {
        "rest" => Ok(InitialState::Rest),
        "linear" => Ok(InitialState::Linear),
        points if points.contains('=') => of_points(points),
        numbers => numbers_of(numbers, size),
    }
}

/// Why a motion cannot begin there, or another failure of its job.
pub fn refused(text: &str, size: usize, error: JobError) -> Result<Failure, JobError> {
    let error = match error {
        JobError::Initial(error) => error,
        other => return Err(other),
    };
    Ok(Failure::BadInput(match &error {
        InitialStateError::NotInFront { frequency_hz, source } => {
            let place = frequency_hz.map_or_else(String::new, |hertz| format!(", at {hertz} Hz"));
            format!("--initial {text}{place}: {source}")
        }
        InitialStateError::Length { found, .. } => {
            return Ok(not_numbers(&format!("found {found} number(s)"), size));
        }
        InitialStateError::NoResults => "--initial branch:N needs --results DIR".to_owned(),
        InitialStateError::NoSuchBranch { last } => {
            let branch = text.strip_prefix("branch:").unwrap_or(text);
            let allowed = last.map_or_else(
                || "the folder of --results has no branches".to_owned(),
                |last| format!("allowed: 1 to {last}"),
            );
            format!("--initial: there is no branch {branch:?}; {allowed}")
        }
        InitialStateError::Points(error) => format!("--initial: {error}"),
        other => return Ok(Failure::NoResult(other.to_string())),
    }))
}

/// `tip.y=1e-3,tip.v=0.2`: displacements [m] and velocities [m/s] of points in space.
fn of_points(text: &str) -> Result<InitialState, Failure> {
    let refused = |part: &str| {
        let found = format!("--initial: found {part:?}");
        Failure::BadInput(format!(
            "{found}; allowed: POINT.y=METRES and POINT.v=METRES_PER_SECOND, separated by commas, each number from -{MOST_OF_A_STATE:e} to {MOST_OF_A_STATE:e}"
        ))
    };
    let mut starts = Vec::new();
    for part in text.split(',').map(str::trim) {
        let (name, value) = part.rsplit_once('=').ok_or_else(|| refused(part))?;
        let value = value.trim().parse::<f64>().ok().filter(|value| value.abs() <= MOST_OF_A_STATE);
        let (point, kind) = match name.trim().rsplit_once('.') {
            Some((point, "y")) => (point, PointStartKind::Displacement),
            Some((point, "v")) => (point, PointStartKind::Velocity),
            _ => return Err(refused(part)),
        };
        let value = value.ok_or_else(|| refused(part))?;
        let is_same = |start: &PointStart| start.point == point && start.kind == kind;
        if starts.iter().any(is_same) {
            let name = name.trim();
            return Err(Failure::BadInput(format!("--initial: {name} is given twice; allowed: once")));
        }
        starts.push(PointStart { point: point.to_owned(), kind, value });
    }
    Ok(InitialState::Points(starts))
}

fn numbers_of(text: &str, size: usize) -> Result<InitialState, Failure> {
    let mut state = Vec::new();
    let separator = if text.contains(',') { "," } else { " " };
    for part in text.trim().split(separator) {
        match part.trim().parse::<f64>() {
            Ok(number) if number.abs() <= MOST_OF_A_STATE => state.push(number),
            _ => return Err(not_numbers(&format!("found {:?}", part.trim()), size)),
        }
    }
    Ok(InitialState::Modal(state))
}

fn not_numbers(found: &str, size: usize) -> Failure {
    let allowed = format!(
        "rest, linear, branch:N with --results, POINT.y=METRES,POINT.v=METRES_PER_SECOND, or {size} numbers q1,..,v1,.. separated by commas or blanks, each from -{MOST_OF_A_STATE:e} to {MOST_OF_A_STATE:e}"
    );
    Failure::BadInput(format!("--initial: {found}; allowed: {allowed}"))
}
