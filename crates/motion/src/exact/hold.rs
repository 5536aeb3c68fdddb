//! Going over to a structure that is held on rigid stops (`held.rs`), and back.
//!
//! The state is written down in modal coordinates, the other structure takes the place of the present one,
//! and the state is read in its coordinates. What was not held before is projected: the homogeneous part of a
//! held displacement is zero. In modal coordinates the projection takes `Phi D^-1 (r', ...)` from the
//! velocities, the impulse of an impact without restitution, and from the displacements what rounding has
//! left. Sensitivities go the same way, with what the particular solutions contribute to the columns of
//! frequency and parameter. Their rank drops by two with each stop: what the motion was relative to the stop
//! before it stuck is forgotten.

use super::{
    ExactIntegrator, MotionError, by_damping::ByDamping, drive::Drive, flight::Boundary, held::Held, run::Run,
};
use crate::Stretch;

/// A held structure in use; its place is taken by the free one meanwhile.
#[derive(Debug)]
pub(super) struct Holding {
    pub held: Held,
    /// Derivative of the particular solution by the level of a held stop, where that is the parameter.
    pub by_level: Option<Drive>,
    /// What the damping as parameter does.
    pub by_damping: Option<ByDamping>,
}

impl ExactIntegrator {
    /// Computes with the free structure again; the coordinates of a run that was held have lost their
    /// meaning.
    pub(super) fn let_go(&mut self) {
        if let Some(mut holding) = self.holding.take() {
            self.exchange(&mut holding.held.structure);
            self.known_held.push(holding.held);
        }
    }

    /// Computes with the structure that is held on these elements.
    pub(super) fn take_hold(&mut self, elements: &[usize]) -> Result<(), MotionError> {
        self.let_go();
        if elements.is_empty() {
            return Ok(());
        }
        let mut held = match self.known_held.iter().position(|held| held.elements == elements) {
            Some(place) => self.known_held.swap_remove(place),
            None => self.make_held(elements)?,
        };
        held.begin(&self.system, &self.stretch);
        let by_level = match self.parameter {
            // Both sides of a stop do not hold at once.
            Some(parameter) => elements
                .iter()
                .position(|e| parameter.is_gap_of(*e))
                .map(|j| held.by_level(&self.system, &self.stretch, j)),
            None => None,
        };
        let of_held = |part| ByDamping::of_held((&self.system, part), &held.structure, held.elements.len());
        let by_damping = self.damping_part().map(of_held);
        self.exchange(&mut held.structure);
        self.holding = Some(Box::new(Holding { held, by_level, by_damping }));
        Ok(())
    }

    /// Computes with the structure that is held on these elements, over a stretch that was gone through
    /// before.
    pub(super) fn turn_to(&mut self, stretch: &Stretch, elements: &[usize]) -> Result<(), MotionError> {
        if elements.is_empty() {
            self.let_go();
            self.drive_over(stretch);
            return Ok(());
        }
        let is_in_use = |holding: &Holding| holding.held.elements == elements;
        if self.stretch == *stretch && self.holding.as_deref().is_some_and(is_in_use) {
            return Ok(());
        }
        self.stretch = *stretch;
        self.take_hold(elements)
    }

    fn make_held(&self, elements: &[usize]) -> Result<Held, MotionError> {
        let of_elements = self.system.elements().iter().map(|e| (e.shape.clone(), e.support_ratios.clone()));
        let outputs: Vec<(Vec<f64>, Vec<f64>)> = of_elements.chain(self.response.clone()).collect();
        Held::new(&self.system, elements, &outputs, &self.stretch)?
            .ok_or_else(|| MotionError::DependentStops { elements: self.names(elements) })
    }

    pub(super) fn names(&self, elements: &[usize]) -> String {
        let names = elements.iter().map(|&e| self.system.elements()[e].name.as_str());
        names.collect::<Vec<_>>().join(", ")
    }

    /// Lets exactly these elements be held from now on; those that were not are projected onto their stops.
    pub(super) fn hold(&mut self, run: &mut Run, elements: Vec<usize>) -> Result<(), MotionError> {
        let modal = self.modal_state(run, run.time);
        let columns = self.modal_columns(run);
        self.take_hold(&elements)?;
        self.blocks.of_modal(&modal, &mut run.state);
        self.drive.add_state(run.time, -1.0, &mut run.state);
        project(&mut run.state, elements.len());
        run.stuck = elements;
        self.directions_lost = self.directions_lost.max(2 * run.stuck.len());
        let Some(mut sensitivity) = run.sensitivity.take() else { return Ok(()) };
        let mut block = vec![0.0; modal.len()];
        for (j, column) in columns.iter().enumerate() {
            self.blocks.of_modal(column, &mut block);
            self.add_particular_column((j, sensitivity.frequency_column()), run.time, -1.0, &mut block);
            project(&mut block, run.stuck.len());
            sensitivity.set_column(j, &block);
        }
        run.sensitivity = Some(sensitivity);
        Ok(())
    }

    /// Columns of the sensitivities in modal coordinates, the particular solution included.
    fn modal_columns(&self, run: &Run) -> Vec<Vec<f64>> {
        let Some(sensitivity) = &run.sensitivity else { return Vec::new() };
        let of_column = |j: usize| {
            let mut block = sensitivity.column(j);
            self.add_particular_column((j, sensitivity.frequency_column()), run.time, 1.0, &mut block);
            self.blocks.to_modal(block)
        };
        (0..sensitivity.used_columns()).map(of_column).collect()
    }

    /// Adds what the particular solution has in a column, times `factor`.
    fn add_particular_column(
        &self,
        (column, frequency): (usize, usize),
        time: f64,
        factor: f64,
        block: &mut [f64],
    ) {
        if column == frequency {
            let n = self.blocks.count();
            self.drive.for_state_by_frequency(time, n, |i, value| block[i] += factor * value);
        }
        if let Some(parameter) = self.parameter.filter(|_| column > frequency) {
            self.add_particular(parameter, time, factor, block);
        }
    }

    /// Number of a held element among those that are held.
    pub(super) fn held_place(&self, run: &Run, element: usize) -> Option<usize> {
        run.stuck.iter().position(|&stuck| stuck == element)
    }

    /// Output that tells when a boundary is crossed: the pressing force of a held element, else the relative
    /// displacement.
    pub(super) fn watched_output(&self, run: &Run, element: usize, boundary: Boundary) -> usize {
        match (&self.holding, self.held_place(run, element)) {
            (Some(holding), Some(j)) if boundary == Boundary::Lifts => {
                self.outputs.len() - holding.held.elements.len() + j
            }
            _ => element,
        }
    }
}

/// Puts the homogeneous part of the last s blocks to zero.
fn project(state: &mut [f64], s: usize) {
    let n = state.len() / 2;
    state[n - s..n].fill(0.0);
    state[2 * n - s..].fill(0.0);
}
