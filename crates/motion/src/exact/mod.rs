//! The exact integrator: closed-form flight, certified contacts, collocated contact forces, exact sensitivities.
//!
//! The mathematics stands in the crate docs; here is who does what:
//!
//! | file | idea |
//! |---|---|
//! | `block.rs`, `decouple.rs`, `plane.rs` | the structure as independent second-order blocks |
//! | `drive.rs`, `secular.rs` | the particular solution of the load |
//! | `output.rs` | rows that read displacements, and bounds on them |
//! | `clearance.rs`, `flight.rs` | certified search for the next contact |
//! | `collocation.rs`, `weights.rs`, `quadrature.rs`, `force_step.rs`, `attempt.rs`, `step_error.rs` | one step with forces |
//! | `lu.rs`, `lanes.rs` | small dense equations, loops on vectors |
//! | `contact_phase.rs`, `event.rs` | steps from touch to release, with error control |
//! | `touching.rs`, `force_bound.rs` | certified search for further contacts while forces act |
//! | `forecast.rs`, `polynomial.rs` | how long a contact will last; where a polynomial falls below zero |
//! | `sensitivity.rs` | the fundamental matrix and the frequency column |
//! | `maxima.rs`, `sampling.rs` | maxima on the continuous motion, reading inside a step |

mod attempt;
mod block;
mod clearance;
mod collocation;
mod contact_phase;
mod decouple;
mod drive;
mod event;
mod flight;
mod flight_maximum;
mod force_bound;
mod force_step;
mod forecast;
mod lanes;
mod lu;
mod maxima;
mod output;
mod plane;
mod polynomial;
mod quadrature;
mod run;
mod sampling;
mod secular;
mod sensitivity;
mod step_error;
mod touching;
mod weights;

#[cfg(test)]
mod tests;

use std::collections::HashMap;

use faer::Mat;

pub use decouple::MergedModes;
pub use maxima::Maxima;

use block::{Blocks, Propagator};
use collocation::Grading;
use drive::{Drive, Jet};
use force_step::ForceStep;
use output::Output;
use run::Run;
use weights::{Series, StepWeights};

use crate::{Flow, Law, Stretch, System};

/// Why a motion was not computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum MotionError {
    /// The damping has no block form; the general integrator still serves.
    #[error(transparent)]
    MergedModes(#[from] MergedModes),
    /// No force step, however short, reached the tolerance.
    #[error("contact step of {step:.2e} s is too short at {time:.6e} s after the start of the stretch")]
    StepTooShort { time: f64, step: f64 },
    /// The search for the next contact does not get on.
    #[error("flight does not advance at {time:.6e} s after the start of the stretch")]
    FlightStalled { time: f64 },
    /// The state is infinite or not a number.
    #[error("state is not finite at {time:.6e} s after the start of the stretch")]
    NotFinite { time: f64 },
}

/// Settings of the exact integrator.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExactSettings {
    /// Bound on the error of each force step, relative to the scales of the stretch; see `step_error.rs` for the formula.
    pub tolerance: f64,
}

impl Default for ExactSettings {
    fn default() -> Self {
        Self { tolerance: 1e-11 }
    }
}

/// Work done since the integrator was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ExactCounts {
    /// Stretches advanced.
    pub stretches: u64,
    /// Looks at the clearances in free flight.
    pub looks: u64,
    /// Force steps accepted.
    pub steps: u64,
    /// Force steps solved, accepted or not.
    pub solves: u64,
}

/// Integrates a [`System`] exactly in flight and to a set tolerance in contact.
#[derive(Debug)]
pub struct ExactIntegrator {
    system: System,
    settings: ExactSettings,
    blocks: Blocks,
    laws: Vec<Law>,
    /// Relative displacements of the elements, then further outputs.
    outputs: Vec<Output>,
    inputs: Vec<Vec<f64>>,
    series: Series,
    /// `C A B`: relative acceleration of output e per force of element f, `[e][f]`.
    mobility: Vec<Vec<f64>>,
    /// Rate of each block, `sqrt(k) + c` [1/s].
    rates: Vec<f64>,
    /// Part of each block in the mobility of each element, `[e][i]`.
    shares: Vec<Vec<f64>>,
    has_contacts: bool,
    counts: ExactCounts,
    drive: Drive,
    run: Run,
    step: ForceStep,
    cache: HashMap<(Vec<usize>, Grading, i32), StepWeights>,
    flight_start: Vec<f64>,
    propagators: Vec<Propagator>,
    touches: Vec<u32>,
    observation: Option<maxima::Observation>,
    closed_throughout: u64,
}

impl ExactIntegrator {
    /// An integrator for `system`.
    ///
    /// # Errors
    /// [`MotionError::MergedModes`] if the damping has no block form.
    pub fn new(system: System, settings: ExactSettings) -> Result<Self, MotionError> {
        Self::watching(system, settings, None)
    }

    /// An integrator that can also observe a response point, whose displacement is `shape . q + support_ratio u`.
    ///
    /// # Errors
    /// [`MotionError::MergedModes`] if the damping has no block form.
    pub fn watching(
        system: System,
        settings: ExactSettings,
        response: Option<(&[f64], f64)>,
    ) -> Result<Self, MotionError> {
        let blocks = Blocks::new(system.model())?;
        let elements = system.elements().iter().map(|e| (e.shape.as_slice(), e.support_ratio));
        let outputs: Vec<Output> =
            elements.chain(response).map(|(shape, ratio)| Output::new(&blocks, shape, ratio)).collect();
        let inputs: Vec<Vec<f64>> = system.elements().iter().map(|e| blocks.input(&e.shape)).collect();
        let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(a, b)| a * b).sum::<f64>();
        let mobility =
            outputs.iter().map(|o| inputs.iter().map(|b| dot(&o.velocity_row, b)).collect()).collect();
        let n = blocks.count();
        let share =
            |o: &Output, b: &[f64], i: usize| o.velocity_row[i] * b[i] + o.velocity_row[n + i] * b[n + i];
        let shares = outputs.iter().zip(&inputs).map(|(o, b)| {
            let parts: Vec<f64> = (0..n).map(|i| share(o, b, i).abs()).collect();
            let total: f64 = parts.iter().sum::<f64>().max(f64::MIN_POSITIVE);
            parts.into_iter().map(|part| part / total).collect()
        });
        let shares = shares.collect();
        let rates = blocks.rates();
        let laws: Vec<Law> = system.elements().iter().map(|e| e.law).collect();
        let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: 0.0 };
        Ok(Self {
            drive: Drive::new(&system, &blocks, &outputs, &stretch),
            series: Series::new(&blocks, &outputs, &inputs),
            has_contacts: laws.iter().any(|law| !law.contacts().is_empty()),
            touches: vec![0; laws.iter().map(|law| law.contacts().len()).sum()],
            system,
            settings,
            rates,
            shares,
            blocks,
            laws,
            outputs,
            inputs,
            mobility,
            counts: ExactCounts::default(),
            run: Run::default(),
            step: ForceStep::default(),
            cache: HashMap::new(),
            flight_start: Vec::new(),
            propagators: Vec::new(),
            observation: None,
            closed_throughout: 0,
        })
    }

    /// The system.
    #[must_use]
    pub fn system(&self) -> &System {
        &self.system
    }

    /// Work done so far.
    #[must_use]
    pub fn counts(&self) -> ExactCounts {
        self.counts
    }

    /// How often each contact closed in the last stretch, in the order of elements and their contacts.
    #[must_use]
    pub fn touches(&self) -> &[u32] {
        &self.touches
    }

    /// Elements that were closed all through the last stretch, one bit each (the first 64).
    #[must_use]
    pub fn closed_throughout(&self) -> u64 {
        self.closed_throughout
    }

    /// State at the end of a stretch, from `state` (`[q; q']`, length 2n) at its start.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn advance(&mut self, stretch: &Stretch, state: &[f64]) -> Result<Vec<f64>, MotionError> {
        let mut run = self.begin(stretch, state, false);
        let result = self.complete(&mut run, stretch);
        let end = self.modal_state(&run, stretch.duration());
        self.run = run;
        result.map(|()| end)
    }

    /// State of the steady motion without local forces at the start of a stretch (of the motion from rest, where resonant).
    pub fn steady_state(&mut self, stretch: &Stretch) -> Vec<f64> {
        let n = self.blocks.count();
        self.drive = Drive::new(&self.system, &self.blocks, &self.outputs, stretch);
        let mut block = vec![0.0; 2 * n];
        self.drive.add_state(0.0, 1.0, &mut block);
        let mut modal = vec![0.0; 2 * n];
        self.blocks.to_modal(&block, &mut modal);
        modal
    }

    /// Flow over a stretch: the state at its end and its sensitivities.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn flow(&mut self, stretch: &Stretch, state: &[f64]) -> Result<Flow, MotionError> {
        let mut run = self.begin(stretch, state, true);
        let result = self.complete(&mut run, stretch);
        let flow = result.map(|()| self.flow_of(&mut run, stretch));
        self.run = run;
        flow
    }

    fn begin(&mut self, stretch: &Stretch, state: &[f64], sensitivities: bool) -> Run {
        let n = self.blocks.count();
        self.drive = Drive::new(&self.system, &self.blocks, &self.outputs, stretch);
        let mut run = std::mem::take(&mut self.run);
        run.time = 0.0;
        run.proposal = 0.0;
        run.touched = None;
        run.slack = 0.0;
        run.release = None;
        run.state.resize(2 * n, 0.0);
        self.blocks.of_modal(state, &mut run.state);
        self.drive.add_state(0.0, -1.0, &mut run.state);
        let reused = run.sensitivity.take();
        run.sensitivity = sensitivities.then(|| {
            let mut by_frequency = vec![0.0; 2 * n];
            self.drive.for_state_by_frequency(0.0, n, |i, value| by_frequency[i] -= value);
            let mut sensitivity = reused.unwrap_or_default();
            sensitivity.start(&self.blocks, |i| by_frequency[i]);
            sensitivity
        });
        run.closed.clear();
        for element in 0..self.laws.len() {
            let closed = self.contact_at_start(&run, element, stretch.duration());
            run.closed.push(closed);
        }
        self.touches.fill(0);
        self.counts.stretches += 1;
        run
    }

    /// The contact of an element that is closed at the start of a stretch.
    fn contact_at_start(&self, run: &Run, element: usize, duration: f64) -> Option<usize> {
        let jet = self.output_jet(&run.state, element, 0.0);
        let margin = self.bounds(&run.state, element, duration).margin;
        self.laws[element].contacts().iter().position(|c| {
            let clearance = flight::clearance_of(jet, c.level, c.sign);
            clearance.value < -margin
        })
    }

    /// Runs to the end of the stretch.
    fn complete(&mut self, run: &mut Run, stretch: &Stretch) -> Result<(), MotionError> {
        let end = stretch.duration();
        self.closed_throughout = maxima::closed_bits(run);
        while run.time < end {
            if self.forces_act(run) {
                self.contact_phase(run, end)?;
            } else if let Some(touch) = self.fly(run, end)? {
                self.close(run, touch);
            }
            if !run.state.iter().all(|value| value.is_finite()) {
                return Err(MotionError::NotFinite { time: run.time });
            }
            self.closed_throughout &= maxima::closed_bits(run);
        }
        Ok(())
    }

    fn forces_act(&self, run: &Run) -> bool {
        self.laws.iter().zip(&run.closed).any(|(law, closed)| closed.is_some() || law.contacts().is_empty())
    }

    /// Notes that a contact closes.
    fn close(&mut self, run: &mut Run, touch: flight::Touch) {
        if let Some(mut observation) = self.observation.take() {
            observation.touch(self.output_jet(&run.state, touch.element, run.time).slope);
            self.observation = Some(observation);
        }
        run.closed[touch.element] = Some(touch.contact);
        run.touched = Some(touch.element);
        run.proposal = 0.0;
        run.release = None;
        run.slack = 0.0;
        let before: usize = self.laws[..touch.element].iter().map(|law| law.contacts().len()).sum();
        self.touches[before + touch.contact] += 1;
    }

    /// An output and its derivatives from the homogeneous block state at `time`, apart from the direct part of forces.
    fn output_jet(&self, state: &[f64], output: usize, time: f64) -> Jet {
        let o = &self.outputs[output];
        let mut jet = self.drive.jet(output, o, time);
        for (i, &x) in state.iter().enumerate() {
            jet.value += o.row[i] * x;
            jet.slope += o.velocity_row[i] * x;
            jet.curvature += o.acceleration_row[i] * x;
        }
        jet
    }

    fn modal_state(&self, run: &Run, time: f64) -> Vec<f64> {
        let mut block = run.state.clone();
        self.drive.add_state(time, 1.0, &mut block);
        let mut modal = vec![0.0; block.len()];
        self.blocks.to_modal(&block, &mut modal);
        modal
    }

    fn flow_of(&mut self, run: &mut Run, stretch: &Stretch) -> Flow {
        let n = self.blocks.count();
        let time = stretch.duration();
        let state = self.modal_state(run, time);
        let mut by_state = Mat::zeros(2 * n, 2 * n);
        let mut by_frequency = vec![0.0; 2 * n];
        let duration_by_frequency = -time / stretch.frequency_hz;
        let rate = self.modal_rate(run, &state, stretch);
        if let Some(sensitivity) = &mut run.sensitivity {
            self.drive.for_state_by_frequency(time, n, |i, value| sensitivity.add_frequency(i, value));
            sensitivity.write(&self.blocks, &mut by_state, &mut by_frequency);
        }
        by_frequency.iter_mut().zip(&rate).for_each(|(b, r)| *b += duration_by_frequency * r);
        Flow { state, by_state, by_frequency }
    }

    /// `z'` at the end of a stretch: the equations of motion in modal coordinates.
    fn modal_rate(&self, run: &Run, state: &[f64], stretch: &Stretch) -> Vec<f64> {
        let (n, model) = (self.blocks.count(), self.system.model());
        let (q, v) = state.split_at(n);
        let mut rate = v.to_vec();
        for i in 0..n {
            let damping: f64 = (0..n).map(|j| model.damping[(i, j)] * v[j]).sum();
            rate.push(-model.natural_frequencies[i].powi(2) * q[i] - damping);
        }
        let omega = std::f64::consts::TAU * stretch.frequency_hz;
        for (index, &order) in self.system.orders().iter().enumerate() {
            let load = self.system.modal_load(index, omega);
            let angle = std::f64::consts::TAU * f64::from(order) * (stretch.end - stretch.end.floor());
            let rotation = faer::c64::new(angle.cos(), angle.sin());
            (0..n).for_each(|i| rate[n + i] += (load.amplitude[i] * rotation).re);
        }
        for (e, element) in self.system.elements().iter().enumerate() {
            let displacement = self.output_jet(&run.state, e, stretch.duration()).value;
            let force = element.law.force(displacement).value;
            (0..n).for_each(|i| rate[n + i] += element.shape[i] * force);
        }
        rate
    }
}
