//! Loads whose amplitude depends on the frequency: against constant ones at one frequency, and against
//! differences.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::f64::consts::TAU;

use crate::common::{diagonal, element, hertz, model};
use hammerbeam_motion::{
    AmplitudeCurve, Flow, FrequencyFactor, Harmonic, HarmonicForce, Law, Load, Parameter, Stretch, System,
    SystemError,
    exact::{ExactIntegrator, ExactSettings},
    general::{GeneralSettings, advance},
    law::{HertzStop, HuntCrossleyStop, LinearStop, RigidStop},
};
use hammerbeam_structure::{ReducedModel, SupportInput};

const SHAPE: [f64; 3] = [-1.4, 1.1, -0.9];
const STRETCH: Stretch = Stretch { frequency_hz: 6.0, start: 0.1, end: 1.05 };
const STATE: [f64; 6] = [2e-3, 1e-3, -1e-5, -0.15, 0.02, 0.001];

fn curve() -> AmplitudeCurve {
    AmplitudeCurve::new(vec![[3.0, 1.3], [5.0, 1.1], [7.0, 0.6], [9.0, 0.5]]).unwrap()
}

/// Support motion of amplitude 1.5 mm and a force of 0.5 N, at a factor.
fn excitation(factor: f64) -> Load {
    let harmonic = Harmonic { order: 3, amplitude: 0.5 * factor, phase: 2.0 };
    Load {
        support: vec![Harmonic { order: 1, amplitude: 1.5e-3 * factor, phase: 0.4 }.into()],
        forces: vec![HarmonicForce { shape: vec![0.3, -0.5, 0.4], harmonic }],
    }
}

/// What keeps its amplitude: a second harmonic of the support, and a weight.
fn constant() -> Load {
    let weight = Harmonic { order: 0, amplitude: -1.0, phase: 0.0 };
    Load {
        support: vec![Harmonic { order: 2, amplitude: 1e-4, phase: -1.0 }.into()],
        forces: vec![HarmonicForce { shape: vec![0.6, 0.2, 0.1], harmonic: weight }],
    }
}

fn three_modes() -> ReducedModel {
    let support = SupportInput { inertia: vec![0.8, -0.3, 0.1], damping: vec![0.4, 0.1, -0.2] };
    let frequencies = [TAU * 3.5, TAU * 23.0, TAU * 111.0];
    ReducedModel { supports: vec![support], ..model(&frequencies, diagonal(&[0.4, 2.0, 9.0])) }
}

fn driven(law: Law, support_ratio: f64) -> System {
    let elements = vec![element(&SHAPE, support_ratio, law)];
    let system = System::new(three_modes(), &constant(), elements).unwrap();
    system.with_amplitude_over_frequency(&excitation(1.0), curve()).unwrap()
}

/// The same with the amplitude that the curve has at a frequency.
fn frozen(law: Law, support_ratio: f64, frequency_hz: f64) -> System {
    let (mut load, further) = (excitation(curve().at(frequency_hz).0), constant());
    load.support.extend(further.support);
    load.forces.extend(further.forces);
    System::new(three_modes(), &load, vec![element(&SHAPE, support_ratio, law)]).unwrap()
}

fn laws() -> Vec<Law> {
    let hertz_stop = HertzStop::with_gap(5e6, 0.0).unwrap();
    vec![
        hertz(5e6, 0.0),
        Law::Linear(LinearStop::with_gap(3e5, 1e-3).unwrap().with_damping(90.0).unwrap()),
        Law::HuntCrossley(HuntCrossleyStop::new(hertz_stop, 1.5).unwrap()),
        Law::Rigid(RigidStop::with_gap(0.6, 1e-3).unwrap()),
    ]
}

fn flow(system: &System, frequency_hz: f64, tolerance: f64) -> Flow {
    let mut integrator = ExactIntegrator::new(system.clone(), ExactSettings { tolerance }).unwrap();
    integrator.flow(&Stretch { frequency_hz, ..STRETCH }, &STATE).unwrap()
}

#[test]
fn motion_is_that_of_the_amplitude_at_its_frequency() {
    for law in laws() {
        for frequency_hz in [2.0, 4.4, 6.0, 9.5] {
            let (found, expected) = (
                flow(&driven(law.clone(), 0.7), frequency_hz, 1e-12),
                flow(&frozen(law.clone(), 0.7, frequency_hz), frequency_hz, 1e-12),
            );
            for (a, b) in found.state.iter().zip(&expected.state) {
                // Amplitudes are added in another order.
                assert!((a - b).abs() < 1e-12, "{law:?} at {frequency_hz} Hz: {a} {b}");
            }
        }
    }
}

#[test]
fn frequency_column_holds_the_slope_of_the_amplitude() {
    for law in laws() {
        for support_ratio in [0.0, 1.0, -0.6] {
            let system = driven(law.clone(), support_ratio);
            let column = flow(&system, 6.0, 1e-12).by_frequency;
            let step = 3e-7;
            let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| flow(&system, 6.0 + k * step, 1e-13).state);
            let without = flow(&frozen(law.clone(), support_ratio, 6.0), 6.0, 1e-12).by_frequency;
            for part in [0..3, 3..6] {
                let difference = |i: usize| (8.0 * (c[i] - b[i]) - (d[i] - a[i])) / (12.0 * step);
                let largest = part.clone().map(|i| difference(i).abs()).fold(0.0, f64::max);
                for i in part.clone() {
                    let error = (column[i] - difference(i)).abs() / largest;
                    // Rounding of states over the step, as in the other tests of columns.
                    assert!(
                        error < 3e-5,
                        "{law:?} {support_ratio}, entry {i}: {} {}",
                        column[i],
                        difference(i)
                    );
                }
                let slope = part.map(|i| (column[i] - without[i]).abs()).fold(0.0, f64::max);
                assert!(slope > 1e-2 * largest, "the slope of the amplitude matters here");
            }
        }
    }
}

#[test]
fn the_general_integrator_agrees() {
    for law in laws() {
        for support_ratio in [0.0, 0.7] {
            let system = driven(law.clone(), support_ratio);
            let exact = flow(&system, 6.0, 1e-12);
            let general =
                advance(&system, &STRETCH, &STATE, &GeneralSettings::with_tolerance(1e-12)).unwrap();
            for (a, b, size) in
                exact.state.iter().zip(&general.flow.state).map(|(a, b)| (a, b, 1.0)).chain(
                    exact.by_frequency.iter().zip(&general.flow.by_frequency).map(|(a, b)| (a, b, 10.0)),
                )
            {
                // The tolerance of the general one is 1e-11 of the motion, that of columns grows with the
                // contacts.
                assert!((a - b).abs() < 1e-7 * size, "{law:?} {support_ratio}: {a} {b}");
            }
        }
    }
}

#[test]
fn scale_of_the_excitation_takes_the_curve_along() {
    let law = hertz(5e6, 0.0);
    let system = driven(law, 0.7).with_parameter(Parameter::ExcitationScale, 1.2).unwrap();
    let mut integrator = ExactIntegrator::new(system.clone(), ExactSettings { tolerance: 1e-12 }).unwrap();
    integrator.differentiate_by(Some(Parameter::ExcitationScale)).unwrap();
    let column = integrator.flow(&STRETCH, &STATE).unwrap().by_parameter;
    let at = |scale: f64| {
        let system = system.clone().with_parameter(Parameter::ExcitationScale, scale).unwrap();
        flow(&system, 6.0, 1e-13).state
    };
    let step = 1e-6;
    let (low, high) = (at(1.2 - step), at(1.2 + step));
    let largest = column[3..].iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    for i in 3..6 {
        let difference = (high[i] - low[i]) / (2.0 * step);
        assert!((column[i] - difference).abs() < 1e-5 * largest, "{} {difference}", column[i]);
    }
}

#[test]
fn support_motion_changes_with_the_frequency_as_differences_say() {
    let system = driven(hertz(5e6, 0.0), 0.7);
    for (frequency_hz, phase) in [(6.0, 0.3), (4.2, 0.9), (8.8, 0.55)] {
        let step = 1e-5;
        let low = system.carried(&[1.0], frequency_hz - step, phase);
        let high = system.carried(&[1.0], frequency_hz + step, phase);
        let found = system.carried_by_frequency(&[1.0], frequency_hz, phase);
        for k in 0..3 {
            let difference = (high[k] - low[k]) / (2.0 * step);
            assert!(
                (found[k] - difference).abs() < 1e-8 * (1.0 + difference.abs()),
                "{k}: {} {difference}",
                found[k]
            );
        }
    }
}

/// Three loads that depend on the frequency, each in its own way, and one that does not: a table, an
/// unbalance, and an acceleration with a table.
fn several(law: Law, support_ratio: f64) -> System {
    let force = |order, amplitude, shape: [f64; 3]| Load {
        support: Vec::new(),
        forces: vec![HarmonicForce {
            shape: shape.to_vec(),
            harmonic: Harmonic { order, amplitude, phase: 0.7 },
        }],
    };
    let accelerated =
        Load { support: vec![Harmonic { order: 2, amplitude: -0.3, phase: 0.2 }.into()], forces: Vec::new() };
    driven(law, support_ratio)
        .with_amplitude_over_frequency(&force(1, 4e-4, [0.5, 0.2, -0.1]), FrequencyFactor::SQUARE)
        .and_then(|system| {
            let factor = FrequencyFactor::INVERSE_SQUARE.with_curve(curve());
            system.with_amplitude_over_frequency(&accelerated, factor)
        })
        .unwrap()
}

/// The same with the amplitudes that they have at a frequency.
fn several_frozen(law: Law, support_ratio: f64, frequency_hz: f64) -> System {
    let square = (TAU * frequency_hz).powi(2);
    let mut load = constant();
    let own = excitation(curve().at(frequency_hz).0);
    load.support.extend(own.support);
    load.forces.extend(own.forces);
    load.forces.push(HarmonicForce {
        shape: vec![0.5, 0.2, -0.1],
        harmonic: Harmonic { order: 1, amplitude: 4e-4 * square, phase: 0.7 },
    });
    let amplitude = -0.3 * curve().at(frequency_hz).0 / square;
    load.support.push(Harmonic { order: 2, amplitude, phase: 0.2 }.into());
    System::new(three_modes(), &load, vec![element(&SHAPE, support_ratio, law)]).unwrap()
}

#[test]
fn several_loads_keep_their_own_factors() {
    for law in laws() {
        for frequency_hz in [4.4, 6.0, 9.5] {
            let found = flow(&several(law.clone(), 0.7), frequency_hz, 1e-12).state;
            let expected = flow(&several_frozen(law.clone(), 0.7, frequency_hz), frequency_hz, 1e-12).state;
            for (a, b) in found.iter().zip(&expected) {
                assert!((a - b).abs() < 1e-11, "{law:?} at {frequency_hz} Hz: {a} {b}");
            }
        }
    }
}

/// By differences of fourth order, and by the general integrator.
#[test]
fn frequency_column_holds_the_slopes_of_all_factors() {
    for law in laws() {
        let system = several(law.clone(), 0.7);
        let column = flow(&system, 6.0, 1e-12).by_frequency;
        let step = 3e-7;
        let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| flow(&system, 6.0 + k * step, 1e-13).state);
        let general = advance(&system, &STRETCH, &STATE, &GeneralSettings::with_tolerance(1e-12)).unwrap();
        for part in [0..3, 3..6] {
            let difference = |i: usize| (8.0 * (c[i] - b[i]) - (d[i] - a[i])) / (12.0 * step);
            let largest = part.clone().map(|i| difference(i).abs()).fold(0.0, f64::max);
            for i in part {
                // As in the test of one load: rounding of states over the step.
                let error = (column[i] - difference(i)).abs() / largest;
                assert!(error < 3e-5, "{law:?}, entry {i}: {} {}", column[i], difference(i));
                let other = general.flow.by_frequency[i];
                assert!((column[i] - other).abs() < 1e-6, "{law:?}, entry {i}: {} {other}", column[i]);
            }
        }
    }
}

#[test]
fn constant_loads_are_refused() {
    let system = System::new(three_modes(), &Load::default(), vec![]).unwrap();
    let refused = system.with_amplitude_over_frequency(&constant(), curve());
    assert_eq!(refused.err(), Some(SystemError::ConstantOverFrequency));
}
