//! Where a run over a stretch stands.

use super::{drive::Jet, event::Event, pressing::Pressing, sensitivity::Sensitivity};

/// State of a run; times are counted from the start of the stretch.
#[derive(Debug, Default)]
pub(crate) struct Run {
    /// Time since the start of the stretch [s].
    pub time: f64,
    /// Homogeneous part of the block state, length 2n.
    pub state: Vec<f64>,
    /// Closed contact of each element.
    pub closed: Vec<Option<usize>>,
    /// Contact of each element that has parted: penetration is left, but no pressure.
    pub parted: Vec<Option<usize>>,
    /// Sensitivities, if wanted.
    pub sensitivity: Option<Sensitivity>,
    /// Time to the end of the stretch at the start of a step [s].
    pub remaining: f64,
    /// Step length that the error allows next [s]; 0 if nothing is known.
    pub proposal: f64,
    /// Length that the error allows a step that is graded towards an end of the contact [s]; 0 if nothing is
    /// known.
    pub graded: f64,
    /// Length of the longest step of this contact, or of the last bold one [s], and steps since then.
    pub longest: (f64, u32),
    /// Element that has just touched, whose force sets in now.
    pub touched: Option<usize>,
    /// Element that has just come to press again after it had parted.
    pub pressed: Option<usize>,
    /// What is known of every element at the start of a step.
    pub start: Vec<ElementStart>,
    /// What the held stops press with at the start of a step.
    pub pressing: Vec<Pressing>,
    /// End of a contact that is known to come soon, and about when [s].
    pub release: Option<(Event, f64)>,
    /// Elements that are held on their rigid stops, ascending (`held.rs`).
    pub stuck: Vec<usize>,
    /// Of each element when its rigid stop was left without speed last.
    pub left: Vec<Left>,
    /// Impacts on rigid stops in this stretch.
    pub impacts: u64,
    /// Time within which contacts that leave count as open, after another was released [s].
    pub slack: f64,
}

/// When a rigid stop was left without speed, and until when its clearance is not looked at [s].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Left {
    pub at: f64,
    pub until: f64,
    /// Whether it is pressed on again at once (`stick.rs`).
    pub briefly: bool,
}

impl Left {
    pub const NEVER: Self = Self { at: f64::NEG_INFINITY, until: f64::NEG_INFINITY, briefly: false };
}

/// What is known of an element at the start of a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ElementStart {
    /// Displacement and its derivatives, apart from the direct part of the forces; of a hole its reading.
    pub jet: Jet,
    /// The same of the output of the element, which of the directions of a hole is not its reading.
    pub output: Jet,
    /// Rounding margin of the displacement [m].
    pub margin: f64,
    /// Largest relative velocity that the state can reach [m/s]; of a hole in any direction.
    pub velocity: f64,
}
