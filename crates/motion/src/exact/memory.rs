//! Laws that remember with what speed their contact began, from one stretch to the next.
//!
//! A state `[q; q']` within such a contact does not tell how the contact began, so a stretch that starts there is refused. One exception: states alone
//! (without sensitivities) go on over the end of the stretch before, if they start with exactly the state, to the last bit, and at the phase in
//! which that ended, and no parameter was changed in between. So motion is followed period by period. Sensitivities would have to begin with those of the remembered speed, which a fundamental matrix
//! over `[q; q']` does not carry: an orbit has to be cut where the contact is open.

use super::{ExactIntegrator, MotionError, run::Run};
use crate::{Law, Stretch};

/// Where a stretch ended, and what the laws remembered there.
#[derive(Debug, Clone)]
pub(crate) struct Memory {
    phase: f64,
    state: Vec<f64>,
    laws: Vec<Law>,
}

impl ExactIntegrator {
    /// Puts laws that remember an impact back to what they are before the first.
    pub(super) fn forget_impacts(&mut self) {
        for (law, element) in self.laws.iter_mut().zip(self.system.elements()) {
            if law.remembers_impact() {
                *law = element.law;
            }
        }
    }

    /// Keeps what the laws remember at the end of a stretch.
    pub(super) fn remember_end(&mut self, stretch: &Stretch, state: &[f64]) {
        if self.laws.iter().any(Law::remembers_impact) {
            let phase = stretch.end - stretch.end.floor();
            self.memory = Some(Memory { phase, state: state.to_vec(), laws: self.laws.clone() });
        }
    }

    /// Lets the laws remember what they did at the end of the last stretch, if this one goes on there.
    pub(super) fn recall_impacts(&mut self, stretch: &Stretch, state: &[f64]) {
        let Some(memory) = &self.memory else { return };
        if memory.phase == stretch.start - stretch.start.floor() && memory.state == state {
            self.laws.clone_from(&memory.laws);
        }
    }

    /// A stretch cannot start in a contact whose law does not know how it began.
    pub(super) fn check_start(&self, run: &Run, stretch: &Stretch) -> Result<(), MotionError> {
        let closed = |element: &usize| run.closed[*element].is_some();
        match (0..self.laws.len()).filter(closed).find(|&e| !self.laws[e].is_struck()) {
            None => Ok(()),
            Some(element) => Err(MotionError::StartsInContact {
                element: self.system.elements()[element].name.clone(),
                phase: stretch.start,
            }),
        }
    }
}
