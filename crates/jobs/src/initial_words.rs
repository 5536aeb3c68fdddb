//! The state at which a motion begins, in words: what `--initial` takes.

use hammerbeam_study::{PointStart, PointStartKind};

use crate::InitialState;

/// Largest entry of a state that is given: its square and the energy of the motion are numbers.
pub const MOST_OF_A_STATE: f64 = 1e100;

/// Words that mean no state: what was found, and what is allowed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct InitialWordsError {
    /// In words.
    pub message: String,
}

impl InitialState {
    /// The state that words mean: `rest`, `linear`, `branch:N`, `POINT.y=METRES,POINT.v=METRES_PER_SECOND` or
    /// the numbers of a modal state.
    ///
    /// * `size`: entries of a modal state.
    ///
    /// # Errors
    /// [`InitialWordsError`].
    pub fn parse(text: &str, size: usize) -> Result<Self, InitialWordsError> {
        if let Some(branch) = text.strip_prefix("branch:") {
            // No branch has the number 0.
            return Ok(Self::Branch(branch.parse().unwrap_or(0)));
        }
        match text {
            "rest" => Ok(Self::Rest),
            "linear" => Ok(Self::Linear),
            points if points.contains('=') => of_points(points),
            numbers => numbers_of(numbers, size),
        }
    }
}

/// `tip.y=1e-3,tip.v=0.2`: displacements [m] and velocities [m/s] of points in space.
fn of_points(text: &str) -> Result<InitialState, InitialWordsError> {
    let refused = |part: &str| {
        let found = format!("found {part:?}");
        InitialWordsError {
            message: format!(
                "{found}; allowed: POINT.y=METRES and POINT.v=METRES_PER_SECOND, separated by commas, \
                 each number from -{MOST_OF_A_STATE:e} to {MOST_OF_A_STATE:e}"
            ),
        }
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
            return Err(InitialWordsError { message: format!("{name} is given twice; allowed: once") });
        }
        starts.push(PointStart { point: point.to_owned(), kind, value });
    }
    Ok(InitialState::Points(starts))
}

fn numbers_of(text: &str, size: usize) -> Result<InitialState, InitialWordsError> {
    let mut state = Vec::new();
    let separator = if text.contains(',') { "," } else { " " };
    for part in text.trim().split(separator) {
        match part.trim().parse::<f64>() {
            Ok(number) if number.abs() <= MOST_OF_A_STATE => state.push(number),
            _ => return Err(InitialWordsError::not_numbers(&format!("found {:?}", part.trim()), size)),
        }
    }
    Ok(InitialState::Modal(state))
}

impl InitialWordsError {
    /// Words that are not the numbers of a state either.
    ///
    /// * `found`: what was found; `size`: entries of a modal state.
    #[must_use]
    pub fn not_numbers(found: &str, size: usize) -> Self {
        let allowed = format!(
            "rest, linear, branch:N with --results, POINT.y=METRES,POINT.v=METRES_PER_SECOND, or {size} \
             numbers q1,..,v1,.. separated by commas or blanks, each from -{MOST_OF_A_STATE:e} to \
             {MOST_OF_A_STATE:e}"
        );
        Self { message: format!("{found}; allowed: {allowed}") }
    }
}
