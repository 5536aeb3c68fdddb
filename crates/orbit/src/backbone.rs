//! States from which resonances of large amplitude are reached, where the linear response suggests no such
//! motion.
//!
//! A mode that swings freely with the amplitude `a` about its place of rest, alone, has the frequency `w(a)^2
//! = w^2 + k(a)` with the describing function of the local forces,
//!
//! `k(a) = -1/(pi a) sum_e phi_e int f_e(r_e + phi_e a cos s) cos s ds`:
//!
//! its *backbone*. Over a rigid stop at `cos s = g` it lacks the time behind the stop, so that `w(a) = w/(1 -
//! arccos(g)/pi)`. Weakly damped motion of large amplitude lies near a backbone whose frequency is `p/q` of
//! the excitation frequency: with `q = 1` at the same frequency or a superharmonic one, else a subharmonic
//! solution of `q` periods (Nayfeh and Mook, *Nonlinear Oscillations*, 1979, chapter 4). The phase is open,
//! so several are tried.

use std::f64::consts::{PI, TAU};

use hammerbeam_motion::{Contact, LocalElement, System, in_front_of_contacts};

use crate::{noise::Noise, state_scale::state_of_rest};

/// Samples of a cycle of the describing function.
const SAMPLES: u32 = 128;
/// Amplitudes that are looked at: powers of two about the one it starts from, to either side.
const OCTAVES: i32 = 40;
/// Bisections of the amplitude.
const BISECTIONS: usize = 40;
/// Modes whose backbones are looked at, the lowest ones.
const MODES: usize = 3;
/// Multiples of the excitation frequency at which a backbone is excited.
const ORDERS: [u32; 3] = [1, 2, 3];

/// A free motion of one mode at a ratio of the excitation frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Resonance {
    mode: usize,
    /// In the modal coordinate [kg^1/2 m].
    amplitude: f64,
    /// [rad/s].
    circular_frequency: f64,
    /// At the excitation frequency itself: the forced motion is part of it.
    is_primary: bool,
}

/// States on backbones at ratios of the excitation frequency, `most` of them, always the same ones at a
/// frequency.
///
/// * `multiples`: period multiples that are looked for.
/// * `linear`: the linear response at phase 0, to which free motion is added.
pub(crate) fn backbone_states(
    system: &System,
    frequency_hz: f64,
    multiples: &[u32],
    linear: &[f64],
    most: usize,
) -> Vec<Vec<f64>> {
    let resonances = resonances(system, frequency_hz, multiples, linear);
    if resonances.is_empty() {
        return Vec::new();
    }
    let n = system.dof();
    let rest = state_of_rest(system);
    // Other resonances come first, and at other phases, from one frequency to the next.
    let mut noise = Noise::new(frequency_hz.to_bits());
    let first = noise.below(resonances.len());
    let state = |k: usize| {
        let Resonance { mode, amplitude, circular_frequency, is_primary } =
            resonances[(first + k) % resonances.len()];
        let (sin, cos) = (PI * noise.signed()).sin_cos();
        let mut state = if is_primary { rest.clone() } else { linear.to_vec() };
        state[mode] += amplitude * cos;
        state[n + mode] -= amplitude * circular_frequency * sin;
        state
    };
    let states: Vec<Vec<f64>> = (0..most).map(state).collect();
    let in_front = |state: Vec<f64>| in_front_of_contacts(system, frequency_hz, 0.0, &state);
    states.into_iter().filter_map(in_front).collect()
}

fn resonances(system: &System, frequency_hz: f64, multiples: &[u32], linear: &[f64]) -> Vec<Resonance> {
    let mut found = Vec::new();
    for mode in 0..system.dof().min(MODES) {
        let Some(backbone) = Backbone::of(system, mode, linear) else { continue };
        for (p, q) in ratios(multiples) {
            let circular_frequency = TAU * frequency_hz * f64::from(p) / f64::from(q);
            let amplitudes = backbone.amplitudes_at(circular_frequency);
            let is_primary = (p, q) == (1, 1);
            let resonance = |amplitude| Resonance { mode, amplitude, circular_frequency, is_primary };
            found.extend(amplitudes.into_iter().map(resonance));
        }
    }
    found
}

/// `p/q` in lowest terms, with `q` among the multiples.
fn ratios(multiples: &[u32]) -> Vec<(u32, u32)> {
    let lowest = |p: u32, q: u32| (2..=p).all(|k| !(p.is_multiple_of(k) && q.is_multiple_of(k)));
    let all = multiples.iter().flat_map(|&q| ORDERS.map(|p| (p, q)));
    all.filter(|&(p, q)| lowest(p, q)).collect()
}

/// The backbone of a mode.
struct Backbone<'a> {
    system: &'a System,
    mode: usize,
    rest: Vec<f64>,
    /// Amplitudes, ascending, and the circular frequency at each.
    table: Vec<(f64, f64)>,
}

impl<'a> Backbone<'a> {
    /// `None` of a mode that no local force acts on.
    fn of(system: &'a System, mode: usize, linear: &[f64]) -> Option<Self> {
        let unit = unit_amplitude(system, mode, linear)?;
        let mut backbone = Self { system, mode, rest: state_of_rest(system), table: Vec::new() };
        let amplitudes = (-OCTAVES..=OCTAVES).map(|octave| unit * 2f64.powi(octave));
        backbone.table = amplitudes.map(|amplitude| (amplitude, backbone.at(amplitude))).collect();
        Some(backbone)
    }

    /// Amplitudes at which it has a circular frequency, ascending.
    fn amplitudes_at(&self, circular_frequency: f64) -> Vec<f64> {
        let above = |frequency: f64| frequency > circular_frequency;
        let crosses = |pair: &&[(f64, f64)]| above(pair[0].1) != above(pair[1].1);
        let place = |pair: &[(f64, f64)]| {
            let (mut low, mut high) = (pair[0].0, pair[1].0);
            for _ in 0..BISECTIONS {
                let middle = 0.5 * (low + high);
                if above(self.at(middle)) == above(pair[0].1) { low = middle } else { high = middle }
            }
            0.5 * (low + high)
        };
        self.table.windows(2).filter(crosses).map(place).collect()
    }

    /// Circular frequency of the free motion with an amplitude [rad/s], zero where the local forces let it
    /// not come back.
    fn at(&self, amplitude: f64) -> f64 {
        let w = self.system.model().natural_frequencies[self.mode];
        let (mut stiffness, mut missing) = (0.0, 0.0);
        for element in self.system.elements() {
            let (phi, place) = (element.shape[self.mode], along(element, &self.rest));
            if element.law.rigid().is_some() {
                missing += missing_share(element, place, phi.abs() * amplitude);
            } else {
                stiffness += describing_function(element, place, (phi, amplitude));
            }
        }
        let squared = w * w + stiffness;
        if squared <= 0.0 || missing >= 1.0 { 0.0 } else { squared.sqrt() / (1.0 - missing) }
    }
}

/// Relative displacement of an element without support motion [m].
fn along(element: &LocalElement, state: &[f64]) -> f64 {
    element.shape.iter().zip(state).map(|(phi, q)| phi * q).sum()
}

/// Share of a cycle of the amplitude `reach` about a place [m] that lies behind a rigid stop.
fn missing_share(element: &LocalElement, place: f64, reach: f64) -> f64 {
    let clear = |contact: &Contact| contact.sign * (contact.level - place) / reach;
    let nearest = element.law.contacts().iter().map(clear).fold(1.0, f64::min);
    nearest.max(-1.0).acos() / PI
}

/// Stiffness of an element for the first harmonic of a mode [1/s^2].
fn describing_function(element: &LocalElement, place: f64, (phi, amplitude): (f64, f64)) -> f64 {
    let sample = |k: u32| {
        let cos = (TAU * (f64::from(k) + 0.5) / f64::from(SAMPLES)).cos();
        element.law.force_along(place + phi * amplitude * cos) * cos
    };
    let mean = (0..SAMPLES).map(sample).sum::<f64>() / f64::from(SAMPLES);
    -2.0 * phi * mean / amplitude
}

/// An amplitude of a mode to start from: the linear response, or the least that reaches a gap.
fn unit_amplitude(system: &System, mode: usize, linear: &[f64]) -> Option<f64> {
    let (n, w) = (system.dof(), system.model().natural_frequencies[mode]);
    let acting = || system.elements().iter().filter(|element| element.shape[mode] != 0.0);
    acting().next()?;
    let levels = acting().flat_map(|element| {
        let reached = |contact: &Contact| (contact.level / element.shape[mode]).abs();
        element.law.contacts().iter().map(reached)
    });
    let gap = levels.filter(|level| *level > 0.0).reduce(f64::min);
    let swing = if w > 0.0 { linear[mode].hypot(linear[n + mode] / w) } else { linear[mode].abs() };
    gap.or((swing > 0.0).then_some(swing))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_oscillator::oscillator;
    use hammerbeam_motion::{
        Law,
        law::{PowerSpring, RigidStop},
    };

    fn backbone_of(law: Law, unit: f64) -> Vec<f64> {
        let (system, _) = oscillator(0.1, 1.0, law);
        let backbone = Backbone::of(&system, 0, &[unit, 0.0]).expect("the element acts on the mode");
        [1.2, 1.7].into_iter().map(|w| backbone.amplitudes_at(w)[0]).collect()
    }

    /// Of `x'' + x + x^3 = 0` the first harmonic has `w^2 = 1 + 3/4 a^2`, whatever the amplitude it is
    /// started from.
    #[test]
    fn backbone_of_a_cubic_spring_is_a_parabola() {
        for unit in [1e-4, 0.3, 50.0] {
            let amplitudes = backbone_of(Law::Power(PowerSpring::cubic(1.0).expect("a spring")), unit);
            for (w, a) in [1.2_f64, 1.7].into_iter().zip(amplitudes) {
                assert!((w * w - 1.0 - 0.75 * a * a).abs() < 1e-9, "{w}: {a}");
            }
        }
    }

    /// A mass that meets a rigid stop at a third of its amplitude lacks `arccos(1/3)/pi` of its cycle.
    #[test]
    fn backbone_of_a_rigid_stop_lacks_the_time_behind_it() {
        let amplitudes = backbone_of(Law::Rigid(RigidStop::with_gap(1.0, 0.5).expect("a stop")), 1.0);
        for (w, a) in [1.2_f64, 1.7].into_iter().zip(amplitudes) {
            assert!((w * (1.0 - (0.5 / a).acos() / PI) - 1.0).abs() < 1e-9, "{w}: {a}");
        }
    }

    #[test]
    fn ratios_are_in_lowest_terms() {
        assert_eq!(ratios(&[1, 2]), [(1, 1), (2, 1), (3, 1), (1, 2), (3, 2)]);
    }
}
