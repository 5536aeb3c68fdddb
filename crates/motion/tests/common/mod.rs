//! Systems and comparisons shared by the tests of the exact integrator.
#![allow(dead_code, reason = "each test file uses some of them")]
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

pub mod differences;

use std::f64::consts::TAU;

use hammerbeam_motion::{
    Flow, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    general::{GeneralSettings, advance},
};
use hammerbeam_structure::{ReducedModel, SupportInput};
#[allow(unused_imports, reason = "the benches use some of them")]
pub use hammerbeam_testkit::{
    laws::{cubic, damped, formula, hertz, hunt_crossley, remembering, rigid},
    structures::{diagonal, modal_damping, modes as model, paper_modes as beam_model},
    systems::{element, force, modal_beam as paper_beam, modal_beam_with as beam_with, shaken},
};

/// A uniform clamped-free beam of `n` modes, the first at 17.5 Hz, with a stop near its end that rides on the
/// shaken support.
pub fn uniform_beam(n: usize) -> System {
    let root = |i: usize| if i == 0 { 1.875_104 } else { std::f64::consts::PI * (i as f64 + 0.5) };
    let natural_frequencies: Vec<f64> = (0..n).map(|i| TAU * 17.5 * (root(i) / root(0)).powi(2)).collect();
    let shape: Vec<f64> =
        (0..n).map(|i| 3.0 * (0.05 * root(i)).cos() * if i % 2 == 0 { -1.0 } else { 1.0 }).collect();
    let inertia: Vec<f64> = (0..n).map(|i| 0.33 / (i as f64 + 1.0).powi(2)).collect();
    let model = ReducedModel {
        supports: vec![SupportInput { inertia, damping: vec![0.0; n] }],
        ..model(&natural_frequencies, modal_damping(&natural_frequencies, 0.015))
    };
    System::new(model, &shaken(1e-3), vec![element(&shape, 0.0, hertz(1e8, 0.0))]).unwrap()
}

pub fn integrator(system: &System) -> ExactIntegrator {
    ExactIntegrator::new(system.clone(), ExactSettings::default()).unwrap()
}

/// The state after `cycles` cycles from rest, stretch by stretch of one cycle, and `part` of a further one.
pub fn settled(system: &System, frequency_hz: f64, cycles: u32, part: f64) -> Vec<f64> {
    let mut exact = integrator(system);
    let mut state = vec![0.0; 2 * system.dof()];
    for _ in 0..cycles {
        state = exact.advance(&Stretch { frequency_hz, start: 0.0, end: 1.0 }, &state).unwrap();
    }
    if part > 0.0 {
        state = exact.advance(&Stretch { frequency_hz, start: 0.0, end: part }, &state).unwrap();
    }
    state
}

/// Relative differences of two flows; displacements are scaled by the eigenfrequencies to velocities, norms
/// are the largest entries.
#[derive(Debug, Clone, Copy)]
pub struct Difference {
    pub state: f64,
    pub by_state: f64,
    pub by_frequency: f64,
}

impl Difference {
    pub fn largest(&self) -> f64 {
        self.state.max(self.by_state).max(self.by_frequency)
    }
}

/// Compares two flows of a system over a stretch, each part relative to its largest entry.
///
/// The column by the frequency is the difference of what the load and the duration change. Where a motion
/// with large losses follows the load it is far smaller than the state over the frequency, of which rounding
/// is left: it is relative to a hundredth of that at least.
pub fn difference(system: &System, stretch: &Stretch, found: &Flow, expected: &Flow) -> Difference {
    let n = system.dof();
    let slowest = TAU * stretch.frequency_hz;
    let scale = |i: usize| if i < n { system.model().natural_frequencies[i].max(slowest) } else { 1.0 };
    let largest = |count: usize, value: &dyn Fn(usize) -> f64| {
        let magnitudes = (0..count).map(|index| value(index).abs());
        magnitudes
            .fold(0.0_f64, |largest, value| if value.is_nan() { f64::INFINITY } else { largest.max(value) })
    };
    let of = |value: &dyn Fn(&Flow, usize) -> f64, count: usize, least: f64| {
        let gap = largest(count, &|index| value(found, index) - value(expected, index));
        if gap == f64::INFINITY {
            return gap;
        }
        gap / largest(count, &|index| value(expected, index)).max(least)
    };
    let entry = |flow: &Flow, index: usize| {
        let (i, j) = (index / (2 * n), index % (2 * n));
        flow.by_state[(i, j)] * scale(i) / scale(j)
    };
    let state = |flow: &Flow, i: usize| flow.state[i] * scale(i);
    let size = largest(2 * n, &|i| state(expected, i));
    Difference {
        state: of(&state, 2 * n, f64::MIN_POSITIVE),
        by_state: of(&entry, 4 * n * n, f64::MIN_POSITIVE),
        by_frequency: of(
            &|flow, i| flow.by_frequency[i] * scale(i),
            2 * n,
            (0.01 * size / stretch.frequency_hz).max(f64::MIN_POSITIVE),
        ),
    }
}

/// Asserts that both integrators find the same flow to `bound`; the number of contacts that closed.
///
/// Both run at a fine tolerance: what each step leaves, the contacts that follow amplify by up to a few
/// hundred. Without sensitivities the steps are longer.
pub fn assert_agreement(system: &System, stretch: &Stretch, state: &[f64], bound: f64, what: &str) -> u32 {
    let mut exact = ExactIntegrator::new(system.clone(), ExactSettings { tolerance: 1e-12 }).unwrap();
    let found = exact.flow(stretch, state).unwrap_or_else(|error| panic!("{what}: {error}"));
    let general = |tolerance| advance(system, stretch, state, &GeneralSettings::with_tolerance(tolerance));
    // The finest tolerance has the best sensitivities, but rounding may end its motion or, in a chatter of
    // two stops, lead it astray; then the next one does.
    let error = [1e-13, 3e-13, 1e-12]
        .into_iter()
        .filter_map(|tolerance| general(tolerance).ok())
        .map(|expected| difference(system, stretch, &found, &expected.flow))
        .find(|error| error.largest() <= bound);
    let finest = || general(1e-12).map(|expected| difference(system, stretch, &found, &expected.flow));
    assert!(error.is_some(), "{what}: {:?}, touches {:?}", finest(), exact.touches());
    let alone = exact.advance(stretch, state).unwrap();
    let alone = Flow { state: alone, ..found.clone() };
    let error = difference(system, stretch, &alone, &found);
    assert!(error.state <= 10.0 * bound, "{what}: with and without sensitivities {error:?}");
    exact.touches().iter().sum()
}
