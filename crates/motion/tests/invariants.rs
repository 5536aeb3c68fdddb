//! What must hold of every flow of the exact integrator: derivatives, volumes, convergence, and pieces that
//! make a whole.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use crate::common::{beam_with, difference, element, formula, hertz, model, paper_beam, settled};
use faer::Mat;
use hammerbeam_motion::{
    Flow, Harmonic, HarmonicForce, Law, Load, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    law::{
        HertzStop, HuntCrossleyStop, LinearStop, PowerSpring, RestitutionModel, RestitutionStop, TwoSidedStop,
    },
};
use hammerbeam_structure::{ReducedModel, SupportInput};
use hammerbeam_testkit::stride;

fn flow(system: &System, stretch: &Stretch, state: &[f64], tolerance: f64) -> Flow {
    ExactIntegrator::new(system.clone(), ExactSettings { tolerance }).unwrap().flow(stretch, state).unwrap()
}

/// Compares a column of derivatives with differences of fourth order of `function` around 0, relative to its
/// largest entry.
fn check_jacobian(column: &[f64], step: f64, bound: f64, what: &str, function: impl Fn(f64) -> Vec<f64>) {
    let [far_below, below, above, far_above] = [-2.0, -1.0, 1.0, 2.0].map(|k| function(k * step));
    let differences: Vec<f64> = (0..column.len())
        .map(|i| (8.0 * (above[i] - below[i]) - (far_above[i] - far_below[i])) / (12.0 * step))
        .collect();
    for part in [0..column.len() / 2, column.len() / 2..column.len()] {
        let largest = differences[part.clone()].iter().fold(0.0_f64, |largest, d| largest.max(d.abs()));
        for i in part {
            let error = (column[i] - differences[i]).abs() / largest;
            assert!(error <= bound, "{what}, entry {i}: {} against {}, {error:e}", column[i], differences[i]);
        }
    }
}

/// Three modes, coupled by a damper or not, the first rigid if `frequency` is 0, on a shaken support under
/// gravity.
fn three_modes(frequency: f64, coupled: bool, elements: Vec<hammerbeam_motion::LocalElement>) -> System {
    let damper = [0.5, -0.7, 0.9];
    let damping = Mat::from_fn(3, 3, |i, j| {
        let modal = if i == j { [0.4, 2.0, 9.0][i] } else { 0.0 };
        modal + if coupled { 3.0 * damper[i] * damper[j] } else { 0.0 }
    });
    let support = SupportInput { inertia: vec![0.8, -0.3, 0.1], damping: vec![0.4, 0.1, -0.2] };
    let model =
        ReducedModel { supports: vec![support], ..model(&[frequency, TAU * 23.0, TAU * 111.0], damping) };
    let force = |shape: &[f64], order, amplitude, phase| HarmonicForce {
        shape: shape.to_vec(),
        harmonic: Harmonic { order, amplitude, phase },
    };
    let load = Load {
        support: vec![
            Harmonic { order: 1, amplitude: 1.5e-3, phase: 0.4 }.into(),
            Harmonic { order: 2, amplitude: 1e-4, phase: -1.0 }.into(),
        ],
        forces: vec![force(&[0.6, 0.2, 0.1], 0, -1.0, 0.0), force(&[0.3, -0.5, 0.4], 3, 0.5, 2.0)],
    };
    System::new(model, &load, elements).unwrap()
}

fn laws() -> Vec<Law> {
    vec![
        hertz(5e6, 0.0),
        Law::Hertz(HertzStop::with_preload(5e6, 3.0).unwrap()),
        Law::Linear(LinearStop::with_gap(3e5, 1e-3).unwrap()),
        Law::TwoSided(TwoSidedStop::new(8e4, 1e-3, 2e-3).unwrap()),
        Law::Power(PowerSpring::cubic(1e8).unwrap()),
        formula("1e4*x + 60*sin(400*x) + 1e5*x^2"),
    ]
}

fn lossy_laws() -> Vec<Law> {
    let damped = LinearStop::with_gap(3e5, 1e-3).unwrap().with_damping(90.0).unwrap();
    let hertz = HertzStop::with_gap(5e6, 0.0).unwrap();
    vec![
        Law::Linear(damped),
        Law::HuntCrossley(HuntCrossleyStop::new(hertz, 1.5).unwrap()),
        Law::HuntCrossley(HuntCrossleyStop::new(hertz, 40.0).unwrap()),
        Law::Restitution(RestitutionStop::new(hertz, RestitutionModel::LankaraniNikravesh, 0.8).unwrap()),
        Law::Restitution(RestitutionStop::new(hertz, RestitutionModel::Flores, 0.3).unwrap()),
        formula("6*v*(2e5*x^2 - 1) + 4*tanh(6*v)/(1 + 1e4*x^2)"),
    ]
}

const SHAPE: [f64; 3] = [-1.4, 1.1, -0.9];
const STRETCH: Stretch = Stretch { frequency_hz: 6.0, start: 0.1, end: 1.05 };
const STATE: [f64; 6] = [2e-3, 1e-3, -1e-5, -0.15, 0.02, 0.001];

/// Every law at several supports, coupled and uncoupled dampers, a rigid-body mode, and several elements. By
/// default a third of these systems.
#[test]
fn sensitivities_agree_with_differences() {
    let mut systems = Vec::new();
    for law in laws().into_iter().chain(lossy_laws()) {
        for support_ratio in [0.0, 1.0, -0.6] {
            systems.push((
                format!("{law:?} {support_ratio}"),
                three_modes(TAU * 3.5, true, vec![element(&SHAPE, support_ratio, law.clone())]),
            ));
        }
        systems.push((format!("{law:?} rigid"), three_modes(0.0, false, vec![element(&SHAPE, 0.0, law)])));
    }
    let every = laws().into_iter().chain(lossy_laws());
    let several = every.map(|law| element(&SHAPE, 0.3, law)).collect();
    systems.push(("all laws at once".into(), three_modes(TAU * 3.5, true, several)));
    // The last one, with all laws at once, is always among them.
    for (what, system) in systems.into_iter().rev().step_by(stride(3)) {
        let found = flow(&system, &STRETCH, &STATE, 1e-12);
        for j in 0..6 {
            let column: Vec<f64> = (0..6).map(|i| found.by_state[(i, j)]).collect();
            check_jacobian(
                &column,
                if j < 3 { 2e-9 } else { 1e-7 },
                3e-5,
                &format!("{what}, column {j}"),
                |step| {
                    let mut state = STATE;
                    state[j] += step;
                    flow(&system, &STRETCH, &state, 1e-13).state
                },
            );
        }
        check_jacobian(&found.by_frequency, 3e-7, 3e-5, &format!("{what}, frequency"), |step| {
            let frequency_hz = STRETCH.frequency_hz + step;
            flow(&system, &Stretch { frequency_hz, ..STRETCH }, &STATE, 1e-13).state
        });
    }
}

/// `det(by_state) = exp(-T tr C)`: elastic stops leave volumes alone.
#[test]
fn contacts_leave_volumes_alone() {
    for law in laws() {
        for coupled in [false, true] {
            let system = three_modes(TAU * 3.5, coupled, vec![element(&SHAPE, 1.0, law.clone())]);
            let trace: f64 = (0..3).map(|i| system.model().damping[(i, i)]).sum();
            let expected = (-trace * STRETCH.duration()).exp();
            let found = flow(&system, &STRETCH, &STATE, 1e-12).by_state.determinant();
            assert!(
                (found / expected - 1.0).abs() < 1e-9,
                "{law:?} {coupled}: {found:e} against {expected:e}"
            );
        }
    }
}

/// The same of the beam, whose modes lose up to eighty powers of ten in one period of 36 Hz: without damping
/// volumes are kept exactly.
#[test]
fn an_undamped_beam_keeps_volumes_through_contacts() {
    for frequency_hz in [36.0, 53.0] {
        let state = settled(&paper_beam(), frequency_hz, 60, 0.0);
        let system = beam_with(0.0, hertz(4.5e9, 0.0));
        let stretch = Stretch { frequency_hz, start: 0.0, end: 0.5 };
        let found = flow(&system, &stretch, &state, 1e-12).by_state.determinant();
        assert!((found - 1.0).abs() < 1e-7, "{frequency_hz} Hz: {found}");
    }
}

/// A stretch in pieces, cut where contacts are open and closed, gives the flow over the whole.
#[test]
fn pieces_make_a_whole() {
    let system = paper_beam();
    for (frequency_hz, pieces, bound) in
        [(36.0, 7, 1e-11), (36.0, 211, 1e-10), (22.0, 16, 1e-11), (41.0, 31, 1e-11)]
    {
        let state = settled(&system, frequency_hz, 100, 0.0);
        let phase = |piece: u32| f64::from(piece) / f64::from(pieces);
        let tolerance = 1e-13;
        let whole = flow(&system, &Stretch { frequency_hz, start: 0.0, end: 1.0 }, &state, tolerance);
        let mut joined = Flow {
            state,
            by_state: Mat::identity(12, 12),
            by_frequency: vec![0.0; 12],
            by_parameter: vec![],
        };
        for piece in 0..pieces {
            let stretch = Stretch { frequency_hz, start: phase(piece), end: phase(piece + 1) };
            let next = flow(&system, &stretch, &joined.state, tolerance);
            let carried: Vec<f64> = (0..12)
                .map(|i| (0..12).map(|j| next.by_state[(i, j)] * joined.by_frequency[j]).sum::<f64>())
                .collect();
            joined = Flow {
                state: next.state,
                by_state: &next.by_state * &joined.by_state,
                by_frequency: carried.iter().zip(&next.by_frequency).map(|(a, b)| a + b).collect(),
                by_parameter: vec![],
            };
        }
        let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
        let error = difference(&system, &stretch, &joined, &whole);
        assert!(error.largest() < bound, "{frequency_hz} Hz in {pieces} pieces: {error:?}");
    }
}

/// What a flow leaves follows the tolerance; contacts amplify what went before.
#[test]
fn errors_follow_the_tolerance() {
    let system = paper_beam();
    for (frequency_hz, contacts) in [(36.0, 1.0), (22.0, 2.0), (41.0, 1.0), (28.0, 2.0)] {
        let state = settled(&system, frequency_hz, 100, 0.0);
        let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
        let best = flow(&system, &stretch, &state, 1e-15);
        for tolerance in [1e-8, 1e-9, 1e-10, 1e-11, 1e-12] {
            let error = difference(&system, &stretch, &flow(&system, &stretch, &state, tolerance), &best);
            let bound = 30.0 * contacts * tolerance + 2e-12;
            assert!(error.largest() < bound, "{frequency_hz} Hz at {tolerance:e}: {error:?}");
        }
    }
}
