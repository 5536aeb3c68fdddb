//! A motion that goes on from checkpoints has the bits of one that was not interrupted.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{beam_with, element, hertz, model, paper_beam};
use hammerbeam_attractor::{AttractorError, ContactRecord, Simulation, SimulationCheckpoint};
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, System,
    exact::{ExactSettings, MotionError},
    law::{HertzStop, HuntCrossleyStop, LinearStop, RestitutionModel, RestitutionStop, RigidStop},
};

const SETTINGS: ExactSettings = ExactSettings { tolerance: 1e-11 };
const PHASES: [f64; 3] = [0.0, 0.31, 0.77];

/// All numbers of a period and of the checkpoint behind it: the shortest texts that read back to the same
/// bits.
fn period(simulation: &mut Simulation) -> (String, SimulationCheckpoint) {
    let written = simulation.period_at(&PHASES).unwrap();
    let checkpoint = simulation.checkpoint();
    (format!("{written:?} {checkpoint:?}"), checkpoint)
}

/// Goes over periods twice, once without a break and once from a checkpoint at every border.
///
/// # Returns
/// The checkpoints.
#[track_caller]
fn assert_same_bits(
    system: &System,
    frequency_hz: f64,
    state: &[f64],
    periods: usize,
) -> Vec<SimulationCheckpoint> {
    let mut whole = Simulation::new(system.clone(), frequency_hz, state, SETTINGS).unwrap();
    let mut checkpoints = vec![whole.checkpoint()];
    for number in 0..periods {
        let before = checkpoints[number].clone();
        let (expected, checkpoint) = period(&mut whole);
        let mut resumed = Simulation::resume(system.clone(), frequency_hz, before, SETTINGS).unwrap();
        let (found, _) = period(&mut resumed);
        assert!(found == expected, "period {number}:\n{found}\n{expected}");
        checkpoints.push(checkpoint);
    }
    checkpoints
}

fn restitution(stiffness: f64, gap: f64) -> Law {
    let elastic = HertzStop::with_gap(stiffness, gap).unwrap();
    let model = RestitutionModel::LankaraniNikravesh;
    Law::Restitution(RestitutionStop::new(elastic, model, 0.7).unwrap())
}

/// Unit mass on a spring of 1 N/m, driven with 1 N at 1.3 rad/s and pressed on by a weight.
fn oscillator(weight: f64, phase: f64, laws: &[Law]) -> (System, f64) {
    let force = |order, amplitude, phase| HarmonicForce {
        shape: vec![1.0],
        harmonic: Harmonic { order, amplitude, phase },
    };
    let load = Load { support: vec![], forces: vec![force(0, weight, 0.0), force(1, 1.0, phase)] };
    let elements = laws.iter().map(|law| element(&[1.0], 0.0, law.clone())).collect();
    let system = System::new(model(&[1.0], faer::mat![[0.1]]), &load, elements).unwrap();
    (system, 1.3 / std::f64::consts::TAU)
}

fn closed_at_borders(checkpoints: &[SimulationCheckpoint], which: impl Fn(&ContactRecord) -> bool) -> usize {
    checkpoints.iter().filter(|checkpoint| checkpoint.open.iter().any(&which)).count()
}

/// The paper's beam, settling and in chaos; its short contacts are open at the borders.
#[test]
fn the_beam_against_its_stop() {
    for (frequency_hz, periods) in [(22.0, 40), (36.0, 40), (53.0, 200)] {
        let checkpoints = assert_same_bits(&paper_beam(), frequency_hz, &[0.0; 12], periods);
        assert!(checkpoints.iter().all(|checkpoint| checkpoint.impact_speeds.is_empty()));
    }
}

/// Contacts that the state determines, closed at borders: what they have gathered goes on.
#[test]
fn contacts_without_a_memory() {
    let lossy = HuntCrossleyStop::new(HertzStop::with_gap(20.0, 0.1).unwrap(), 0.3).unwrap();
    for law in [hertz(20.0, 0.1), Law::HuntCrossley(lossy)] {
        let mut closed = 0;
        for step in 0..8 {
            let phase = std::f64::consts::TAU * f64::from(step) / 8.0;
            let (system, frequency_hz) = oscillator(0.0, phase, std::slice::from_ref(&law));
            let checkpoints = assert_same_bits(&system, frequency_hz, &[0.0, 0.0], 60);
            closed += closed_at_borders(&checkpoints, |record| record.impulse > 0.0);
        }
        assert!(closed > 50, "{law:?}: closed at {closed} borders");
    }
}

/// Impact-speed-dependent laws, closed at borders: neither the state nor the contact says how fast they
/// closed.
#[test]
fn contacts_of_impact_speed_dependent_laws() {
    let mut closed = 0;
    let of_such_a_law = |record: &ContactRecord| record.element == 0;
    for step in 0..8 {
        let phase = std::f64::consts::TAU * f64::from(step) / 8.0;
        let linear = Law::Linear(LinearStop::with_gap(3.0, 0.5).unwrap());
        let (system, frequency_hz) = oscillator(0.0, phase, &[restitution(20.0, 0.1), linear]);
        let checkpoints = assert_same_bits(&system, frequency_hz, &[-0.5, 0.0], 60);
        closed += closed_at_borders(&checkpoints, of_such_a_law);
        let last = checkpoints.into_iter().rfind(|checkpoint| checkpoint.open.iter().any(of_such_a_law));
        let Some(mut forgetful) = last else { continue };
        assert!(forgetful.impact_speeds[0].is_finite());
        forgetful.impact_speeds.clear();
        let mut refused = Simulation::resume(system, frequency_hz, forgetful, SETTINGS).unwrap();
        let refusal = refused.period(1).unwrap_err();
        assert!(
            matches!(refusal, AttractorError::Motion(MotionError::StartsInContact { .. })),
            "without its memory it cannot go on: {refusal}"
        );
    }
    assert!(closed > 50, "closed at {closed} borders");
}

/// The beam whose contacts last thousandths of a period.
#[test]
fn the_beam_with_an_impact_speed_dependent_law() {
    let beam = beam_with(0.015, restitution(1e7, 0.0));
    // In front of the stop, so that a motion can begin.
    let mut state = vec![0.0; 2 * beam.dof()];
    state[0] = -1e-3 * beam.elements()[0].shape[0].signum();
    for frequency_hz in [28.0, 36.0, 53.0] {
        assert_same_bits(&beam, frequency_hz, &state, 60);
    }
}

/// A rigid stop that holds the mass at borders of periods, after chatter and, without restitution, after one
/// impact.
#[test]
fn masses_that_stick_to_rigid_stops() {
    for restitution in [0.0, 0.5] {
        let mut held = 0;
        for step in 0..8 {
            let phase = std::f64::consts::TAU * f64::from(step) / 8.0;
            let stop = Law::Rigid(RigidStop::with_gap(restitution, 0.2).unwrap());
            let (system, frequency_hz) = oscillator(0.8, phase, &[stop]);
            let checkpoints = assert_same_bits(&system, frequency_hz, &[0.0, 0.0], 40);
            held += closed_at_borders(&checkpoints, |record| record.peak_force > 0.0);
        }
        assert!(held > 10, "{restitution}: held at {held} borders");
    }
}

/// A period that cannot be computed leaves the motion where it was.
#[test]
fn a_failure_changes_nothing() {
    let (system, frequency_hz) = oscillator(1.0, 0.3, &[restitution(20.0, 0.0)]);
    let mut simulation = Simulation::new(system, frequency_hz, &[0.0, 0.0], SETTINGS).unwrap();
    let before = simulation.checkpoint();
    simulation.period(1).unwrap_err();
    assert_eq!(simulation.checkpoint(), before);
}

#[test]
fn checkpoints_of_other_systems_are_refused() {
    let (system, frequency_hz) = oscillator(0.0, 0.0, &[restitution(20.0, 0.1)]);
    let simulation = Simulation::new(system, frequency_hz, &[0.0, 0.0], SETTINGS).unwrap();
    let checkpoint = SimulationCheckpoint { impact_speeds: vec![f64::INFINITY], ..simulation.checkpoint() };
    let of = |checkpoint| Simulation::resume(paper_beam(), frequency_hz, checkpoint, SETTINGS);
    assert!(matches!(of(checkpoint.clone()), Err(AttractorError::StateLength { found: 2, expected: 12 })));
    let two = SimulationCheckpoint { state: vec![0.0; 12], impact_speeds: vec![1.0; 2], ..checkpoint };
    assert!(matches!(of(two), Err(AttractorError::Input { what: "remembered impacts", .. })));
}
