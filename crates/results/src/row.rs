//! One row of a branch: the same over the frequency, over another parameter and along a curve.

use hammerbeam_orbit::{
    BranchRow, CurveRow, EventSet, LocatedEvent, OrbitMaxima, PeriodicSolution, Stability,
};

/// A solution of a branch or a curve as it is stored.
#[derive(Debug, Clone, PartialEq)]
pub struct SolvedRow {
    /// Value of what varies, in the unit of its name; the excitation frequency [Hz] where it is that.
    pub parameter: f64,
    /// The solution.
    pub solution: PeriodicSolution,
    /// What happens at it.
    pub events: EventSet,
    /// What is known of that, uncertainty and direction in the unit of the parameter; `None` where nothing
    /// happens, and on curves.
    pub located: Option<LocatedEvent>,
}

impl From<BranchRow> for SolvedRow {
    /// In the unit of the walk.
    fn from(row: BranchRow) -> Self {
        Self {
            parameter: row.parameter.unwrap_or(row.solution.frequency_hz),
            solution: row.solution,
            events: row.events.into(),
            located: row.located,
        }
    }
}

impl From<CurveRow> for SolvedRow {
    /// In the unit of the walk.
    fn from(row: CurveRow) -> Self {
        Self { parameter: row.parameter, solution: row.solution, events: row.events.into(), located: None }
    }
}

/// What the tables of a solution show, without its nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Value of what varies, in the unit of its name; the excitation frequency [Hz] where it is that.
    pub parameter: f64,
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
    /// Maxima over the orbit.
    pub maxima: OrbitMaxima,
    /// What happens there; start and end of a branch over the frequency included.
    pub events: EventSet,
    /// What is known of its stability.
    pub stability: Stability,
    /// Multiplier of the largest modulus, the positive one of a pair.
    pub leading_multiplier: [f64; 2],
    /// Residual of the shooting equations.
    pub residual: f64,
    /// Estimated error.
    pub error_estimate: f64,
}

impl Default for Row {
    /// Nothing but zeros.
    fn default() -> Self {
        Self {
            parameter: 0.0,
            frequency_hz: 0.0,
            maxima: OrbitMaxima::default(),
            events: EventSet::default(),
            stability: Stability::Unstable,
            leading_multiplier: [0.0; 2],
            residual: 0.0,
            error_estimate: 0.0,
        }
    }
}

impl From<&SolvedRow> for Row {
    fn from(row: &SolvedRow) -> Self {
        let solution = &row.solution;
        let [re, im] = solution.floquet_multipliers.first().copied().unwrap_or([0.0, 0.0]);
        Self {
            parameter: row.parameter,
            frequency_hz: solution.frequency_hz,
            maxima: solution.maxima,
            events: row.events,
            stability: solution.stability(),
            leading_multiplier: [re, im.abs()],
            residual: solution.residual,
            error_estimate: solution.error_estimate,
        }
    }
}
