//! A system at one instant: the rate of its state, and the relative motion of an element.
//!
//! At the phase `x` (in cycles), with `u_s = Re sum_m U_sm exp(i 2 pi m x)` and the circular frequency `W`:
//! `r = phi . q + s . u`, `r' = phi . q' + s . u'`, `r'' = phi . q'' + s . u''`, where `q''` is that of the
//! equations of motion.

use std::f64::consts::TAU;

use faer::c64;

use crate::{LocalElement, System, vectors::dot};

impl System {
    /// Displacement of each support and its first two derivatives by time at a phase.
    ///
    /// * `phase`: [cycles].
    ///
    /// # Returns
    /// `[u, u', u'']` [m, m/s, m/s^2], for each support that moves.
    #[must_use]
    pub fn support_motions(&self, frequency_hz: f64, phase: f64) -> Vec<[f64; 3]> {
        let mut motions = vec![[0.0; 3]; self.model().supports.len()];
        for (index, &order) in self.orders().iter().enumerate() {
            let moved = self.support_amplitudes(index, TAU * frequency_hz);
            for (motion, (amplitude, _)) in motions.iter_mut().zip(moved) {
                let value = amplitude * rotation(order, phase);
                let rate = TAU * f64::from(order) * frequency_hz;
                motion[0] += value.re;
                motion[1] -= rate * value.im;
                motion[2] -= rate * rate * value.re;
            }
        }
        motions
    }

    /// What the supports add to a displacement `shape . q + support_ratios . u`, and to its first two
    /// derivatives by time, at a phase [cycles].
    #[must_use]
    pub fn carried(&self, support_ratios: &[f64], frequency_hz: f64, phase: f64) -> [f64; 3] {
        share_of(support_ratios, || self.support_motions(frequency_hz, phase))
    }

    /// Derivatives of [`System::carried`] by the frequency at a fixed phase [m/Hz, m/s/Hz, m/s^2/Hz].
    #[must_use]
    pub fn carried_by_frequency(&self, support_ratios: &[f64], frequency_hz: f64, phase: f64) -> [f64; 3] {
        share_of(support_ratios, || self.support_motions_by_frequency(frequency_hz, phase))
    }

    fn support_motions_by_frequency(&self, frequency_hz: f64, phase: f64) -> Vec<[f64; 3]> {
        let mut changes = vec![[0.0; 3]; self.model().supports.len()];
        for (index, &order) in self.orders().iter().enumerate() {
            let turned = rotation(order, phase);
            let moved = self.support_amplitudes(index, TAU * frequency_hz);
            for (change, (amplitude, by_circular)) in changes.iter_mut().zip(moved) {
                let (value, slope) = (amplitude * turned, by_circular * TAU * turned);
                let per_hertz = TAU * f64::from(order);
                let rate = per_hertz * frequency_hz;
                change[0] += slope.re;
                change[1] -= per_hertz * value.im + rate * slope.im;
                change[2] -= 2.0 * per_hertz * rate * value.re + rate * rate * slope.re;
            }
        }
        changes
    }

    /// Rate `[q'; q'']` of a state at a phase, by the equations of motion. A law that remembers its impact is
    /// taken without loss: a state does not tell it.
    ///
    /// * `phase`: [cycles]; `state`: `[q; q']`, length 2n.
    #[must_use]
    pub fn rate(&self, frequency_hz: f64, phase: f64, state: &[f64]) -> Vec<f64> {
        let (n, model) = (self.dof(), self.model());
        let (q, v) = state.split_at(n);
        let mut rate = v.to_vec();
        for i in 0..n {
            let damping: f64 = (0..n).map(|j| model.damping[(i, j)] * v[j]).sum();
            rate.push(-model.natural_frequencies[i].powi(2) * q[i] - damping);
        }
        for (index, &order) in self.orders().iter().enumerate() {
            let (load, turned) = (self.modal_load(index, TAU * frequency_hz), rotation(order, phase));
            (0..n).for_each(|i| rate[n + i] += (load.amplitude[i] * turned).re);
        }
        let along = |element: &LocalElement| {
            let u = self.carried(&element.support_ratios, frequency_hz, phase);
            [(q, u[0]), (v, u[1])].map(|(z, u)| dot(&element.shape, z) + u)
        };
        for (e, element) in self.elements().iter().enumerate() {
            if let Some(hole) = element.law.round_hole() {
                let both = &self.elements()[e..e + 2];
                let force = hole.force_at([0, 1].map(|k: usize| along(&both[k])[0]));
                for (element, force) in both.iter().zip(force.value) {
                    (0..n).for_each(|i| rate[n + i] += element.shape[i] * force);
                }
                continue;
            }
            let [r, speed] = along(element);
            let force = element.law.force(r, speed).value;
            (0..n).for_each(|i| rate[n + i] += element.shape[i] * force);
        }
        rate
    }

    /// Relative displacement of an element and its first two derivatives by time at a phase.
    ///
    /// * `element`: its number; `phase`: [cycles]; `state`: `[q; q']`, length 2n.
    ///
    /// # Returns
    /// `[r, r', r'']` [m, m/s, m/s^2].
    #[must_use]
    pub fn relative_motion(&self, element: usize, frequency_hz: f64, phase: f64, state: &[f64]) -> [f64; 3] {
        let n = self.dof();
        let (element, rate) = (&self.elements()[element], self.rate(frequency_hz, phase, state));
        let u = self.carried(&element.support_ratios, frequency_hz, phase);
        let parts = [&state[..n], &state[n..], &rate[n..]];
        std::array::from_fn(|k| dot(&element.shape, parts[k]) + u[k])
    }

    /// What tells of the contact of an element, and its first two derivatives by time at a phase: its
    /// relative displacement, or the reading of a round hole ([`RoundHole`](crate::law::RoundHole)).
    ///
    /// * as for [`System::relative_motion`].
    #[must_use]
    pub fn contact_motion(&self, element: usize, frequency_hz: f64, phase: f64, state: &[f64]) -> [f64; 3] {
        let along = |element: usize| self.relative_motion(element, frequency_hz, phase, state);
        match self.elements()[element].law.round_hole() {
            Some(hole) => hole.reading(along(element), along(element + 1)),
            None => along(element),
        }
    }

    /// How deeply a state lies behind the level of an element's contact, `sign (r - level)` [m]: of the
    /// deepest of its contacts, negative in front of all of them.
    ///
    /// * `element`: its number; `phase`: [cycles]; `state`: `[q; q']`, length 2n.
    ///
    /// # Returns
    /// `None` of a law without a contact.
    #[must_use]
    pub fn depth_in_contact(
        &self,
        element: usize,
        frequency_hz: f64,
        phase: f64,
        state: &[f64],
    ) -> Option<f64> {
        let [r, ..] = self.contact_motion(element, frequency_hz, phase, state);
        let contacts = self.elements()[element].law.contacts().iter();
        contacts.map(|contact| contact.sign * (r - contact.level)).reduce(f64::max)
    }

    /// Elements, by their numbers, in whose contacts a state lies and whose laws remember the impact: how
    /// those contacts began is not in the state.
    pub fn remembered_contacts(
        &self,
        frequency_hz: f64,
        phase: f64,
        state: &[f64],
    ) -> impl Iterator<Item = usize> {
        let remembering = (0..self.elements().len()).filter(|&k| self.elements()[k].law.remembers_impact());
        remembering.filter(move |&element| {
            self.depth_in_contact(element, frequency_hz, phase, state).is_some_and(|depth| depth > 0.0)
        })
    }

    /// Whether a state lies within such a contact.
    #[must_use]
    pub fn is_in_remembered_contact(&self, frequency_hz: f64, phase: f64, state: &[f64]) -> bool {
        self.remembered_contacts(frequency_hz, phase, state).next().is_some()
    }
}

/// `sum_s ratio_s u_s` of motions that are asked for only where a support takes part.
fn share_of(support_ratios: &[f64], motions: impl Fn() -> Vec<[f64; 3]>) -> [f64; 3] {
    let mut sum = [0.0; 3];
    if support_ratios.iter().all(|ratio| *ratio == 0.0) {
        return sum;
    }
    for (ratio, motion) in support_ratios.iter().zip(motions()) {
        sum.iter_mut().zip(motion).for_each(|(sum, value)| *sum += ratio * value);
    }
    sum
}

fn rotation(order: u32, phase: f64) -> c64 {
    let (sin, cos) = (TAU * f64::from(order) * (phase - phase.floor())).sin_cos();
    c64::new(cos, sin)
}
