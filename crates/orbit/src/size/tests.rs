#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use std::f64::consts::TAU;

use faer::Mat;
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, LocalElement, System,
    general::{GeneralSettings, sample},
    law::HertzStop,
};
use hammerbeam_structure::{PointOutput, ReducedModel};

use super::*;
use crate::{
    OrbitSettings, Response, find_start,
    solve::{integrator, nodes_from},
};

/// Below the resonance of the free mass, with the force of one cycle slow enough for the mass to come to rest
/// on its stop.
const FREQUENCY_HZ: f64 = 0.3;

/// 1 kg on 100 N/m damped critically, pressed with 2 N on a stop of 1e6 N/m^1.5, under `10 N cos(2 pi (f t +
/// phase))`.
fn resting(phase: f64) -> (System, Response) {
    let model = ReducedModel {
        natural_frequencies: vec![10.0],
        damping: Mat::from_fn(1, 1, |_, _| 20.0),
        points: vec![PointOutput { name: "mass".into(), shape: vec![1.0], support_ratios: vec![0.0] }],
        supports: vec![],
        uniform_acceleration: vec![1.0],
    };
    let harmonic = Harmonic { order: 1, amplitude: 10.0, phase: TAU * phase };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: vec![1.0], harmonic }] };
    let law = Law::Hertz(HertzStop::with_preload(1e6, 2.0).unwrap());
    let stop = LocalElement { name: "stop".into(), shape: vec![1.0], support_ratios: vec![0.0], law };
    (System::new(model, &load, vec![stop]).unwrap(), Response { shape: vec![1.0], support_ratios: vec![0.0] })
}

struct MeasuredStart {
    integrator: ExactIntegrator,
    orbit: PeriodicSolution,
    unit: StateScale,
}

fn found(phase: f64) -> MeasuredStart {
    let (system, response) = resting(phase);
    let settings = OrbitSettings::default();
    let orbit = find_start(&system, &response, FREQUENCY_HZ, 1, &settings).unwrap();
    let unit = unit_scale(&system, FREQUENCY_HZ);
    MeasuredStart { integrator: integrator(&system, &response, &settings).unwrap(), orbit, unit }
}

impl MeasuredStart {
    fn size(&mut self) -> f64 {
        Cut::of(&self.orbit).size(&mut self.integrator, &self.unit).unwrap()
    }
}

#[track_caller]
fn assert_near(found: f64, expected: f64, relative: f64) {
    assert!((found / expected - 1.0).abs() < relative, "{found}, expected {expected}");
}

/// The load a whole number of eighths later has the orbit at the same states; in between the higher harmonics
/// of a motion that is thrown off its stop and comes back show: the eight states make the mean of the squares
/// to about a fiftieth.
#[test]
fn size_does_not_depend_on_the_phase_at_which_an_orbit_starts() {
    let expected = found(0.0).size();
    for eighth in 1..8 {
        // Orbits are found to 1e-10 of their size.
        assert_near(found(f64::from(eighth) / 8.0).size(), expected, 1e-8);
    }
    for phase in [0.03, 0.06, 0.2, 0.55, 0.7] {
        assert_near(found(phase).size(), expected, 0.02);
    }
}

#[test]
fn size_is_far_more_than_that_of_a_state_that_rests_on_its_stop() {
    let mut found = found(0.0);
    let size = found.size();
    assert!(found.unit.size(&found.orbit.nodes[0]) < 0.02 * size);
    let system = found.integrator.system().clone();
    let scale = orbit_scale(&mut found.integrator, &found.orbit).unwrap();
    assert_near(scale.values()[1], size, 1e-14);
    assert!(state_scale(&system, &found.orbit.nodes[0], FREQUENCY_HZ).values()[1] < 0.02 * size);
}

/// By the general integrator and a thousand states.
#[test]
fn size_is_the_root_mean_square_of_the_motion() {
    let mut found = found(0.25);
    let system = found.integrator.system().clone();
    let count = 1000;
    let phases: Vec<f64> = (0..count).map(|k| f64::from(k) / f64::from(count)).collect();
    let stretch = Stretch { frequency_hz: FREQUENCY_HZ, start: 0.0, end: 1.0 };
    let settings = GeneralSettings::with_tolerance(1e-8).state_only();
    let states = sample(&system, &stretch, &found.orbit.nodes[0], &phases, &settings).unwrap();
    let squares = states.iter().map(|state| (10.0 * state[0]).powi(2) + state[1].powi(2));
    let mean = squares.sum::<f64>() / f64::from(count);
    // As above.
    assert_near(found.size(), mean.sqrt(), 0.02);
}

#[test]
fn size_does_not_depend_on_the_number_of_nodes() {
    let mut found = found(0.0);
    let expected = found.size();
    for segments in [2, 4, 8, 16] {
        let start = (found.orbit.phase, found.orbit.nodes[0].clone());
        let nodes = nodes_from(&mut found.integrator, (start.0, &start.1), FREQUENCY_HZ, 1, segments);
        found.orbit.nodes = nodes.unwrap();
        // Sixteen states instead of eight, as above; else the same ones, to the accuracy of the motion.
        let tolerance = if segments > 8 { 0.02 } else { 1e-9 };
        assert_near(found.size(), expected, tolerance);
        found.orbit.nodes.truncate(1);
    }
}
