//! Impact-speed-dependent laws where a contact lies over phase 0: the motion is the one whose load has
//! another phase, which has no contact there.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use crate::common::{element, model};
use hammerbeam_attractor::{
    AttractorError, Axis, Basins, Class, Effort, Grid, LyapunovSettings, Observable, OneByOne, SectionMap,
    SweepSettings, Sweeper, SystemMap, lyapunov,
};
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    law::{HertzStop, RestitutionModel, RestitutionStop},
};
use hammerbeam_orbit::{OrbitSettings, PeriodicSolution, Response, find_start};

const FREQUENCY_HZ: f64 = 0.18;
/// With this phase of the load no contact comes near phase 0.
const PLAIN: f64 = -2.2;

/// Unit mass on a spring, `w = 1`, damping 0.04, with a stop after Lankarani and Nikravesh.
fn oscillator(phase: f64) -> System {
    pressed(phase, 0.0)
}

/// The same under a weight that pulls it towards the stop.
fn pressed(phase: f64, weight: f64) -> System {
    let force = |order, amplitude, phase| HarmonicForce {
        shape: vec![1.0],
        harmonic: Harmonic { order, amplitude, phase },
    };
    let load = Load { support: vec![], forces: vec![force(0, weight, 0.0), force(1, 0.2, phase)] };
    let elastic = HertzStop::with_gap(20.0, 0.5).unwrap();
    let law = RestitutionStop::new(elastic, RestitutionModel::LankaraniNikravesh, 0.7).unwrap();
    let stop = element(&[1.0], 0.0, Law::Restitution(law));
    System::new(model(&[1.0], faer::mat![[0.04]]), &load, vec![stop]).unwrap()
}

/// The orbit with [`PLAIN`], and the phase of the load that puts the middle of its contact at phase 0.
fn orbit() -> (PeriodicSolution, f64) {
    let system = oscillator(PLAIN);
    let response = Response { shape: vec![1.0], support_ratios: vec![0.0] };
    let orbit = find_start(&system, &response, FREQUENCY_HZ, 1, &OrbitSettings::default()).unwrap();
    let mut integrator = ExactIntegrator::new(system, ExactSettings::default()).unwrap();
    let stretch = Stretch { frequency_hz: FREQUENCY_HZ, start: 0.0, end: 1.0 };
    let touch = &integrator.trace(&stretch, &orbit.nodes[0], &[]).unwrap().contacts[0];
    let middle = 0.5 * FREQUENCY_HZ * (touch.begin.as_ref().unwrap().time + touch.end.unwrap());
    (orbit, PLAIN + TAU * middle)
}

#[test]
fn exponents_agree_with_the_multipliers_whatever_lies_over_the_sections() {
    let (orbit, phase) = orbit();
    let [[a, b], [c, d]] = [orbit.floquet_multipliers[0], orbit.floquet_multipliers[1]];
    let expected = (a * c - b * d).ln() * FREQUENCY_HZ;
    for phase in [PLAIN, phase] {
        for parts in [1, 8] {
            let mut map =
                SystemMap::new(oscillator(phase), FREQUENCY_HZ, 1, ExactSettings::default()).unwrap();
            let mut state = vec![0.0; 2];
            for period in 0..300 {
                state = map.advance(period, &state).unwrap();
            }
            map.set_parts(parts);
            let settings = LyapunovSettings { aligning: 20 * parts, averaged: 100 * parts };
            let found = lyapunov(&mut map, &state, settings).unwrap();
            // The orbit is good to 1e-10, the motion has settled to rounding.
            assert!((found.sum / expected - 1.0).abs() < 1e-7, "{phase} {parts}: {} {expected}", found.sum);
        }
    }
}

#[test]
fn a_sweep_goes_on_from_within_a_contact() {
    let (orbit, phase) = orbit();
    let observable = Observable { shape: vec![1.0], support_ratios: vec![0.0] };
    let settings = SweepSettings { effort: Effort::default(), sampled: 8, motion: ExactSettings::default() };
    let mut sweeper = Sweeper::new(&oscillator(phase), &observable, settings).unwrap();
    let first = sweeper.at(FREQUENCY_HZ - 0.001, &[0.0, 0.0]).unwrap();
    assert!(!sweeper.can_begin(&first.state), "phase 0 lies within the contact");
    let found = sweeper.at(FREQUENCY_HZ, &first.state).unwrap();
    assert_eq!(found.class, Class::Periodic { period: 1 });
    // The motion has repeated to 1e-8.
    assert!((found.max_abs_displacement / orbit.maxima.displacement - 1.0).abs() < 1e-7);
    assert!(
        Sweeper::new(&oscillator(phase), &observable, settings)
            .unwrap()
            .at(FREQUENCY_HZ, &first.state)
            .is_err()
    );
}

/// A weight of 8 N against a force of 0.2 N: after its first bounces the contact stays closed, and its
/// damping says for ever how fast it began. Such a motion is not one of the system.
#[test]
fn a_contact_that_stays_closed_is_refused_by_name() {
    let system = pressed(0.0, 8.0);
    let never_opens = |error: AttractorError| matches!(error, AttractorError::NeverOpens { .. });
    let observable = Observable { shape: vec![1.0], support_ratios: vec![0.0] };
    let motion = ExactSettings::default();
    let settings = SweepSettings { effort: Effort::default(), sampled: 8, motion };
    let mut sweeper = Sweeper::new(&system, &observable, settings).unwrap();
    assert!(never_opens(sweeper.begin_at(FREQUENCY_HZ, &[0.0, 0.0]).unwrap_err()));
    let axis = |direction: [f64; 2]| Axis { direction: direction.to_vec(), low: -1.0, high: 0.4, count: 2 };
    let grid = Grid { base: vec![0.0; 2], x: axis([1.0, 0.0]), y: axis([0.0, 1.0]) };
    let mut basins = Basins::new(system, FREQUENCY_HZ, grid, Effort::default(), motion).unwrap();
    let mut cells = Vec::new();
    while let Some(round) = basins.round(&mut OneByOne) {
        cells.extend(round.cells);
    }
    assert_eq!((cells, basins.attractors().len()), (vec![0; 4], 0));
}

/// A contact that lies over phase 0 and opens in every period is none that stays closed; nor is one that is
/// open at phase 0.
#[test]
fn a_contact_over_phase_0_is_distinguished_from_one_that_stays_closed() {
    let (_, over) = orbit();
    for (system, stays) in [(oscillator(over), false), (oscillator(PLAIN), false), (pressed(0.0, 8.0), true)]
    {
        let mut map = SystemMap::new(system, FREQUENCY_HZ, 1, ExactSettings::default()).unwrap();
        let mut state = vec![0.0; 2];
        for period in 0..300 {
            state = map.advance(period, &state).unwrap();
        }
        let found = map.check_opens(&state, 64);
        assert_eq!(matches!(found, Err(AttractorError::NeverOpens { .. })), stays, "{found:?}");
        // The motion goes on from where it was.
        map.advance(300, &state).unwrap();
    }
}

/// The rest and the linear motion lie within the contact of a weight; the other states of a diagram do not,
/// whatever the law.
#[test]
fn a_diagram_starts_in_front_of_contacts() {
    let settings = SweepSettings { effort: Effort::default(), sampled: 8, motion: ExactSettings::default() };
    let observable = Observable { shape: vec![1.0], support_ratios: vec![0.0] };
    for weight in [0.0, 8.0, 1e6] {
        let mut sweeper = Sweeper::new(&pressed(0.0, weight), &observable, settings).unwrap();
        let starts = sweeper.starts(FREQUENCY_HZ, 12).unwrap();
        // The gap is 0.5 m.
        assert!(starts[2..].iter().all(|state| state[0] <= 0.5), "{weight}: {starts:?}");
    }
}
