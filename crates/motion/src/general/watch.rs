//! What looks on while a motion is integrated.

use super::{dense::Dense, stepper::Stepper};

/// Looks on at the steps of a motion along a field of type `F`.
pub(super) trait Watcher<F> {
    /// The motion begins.
    fn begin(&mut self, field: &mut F, start: Place<'_>);

    /// Whether it looks inside a step that ends there.
    fn wants(&self, end: f64) -> bool;

    /// A step is being accepted.
    fn step(&mut self, field: &mut F, step: &Accepted<'_>);

    /// Boundaries were crossed; the place has the new region.
    fn crossed(&mut self, field: &mut F, at: Place<'_>);
}

/// A place on the way.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place<'a> {
    pub(super) time: f64,
    pub(super) state: &'a [f64],
    /// For each switching function whether it is taken as positive.
    pub(super) inside: &'a [bool],
}

/// A step that is being accepted, with its dense output.
pub(super) struct Accepted<'a> {
    pub(super) stepper: &'a Stepper,
    pub(super) dense: &'a Dense,
    pub(super) inside: &'a [bool],
    pub(super) time: f64,
    pub(super) length: f64,
    pub(super) end: f64,
}

/// States wanted at given times, in ascending order.
pub(super) struct Samples<'a> {
    pub(super) times: &'a [f64],
    pub(super) states: Vec<Vec<f64>>,
}

impl Samples<'_> {
    fn due(&self, end: f64) -> Option<f64> {
        self.times.get(self.states.len()).copied().filter(|&time| time <= end)
    }
}

impl<F> Watcher<F> for Samples<'_> {
    fn begin(&mut self, _: &mut F, start: Place<'_>) {
        while self.due(start.time).is_some() {
            self.states.push(start.state.to_vec());
        }
    }

    fn wants(&self, end: f64) -> bool {
        self.due(end).is_some()
    }

    fn step(&mut self, _: &mut F, step: &Accepted<'_>) {
        while let Some(time) = self.due(step.end) {
            let mut state = step.stepper.end_state().to_vec();
            if time < step.end {
                step.dense.state((time - step.time) / step.length, &mut state);
            }
            self.states.push(state);
        }
    }

    fn crossed(&mut self, _: &mut F, _: Place<'_>) {}
}
