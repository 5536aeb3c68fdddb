//! Held rigid stops that are let go at once: by an impact elsewhere that would pull them, or because what
//! they press with falls below zero by a jump.
//!
//! The second is where another stop is hit, or a damper sets in. A neighbour comes there by dt later, and up
//! to then is pressed by the stop: `dv+ = dv - psi_j lambda_j dt`, with the force before it where the
//! damper's own jump comes next, and with the one after it behind an impact.

use super::{
    stops::AT_START,
    system_field::{SystemField, region::switches_of},
};
use crate::vectors::{add_scaled, dot};

impl SystemField<'_> {
    /// Held stops that an impact on an element would pull are let go.
    pub(super) fn let_go_of_pulling(&mut self, e: usize, inside: &mut [bool]) {
        while !self.rigid.held.is_empty() {
            let held = self.rigid.held.clone();
            let mut direction = self.system.elements()[e].shape.clone();
            let reactions = self.constrain(&held, &vec![0.0; held.len()], &mut direction);
            // The impulse of the impact is negative; a positive part along a held shape is pushed against it.
            let strongest = (0..held.len()).max_by(|&j, &k| reactions[j].total_cmp(&reactions[k]));
            let Some(pulled) = strongest.filter(|&j| reactions[j] > 1e-12) else { return };
            self.release(held[pulled], inside);
        }
    }

    /// The held stop that would have to pull most, and the force with which it presses.
    pub(super) fn weakest_that_pulls(
        &self,
        time: f64,
        state: &[f64],
        inside: &[bool],
    ) -> Option<(usize, f64)> {
        let pressing = self.pressing_forces(time, state, inside);
        let held = self.rigid.held.iter().copied();
        let weakest = held.min_by(|&a, &b| pressing[a].total_cmp(&pressing[b]))?;
        let shape = &self.system.elements()[weakest].shape;
        let usual = self.usual_speed(weakest, state) / (self.period * dot(shape, shape));
        (pressing[weakest] < -AT_START * usual).then_some((weakest, pressing[weakest]))
    }

    /// Held stops are let go that would have to pull behind an impact that comes later by `delays`, the
    /// strongest first.
    pub(super) fn let_go_of_tension(
        &mut self,
        time: f64,
        (state, columns): (&[f64], &mut [f64]),
        inside: &mut [bool],
        delays: &[f64],
    ) {
        while let Some((pulled, force)) = self.weakest_that_pulls(time, state, inside) {
            self.release(pulled, inside);
            self.throw_off((pulled, force), columns, delays);
        }
    }

    /// Sensitivities as a stop that was released had pressed with `force` before an instant that comes later
    /// by `delays`, one for each column.
    pub(super) fn throw_off(&self, (e, force): (usize, f64), columns: &mut [f64], delays: &[f64]) {
        let n = self.system.dof();
        let direction = self.free_direction(e);
        for (column, delay) in columns.chunks_exact_mut(2 * n).zip(delays) {
            add_scaled(&mut column[n..], -force * delay, &direction);
        }
    }

    /// Held stops are let go that would have to pull now that a damper has set in; its own jump comes next.
    pub(super) fn throw_off_by_dampers(
        &mut self,
        time: f64,
        (state, columns): (&[f64], &mut [f64]),
        (inside, before): (&mut [bool], &[bool]),
    ) {
        let n = self.system.dof();
        let mut switch = 0;
        for (e, element) in self.system.elements().iter().enumerate() {
            let first = switch;
            switch += switches_of(element);
            let damped = element.law.onset_damping() > 0.0 && !self.rigid.held.is_empty();
            if !damped || before[first] || !inside[first] {
                continue;
            }
            let pressed = self.pressing_forces(time, state, before);
            while let Some((pulled, _)) = self.weakest_that_pulls(time, state, inside) {
                self.release(pulled, inside);
                let speed = dot(&element.shape, &state[n..]) + self.carried(&element.support_ratios, time)[1];
                let last = columns.len() / (2 * n);
                let delay = |(index, column): (usize, &[f64])| {
                    let moved = self.support_change(e, time, index + 1 == last)[0];
                    -(dot(&element.shape, &column[..n]) + moved) / speed
                };
                let delays: Vec<f64> = columns.chunks_exact(2 * n).enumerate().map(delay).collect();
                self.throw_off((pulled, pressed[pulled]), columns, &delays);
            }
        }
    }
}
