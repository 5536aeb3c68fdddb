//! Where something is largest within a step.

use super::{Observer, Output, Watched};
use crate::general::{
    system_field::SystemField,
    watch::{Accepted, Place},
    zero::{minimum, zero},
};

const SAMPLES: usize = 8;

/// Nodes in (-1, 1) and weights of Gauss' rule of order 16, one half of each.
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_3),
];

impl Observer<'_> {
    /// State at a fraction of a step, from a step of the method itself.
    fn exact_state(&mut self, field: &mut SystemField<'_>, step: &Accepted<'_>, fraction: f64) -> Vec<f64> {
        self.exact.value.copy_from_slice(step.stepper.state());
        self.exact.start(field, step.time, step.inside);
        self.exact.attempt_state(field, step.time, fraction * step.length, step.inside);
        self.exact.end_state().to_vec()
    }

    fn take_at(&mut self, field: &mut SystemField<'_>, step: &Accepted<'_>, fraction: f64) -> Vec<f64> {
        let state = self.exact_state(field, step, fraction);
        let time = step.time + fraction * step.length;
        self.take(field, Place { time, state: &state, inside: step.inside });
        state
    }

    /// Extrema of an output within a step.
    pub(super) fn extrema_of(&mut self, field: &mut SystemField<'_>, step: &Accepted<'_>, output: Output) {
        let mut state = std::mem::take(&mut self.state);
        let mut velocity = |field: &SystemField<'_>, x: f64| {
            step.dense.state(x, &mut state);
            self.read(field, output, step.time + x * step.length, &state)[1]
        };
        let mut velocities: Vec<f64> = (0..=SAMPLES).map(|k| velocity(field, sample(k))).collect();
        if let Output::Element(element) = output {
            velocities[0] = self.velocities[element];
            velocities[SAMPLES] = self.read(field, output, step.end, step.stepper.end_state())[1];
        }
        let mut places = Vec::new();
        for (k, pair) in velocities.windows(2).enumerate() {
            if (pair[0] > 0.0) != (pair[1] > 0.0) {
                let sign = if pair[0] > 0.0 { 1.0 } else { -1.0 };
                places.push(zero(&mut |x| sign * velocity(field, x), sample(k), sample(k + 1)));
            }
        }
        self.state = state;
        for place in places {
            let state = self.take_at(field, step, place);
            if let Output::Element(e) = output {
                let [r, _] = self.read(field, output, step.time + place * step.length, &state);
                let contacts = self.contacts.iter().filter(|watched| watched.element == e);
                let penetration = |watched: &Watched| watched.contact.sign * (r - watched.contact.level);
                let penetrations: Vec<f64> = contacts.map(penetration).collect();
                penetrations.into_iter().for_each(|penetration| self.add_extremum(e, penetration));
            }
        }
    }

    pub(super) fn largest_acceleration(&mut self, field: &mut SystemField<'_>, step: &Accepted<'_>) {
        let mut state = vec![0.0; self.state.len()];
        let mut negative = |observer: &mut Self, field: &mut SystemField<'_>, x: f64| {
            step.dense.state(x, &mut state);
            let time = step.time + x * step.length;
            -observer.acceleration(field, Place { time, state: &state, inside: step.inside }).abs()
        };
        let values: Vec<f64> = (0..=SAMPLES).map(|k| negative(self, field, sample(k))).collect();
        let best = (0..=SAMPLES).fold(0, |best, k| if values[k] < values[best] { k } else { best });
        let spread = values.iter().copied().fold(f64::NEG_INFINITY, f64::max) - values[best];
        // Between samples a maximum is higher by a part of what the samples differ by.
        if -values[best] + 0.2 * spread <= self.maxima.acceleration {
            return;
        }
        let (low, high) = (sample(best.saturating_sub(1)), sample((best + 1).min(SAMPLES)));
        let place = minimum(&mut |x| negative(self, field, x), low, high);
        self.take_at(field, step, place);
    }

    /// The largest force of a law that depends on the velocity, which need not be where the penetration is
    /// largest.
    pub(super) fn largest_force(&mut self, field: &mut SystemField<'_>, step: &Accepted<'_>, element: usize) {
        let mut state = vec![0.0; self.state.len()];
        let mut negative = |observer: &Self, field: &SystemField<'_>, x: f64| {
            step.dense.state(x, &mut state);
            let at = Place { time: step.time + x * step.length, state: &state, inside: step.inside };
            -observer.forces(field, at).nth(element).unwrap_or(0.0)
        };
        let values: Vec<f64> = (0..=SAMPLES).map(|k| negative(self, field, sample(k))).collect();
        let best = (0..=SAMPLES).fold(0, |best, k| if values[k] < values[best] { k } else { best });
        let spread = values.iter().copied().fold(f64::NEG_INFINITY, f64::max) - values[best];
        if values[best] == 0.0 || -values[best] + 0.2 * spread <= self.of_elements[element].contact_force {
            return;
        }
        let (low, high) = (sample(best.saturating_sub(1)), sample((best + 1).min(SAMPLES)));
        let place = minimum(&mut |x| negative(self, field, x), low, high);
        self.take_at(field, step, place);
    }

    pub(super) fn add_impulse(&mut self, field: &SystemField<'_>, step: &Accepted<'_>) {
        let mut state = std::mem::take(&mut self.state);
        let mut sums = vec![0.0; self.of_elements.len()];
        for (node, weight) in GAUSS.iter().flat_map(|&(node, weight)| [(-node, weight), (node, weight)]) {
            let x = 0.5 + 0.5 * node;
            step.dense.state(x, &mut state);
            let at = Place { time: step.time + x * step.length, state: &state, inside: step.inside };
            sums.iter_mut().zip(self.forces(field, at)).for_each(|(sum, force)| *sum += weight * force);
        }
        self.state = state;
        let duration = 0.5 * step.length * field.period;
        self.of_elements.iter_mut().zip(sums).for_each(|(element, sum)| element.impulse += duration * sum);
    }
}

fn sample(k: usize) -> f64 {
    k as f64 / SAMPLES as f64
}
