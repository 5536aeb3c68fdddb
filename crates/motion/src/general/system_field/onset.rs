//! What begins with a contact: forces that jump, impacts that are remembered.

use std::{f64::consts::TAU, ops::Range};

use super::{SystemField, region::switches_of};
use crate::{
    general::{GeneralError, Point, VectorField},
    vectors::{add_scaled, dot},
};

impl SystemField<'_> {
    /// A stretch cannot start in a contact whose law needs to know how it began.
    pub(in crate::general) fn check_start(&self, phase: f64, state: &[f64]) -> Result<(), GeneralError> {
        let (q, v) = state.split_at(self.system.dof().min(state.len()));
        for element in self.system.elements().iter().filter(|element| element.law.remembers_impact()) {
            let contact = element.law.contacts()[0];
            let penetration = contact.sign * (self.relative_displacement(element, q, phase) - contact.level);
            let rate = contact.sign * self.relative_velocity(element, v, phase);
            if penetration > 0.0 || (penetration == 0.0 && rate > 0.0) {
                return Err(GeneralError::StartsInContact { element: element.name.clone() });
            }
        }
        Ok(())
    }

    /// What the frequency changes in the rates of the velocities at a fixed state and phase, apart from the
    /// length of time.
    pub(super) fn add_change_of_forces(&self, at: Point<'_>, sum: &mut [f64]) {
        self.add_load(|load| &load.by_frequency, TAU * self.period, sum);
        for (element, &(slope, damping)) in self.system.elements().iter().zip(&self.slopes) {
            if slope != 0.0 || damping != 0.0 {
                let [u, v, _] = self.carried_by_frequency(&element.support_ratios, at.time);
                add_scaled(sum, self.period * (slope * u + damping * v), &element.shape);
            }
        }
        for (first, cross) in self.cross.iter().enumerate().filter(|(_, cross)| **cross != 0.0) {
            let both = &self.system.elements()[first..first + 2];
            for (from, onto) in [(0, 1), (1, 0)] {
                let [u, ..] = self.carried_by_frequency(&both[from].support_ratios, at.time);
                add_scaled(sum, self.period * cross * u, &both[onto].shape);
            }
        }
    }

    /// Lets the sensitivities jump with the force of a contact that closes.
    pub(super) fn jump_at_onset(&self, e: usize, time: f64, columns: &mut [f64]) {
        let element = &self.system.elements()[e];
        let (n, damping) = (self.system.dof(), element.law.onset_damping());
        if damping == 0.0 {
            return;
        }
        let direction = self.free_direction(e);
        let last = columns.len() / (2 * n);
        for (index, column) in columns.chunks_exact_mut(2 * n).enumerate() {
            let mut displacement = dot(&element.shape, &column[..n]);
            if index + 1 == last {
                displacement += self.carried_by_frequency(&element.support_ratios, time)[0];
            }
            let impulse = -damping * displacement;
            add_scaled(&mut column[n..], impulse, &direction);
        }
    }

    /// Elements whose force depends on the velocity and whose contact closes, with their switching functions.
    pub(super) fn damped_that_close(&self, inside: &[bool], before: &[bool]) -> Vec<(usize, Range<usize>)> {
        let (mut first, mut closing) = (0, Vec::new());
        for (e, element) in self.system.elements().iter().enumerate() {
            let switches = first..first + switches_of(element);
            first = switches.end;
            if element.law.has_pressure() && !before[switches.start] && inside[switches.start] {
                closing.push((e, switches));
            }
        }
        closing
    }

    /// Keeps the speeds of impacts in memory: those of the motion before all velocities and forces that jump
    /// in this instant. A contact that rested has none.
    pub(super) fn remember_impacts(
        &mut self,
        time: f64,
        (state, columns): (&[f64], &[f64]),
        (inside, before): (&[bool], &[bool]),
    ) {
        let (closing, mut open) = (self.damped_that_close(inside, before), inside.to_vec());
        for (_, switches) in &closing {
            open[switches.clone()].copy_from_slice(&before[switches.clone()]);
        }
        for (e, _) in closing.into_iter().filter(|(e, _)| !self.rests(*e)).collect::<Vec<_>>() {
            self.remember_impact(e, Point { time, state, inside: &open }, columns);
        }
    }

    /// Keeps the speed of an impact in memory, and its sensitivities `dr' - r'' dr/r'`.
    fn remember_impact(&mut self, e: usize, at: Point<'_>, columns: &[f64]) {
        if !self.laws[e].remembers_impact() {
            return;
        }
        let (n, element) = (self.system.dof(), &self.system.elements()[e]);
        let speed = self.relative_velocity(element, &at.state[n..], at.time);
        let mut rates = vec![0.0; 2 * n];
        self.evaluate(at, &mut rates);
        let carried = self.carried(&element.support_ratios, at.time);
        let acceleration = dot(&element.shape, &rates[n..]) / self.period + carried[2];
        let last = columns.len() / (2 * n);
        let row = columns.chunks_exact(2 * n).enumerate().map(|(index, column)| {
            let mut change = dot(&element.shape, &column[n..]);
            let mut displacement = dot(&element.shape, &column[..n]);
            if index + 1 == last {
                let by_frequency = self.carried_by_frequency(&element.support_ratios, at.time);
                displacement += by_frequency[0];
                change += by_frequency[1];
            }
            (change - acceleration * displacement / speed) * speed.signum()
        });
        self.impacts[e].1 = row.collect();
        self.laws[e] = self.laws[e].struck_at(speed.abs());
    }
}
