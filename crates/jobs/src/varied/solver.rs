//! What the computing of a piece needs of the numerics; the rest of this module knows no more of them than
//! this.

use hammerbeam_orbit::{OrbitError, PeriodicSolution, Side};
use hammerbeam_results::store::StoredMemory;

use crate::walk::Walk;

/// Why a piece has no result, or none yet.
#[derive(Debug)]
pub(super) enum Failed {
    Interrupted,
    /// In words; it is stored as what came of the piece.
    Message(String),
}

impl From<OrbitError> for Failed {
    fn from(error: OrbitError) -> Self {
        match error {
            OrbitError::Interrupted => Self::Interrupted,
            error => Self::Message(error.to_string()),
        }
    }
}

/// What the search of a piece has found.
#[derive(Debug)]
pub(super) struct FoundStarts {
    /// Where branches may start.
    pub starts: Vec<PeriodicSolution>,
    /// Value of the parameter there, in the unit of its name.
    pub parameter: f64,
    /// Why there are none, or not all.
    pub message: Option<String>,
}

/// Finds where the branches of a piece start, and follows them; shared by all threads.
pub(super) trait PieceSolver: Sync {
    /// Where branches start.
    ///
    /// * `interrupted`: asked now and then.
    fn search(&self, interrupted: &dyn Fn() -> bool) -> Result<FoundStarts, Failed>;

    /// A walk from a start. The one to the up side gives the start as its first row.
    fn begin<'a>(&'a self, start: &PeriodicSolution, side: Side) -> Result<Box<dyn Walk + 'a>, Failed>;

    /// The walk that a checkpoint was taken of; it goes on as if it had never been left.
    fn resume<'a>(&'a self, memory: &StoredMemory) -> Result<Box<dyn Walk + 'a>, Failed>;

    /// Range of the parameter and its value where walks start, in the unit of its name.
    fn way(&self) -> ([f64; 2], f64);

    /// Whether a start is the orbit near one of these states, each with its phase [cycles].
    fn is_near(&self, start: &PeriodicSolution, states: &[(f64, Vec<f64>)]) -> Result<bool, Failed>;
}
