//! In which units states are measured: displacements and velocities differ by orders of magnitude.
//!
//! The size of an orbit is the size of its motion, without the sag: under a weight a state is `z_0 + z` with
//! the place of rest `z_0`, and tolerances and steps relative to `z_0` would be far too coarse for a small
//! `z`. Where stops carry the weight, `z_0`, which knows nothing of stops, may be further from the orbit than
//! the origin is; then the origin counts. Rounding is relative to the whole state, so a motion below a
//! thousandth of it is measured by that.

use hammerbeam_motion::System;

/// Least size of a motion, relative to its state.
const LEAST_MOTION: f64 = 1e-3;

/// A motion smaller than this part of the state of rest is rounding of what is pressed.
const ROUNDED: f64 = 1e-12;

/// Scales of a state: displacements `V/max(w_i, 2 pi f)`, velocities `V`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StateScale {
    scales: Vec<f64>,
    /// State of rest under the constant loads.
    rest: Vec<f64>,
}

impl StateScale {
    /// * `natural_frequencies`: `w_i` [rad/s]; slower modes than `reference`, `2 pi f` [rad/s], take that.
    /// * `velocity`: `V` [kg^1/2 m/s].
    pub fn new(natural_frequencies: &[f64], reference: f64, velocity: f64) -> Self {
        let displacement = natural_frequencies.iter().map(|w| velocity / w.max(reference));
        let velocities = natural_frequencies.iter().map(|_| velocity);
        let scales: Vec<f64> = displacement.chain(velocities).collect();
        Self { rest: vec![0.0; scales.len()], scales }
    }

    /// The scale with these [`StateScale::values`].
    pub fn from_values(scales: Vec<f64>) -> Self {
        Self { rest: vec![0.0; scales.len()], scales }
    }

    /// Sizes are measured about this state of rest, of the same length.
    pub fn about(self, rest: Vec<f64>) -> Self {
        Self { rest, ..self }
    }

    /// Multiplies the scales.
    pub fn multiply(&mut self, factor: f64) {
        self.scales.iter_mut().for_each(|scale| *scale *= factor);
    }

    /// Multiplies each scale by its factor.
    pub fn multiply_each(&mut self, factors: &[f64]) {
        self.scales.iter_mut().zip(factors).for_each(|(scale, factor)| *scale *= factor);
    }

    /// Scales, one per entry of a state.
    pub fn values(&self) -> &[f64] {
        &self.scales
    }

    /// What a change of velocities by displacements [1/s] is at most, relative to the scale.
    pub fn relative_rate(&self, rate: f64) -> f64 {
        let (displacements, velocities) = self.scales.split_at(self.scales.len() / 2);
        let ratios = displacements.iter().zip(velocities).map(|(x, v)| x / v);
        rate * ratios.fold(0.0, f64::max)
    }

    /// Norm of the difference of two states relative to the scale.
    pub fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).zip(&self.scales).map(|((a, b), s)| ((a - b) / s).powi(2)).sum::<f64>().sqrt()
    }

    /// Whether the distance of two states is less than a bound: no more of them is looked at than decides it.
    pub fn are_within(&self, a: &[f64], b: &[f64], bound: f64) -> bool {
        // Beyond rounding of the square.
        let enough = bound * bound * (1.0 + 8.0 * f64::EPSILON);
        let mut square = 0.0;
        for ((a, b), s) in a.iter().zip(b).zip(&self.scales) {
            square += ((a - b) / s).powi(2);
            if square > enough {
                return false;
            }
        }
        square.sqrt() < bound
    }

    /// Multiplies the scales by the size of a motion, if it has one; returns the size. For a structure that
    /// its stops hold throughout, where the model has its zero, it is the size of the state of rest without
    /// stops.
    pub fn fit_to(&mut self, states: &[impl AsRef<[f64]>]) -> f64 {
        let rest = self.rest.iter().zip(&self.scales).map(|(z, s)| (z / s).powi(2)).sum::<f64>().sqrt();
        let moved = self.size_of_motion(states);
        let size = if moved <= ROUNDED * rest { rest } else { moved };
        if size > 0.0 {
            self.multiply(size);
        }
        size
    }

    /// [`StateScale::size`] of the root of the mean square over states.
    pub fn size_of_motion(&self, states: &[impl AsRef<[f64]>]) -> f64 {
        let scaled =
            states.iter().flat_map(|state| state.as_ref().iter().zip(&self.scales).map(|(z, s)| z / s));
        self.size_of_scaled(scaled, states.len())
    }

    /// Root of the mean square of the deviations of states from their mean, relative to the scale.
    pub fn deviation(&self, states: &[impl AsRef<[f64]>]) -> f64 {
        let count = states.len() as f64;
        let mean: Vec<f64> = (0..self.scales.len())
            .map(|i| states.iter().map(|z| z.as_ref()[i]).sum::<f64>() / count)
            .collect();
        let squares: f64 = states.iter().map(|state| self.distance(state.as_ref(), &mean).powi(2)).sum();
        (squares / count).sqrt()
    }

    /// Size of a motion relative to the scale: the norm of a state about the state of rest or about the
    /// origin, whichever is less.
    pub fn size(&self, state: &[f64]) -> f64 {
        self.size_of_motion(&[state])
    }

    /// [`StateScale::size_of_motion`] of nodes, given one after the other in scaled states.
    pub fn size_of_scaled(&self, scaled: impl Iterator<Item = f64>, nodes: usize) -> f64 {
        let rest = self.rest.iter().zip(&self.scales).map(|(z, s)| z / s).cycle();
        let squares = scaled.zip(rest).map(|(x, rest)| [x * x, (x - rest).powi(2)]);
        let [whole, about_rest] =
            squares.fold([0.0, 0.0], |sum, square| [sum[0] + square[0], sum[1] + square[1]]);
        let norm = |squares: f64| (squares / nodes as f64).sqrt();
        norm(about_rest).min(norm(whole)).max(LEAST_MOTION * norm(whole))
    }
}

/// Units of one `kg^1/2 m/s` about the place of rest.
pub(crate) fn unit_scale(system: &System, frequency_hz: f64) -> StateScale {
    let reference = std::f64::consts::TAU * frequency_hz;
    StateScale::new(&system.model().natural_frequencies, reference, 1.0).about(state_of_rest(system))
}

/// Scale of one state of which no more is known: how far about it starts are spread. Orbits, and guesses of
/// them, are measured by their motion (`size.rs`).
pub(crate) fn state_scale(system: &System, state: &[f64], frequency_hz: f64) -> StateScale {
    let mut scale = unit_scale(system, frequency_hz);
    scale.fit_to(&[state]);
    scale
}

/// Where the modes rest under the constant loads, without stops; rigid ones, which have no place of rest, at
/// zero.
pub(crate) fn state_of_rest(system: &System) -> Vec<f64> {
    let mut rest = vec![0.0; 2 * system.dof()];
    if let Some(index) = system.orders().iter().position(|&order| order == 0) {
        let load = system.modal_load(index, 0.0).amplitude;
        let modes = load.iter().zip(&system.model().natural_frequencies);
        rest.iter_mut()
            .zip(modes)
            .filter(|(_, (_, w))| **w > 0.0)
            .for_each(|(z, (b, w))| *z = b.re / (w * w));
    }
    rest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sag far larger than the motion does not count.
    #[test]
    fn a_deviation_is_that_from_the_mean() {
        let scale = StateScale::from_values(vec![2.0, 1.0]);
        let states = [[1e3 + 6.0, -4.0], [1e3 - 6.0, -4.0], [1e3 + 6.0, 4.0], [1e3 - 6.0, 4.0]];
        assert!((scale.deviation(&states) - 5.0).abs() < 1e-12);
    }

    fn scale(rest: f64) -> StateScale {
        StateScale::new(&[2.0], 1.0, 1.0).about(vec![rest, 0.0])
    }

    #[test]
    fn size_is_that_of_the_motion_about_the_sag() {
        assert_eq!(scale(0.0).size(&[3.0, 8.0]), 10.0);
        assert_eq!(scale(40.0).size(&[43.0, 8.0]), 10.0);
        assert_eq!(scale(40.0).size(&[3.0, 8.0]), 10.0, "a stop carries the weight");
        let nodes = [86.0, 8.0, 74.0, 8.0];
        assert_eq!(scale(40.0).size_of_scaled(nodes.into_iter(), 2), 10.0);
    }

    #[test]
    fn states_are_within_a_distance_of_one_another_if_their_distance_is_less() {
        let scale = StateScale::from_values(vec![0.5, 2.0, 1.0]);
        let (a, b) = ([1.0, -3.0, 0.25], [1.5, 1.0, 0.5]);
        let distance = scale.distance(&a, &b);
        for (bound, is_within) in [(0.5, false), (distance, false), (distance.next_up(), true), (9.0, true)] {
            assert_eq!(scale.are_within(&a, &b, bound), is_within, "{bound}");
        }
        assert!(!scale.are_within(&a, &[f64::NAN; 3], 9.0));
    }

    #[test]
    fn what_stops_hold_at_zero_is_measured_by_the_load_that_presses() {
        for state in [[0.0, 0.0], [0.0, -1.2e-20], [3e-19, 0.0]] {
            let mut held = scale(40.0);
            assert_eq!(held.fit_to(&[state]), 80.0);
            assert_eq!(held.values(), [40.0, 80.0]);
        }
        assert_eq!(scale(40.0).fit_to(&[[3e-10, 0.0]]), 6e-10, "a motion");
    }

    #[test]
    fn size_is_at_least_what_rounding_leaves_to_be_seen() {
        assert_eq!(scale(40.0).size(&[40.0, 0.0]), 0.08);
    }
}
