//! What a motion went through, as far as its maxima need it: flights, touches and force steps, noted as they
//! are computed.
//!
//! An orbit is evaluated with its sensitivities first and observed then. The course saves going through the
//! motion a second time.

use super::{
    collocation::{Grading, NODES},
    force_step::ForceStep,
    maxima::closed_bits,
    run::Run,
};
use crate::{Law, Stretch};

/// A place in a list of numbers: first and behind the last.
type Span = (usize, usize);

/// Something that happened.
#[derive(Debug, Clone, Copy)]
pub(super) enum Passage {
    /// A flight, from a homogeneous block state; with the elements that are closed, those held on rigid
    /// stops, and the impulses that these got.
    Flight { start: f64, duration: f64, state: Span, closed: u64, held: Span, impulses: Span },
    /// A contact of this element closed with that relative velocity [m/s]; a brief hop (`impact.rs`) does
    /// not end it.
    Touch { element: usize, speed: f64 },
    /// It was an impact on the rigid stop of this element, with that impulse [N s], which took that energy
    /// [J], and after which the contact stuck or not.
    Impact { element: usize, impulse: f64, energy: f64, sticks: bool },
    /// A force step.
    Step(CourseStep),
}

/// A force step that was accepted.
#[derive(Debug, Clone, Copy)]
pub(super) struct CourseStep {
    pub grading: Grading,
    /// Start in the time of the stretch, and length [s].
    pub start: f64,
    pub length: f64,
    /// Homogeneous block state at the start.
    pub state: Span,
    /// Forces at the nodes.
    pub force: Span,
    /// Elements that act.
    pub active: Span,
    /// Energy that they took [J].
    pub energy_taken: f64,
    /// Elements held on rigid stops, and the impulses that they got.
    pub held: Span,
    pub impulses: Span,
    /// Closed elements, one bit each.
    pub closed: u64,
}

/// One stretch of a motion.
#[derive(Debug, Clone, Copy)]
pub(super) struct CourseStretch {
    pub stretch: Stretch,
    /// State at its start, as it was given.
    given: Span,
    /// Elements closed at its start, one bit each.
    pub closed: u64,
    pub first_passage: usize,
}

/// The course of a motion over stretches.
#[derive(Debug, Default)]
pub(super) struct Course {
    pub stretches: Vec<CourseStretch>,
    pub passages: Vec<Passage>,
    numbers: Vec<f64>,
    /// Elements and their laws, with what these remember.
    elements: Vec<(usize, Law)>,
    held: Vec<usize>,
}

impl Course {
    pub fn clear(&mut self) {
        self.stretches.clear();
        self.passages.clear();
        self.numbers.clear();
        self.elements.clear();
        self.held.clear();
    }

    /// Whether it is the whole course of this motion: the same stretches from the same states.
    pub fn is_of(&self, motion: &[(Stretch, &[f64])]) -> bool {
        let same = |(passed, (stretch, state)): (&CourseStretch, &(Stretch, &[f64]))| {
            passed.stretch == *stretch && self.numbers(passed.given) == *state
        };
        self.stretches.len() == motion.len() && self.stretches.iter().zip(motion).all(same)
    }

    pub fn numbers(&self, (first, end): Span) -> &[f64] {
        &self.numbers[first..end]
    }

    /// What happened in one stretch.
    pub fn of_stretch(&self, piece: usize) -> &[Passage] {
        let end = self.stretches.get(piece + 1).map_or(self.passages.len(), |next| next.first_passage);
        &self.passages[self.stretches[piece].first_passage..end]
    }

    /// The elements that act in a step, and their laws.
    pub fn active(&self, step: &CourseStep) -> &[(usize, Law)] {
        &self.elements[step.active.0..step.active.1]
    }

    fn keep(&mut self, numbers: &[f64]) -> Span {
        let first = self.numbers.len();
        self.numbers.extend_from_slice(numbers);
        (first, self.numbers.len())
    }

    pub fn begin(&mut self, stretch: &Stretch, state: &[f64], run: &Run) {
        let given = self.keep(state);
        let (closed, first_passage) = (closed_bits(run), self.passages.len());
        self.stretches.push(CourseStretch { stretch: *stretch, given, closed, first_passage });
    }

    /// A flight of some duration, with `run` at its start but for the state, which is given.
    pub fn flight(&mut self, run: &Run, duration: f64, state: &[f64], impulses: &[f64]) {
        let (state, impulses) = (self.keep(state), self.keep(impulses));
        let (closed, held) = (closed_bits(run), self.keep_held(&run.stuck));
        self.passages.push(Passage::Flight { start: run.time, duration, state, closed, held, impulses });
    }

    fn keep_held(&mut self, held: &[usize]) -> Span {
        let first = self.held.len();
        self.held.extend_from_slice(held);
        (first, self.held.len())
    }

    /// Elements that were held.
    pub fn held(&self, (first, end): Span) -> &[usize] {
        &self.held[first..end]
    }

    pub fn impact(&mut self, element: usize, (impulse, energy): (f64, f64), sticks: bool) {
        self.passages.push(Passage::Impact { element, impulse, energy, sticks });
    }

    pub fn touch(&mut self, element: usize, speed: f64) {
        self.passages.push(Passage::Touch { element, speed });
    }

    /// The solved step, with `run` at its start.
    pub fn step(&mut self, run: &Run, step: &ForceStep, laws: &[Law], impulses: &[f64]) {
        let first = self.elements.len();
        self.elements.extend(step.active.iter().map(|&element| (element, laws[element].clone())));
        let damped = |a: &usize| laws[step.active[*a]].has_pressure();
        let passed = CourseStep {
            grading: step.grading(),
            start: step.start,
            length: step.length,
            state: self.keep(&run.state),
            force: self.keep(&step.force),
            active: (first, self.elements.len()),
            energy_taken: (0..step.active.len()).filter(damped).map(|a| energy_taken(step, a)).sum(),
            closed: closed_bits(run),
            held: self.keep_held(&run.stuck),
            impulses: self.keep(impulses),
        };
        self.passages.push(Passage::Step(passed));
    }
}

/// Energy that the a-th active element takes in the solved step, `-sum_j w_j F_j r'_j`.
fn energy_taken(step: &ForceStep, a: usize) -> f64 {
    let weights = &step.grading().rule().at_end[0];
    let power = |j: usize| step.force[a * NODES + j] * step.velocity[a * NODES + j];
    -step.length * (0..NODES).map(|j| weights[j] * power(j)).sum::<f64>()
}
