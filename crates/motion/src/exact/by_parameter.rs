//! The column of the sensitivities that belongs to a parameter of the system.
//!
//! With `r = r_free + W F`, `F = f(r, p)`: `dF = f' dr + f_p` and `(I - W f') dr = X V + d r_particular + W
//! f_p`.
//!
//! - Excitation scale `a`: `f_p = 0`, and the particular solution of all orders above 0 is proportional to
//!   `a`.
//! - Gap: `f(r - level)`, so `f_p = -f' level_g`. The gap of a rigid stop that holds the structure moves the
//!   particular solution (`held.rs`).
//! - Clearance of a hole: the same with the normal, `f_p = -f' n = -(df/drho) n`.
//! - Another constant of a law: `f_p` by the law, as `F/k` for a stiffness (of forces that depend on the
//!   velocity in `damped_step.rs`).
//! - A number of a family: differences (`by_family.rs`).
//! - Added damping: it is in the propagators, the weights and the particular solution; see `by_damping.rs`.

use super::{
    ExactIntegrator, MotionError,
    by_damping::{ByDamping, SolvedStep},
    by_family::ByFamily,
    collocation::NODES,
    drive::Drive,
    force_step::ForceStep,
    hole,
    output::Output,
    run::Run,
    sensitivity::Sensitivity,
};
use crate::{Law, LawConstant, Parameter, System, law::ForcePoint};

impl ForceStep {
    /// Adds what the parameter has in the equations for the displacements.
    pub(super) fn add_parameter(
        &mut self,
        parameter: Parameter,
        drive: &Drive,
        (laws, outputs): (&[Law], &[Output]),
        (column, columns): (usize, usize),
    ) {
        let (span, c) = ((self.start, self.length), &self.grading().rule().c);
        let count = self.active.len();
        for (a, &e) in self.active.iter().enumerate() {
            let values: [f64; NODES] = match parameter {
                Parameter::ExcitationScale => drive.values_by_scale(e, &outputs[e], span, c),
                Parameter::AddedDamping { .. } | Parameter::OfLaw { constant: LawConstant::Gap, .. }
                    if !self.driven.nodes.is_empty() =>
                {
                    std::array::from_fn(|k| self.driven.nodes[a * NODES + k])
                }
                Parameter::OfLaw { constant, .. } => {
                    let mut values = [0.0; NODES];
                    for b in (0..count).filter(|&b| self.has_parameter(b, parameter, laws)) {
                        let (w, (part, of)) =
                            (&self.weights.convolution[a * count + b], self.direct(b, constant, laws));
                        for (k, value) in values.iter_mut().enumerate() {
                            *value += (0..NODES).map(|j| w[j][k] * part[j] / of).sum::<f64>();
                        }
                    }
                    values
                }
                _ => continue,
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
        let Parameter::OfLaw { constant, .. } = parameter else { return };
        for a in 0..self.active.len() {
            if !self.has_parameter(a, parameter, laws) {
                continue;
            }
            let (part, of) = self.direct(a, constant, laws);
            let rows = self.work[a * NODES * columns..].chunks_exact_mut(columns);
            rows.zip(part).for_each(|(row, part)| row[column] += part / of);
        }
    }

    /// Whether the law of the a-th active element has the parameter; that of a hole is its first one's.
    fn has_parameter(&self, a: usize, parameter: Parameter, laws: &[Law]) -> bool {
        parameter.constant_of(hole::owner(laws, self.active[a])).is_some()
    }

    /// Derivative of the force of the a-th active element at the nodes by the gap of its law.
    fn by_gap(&self, laws: &[Law], a: usize) -> [f64; NODES] {
        let element = self.active[a];
        let Some(hole) = laws[hole::owner(laws, element)].round_hole() else {
            let level = |k: usize| laws[element].level_by_gap(self.displacement[a * NODES + k]);
            return std::array::from_fn(|k| -self.slope[a * NODES + k] * level(k));
        };
        let first = if laws[element].is_across_hole() { a - 1 } else { a };
        std::array::from_fn(|k| {
            let [y, z] = [0, 1].map(|part| self.displacement[(first + part) * NODES + k]);
            let normal = hole.force_at([y, z]).normal;
            let place = a * NODES + k;
            -self.slope[place] * normal[a - first] - self.cross[place] * normal[1 - (a - first)]
        })
    }

    /// `f_p` of the a-th active element at the nodes, times the second number.
    fn direct(&self, a: usize, constant: LawConstant, laws: &[Law]) -> ([f64; NODES], f64) {
        let law = &laws[hole::owner(laws, self.active[a])];
        if constant == LawConstant::Gap {
            return (self.by_gap(laws, a), 1.0);
        }
        if let Some(value) = law.proportional_to(constant) {
            return (std::array::from_fn(|k| self.force[a * NODES + k]), value);
        }
        let by_constant = |k: usize| {
            let (displacement, force) = (self.displacement[a * NODES + k], self.force[a * NODES + k]);
            law.by_constant(constant, ForcePoint { displacement, velocity: 0.0, force })
        };
        (std::array::from_fn(by_constant), 1.0)
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
        self.by_family = match parameter {
            Some(Parameter::OfFamily { family }) => Some(Box::new(ByFamily::new(family))),
            _ => None,
        };
        self.parameter = parameter.filter(|_| self.by_family.is_none());
        self.prepare_damping();
        Ok(())
    }

    /// Gives a parameter of the system another value.
    ///
    /// # Errors
    /// [`MotionError::Parameter`], [`MotionError::MergedModes`]; nothing has changed then.
    pub fn set_parameter(&mut self, parameter: Parameter, value: f64) -> Result<(), MotionError> {
        if self.system.parameter(parameter)? == value {
            return Ok(());
        }
        match parameter {
            Parameter::AddedDamping { .. } => {
                let system = self.system.clone().with_parameter(parameter, value)?;
                return self.rebuild(system, self.response.clone());
            }
            Parameter::OfFamily { family } => {
                let member = self.system.member(family, value)?;
                let response = self.response.as_ref().map(|_| member.response);
                return self.rebuild(member.system, response);
            }
            _ => {}
        }
        self.system.set_parameter(parameter, value)?;
        self.drive.forget();
        self.course.clear();
        self.laws.clear();
        self.laws.extend(self.system.elements().iter().map(|element| element.law.clone()));
        self.memory = None;
        Ok(())
    }

    /// Starts anew with a system whose structure has changed.
    fn rebuild(&mut self, system: System, response: Option<(Vec<f64>, Vec<f64>)>) -> Result<(), MotionError> {
        let response = response.as_ref().map(|(shape, ratios)| (shape.as_slice(), ratios.as_slice()));
        let rebuilt = Self::watching(system, self.settings, response)?;
        let before = std::mem::replace(self, rebuilt);
        self.counts = before.counts;
        self.parameter = before.parameter;
        self.by_family = before.by_family.map(|by_family| Box::new(ByFamily::new(by_family.family)));
        self.prepare_damping();
        Ok(())
    }

    fn prepare_damping(&mut self) {
        let make =
            |part| Box::new(ByDamping::new((&self.system, part), &self.blocks, &self.series, &self.drive));
        self.by_damping = self.damping_part().map(make);
    }

    /// The part of the damping that is the parameter.
    pub(super) fn damping_part(&self) -> Option<usize> {
        match self.parameter {
            Some(Parameter::AddedDamping { part }) => Some(part),
            _ => None,
        }
    }

    /// Column of the parameter at the start of a stretch: without the particular solution, which does not
    /// start from the given state.
    pub(super) fn parameter_column_at_start(&mut self) -> Option<Vec<f64>> {
        let parameter = self.parameter?;
        if let Some(by_damping) = &mut self.by_damping {
            by_damping.start(&self.system, &self.drive, &self.blocks, &self.outputs);
        }
        let mut column = vec![0.0; 2 * self.blocks.count()];
        self.add_particular(parameter, 0.0, -1.0, &mut column);
        Some(column)
    }

    /// Adds the derivative of the particular state by the parameter, times `factor`.
    pub(super) fn add_particular(&self, parameter: Parameter, time: f64, factor: f64, column: &mut [f64]) {
        let held = self.holding.as_deref();
        let by_damping = self.damping_in_use().map(|by_damping| &by_damping.drive);
        match (parameter, by_damping, held.and_then(|holding| holding.by_level.as_ref())) {
            (Parameter::ExcitationScale, ..) => self.drive.add_state_by_scale(time, factor, column),
            (Parameter::AddedDamping { .. }, Some(drive), _)
            | (Parameter::OfLaw { constant: LawConstant::Gap, .. }, _, Some(drive)) => {
                drive.add_state(time, factor, column);
            }
            _ => {}
        }
    }

    /// What the damping as parameter does to the structure in use.
    fn damping_in_use(&self) -> Option<&ByDamping> {
        match &self.holding {
            Some(holding) => holding.by_damping.as_ref(),
            None => self.by_damping.as_deref(),
        }
    }

    /// Readies what a parameter that is not in the forces has in the solved step that starts from the state
    /// of `run`.
    pub(super) fn prepare_driven(&mut self, run: &Run) {
        if self.parameter.is_none() {
            return;
        }
        let mut driven = std::mem::take(&mut self.step.driven);
        driven.clear();
        let (grading, step) = (self.step.grading(), &self.step);
        let (length, active) = (step.length, step.active.as_slice());
        let (span, c) = ((step.start, length), &grading.rule().c);
        if let Some(by_damping) = self.damping_in_use() {
            let solved = SolvedStep { grading, length, active, force: &step.force, state: &run.state };
            by_damping.over_step(&solved, (&self.outputs, &self.inputs), step.damped, &mut driven);
            for (values, &e) in driven.nodes.as_chunks_mut::<NODES>().0.iter_mut().zip(active) {
                by_damping.drive.add_values(e, &self.outputs[e], span, c, values);
            }
            for (rates, &e) in driven.rates.as_chunks_mut::<NODES>().0.iter_mut().zip(active) {
                by_damping.drive.add_rates(e, &self.outputs[e], span, c, rates);
            }
        } else if let Some(drive) = self.holding.as_ref().and_then(|holding| holding.by_level.as_ref()) {
            for &e in active {
                let (mut values, mut rates) = ([0.0; NODES], [0.0; NODES]);
                drive.add_values(e, &self.outputs[e], span, c, &mut values);
                drive.add_rates(e, &self.outputs[e], span, c, &mut rates);
                driven.nodes.extend(values);
                driven.rates.extend(rates);
            }
        }
        self.step.driven = driven;
    }

    /// Adds what the damping does over a flight, from the state at its start, to its column.
    pub(super) fn add_damped_flight(&self, time: f64, state: &[f64], sensitivity: &mut Sensitivity) {
        let change = self.damping_in_use().map(|by_damping| by_damping.over_flight(time, state));
        if let (Some(change), Some(column)) = (change, sensitivity.parameter_column()) {
            change.iter().enumerate().for_each(|(i, &value)| sensitivity.add_to(column, i, value));
        }
    }
}
