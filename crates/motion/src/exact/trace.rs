//! A motion written down: its states at given phases, and each of its contacts. What each piece of motion
//! adds to it is in `tracing.rs`.
//!
//! In flight a state is that of the closed form; inside a step with forces it is carried there from the start
//! of the step, forces included (`sampling.rs`). Of a contact force `F(t)` that acts along the relative
//! displacement `r` are noted
//!
//! `impulse = int F dt`, `energy lost = - int F r' dt`
//!
//! by Gauss' rule on the nodes of the steps, where `F` and `r` obey the law and `r'` follows from the
//! convolution with the modes. The energy lost by a law that depends on the displacement alone is zero over a
//! whole contact; what comes out is the error of the steps. The largest force is that of its polynomial,
//! which is good to about 1e-5; maxima that are better are those of `maxima.rs`.

use std::f64::consts::TAU;

use super::{
    ExactIntegrator, MotionError,
    panels::{MotionPanel, MotionSpan, StateAndForces},
    run::Run,
};
use crate::Stretch;

/// Begin of a contact.
#[derive(Debug, Clone, PartialEq)]
pub struct Touchdown {
    /// Time since the start of the stretch [s].
    pub time: f64,
    /// `r'` of the element as the contact closes [m/s].
    pub velocity: f64,
    /// Modal state `[q; q']` then, length 2n.
    pub state: Vec<f64>,
}

/// What an impact on a rigid stop does at once.
#[derive(Debug, Clone, PartialEq)]
pub struct Jump {
    /// Magnitude of the impulse [N s].
    pub impulse: f64,
    /// Modal state `[q; q']` right after it, length 2n.
    pub state: Vec<f64>,
}

/// A contact, or the part of it that lies within a stretch.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactPiece {
    /// Number of the local element.
    pub element: usize,
    /// Number of the contact of its law.
    pub contact: usize,
    /// Where it closed; `None` if it was closed at the start of the stretch.
    pub begin: Option<Touchdown>,
    /// Of an impact on a rigid stop what it did then; `None` where a force acts over a time.
    pub jump: Option<Jump>,
    /// When it opened, since the start of the stretch [s]; `None` if it is closed at the end of the stretch.
    pub end: Option<f64>,
    /// When its penetration ended [s]: later than `end` where the force had vanished before; `None` if that
    /// is beyond the end of the stretch.
    pub clear: Option<f64>,
    /// Integral of the magnitude of the force [N s].
    pub impulse: f64,
    /// Largest magnitude of the force [N]; of an impact on a rigid stop 0, of one that sticks that of the
    /// pressing force after it.
    pub peak_force: f64,
    /// Energy that the structure gave to the contact and did not get back [J].
    pub energy_lost: f64,
}

impl ContactPiece {
    /// When it closed, since the start of the stretch [s]; 0 if it was closed there.
    #[must_use]
    pub fn since(&self) -> f64 {
        self.begin.as_ref().map_or(0.0, |begin| begin.time)
    }
}

/// What was written down of a motion.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Trace {
    /// State at the end of the stretch, bit by bit that of [`ExactIntegrator::advance`].
    pub state: Vec<f64>,
    /// Modal states at the phases asked for.
    pub samples: Vec<Vec<f64>>,
    /// Forces of the elements along their relative displacements at these phases [N].
    pub forces: Vec<Vec<f64>>,
    /// Contacts in the order in which they closed.
    pub contacts: Vec<ContactPiece>,
    /// States within contacts, besides those at the phases, as far as [`ExactIntegrator::trace_closely`] asks
    /// for them; ascending in time.
    pub inside: Vec<Inside>,
}

/// A stretch of motion in smooth panels, with its contacts.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PanelledMotion {
    /// The panels, one after the other.
    pub panels: Vec<MotionPanel>,
    /// Contacts in the order in which they closed, impacts on rigid stops among them.
    pub contacts: Vec<ContactPiece>,
}

/// A state within a contact.
#[derive(Debug, Clone, PartialEq)]
pub struct Inside {
    /// Time since the start of the stretch [s].
    pub time: f64,
    /// Modal state `[q; q']`, length 2n.
    pub state: Vec<f64>,
    /// Forces of the elements along their relative displacements [N].
    pub forces: Vec<f64>,
}

/// What is being written down.
#[derive(Debug, Clone, Default)]
pub(super) struct Tracing {
    /// Times since the start of the stretch at which the state is wanted, ascending [s].
    times: Vec<f64>,
    /// States that each step within a contact has at least.
    in_a_step: usize,
    /// Panels of the motion, where they are asked for, with the rate of what moves fastest [1/s].
    panels: Option<(Vec<MotionPanel>, f64)>,
    pub(super) trace: Trace,
    /// Index of the open piece of each element.
    pub(super) open: Vec<Option<usize>>,
}

impl Tracing {
    /// Times at which the state is wanted in a step: at given phases, and within a contact at equal steps
    /// besides, where those are too few.
    fn due(&self, start: f64, length: f64) -> (Vec<f64>, Vec<f64>) {
        let left = self.times[self.trace.samples.len()..].iter().copied();
        let given: Vec<f64> = left.take_while(|time| *time < start + length).collect();
        let more = if self.open.iter().any(Option::is_some) { self.in_a_step } else { 0 };
        let more = if given.len() < more { more } else { 0 };
        let inside = (0..more).map(|k| start + length * (k as f64 + 0.5) / more as f64);
        (given, inside.collect())
    }

    /// Notes states in a step.
    ///
    /// * `at`: states and forces at times.
    pub(super) fn note(&mut self, span: MotionSpan, at: impl Fn(&[f64]) -> Vec<StateAndForces>) {
        if let Some((panels, fastest)) = &mut self.panels {
            panels.extend(span.panels(*fastest, &at));
        }
        let (given, inside) = self.due(span.start, span.length);
        for (state, forces) in at(&given) {
            self.trace.samples.push(state);
            self.trace.forces.push(forces);
        }
        for (time, (state, forces)) in inside.iter().copied().zip(at(&inside)) {
            self.trace.inside.push(Inside { time, state, forces });
        }
    }

    /// Ends the pieces of elements without force. Those that have parted before their penetration has ended
    /// may go on.
    pub(super) fn end_open(&mut self, run: &Run) {
        for (element, open) in self.open.iter_mut().enumerate() {
            let Some(piece) = *open else { continue };
            let contact = &mut self.trace.contacts[piece];
            if run.closed[element].is_some() || run.stuck.contains(&element) {
                contact.end = None;
                continue;
            }
            contact.end.get_or_insert(run.time);
            if run.parted[element].is_none() {
                contact.clear = Some(run.time);
                *open = None;
            }
        }
    }

    pub(super) fn begin(&mut self, element: usize, contact: usize, begin: Option<Touchdown>) {
        self.open[element] = Some(self.trace.contacts.len());
        self.trace.contacts.push(ContactPiece {
            element,
            contact,
            begin,
            jump: None,
            end: None,
            clear: None,
            impulse: 0.0,
            peak_force: 0.0,
            energy_lost: 0.0,
        });
    }
}

impl ExactIntegrator {
    /// A motion over a stretch from `state`, with its states at `phases` [cycles, ascending, within the
    /// stretch] and its contacts.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn trace(&mut self, stretch: &Stretch, state: &[f64], phases: &[f64]) -> Result<Trace, MotionError> {
        self.trace_closely(stretch, state, phases, 0)
    }

    /// As [`Self::trace`], with states within contacts that are too short for the phases: the trace has
    /// [`Trace::inside`].
    ///
    /// * `in_a_step`: so many at equal distances in each step of the integrator in which something is in
    ///   contact and fewer of the phases lie. A contact takes some three steps.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn trace_closely(
        &mut self,
        stretch: &Stretch,
        state: &[f64],
        phases: &[f64],
        in_a_step: usize,
    ) -> Result<Trace, MotionError> {
        let times = phases.iter().map(|phase| (phase - stretch.start) / stretch.frequency_hz).collect();
        let tracing = Tracing { times, in_a_step, ..Tracing::default() };
        Ok(self.written_down(stretch, state, tracing)?.trace)
    }

    /// The motion over a stretch from `state` in smooth panels.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn panelled(&mut self, stretch: &Stretch, state: &[f64]) -> Result<PanelledMotion, MotionError> {
        let order = self.system.orders().iter().max().map_or(0.0, |order| f64::from(*order));
        let driven = TAU * order * stretch.frequency_hz;
        let fastest = self.blocks.rates().into_iter().fold(driven, f64::max);
        let tracing = Tracing { panels: Some((Vec::new(), fastest)), ..Tracing::default() };
        let Tracing { trace, panels, .. } = self.written_down(stretch, state, tracing)?;
        let (panels, _) = panels.unwrap_or_default();
        Ok(PanelledMotion { panels, contacts: trace.contacts })
    }

    /// Goes over a stretch and writes down what is asked for.
    fn written_down(
        &mut self,
        stretch: &Stretch,
        state: &[f64],
        mut tracing: Tracing,
    ) -> Result<Tracing, MotionError> {
        tracing.open = vec![None; self.laws.len()];
        let mut run = self.begin(stretch, state, false)?;
        for element in 0..self.laws.len() {
            if let Some(contact) = run.closed[element] {
                tracing.begin(element, contact, None);
            } else if run.stuck.contains(&element) {
                tracing.begin(element, 0, None);
            }
        }
        self.tracing = Some(tracing);
        let result = self.complete(&mut run, stretch);
        let mut tracing = self.tracing.take().unwrap_or_default();
        tracing.end_open(&run);
        let end = self.modal_state(&run, stretch.duration());
        // Samples at the very end, or within rounding of it.
        while tracing.trace.samples.len() < tracing.times.len() {
            tracing.trace.samples.push(end.clone());
            tracing.trace.forces.push(self.forces_of(&run, &run.state, stretch.duration()));
        }
        self.let_go();
        self.run = run;
        result?;
        self.remember_end(stretch, &end);
        tracing.trace.state = end;
        Ok(tracing)
    }
}
