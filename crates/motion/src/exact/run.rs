//! Where a run over a stretch stands.

use super::{drive::Jet, sensitivity::Sensitivity};

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
    /// Time to the end of the stretch at the start of a step [s].
    pub remaining: f64,
    /// Step length that the error allows next [s]; 0 if nothing is known.
    pub proposal: f64,
    /// Element that has just touched, whose force sets in now.
    pub touched: Option<usize>,
    /// What is known of every element at the start of a step.
    pub start: Vec<ElementStart>,
    /// Element whose contact is known to open soon, and about when [s].
    pub release: Option<(usize, f64)>,
    /// Time within which contacts that leave count as open, after another was released [s].
    pub slack: f64,
}

/// What is known of an element at the start of a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ElementStart {
    /// Displacement and its derivatives, apart from the direct part of the forces.
    pub jet: Jet,
    /// Rounding margin of the displacement [m].
    pub margin: f64,
    /// Largest relative velocity that the state can reach [m/s].
    pub velocity: f64,
}
