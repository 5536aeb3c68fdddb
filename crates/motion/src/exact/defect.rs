//! What the polynomial of a force leaves of it between the nodes of a step, and what that makes of
//! velocities.
//!
//! A polynomial P meets the law at the nodes; elsewhere it differs by the *defect* `e = f(r, r') - P`.
//! Integrals of e to the end of a step nearly vanish, so the motion from step to step does not feel it.
//! Within the step they do not: `r'(t)` is wrong by `sum_b M_b int_0^t e_b ds`, with the mobility `M_b` of
//! the element against the force b, and r by the integral of that, which is smaller by the length of the
//! step. A force that hangs on the velocity shows it. The integral is taken by sixteen points of Gauss in the
//! variable of the grading, with defects from the velocities as they are: what the correction itself changes
//! of them is smaller by `M f_v h`, a damper's share of the velocity in a step of the length h. Where that is
//! not below one the correction does not help.

use super::{ExactIntegrator, drive::Jet, recurrence::gauss_sixteen};

impl ExactIntegrator {
    /// [`Self::jet_in_step`] of an element, its velocity without the share of the defects.
    pub(super) fn refined_jet(&self, state: &[f64], element: usize, time: f64) -> Jet {
        let mut jet = self.jet_in_step(state, element, time);
        for (b, &other) in self.step.active.iter().enumerate() {
            let mobility = self.mobility[element][other];
            if mobility != 0.0 {
                jet.slope += mobility * self.defect_impulse(state, (b, other), time);
            }
        }
        jet
    }

    /// `int_0^t e ds` of the b-th active element.
    fn defect_impulse(&self, state: &[f64], (b, element): (usize, usize), time: f64) -> f64 {
        let (step, grading) = (&self.step, self.step.grading());
        let end = grading.inverse((time / step.length).clamp(0.0, 1.0));
        let mut impulse = 0.0;
        for (x, weight) in gauss_sixteen() {
            let place = end * x;
            let (c, slope) = grading.map(place);
            let jet = self.jet_in_step(state, element, c * step.length);
            let force = self.laws[element].pressing_force(jet.value, jet.slope).value;
            let defect = force - step.interpolate(&step.force, b, place);
            impulse += weight * end * slope * step.length * defect;
        }
        impulse
    }
}
