//! Where a run over a stretch stands.

use super::sensitivity::Sensitivity;

/// State of a run; times are counted from the start of the stretch.
#[derive(Debug, Default)]
pub(crate) struct Run {
    /// Time since the start of the stretch [s].
    pub time: f64,
    /// Homogeneous part of the block state, length 2n.
    pub state: Vec<f64>,
    /// Closed contact of each element.
    pub closed: Vec<Option<usize>>,
    /// Sensitivities, if wanted.
    pub sensitivity: Option<Sensitivity>,
    /// Step length that the error allows next [s]; 0 if nothing is known.
    pub proposal: f64,
    /// Element that has just touched, whose force sets in now.
    pub touched: Option<usize>,
}
