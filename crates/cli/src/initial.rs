//! The state from which a motion begins, and what is read off a motion.

use std::path::Path;

use hammerbeam_attractor::{AttractorError, SectionMap, SystemMap};
use hammerbeam_jobs::StoredBranches;
use hammerbeam_motion::Stretch;
use hammerbeam_orbit::states_at_phase;
use hammerbeam_study::{Model, PointStart, PointStartKind, StudyFile};

use crate::{failure::Failure, motion_args::MOST_OF_A_STATE};

impl From<AttractorError> for Failure {
    fn from(error: AttractorError) -> Self {
        match error {
            AttractorError::Input { .. }
            | AttractorError::StateLength { .. }
            | AttractorError::BehindRigidStop { .. }
            | AttractorError::WithinContact { .. } => Self::BadInput(error.to_string()),
            other => Self::NoResult(other.to_string()),
        }
    }
}

/// The state that `--initial` means: one in front of every rigid stop, and in no contact whose law remembers
/// its impact.
///
/// * `map`: of the system at the frequency.
pub fn state(
    text: &str,
    map: &mut SystemMap,
    study: (&StudyFile, &Model),
    results: Option<&Path>,
) -> Result<Vec<f64>, Failure> {
    let branches = results.map(|folder| StoredBranches::open(folder, study.0)).transpose()?;
    let state = meant(text, map, study.1, branches.as_ref())?;
    map.check_in_front_of_stops(&state).map_err(|error| {
        let place = match study.0.study.excitation.harmonic() {
            Some(_) => format!(", at {} Hz", map.frequency_hz()),
            None => String::new(),
        };
        Failure::BadInput(format!("--initial {text}{place}: {error}"))
    })?;
    Ok(state)
}

fn meant(
    text: &str,
    map: &mut SystemMap,
    model: &Model,
    branches: Option<&StoredBranches>,
) -> Result<Vec<f64>, Failure> {
    let size = map.dimension();
    if let Some(branch) = text.strip_prefix("branch:") {
        return of_branch(branch, map, model, branches);
    }
    match text {
        "rest" => Ok(vec![0.0; size]),
        "linear" => {
            let stretch = Stretch { frequency_hz: map.frequency_hz(), start: 0.0, end: 1.0 };
            Ok(map.integrator().steady_state(&stretch))
        }
        points if points.contains('=') => of_points(points, map.frequency_hz(), model),
        numbers => numbers_of(numbers, size),
    }
}

/// `tip.y=1e-3,tip.v=0.2`: displacements [m] and velocities [m/s] of points in space.
fn of_points(text: &str, frequency_hz: f64, model: &Model) -> Result<Vec<f64>, Failure> {
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
    let state = model.state_of_points(frequency_hz, &starts);
    state.map_err(|error| Failure::BadInput(format!("--initial: {error}")))
}

fn numbers_of(text: &str, size: usize) -> Result<Vec<f64>, Failure> {
    let refused = |found: &str| {
        let allowed = format!(
            "rest, linear, branch:N with --results, POINT.y=METRES,POINT.v=METRES_PER_SECOND, or {size} numbers q1,..,v1,.. separated by commas or blanks, each from -{MOST_OF_A_STATE:e} to {MOST_OF_A_STATE:e}"
        );
        Failure::BadInput(format!("--initial: {found}; allowed: {allowed}"))
    };
    let mut state = Vec::new();
    let separator = if text.contains(',') { "," } else { " " };
    for part in text.trim().split(separator) {
        match part.trim().parse::<f64>() {
            Ok(number) if number.abs() <= MOST_OF_A_STATE => state.push(number),
            _ => return Err(refused(&format!("found {:?}", part.trim()))),
        }
    }
    if state.len() == size { Ok(state) } else { Err(refused(&format!("found {} number(s)", state.len()))) }
}

/// The state at phase 0 of the orbit in which a branch crosses the frequency: of a stable one where there are
/// several.
fn of_branch(
    text: &str,
    map: &mut SystemMap,
    model: &Model,
    branches: Option<&StoredBranches>,
) -> Result<Vec<f64>, Failure> {
    let frequency_hz = map.frequency_hz();
    let Some(branches) = branches else {
        return Err(Failure::BadInput("--initial branch:N needs --results DIR".to_owned()));
    };
    let known: Vec<u32> = branches.branches().iter().map(|branch| branch.record.id).collect();
    let Some(number) = text.parse::<u32>().ok().filter(|number| known.contains(number)) else {
        let allowed = known.last().map_or_else(
            || "the folder of --results has no branches".to_owned(),
            |last| format!("allowed: 1 to {last}"),
        );
        return Err(Failure::BadInput(format!("--initial: there is no branch {text:?}; {allowed}")));
    };
    let mut orbits = branches.crossings(model, frequency_hz, |record| record.id == number)?;
    orbits.sort_by_key(|(_, orbit)| !orbit.may_be_stable());
    match orbits.into_iter().next() {
        Some((_, orbit)) => states_at_phase(map.integrator(), &orbit, 0.0)
            .map(|mut states| states.swap_remove(0))
            .map_err(|error| Failure::NoResult(error.to_string())),
        None => Err(Failure::NoResult(format!("branch {number} does not cross {frequency_hz} Hz"))),
    }
}
