//! Systems and comparisons shared by the tests of the exact integrator.
#![allow(dead_code, reason = "each test file uses some of them")]
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

pub mod differences;

use std::f64::consts::TAU;

use faer::Mat;
use hammerbeam_motion::{
    Flow, Harmonic, HarmonicForce, Law, Load, LocalElement, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    general::{GeneralSettings, advance},
    law::{
        Formula, HertzStop, HuntCrossleyStop, LinearStop, PowerSpring, RestitutionModel, RestitutionStop,
        RigidStop,
    },
};
use hammerbeam_structure::{PointOutput, ReducedModel, SupportInput};

/// The six-dof beam of the reference table "In modal coordinates of the reduced clamped beam".
pub fn beam_model(damping_ratio: f64) -> ReducedModel {
    let frequencies = [17.49546, 137.27615, 414.31135, 843.22742, 1538.84987, 3945.26664];
    let shape = vec![3.719882, 1.767674, 1.071971, 0.656816, 0.374580, 1.326146];
    let inertia = vec![0.326581, -0.160943, 0.092436, -0.064797, 0.065038, -0.029896];
    let natural_frequencies: Vec<f64> = frequencies.iter().map(|f| TAU * f).collect();
    ReducedModel {
        damping: modal_damping(&natural_frequencies, damping_ratio),
        natural_frequencies,
        points: vec![PointOutput { name: "contact".into(), shape, support_ratios: vec![1.0] }],
        supports: vec![SupportInput { inertia, damping: vec![0.0; 6] }],
        uniform_acceleration: vec![0.0; 6],
    }
}

/// Diagonal damping matrix of one damping ratio for all modes.
pub fn modal_damping(natural_frequencies: &[f64], ratio: f64) -> Mat<f64> {
    let n = natural_frequencies.len();
    Mat::from_fn(n, n, |i, j| if i == j { 2.0 * ratio * natural_frequencies[i] } else { 0.0 })
}

/// The beam with a stop below the contact point that rides on the support.
pub fn beam_with(damping_ratio: f64, law: Law) -> System {
    let model = beam_model(damping_ratio);
    let shape: Vec<f64> = model.points[0].shape.iter().map(|phi| -phi).collect();
    let load = Load {
        support: vec![Harmonic { order: 1, amplitude: 0.5015e-3, phase: 0.0 }.into()],
        ..Load::default()
    };
    System::new(model, &load, vec![element(&shape, 0.0, law)]).unwrap()
}

/// The beam of the paper.
pub fn paper_beam() -> System {
    beam_with(0.015, hertz(4.5e9, 0.0))
}

/// A uniform clamped-free beam of `n` modes, the first at 17.5 Hz, with a stop near its end that rides on the
/// shaken support.
pub fn uniform_beam(n: usize) -> System {
    let root = |i: usize| if i == 0 { 1.875_104 } else { std::f64::consts::PI * (i as f64 + 0.5) };
    let natural_frequencies: Vec<f64> = (0..n).map(|i| TAU * 17.5 * (root(i) / root(0)).powi(2)).collect();
    let shape: Vec<f64> =
        (0..n).map(|i| 3.0 * (0.05 * root(i)).cos() * if i % 2 == 0 { -1.0 } else { 1.0 }).collect();
    let inertia: Vec<f64> = (0..n).map(|i| 0.33 / (i as f64 + 1.0).powi(2)).collect();
    let model = ReducedModel {
        damping: modal_damping(&natural_frequencies, 0.015),
        natural_frequencies,
        points: vec![],
        supports: vec![SupportInput { inertia, damping: vec![0.0; n] }],
        uniform_acceleration: vec![0.0; n],
    };
    let load =
        Load { support: vec![Harmonic { order: 1, amplitude: 1e-3, phase: 0.0 }.into()], ..Load::default() };
    System::new(model, &load, vec![element(&shape, 0.0, hertz(1e8, 0.0))]).unwrap()
}

/// A model without support motion.
pub fn model(natural_frequencies: &[f64], damping: Mat<f64>) -> ReducedModel {
    ReducedModel {
        natural_frequencies: natural_frequencies.to_vec(),
        damping,
        points: vec![],
        supports: vec![],
        uniform_acceleration: vec![0.0; natural_frequencies.len()],
    }
}

pub fn diagonal(values: &[f64]) -> Mat<f64> {
    Mat::from_fn(values.len(), values.len(), |i, j| if i == j { values[i] } else { 0.0 })
}

/// A rigid stop.
pub fn rigid(restitution: f64, gap: f64) -> Law {
    Law::Rigid(RigidStop::with_gap(restitution, gap).unwrap())
}

/// A cubic spring.
pub fn cubic(stiffness: f64) -> Law {
    Law::Power(PowerSpring::cubic(stiffness).unwrap())
}

/// A force that resists by a formula.
pub fn formula(text: &str) -> Law {
    Law::Formula(Formula::new(text, &[]).unwrap())
}

/// A harmonic force in modal coordinates.
pub fn force(shape: &[f64], order: u32, amplitude: f64, phase: f64) -> HarmonicForce {
    HarmonicForce { shape: shape.to_vec(), harmonic: Harmonic { order, amplitude, phase } }
}

/// A Hertz stop with a gap.
pub fn hertz(stiffness: f64, gap: f64) -> Law {
    Law::Hertz(HertzStop::with_gap(stiffness, gap).unwrap())
}

pub fn element(shape: &[f64], support_ratio: f64, law: Law) -> LocalElement {
    LocalElement { name: "stop".into(), shape: shape.to_vec(), support_ratios: vec![support_ratio], law }
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

/// A linear stop with a damper.
pub fn damped(stiffness: f64, damping: f64, gap: f64) -> Law {
    Law::Linear(LinearStop::with_gap(stiffness, gap).unwrap().with_damping(damping).unwrap())
}

/// A Hertz stop with the loss of Hunt and Crossley.
pub fn hunt_crossley(stiffness: f64, loss: f64, gap: f64) -> Law {
    Law::HuntCrossley(HuntCrossleyStop::new(HertzStop::with_gap(stiffness, gap).unwrap(), loss).unwrap())
}

/// A Hertz stop that remembers the speed of its impact.
pub fn remembering(stiffness: f64, model: RestitutionModel, e: f64, gap: f64) -> Law {
    let hertz = HertzStop::with_gap(stiffness, gap).unwrap();
    Law::Restitution(RestitutionStop::new(hertz, model, e).unwrap())
}
