//! The column of the sensitivities that belongs to a parameter of the system.
//!
//! With `r = r_free + W F`, `F = f(r, p)`: `dF = f' dr + f_p` and `(I - W f') dr = X V + d r_particular + W f_p`.
//!
//! - Excitation scale `a`: `f_p = 0`, and the particular solution of all orders above 0 is proportional to `a`.
//! - Gap: `f(r - level)`, so `dF = f' (dr - level_g)`, where `e = dr - level_g` solves `(I - W f') e = X V - level_g`.
//! - Stiffness: `f_p = F/k`.
//! - Added damping ratio: it changes every propagator, weight and particular solution, so its derivative is a difference of fourth order of motions beside,
//!   `(8 (z_1 - z_-1) - (z_2 - z_-2))/(12 h)`, run at a fine tolerance. With `h` of [`DAMPING_STEP`] of the mean ratio its relative error is about 1e-8.

use super::{
    ExactIntegrator, ExactSettings, MotionError, collocation::NODES, drive::Drive, force_step::ForceStep,
    output::Output,
};
use crate::{Law, Parameter, Stretch, System};

/// Step of the difference by the damping ratio, relative to the mean ratio of the modes.
const DAMPING_STEP: f64 = 2e-3;
/// Least step of it.
const LEAST_DAMPING_STEP: f64 = 1e-6;
/// Tolerance of the motions of the difference.
const FINE: f64 = 1e-13;

/// Integrators of systems with a little more and a little less damping.
#[derive(Debug)]
pub(crate) struct Neighbours {
    step: f64,
    /// At -2, -1, 1 and 2 steps.
    integrators: Vec<ExactIntegrator>,
}

impl ForceStep {
    /// Adds what the parameter has in the equations for the displacements.
    pub(super) fn add_parameter(
        &mut self,
        parameter: Parameter,
        drive: &Drive,
        (laws, outputs): (&[Law], &[Output]),
        (column, columns): (usize, usize),
    ) {
        let (span, c) = ((self.start, self.weights.length), &self.grading().rule().c);
        let count = self.active.len();
        for (a, &e) in self.active.iter().enumerate() {
            let values: [f64; NODES] = match parameter {
                Parameter::ExcitationScale => drive.values_by_scale(e, &outputs[e], span, c),
                Parameter::Gap { element } if element == e => {
                    std::array::from_fn(|k| -laws[e].level_by_gap(self.displacement[a * NODES + k]))
                }
                Parameter::Stiffness { element } => {
                    let Some(b) = self.active.iter().position(|&other| other == element) else { return };
                    let (w, force) = (&self.weights.convolution[a * count + b], &self.force[b * NODES..]);
                    let stiffness = laws[element].stiffness();
                    std::array::from_fn(|k| (0..NODES).map(|j| w[j][k] * force[j] / stiffness).sum())
                }
                Parameter::Gap { .. } | Parameter::AddedDampingRatio => continue,
            };
            let rows = self.work[a * NODES * columns..].chunks_exact_mut(columns);
            rows.zip(values).for_each(|(row, value)| row[column] += value);
        }
    }

    /// Adds `f_p` to the sensitivities of the forces.
    pub(super) fn add_direct_part(
        &mut self,
        parameter: Parameter,
        laws: &[Law],
        (column, columns): (usize, usize),
    ) {
        let Parameter::Stiffness { element } = parameter else { return };
        let Some(a) = self.active.iter().position(|&e| e == element) else { return };
        let stiffness = laws[element].stiffness();
        let rows = self.work[a * NODES * columns..].chunks_exact_mut(columns);
        rows.zip(&self.force[a * NODES..(a + 1) * NODES])
            .for_each(|(row, force)| row[column] += force / stiffness);
    }
}

impl ExactIntegrator {
    /// Chooses the parameter by which flows are differentiated besides the frequency; `None` for none.
    ///
    /// # Errors
    /// [`MotionError::Parameter`] if the system has no such parameter.
    pub fn differentiate_by(&mut self, parameter: Option<Parameter>) -> Result<(), MotionError> {
        if let Some(parameter) = parameter {
            self.system.parameter(parameter)?;
        }
        self.parameter = parameter;
        self.make_neighbours()
    }

    /// Gives a parameter of the system another value.
    ///
    /// # Errors
    /// [`MotionError::Parameter`], [`MotionError::MergedModes`]; nothing has changed then.
    pub fn set_parameter(&mut self, parameter: Parameter, value: f64) -> Result<(), MotionError> {
        if self.system.parameter(parameter)? == value {
            return Ok(());
        }
        if parameter == Parameter::AddedDampingRatio {
            return self.rebuild(self.system.clone().with_parameter(parameter, value)?);
        }
        self.system.set_parameter(parameter, value)?;
        self.laws.clear();
        self.laws.extend(self.system.elements().iter().map(|element| element.law));
        self.memory = None;
        for neighbour in self.neighbours.iter_mut().flat_map(|n| &mut n.integrators) {
            neighbour.set_parameter(parameter, value)?;
        }
        Ok(())
    }

    /// The parameter whose derivative goes with the sensitivities.
    pub(super) fn column_parameter(&self) -> Option<Parameter> {
        self.parameter.filter(|parameter| *parameter != Parameter::AddedDampingRatio)
    }

    /// Starts anew with a system whose structure has changed.
    fn rebuild(&mut self, system: System) -> Result<(), MotionError> {
        let response = self.response.as_ref().map(|(shape, ratio)| (shape.as_slice(), *ratio));
        let rebuilt = Self::watching(system, self.settings, response)?;
        let before = std::mem::replace(self, rebuilt);
        self.counts = before.counts;
        self.parameter = before.parameter;
        self.make_neighbours()
    }

    fn make_neighbours(&mut self) -> Result<(), MotionError> {
        self.neighbours = None;
        if self.parameter != Some(Parameter::AddedDampingRatio) {
            return Ok(());
        }
        let model = self.system.model();
        let elastic = (0..model.dof()).filter(|&i| model.natural_frequencies[i] > 0.0);
        let ratios: Vec<f64> =
            elastic.map(|i| 0.5 * model.damping[(i, i)] / model.natural_frequencies[i]).collect();
        let mean = ratios.iter().sum::<f64>() / ratios.len().max(1) as f64;
        let step = (DAMPING_STEP * mean).max(LEAST_DAMPING_STEP);
        let now = self.system.added_damping_ratio();
        let settings = ExactSettings { tolerance: self.settings.tolerance.min(FINE) };
        let mut integrators = Vec::new();
        for k in [-2.0, -1.0, 1.0, 2.0] {
            let system = self.system.clone().with_parameter(Parameter::AddedDampingRatio, now + k * step)?;
            integrators.push(Self::new(system, settings)?);
        }
        self.neighbours = Some(Box::new(Neighbours { step, integrators }));
        Ok(())
    }

    /// Derivative of the final state by the added damping ratio.
    pub(super) fn by_damping(&mut self, stretch: &Stretch, state: &[f64]) -> Result<Vec<f64>, MotionError> {
        let Some(neighbours) = &mut self.neighbours else { return Ok(Vec::new()) };
        let mut column = vec![0.0; state.len()];
        let weights = [1.0, -8.0, 8.0, -1.0];
        for (integrator, weight) in neighbours.integrators.iter_mut().zip(weights) {
            let end = integrator.advance(stretch, state)?;
            let factor = weight / (12.0 * neighbours.step);
            column.iter_mut().zip(&end).for_each(|(sum, value)| *sum += factor * value);
        }
        Ok(column)
    }
}
