//! What varies along a branch: the excitation frequency, or another parameter of the system.

use hammerbeam_motion::{Flow, Parameter};

/// What varies along a branch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ContinuationParameter {
    /// The excitation frequency [Hz].
    Frequency,
    /// A parameter of the system, at a fixed excitation frequency.
    Other {
        /// Which one.
        parameter: Parameter,
        /// Excitation frequency [Hz].
        frequency_hz: f64,
    },
}

impl ContinuationParameter {
    /// The parameter of the system, if it is one.
    #[must_use]
    pub fn parameter(self) -> Option<Parameter> {
        match self {
            Self::Frequency => None,
            Self::Other { parameter, .. } => Some(parameter),
        }
    }

    /// The column of a flow that belongs to it.
    pub(crate) fn column_of(self, flow: &Flow) -> &[f64] {
        if self.parameter().is_some() { &flow.by_parameter } else { &flow.by_frequency }
    }
}
