//! Sensitivities at the touch of a contact whose force jumps.
//!
//! A damper begins with the force `-c r'`. Where the touch comes earlier by `dr/r'`, that force acts for so long besides, and its impulse is
//! `-c r' dr/r' = -c dr`. So the sensitivities jump by
//!
//! `V+ = V - c B (C V + d r_particular - level_p)`,
//!
//! the saltation matrix `1 - c B C`, of determinant 1 since `C B` vanishes. It is finite for any speed of the touch, so grazing touches are no exception.

use super::{ExactIntegrator, collocation::NODES, flight::Touch, run::Run};
use crate::Parameter;

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

    /// Sensitivities of the penetration, with its sign that of the displacement, at fixed time, one per column.
    fn displacement_sensitivity(&self, run: &Run, touch: Touch) -> Vec<f64> {
        let (element, output) = (touch.element, &self.outputs[touch.element]);
        let Some(sensitivity) = &run.sensitivity else { return Vec::new() };
        let mut row = sensitivity.combined(&output.row);
        let (span, now) = ((run.time, 0.0), &[0.0; NODES]);
        row[sensitivity.frequency_column()] += self.drive.values_by_frequency(element, output, span, now)[0];
        if let Some((parameter, column)) = self.column_parameter().zip(sensitivity.parameter_column()) {
            row[column] += match parameter {
                Parameter::ExcitationScale => self.drive.values_by_scale(element, output, span, now)[0],
                Parameter::Gap { element: other } if other == element => {
                    -self.laws[element].contacts()[touch.contact].sign
                }
                _ => 0.0,
            };
        }
        row
    }
}
