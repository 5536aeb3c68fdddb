//! What a contact does to the sensitivities, and keeps in memory, as it closes.
//! Equations (G1), (G2) and (G11) of the book, `docs/theory`.
//!
//! **Force that jumps.** A damper begins with the force `-c r'`. Where the touch comes earlier by `dr/r'`,
//! that force acts for so long besides, and its impulse is `-c r' dr/r' = -c dr`. So the sensitivities jump
//! by
//!
//! `V+ = V - c B (C V + d r_particular - level_p)`,
//!
//! the saltation matrix `1 - c B C`, of determinant 1 since `C B` vanishes. It is finite for any speed of the
//! touch, so grazing touches are no exception.
//!
//! **Speed that is remembered.** The touch comes `-dr/r'` later, so its speed changes by `dv = dr' - r''
//! dr/r'`, where `dr'` is taken at fixed time and `r''` has the forces of the other elements (its own begins
//! with zero). While the contact lasts, its force has the direct part `f_v dv` (`damped_step.rs`). Towards
//! grazing `dv` grows like `1/r'`, but the force goes like `r'^3`, so their product vanishes.

use super::{ExactIntegrator, MotionError, collocation::NODES, flight::Touch, run::Run};
use crate::Parameter;

/// Speed that stands for none [m/s].
const LEAST_SPEED: f64 = 1.5e-154;

impl ExactIntegrator {
    /// Lets the sensitivities jump as a contact closes; nothing where its force is continuous.
    pub(super) fn jump_at_onset(&self, run: &mut Run, touch: Touch) {
        let damping = self.laws[touch.element].onset_damping();
        if damping == 0.0 || run.sensitivity.is_none() {
            return;
        }
        let displacement = self.displacement_sensitivity(run, touch);
        if let Some(sensitivity) = &mut run.sensitivity {
            sensitivity.add_outer(&self.inputs[touch.element], -damping, &displacement);
        }
    }

    /// A law that remembers its impact cannot begin a contact that has no speed at all and is pressed on. One
    /// that turns by itself has next to no force.
    pub(super) fn check_impact(&self, run: &Run, touch: Touch) -> Result<(), MotionError> {
        let element = touch.element;
        let jet = self.jet_with_forces(run, element);
        let sign = self.laws[element].contacts()[touch.contact].sign;
        let pressed = jet.slope.abs() < LEAST_SPEED && sign * jet.curvature > 0.0;
        if pressed && self.laws[element].remembers_impact() {
            let element = self.system.elements()[element].name.clone();
            return Err(MotionError::PressedWithoutImpact { element, time: run.time });
        }
        Ok(())
    }

    /// Puts the speed of an impact, and its sensitivities, in memory for the contact that begins; nothing for
    /// a law without memory.
    pub(super) fn remember_impact(&mut self, run: &mut Run, touch: Touch) {
        let element = touch.element;
        if !self.laws[element].remembers_impact() {
            return;
        }
        let jet = self.jet_with_forces(run, element);
        // A touch within the rounding margin may have no speed at all.
        let speed = jet.slope.abs().max(LEAST_SPEED);
        self.laws[element] = self.laws[element].struck_at(speed);
        let displacement = self.displacement_sensitivity(run, touch);
        let mut row = self.velocity_sensitivity(run, element);
        let (sign, shift) = (jet.slope.signum(), jet.curvature / speed);
        row.iter_mut().zip(&displacement).for_each(|(v, r)| *v = sign * *v - shift * r);
        if let Some(sensitivity) = &mut run.sensitivity {
            sensitivity.remember_impact(element, row);
        }
    }

    /// Sensitivities of the relative velocity at fixed time, one per column.
    pub(super) fn velocity_sensitivity(&self, run: &Run, element: usize) -> Vec<f64> {
        let output = &self.outputs[element];
        let Some(sensitivity) = &run.sensitivity else { return Vec::new() };
        let mut row = sensitivity.combined(&output.velocity_row);
        let (span, now) = ((run.time, 0.0), &[0.0; NODES]);
        row[sensitivity.frequency_column()] += self.drive.rates_by_frequency(element, output, span, now)[0];
        if let Some((parameter, column)) = self.parameter.zip(sensitivity.parameter_column()) {
            row[column] += match parameter {
                Parameter::ExcitationScale => self.drive.rates_by_scale(element, output, span, now)[0],
                other => self.read_particular(other, run.time, &output.velocity_row),
            };
        }
        row
    }

    /// Sensitivities of the penetration, with its sign that of the displacement, at fixed time, one per
    /// column.
    pub(super) fn displacement_sensitivity(&self, run: &Run, touch: Touch) -> Vec<f64> {
        let (element, output) = (touch.element, &self.outputs[touch.element]);
        let Some(sensitivity) = &run.sensitivity else { return Vec::new() };
        let mut row = sensitivity.combined(&output.row);
        let (span, now) = ((run.time, 0.0), &[0.0; NODES]);
        row[sensitivity.frequency_column()] += self.drive.values_by_frequency(element, output, span, now)[0];
        if let Some((parameter, column)) = self.parameter.zip(sensitivity.parameter_column()) {
            row[column] += match parameter {
                Parameter::ExcitationScale => self.drive.values_by_scale(element, output, span, now)[0],
                other if other.is_gap_of(element) => -self.laws[element].contacts()[touch.contact].sign,
                other => self.read_particular(other, run.time, &output.row),
            };
        }
        row
    }

    /// What a row reads of the derivative of the particular solution by a parameter.
    fn read_particular(&self, parameter: Parameter, time: f64, row: &[f64]) -> f64 {
        let mut column = vec![0.0; row.len()];
        self.add_particular(parameter, time, 1.0, &mut column);
        row.iter().zip(&column).map(|(r, x)| r * x).sum()
    }
}
