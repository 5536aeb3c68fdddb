//! Solving one step with forces, and its error.

use std::sync::Arc;

use super::{
    ExactIntegrator,
    collocation::{Grading, NODES},
    drive::Jet,
    hole,
    run::{ElementStart, Run},
    weights::StepWeights,
};

/// Relative change of the length up to which the matrix of the last step serves again.
const NEARLY_THE_SAME: f64 = 0.02;
/// Fourth part of an octave: lengths that are proposed with some caution may be exceeded by half of it.
const GRID_SLACK: f64 = 0.5;

impl ExactIntegrator {
    /// Notes what is known of every element at the start of a step.
    pub(super) fn note_start(&self, run: &mut Run, end: f64) {
        run.remaining = end - run.time;
        run.start.clear();
        for element in 0..self.laws.len() {
            let owner = hole::owner(&self.laws, element);
            let output = self.output_jet(&run.state, element, run.time);
            let start = ElementStart {
                jet: self.reading_of(&run.state, element, (run.time, output)),
                output,
                margin: self.element_bounds(&run.state, element, (run.time, end)).margin,
                velocity: self.element_speed(&run.state, owner),
            };
            run.start.push(start);
        }
        run.pressing = self.pressing_now(run);
    }

    /// Solves a step of about `length` (shorter where the lengths are discrete); its error see
    /// `step_error.rs`.
    pub(super) fn attempt(&mut self, run: &Run, length: f64, grading: Grading) -> Option<f64> {
        self.solve_step(run, length, (grading, false), self.full_precision())?;
        Some(self.state_error(run))
    }

    /// What Newton's method may leave of the displacements, relative to their range: next to nothing against
    /// the error of a step.
    pub(super) fn full_precision(&self) -> f64 {
        (1e-4 * self.settings.tolerance).max(1e-15)
    }

    /// Solves a step of about `length` to some precision.
    ///
    /// * `again`: the last step solved had the same start and grading, and about the same length.
    pub(super) fn solve_step(
        &mut self,
        run: &Run,
        length: f64,
        (grading, again): (Grading, bool),
        precision: f64,
    ) -> Option<()> {
        self.counts.solves += 1;
        let (unknowns, states) = (NODES * self.step.coinciding.first().len(), 2 * self.blocks.count());
        self.counts.operations += (unknowns * unknowns * unknowns / 3 + unknowns * states) as u64;
        let before = self.step.length;
        self.step.known_ends.clear();
        self.set_weights(length, run.remaining, grading);
        let step = &mut self.step;
        step.grading = Some(grading);
        step.start = run.time;
        step.set_free_motion(&self.series, &self.drive, &self.outputs, &run.state);
        let change = step.length / before - 1.0;
        if again {
            step.shift_guess(change);
        } else {
            self.guess(run);
        }
        let margin = self.step.active.iter().map(|&e| run.start[e].margin).fold(0.0, f64::max);
        if self.step.damped {
            let speeds = self.step.active.iter().map(|&e| run.start[e].velocity);
            let rate_margin = 8.0 * f64::EPSILON * speeds.fold(0.0, f64::max);
            return self.step.solve_damped(&self.laws, (margin, rate_margin, precision)).ok();
        }
        self.step.solve(&self.laws, (margin, precision), again && change.abs() < NEARLY_THE_SAME).ok()
    }

    fn set_weights(&mut self, length: f64, remaining: f64, grading: Grading) {
        if length <= self.series.reach() {
            return self.prepare_weights(length, grading);
        }
        // Lengths on a grid, so that matrices made by quadrature serve again.
        let place = (4.0 * length.log2() + GRID_SLACK).floor().min((4.0 * remaining.log2()).floor());
        let length = (0.25 * place).exp2().min(remaining);
        if length <= self.series.reach() {
            return self.prepare_weights(length, grading);
        }
        let Self { blocks, step, kept_weights, own_weights, outputs, inputs, .. } = self;
        let make = || {
            let active = (step.active.as_slice(), step.damped);
            Arc::new(StepWeights::by_quadrature(blocks, outputs, inputs, active, grading, length))
        };
        let kept =
            kept_weights.entry((step.active.clone(), grading, place as i32)).or_insert_with(make).clone();
        let before = std::mem::replace(&mut step.weights, kept);
        if Arc::strong_count(&before) == 1 {
            *own_weights = before;
        }
        step.length = length;
    }

    /// Matrices of a step within the reach of the series, in the integrator's own place for them.
    fn prepare_weights(&mut self, length: f64, grading: Grading) {
        let Self { series, step, own_weights, .. } = self;
        if Arc::strong_count(&step.weights) > 1 {
            step.weights = std::mem::take(own_weights);
        }
        let active = (step.active.as_slice(), step.damped);
        series.prepare(active, grading, length, Arc::make_mut(&mut step.weights));
        step.length = length;
    }

    /// The force of an element after a time in which displacements go on with their present velocities.
    fn force_straight_on(&self, run: &Run, element: usize, time: f64) -> f64 {
        let straight = |e: usize| {
            let Jet { value, slope, .. } = run.start[e].output;
            value + slope * time
        };
        if self.laws[hole::owner(&self.laws, element)].round_hole().is_none() {
            return self.laws[element].force(straight(element), 0.0).value;
        }
        let ahead = |e: usize| Jet { value: straight(e), ..Jet::default() };
        hole::force_of(&self.laws, element, ahead).value
    }

    /// First guess of the displacements: the present motion continued.
    ///
    /// `r + r' t + r'' t^2/2 + G f' r' t^3/6` with the forces in `r''`; after a touch the force sets in with
    /// the power e instead, and `r + r' t + r'' t^2/2 + G f(r + r' t) t^2/((e + 1)(e + 2))`.
    fn guess(&mut self, run: &Run) {
        self.step.displacement.clear();
        self.step.velocity.clear();
        for a in 0..self.step.active.len() {
            let element = self.step.active[a];
            let mobility = self.mobility[element][element];
            let outputs = |e: usize| run.start[e].output;
            let mut jet = run.start[element].output;
            let stiffness = mobility * hole::force_of(&self.laws, element, outputs).slope * jet.slope;
            for &other in &self.step.active {
                jet.curvature +=
                    self.mobility[element][other] * hole::force_of(&self.laws, other, outputs).value;
            }
            let owner = hole::owner(&self.laws, element);
            let onset = self.closed_contact(run, owner).map(|contact| contact.onset_exponent);
            for k in 0..NODES {
                let t = self.step.node_time(k);
                let mut guess = jet.value + t * (jet.slope + 0.5 * t * jet.curvature);
                if let (Grading::Touch, Some(e)) = (self.step.grading(), onset) {
                    let force = self.force_straight_on(run, element, t);
                    guess += mobility * force * t * t / ((e + 1.0) * (e + 2.0));
                } else {
                    guess += stiffness * t * t * t / 6.0;
                }
                self.step.displacement.push(guess);
                if self.step.damped {
                    self.step.velocity.push(jet.slope + t * (jet.curvature + 0.5 * t * stiffness));
                }
            }
        }
    }
}
