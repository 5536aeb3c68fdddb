//! A system as a vector field: rates, tangents, switching.

use std::f64::consts::TAU;

use super::{SystemField, linear_rates, region::kink_of};
use crate::{
    general::{Column, Point, VectorField},
    vectors::{add_scaled, dot},
};

impl VectorField for SystemField<'_> {
    fn dimension(&self) -> usize {
        2 * self.system.dof()
    }

    fn parts(&self) -> usize {
        2
    }

    fn raise_magnitudes(&self, column: Column, magnitudes: &mut [f64]) {
        let least = match column {
            Column::State => self.length,
            Column::ByState => 0.0,
            Column::ByParameter => self.length * self.period,
        };
        magnitudes[0] = magnitudes[0].max(least);
        magnitudes[1] = magnitudes[1].max(TAU / self.period * magnitudes[0]);
    }

    fn evaluate(&mut self, at: Point<'_>, derivative: &mut [f64]) {
        let n = self.system.dof();
        if !self.rigid.stops.is_empty() {
            self.region.clear();
            self.region.extend_from_slice(at.inside);
        }
        self.rotate(at.time);
        linear_rates(&self.stiffness, &self.damping, self.period, at.state, derivative);
        let rate = &mut derivative[n..];
        self.add_load(|load| &load.amplitude, self.period, rate);
        self.add_local_forces(at, rate);
        self.hold_rates(at.time, rate);
    }

    fn tangents(&mut self, _: Point<'_>, columns: &[f64], derivatives: &mut [f64]) {
        let n = self.system.dof();
        let pairs = columns.chunks_exact(2 * n).zip(derivatives.chunks_exact_mut(2 * n));
        for (index, (column, derivative)) in pairs.enumerate() {
            linear_rates(&self.stiffness, &self.damping, self.period, column, derivative);
            for (element, &(slope, damping)) in self.system.elements().iter().zip(&self.slopes) {
                if slope != 0.0 || damping != 0.0 {
                    let mut force = slope * dot(&element.shape, &column[..n]);
                    if damping != 0.0 {
                        force += damping * dot(&element.shape, &column[n..]);
                    }
                    add_scaled(&mut derivative[n..], self.period * force, &element.shape);
                }
            }
            for (first, cross) in self.cross.iter().enumerate().filter(|(_, cross)| **cross != 0.0) {
                let both = &self.system.elements()[first..first + 2];
                for (from, onto) in [(0, 1), (1, 0)] {
                    let force = cross * dot(&both[from].shape, &column[..n]);
                    add_scaled(&mut derivative[n..], self.period * force, &both[onto].shape);
                }
            }
            for (element, (by_speed, row)) in self.system.elements().iter().zip(&self.impacts) {
                if *by_speed != 0.0 {
                    add_scaled(&mut derivative[n..], self.period * by_speed * row[index], &element.shape);
                }
            }
            self.hold_tangent(&mut derivative[n..]);
        }
    }

    fn add_by_parameter(&mut self, at: Point<'_>, derivative: &[f64], sum: &mut [f64]) {
        add_scaled(sum, -self.period, derivative);
        let n = self.system.dof();
        if self.rigid.held.is_empty() {
            return self.add_change_of_forces(at, &mut sum[n..]);
        }
        let mut change = vec![0.0; n];
        self.add_change_of_forces(at, &mut change);
        self.hold_by_frequency(at.time, &mut change);
        add_scaled(&mut sum[n..], 1.0, &change);
    }

    fn begin(&mut self, time: f64, state: &mut [f64], columns: &mut [f64], inside: &mut [bool]) {
        self.begin_rigid(time, state, columns, inside);
    }

    fn impact(&mut self, time: f64, motion: (&mut [f64], &mut [f64]), region: (&mut [bool], &[bool])) {
        let (state, columns) = motion;
        self.remember_impacts(time, (state, columns), (region.0, region.1));
        self.cross_rigid(time, (state, columns), region);
    }

    fn jump(&mut self, at: Point<'_>, before: &[bool], columns: &mut [f64]) {
        for (e, _) in self.damped_that_close(at.inside, before) {
            self.jump_at_onset(e, at.time, columns);
        }
    }

    fn switches(&self) -> usize {
        self.switches
    }

    fn switching(&self, phase: f64, state: &[f64], values: &mut [f64]) {
        let (q, v) = state.split_at(self.system.dof());
        let mut k = 0;
        let held = &self.rigid.held;
        let pressing =
            if held.is_empty() { Vec::new() } else { self.pressing_forces(phase, state, &self.region) };
        for (e, element) in self.system.elements().iter().enumerate() {
            if held.contains(&e) {
                values[k] = pressing[e];
                k += 1;
                continue;
            }
            let contacts = element.law.contacts();
            if contacts.is_empty() {
                continue;
            }
            let r = match element.law.round_hole() {
                Some(_) => self.reading(e, (q, v), phase)[0],
                None => self.relative_displacement(element, q, phase),
            };
            for contact in contacts {
                values[k] = contact.sign * (r - contact.level);
                k += 1;
            }
            if element.law.has_kinks() {
                values[k] = contacts[0].sign * (r - kink_of(&element.law));
                k += 1;
            }
            if let Some(pressure) = self.laws[e].pressure() {
                let rate = contacts[0].sign * self.relative_velocity(element, v, phase);
                values[k] = pressure.at(values[k - 1], rate);
                k += 1;
            }
        }
        self.rigid.resting.iter().for_each(|contact| contact.write(&pressing, &self.region, values));
    }
}
