//! A candidate that is to be accepted, with what happened on the way to it.

use crate::{error::PathStop, point::PathEvents};

/// What is known of a candidate that is to be accepted.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Arrival {
    pub events: PathEvents,
    /// The branch ends here for this reason.
    pub end: Option<PathStop>,
    /// Earlier nodes of the predictor, for the order in the step control.
    pub earlier: usize,
    /// Sign of `t_λ` from here on, if it differs from that before.
    pub parameter_sign: Option<f64>,
    /// The sign of the determinant changes here while the direction of travel does not.
    pub anchors_anew: bool,
    /// Arc length within which an event was located.
    pub uncertainty: f64,
    /// Test functions that have not left their last zero yet.
    pub zeros_near: u32,
    /// Least and most number of multipliers outside the unit circle behind the candidate, if known.
    pub outside: Option<(u32, u32)>,
    /// Multipliers outside beside the zero that the candidate is, if it was looked for and they are known.
    pub counted: Option<Counted>,
}

/// How many multipliers lie outside at a place beside a zero of a test function.
#[derive(Debug, Clone, Copy)]
pub(super) struct Counted {
    pub count: u32,
    /// The place is before the zero.
    pub before: bool,
}
