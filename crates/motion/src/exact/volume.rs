//! What contacts do to volumes of states, over and above the damping of the structure.
//!
//! Neighbours of a motion fill a volume that goes like `|det V|`, with the sensitivities V by the initial
//! state. While a contact lasts, `V' = A V + b u`, where `b` is the derivative of the rate of the state by
//! the speed that the law remembers and `u` that of the speed by the initial state, which stays as it was at
//! the touch (without such a law there is no `b`). Over a step
//!
//! `V_1 = P V_0 + p u`, `ln |det P| = int tr A dt`,
//!
//! where `p` is what a unit of speed makes of a state that begins with nothing. Of `tr A` the contact has
//! `int phi^T phi df/dr' dt`, and since `det (V_1 - p u) = det V_1 det (1 - w p)` with the derivative `w = u
//! V_1^-1` of the speed by the present state,
//!
//! `ln |det V_1| - ln |det V_0| = int tr A dt - ln |det (1 - w p)|`;
//!
//! with several contacts w has a row and p a column for each. So a contact with memory is a field with one
//! more divergence, `b w`: neighbours that are faster now were struck faster. In a sum that is held against
//! exponents this checks the trace and P, and takes `p` and `u` as they are; those are held against the
//! general integrator (`tests/onwards.rs` and the exponents of such laws).
//!
//! **Cancellation.** A contact that begins slowly and is pressed on loses energy as if it were drowned: one
//! direction of P shrinks by e^-40 in a contact, and `1 - w p` with it, while that of V does not. Of `1 - w
//! p` the error of p is left, over it. So steps in which it would shrink by more than [`MOST_SHRINKING`] are
//! made shorter, and the error of a step is amplified by e^8, three thousand, at most. After [`MOST_CUTS`]
//! such steps in a stretch (a contact of small restitution that is pressed on for long) they are taken as
//! they are, and what happens to volumes is not told: it is not a number.
//!
//! A touch and a release add nothing, since forces that jump there do so with a determinant of one
//! (`onset.rs`); for impacts see `impact.rs` and `stick.rs`.

use faer::{Mat, linalg::solvers::Solve};

use super::{ExactIntegrator, collocation::NODES, run::Run, sensitivity::Sensitivity};

/// Most that a direction may shrink by in a step whose `1 - w p` is asked for, as a logarithm.
const MOST_SHRINKING: f64 = 8.0;
/// So many steps of a stretch are made shorter for that.
const MOST_CUTS: u32 = 100;

impl ExactIntegrator {
    /// A length for the solved step with which what it does to volumes can be told, if it is too long for
    /// that.
    pub(super) fn shorter_for_volume(&mut self, run: &Run) -> Option<f64> {
        let sensitivity = run.sensitivity.as_ref().filter(|_| self.goes_on && self.step.damped)?;
        if !self.step.active.iter().any(|&e| sensitivity.impact_speed(e).is_some()) {
            return None;
        }
        let shrinking = -self.divergence_in_step();
        if shrinking <= MOST_SHRINKING || self.cuts_for_volume == MOST_CUTS || !self.contraction.is_finite() {
            return None;
        }
        self.cuts_for_volume += 1;
        Some(self.step.length * (0.8 * MOST_SHRINKING / shrinking).max(0.1))
    }

    /// Adds what the solved step does to volumes.
    ///
    /// * `sensitivity`: at the end of the step. The sensitivities of the step's forces are lost.
    pub(super) fn count_contraction(&mut self, sensitivity: &Sensitivity) {
        if !self.step.damped {
            return;
        }
        let divergence = self.divergence_in_step();
        self.contraction += divergence;
        let remembering: Vec<usize> =
            self.step.active.iter().copied().filter(|&e| sensitivity.impact_speed(e).is_some()).collect();
        if self.goes_on && self.contraction.is_finite() && !remembering.is_empty() {
            let told = -divergence <= MOST_SHRINKING;
            self.contraction +=
                if told { self.growth_by_memory(sensitivity, &remembering) } else { f64::NAN };
        }
    }

    /// Integral over the solved step of the divergence `phi^T phi df/dr'` of its forces.
    fn divergence_in_step(&self) -> f64 {
        let step = &self.step;
        let weights = &step.grading().rule().at_end[0];
        let of_active = |(a, &element): (usize, &usize)| {
            let at = |k: usize| {
                let (r, v) = (step.displacement[a * NODES + k], step.velocity[a * NODES + k]);
                weights[k] * self.laws[element].pressing_force(r, v).damping
            };
            self.mobility[element][element] * (0..NODES).map(at).sum::<f64>()
        };
        step.length * step.active.iter().enumerate().map(of_active).sum::<f64>()
    }

    /// `-ln |det (1 - w p)|` of the solved step, for these elements.
    fn growth_by_memory(&mut self, sensitivity: &Sensitivity, elements: &[usize]) -> f64 {
        let by_state = sensitivity.by_initial_state();
        let rows = by_state.nrows();
        let speeds = Mat::from_fn(rows, elements.len(), |i, e| {
            sensitivity.impact_speed(elements[e]).map_or(0.0, |row| row[i])
        });
        // By columns: the transposed of w.
        let by_present_state = by_state.transpose().partial_piv_lu().solve(speeds);
        let mut matrix = Mat::<f64>::identity(elements.len(), elements.len());
        for (f, &element) in elements.iter().enumerate() {
            let mut unit = sensitivity.by_impact_speed_alone(element);
            let solved = self.step.solve_sensitivity(&self.drive, (&self.laws, &self.outputs), &unit, None);
            solved.expect("the sensitivities of this step were solved for with the same matrix");
            self.step.advance_sensitivity(&mut unit, None);
            let response = unit.column(0);
            for e in 0..elements.len() {
                let product: f64 = (0..rows).map(|i| by_present_state[(i, e)] * response[i]).sum();
                matrix[(e, f)] -= product;
            }
        }
        -matrix.determinant().abs().ln()
    }
}
