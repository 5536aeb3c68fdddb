//! Why a motion cannot begin at a state.

use hammerbeam_attractor::AttractorError;
use hammerbeam_motion::exact::MotionError;
use hammerbeam_study::PointStartError;

use crate::counted;

/// Why a motion cannot begin at a state.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum InitialStateError {
    /// It lies behind a rigid stop, or in a contact whose law depends on the speed of its impact.
    ///
    /// * `frequency_hz`: of the excitation, if there is one.
    #[error("{source}")]
    NotInFront { frequency_hz: Option<f64>, source: AttractorError },
    /// A state of another length.
    #[error("found {}, the state has {expected}", counted(*found as u64, "number"))]
    Length { found: usize, expected: usize },
    /// Points that no state of the model has.
    #[error(transparent)]
    Points(#[from] PointStartError),
    /// A branch without results that hold it.
    #[error("a branch needs the results that hold it")]
    NoResults,
    /// No such branch is stored.
    #[error("there is no such branch; {}", allowed(*last))]
    NoSuchBranch { last: Option<u32> },
    /// The branch does not reach the frequency.
    #[error("branch {branch} does not cross {frequency_hz} Hz")]
    NoCrossing { branch: u32, frequency_hz: f64 },
    /// The orbit of the branch cannot be gone over.
    #[error(transparent)]
    Orbit(MotionError),
}

/// Which branches there are, in words.
fn allowed(last: Option<u32>) -> String {
    last.map_or_else(|| "the results have no branches".to_owned(), |last| format!("allowed: 1 to {last}"))
}
