//! Why no force step, however short, was good enough.
//!
//! Mostly a contact is far too stiff. But a force that always acts, a spring or a formula, may push away from
//! rest, and the harder the farther the motion is: that is infinite after a finite time, before which no step
//! resolves it. Or a formula has no value where the motion goes, such as `x^2.5` below zero.

use super::{ExactIntegrator, MotionError, run::Run};

/// How far ahead a force is asked for, in parts of the time that was to be gone.
const AHEAD: f64 = 1e-9;

impl ExactIntegrator {
    /// The reason for which the last step, of this length, was given up.
    pub(super) fn given_up(&self, run: &Run, step: f64, remaining: f64) -> MotionError {
        let always = self.step.active.iter().filter(|&&element| self.laws[element].contacts().is_empty());
        for &element in always {
            let law = &self.laws[element];
            let jet = self.output_jet(&run.state, element, run.time);
            let way = AHEAD * remaining * jet.slope;
            let (here, ahead) = (law.force(jet.value, jet.slope), law.force(jet.value + way, jet.slope));
            let (name, displacement, time) = (self.names(&[element]), jet.value, run.time);
            // Far from where it began, in next to no time: not on its way over the top between two wells.
            if here.slope > 0.0 && way * jet.value > jet.value * jet.value {
                return MotionError::Escapes { element: name, displacement, time };
            }
            if !here.value.is_finite() || !ahead.value.is_finite() {
                return MotionError::NoForce { element: name, displacement, time };
            }
        }
        MotionError::StepTooShort { time: run.time, step }
    }
}
