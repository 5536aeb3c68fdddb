//! The end of a contact: the step that ends where the penetration does.

use super::{
    ExactIntegrator,
    collocation::{Grading, NODES},
    run::Run,
};

/// Nodes and weights of Gauss-Legendre with three nodes on [0, 1].
const GAUSS_3: [(f64, f64); 3] =
    [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

/// What became of an attempt to end a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ReleaseStep {
    /// The solved step ends at the release; its error relative to the tolerance.
    Solved(f64),
    /// First take a step of this length [s].
    Shorter(f64),
}

impl ExactIntegrator {
    /// The first closed contact that opens within the solved step, and about when.
    pub(super) fn first_release(&self, run: &Run) -> Option<(usize, f64)> {
        let step = &self.step;
        let mut first: Option<(usize, f64)> = None;
        for (a, &element) in step.active.iter().enumerate() {
            let Some(contact) = self.closed_contact(run, element) else { continue };
            // A contact may have been closed within the rounding margin before its time.
            let margin = self.bounds(run, element, run.time + step.weights.length).margin;
            let penetration: Vec<f64> = (0..NODES)
                .map(|k| contact.sign * (step.displacement[a * NODES + k] - contact.level) + margin)
                .collect();
            let end = contact.sign * (self.jet_at_step_end(a).value - contact.level) + margin;
            let Some(s) = self.release_variable(&penetration, end) else { continue };
            let time = step.grading().map(s).0 * step.weights.length;
            if first.is_none_or(|(_, earlier)| time < earlier) {
                first = Some((element, time));
            }
        }
        first
    }

    /// The first closed contact that is expected to open, and in what time, from the energy of the contact.
    ///
    /// From the penetration p and the speed w with which it falls, `v(x)^2 = w^2 + 2 G K/(e+1) (p^(e+1) - x^(e+1))` and the time is
    /// `int_0^p dx/v(x)`. Good to some ten percent: a start for Newton's method.
    pub(super) fn expected_release(&self, run: &Run) -> Option<(usize, f64)> {
        let of_element = |&element: &usize| {
            let contact = self.closed_contact(run, element)?;
            let jet = self.output_jet(run, element, run.time);
            let (penetration, speed) = (contact.sign * (jet.value - contact.level), -contact.sign * jet.slope);
            if penetration <= 0.0 || speed <= 0.0 {
                return None;
            }
            let stiffness = self.laws[element].force(jet.value).value.abs() * self.mobility[element][element];
            let gain = 2.0 * stiffness * penetration / (contact.onset_exponent + 1.0);
            let slowness = |x: f64| 1.0 / (speed * speed + gain * (1.0 - x.powf(contact.onset_exponent + 1.0))).sqrt();
            let time = GAUSS_3.iter().map(|&(x, weight)| weight * slowness(x)).sum::<f64>() * penetration;
            Some((element, time))
        };
        self.step.active.iter().filter_map(of_element).min_by(|x, y| x.1.total_cmp(&y.1))
    }

    /// Where in the variable of the grading the penetration falls to zero, from its values at the nodes and at the end.
    fn release_variable(&self, penetration: &[f64], end: f64) -> Option<f64> {
        let nodes = &self.step.grading().rule().s;
        let after = penetration.iter().position(|&p| p < 0.0).unwrap_or(NODES);
        if after == NODES && end >= 0.0 {
            return None;
        }
        let (mut high, mut at_high) = if after < NODES { (nodes[after], penetration[after]) } else { (1.0, end) };
        let (mut low, mut at_low) =
            if after > 0 { (nodes[after - 1], penetration[after - 1]) } else { (0.0, penetration[0].abs()) };
        // Secants on the interpolation polynomial, kept in the bracket (Illinois).
        for _ in 0..12 {
            let s = (low * at_high - high * at_low) / (at_high - at_low);
            let value = self.step.interpolate(penetration, 0, s);
            if (high - low) < 1e-9 || value == 0.0 {
                return Some(s);
            }
            if value < 0.0 {
                (high, at_high) = (s, value);
                at_low *= 0.5;
            } else {
                (low, at_low) = (s, value);
                at_high *= 0.5;
            }
        }
        Some(0.5 * (low + high))
    }

    /// Ends the contact of `element` at about `time` after the start of the step.
    ///
    /// Newton's method on the length of the step: the end is moved until the penetration vanishes there. What is missed by a relative error d
    /// of the length is `d^exponent` of the contact's effect on the sensitivities.
    pub(super) fn release(
        &mut self,
        run: &Run,
        element: usize,
        time: f64,
        grading: Grading,
        remaining: f64,
    ) -> ReleaseStep {
        let Some(contact) = self.closed_contact(run, element) else { return ReleaseStep::Shorter(0.5 * time) };
        let half_integer = contact.onset_exponent.fract() != 0.0;
        if (half_integer && grading == Grading::Touch) || time > self.series.reach() {
            return ReleaseStep::Shorter(0.5 * time);
        }
        let grading = if half_integer { Grading::Release } else { grading };
        let tolerance = self.settings.tolerance.powf(1.0 / contact.onset_exponent);
        let a = self.step.active.iter().position(|&e| e == element).unwrap_or_default();
        let mut length = time.min(remaining);
        for _ in 0..12 {
            let Some(error) = self.attempt(run, length, grading) else { break };
            let jet = self.jet_at_step_end(a);
            let (penetration, rate) = (contact.sign * (jet.value - contact.level), contact.sign * jet.slope);
            if rate >= 0.0 || error > 1.0 {
                break;
            }
            let change = -penetration / rate;
            if change.abs() <= tolerance * length {
                return ReleaseStep::Solved(error);
            }
            if length >= remaining && change > 0.0 {
                // The stretch ends before the contact does.
                break;
            }
            length = (length + change.clamp(-0.5 * length, 0.5 * length)).min(remaining);
            if length > self.series.reach() {
                break;
            }
        }
        ReleaseStep::Shorter(0.5 * time)
    }
}
