//! Branches in other parameters than the frequency: against closed forms, and against branches in the
//! frequency.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{beam, duffing};
use faer::Mat;
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, LocalElement, Parameter, System, law::LinearStop,
};
use hammerbeam_orbit::{
    BranchRow, BranchWalk, ContinuationParameter, OrbitSettings, Response, Side, StopReason, find_start,
};
use hammerbeam_structure::{PointOutput, ReducedModel};

/// `x'' + 0.2 x' + x = cos(2 pi f t)` with a linear stop of stiffness 5 at the gap.
fn oscillator(gap: f64) -> (System, Response) {
    let model = ReducedModel {
        natural_frequencies: vec![1.0],
        damping: Mat::from_fn(1, 1, |_, _| 0.2),
        points: vec![PointOutput { name: "mass".into(), shape: vec![1.0], support_ratios: vec![0.0] }],
        supports: vec![],
        uniform_acceleration: vec![1.0],
    };
    let harmonic = Harmonic { order: 1, amplitude: 1.0, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: vec![1.0], harmonic }] };
    let law = Law::Linear(LinearStop::with_gap(5.0, gap).unwrap());
    let stop = LocalElement { name: "stop".into(), shape: vec![1.0], support_ratios: vec![0.0], law };
    (System::new(model, &load, vec![stop]).unwrap(), Response { shape: vec![1.0], support_ratios: vec![0.0] })
}

fn amplitude(frequency_hz: f64, damping: f64) -> f64 {
    let w = std::f64::consts::TAU * frequency_hz;
    1.0 / (1.0 - w * w).hypot(damping * w)
}

/// One side of a branch in a parameter, from the system as it is, to the end of the range.
fn rows(
    (system, response): &(System, Response),
    (parameter, frequency_hz): (Parameter, f64),
    side: Side,
    range: (f64, f64),
) -> Vec<BranchRow> {
    let settings = OrbitSettings::for_range(range);
    let settings = OrbitSettings { max_step: 20.0 * settings.max_step, ..settings };
    let start = find_start(system, response, frequency_hz, 1, &settings).unwrap();
    let varied = ContinuationParameter::Other { parameter, frequency_hz };
    let mut walk = BranchWalk::varying(system, response, &start, (varied, side, range), &settings).unwrap();
    let mut rows = vec![walk.start_row().unwrap()];
    loop {
        if let Some(reason) = walk.step(&mut rows).unwrap() {
            assert!(matches!(reason, StopReason::RangeEnd { .. }), "{reason:?}");
            return rows;
        }
    }
}

/// The linear amplitude is proportional to the excitation, until it equals the gap: there the branch grazes.
#[test]
fn a_linear_amplitude_grows_with_the_excitation_until_it_grazes() {
    let frequency_hz = 0.12;
    let gap = 3.0 * amplitude(frequency_hz, 0.2);
    let found = rows(&oscillator(gap), (Parameter::ExcitationScale, frequency_hz), Side::Up, (0.5, 4.0));
    let mut linear = 0;
    for row in &found {
        let scale = row.parameter.unwrap();
        assert_eq!(row.solution.frequency_hz, frequency_hz);
        if scale < 3.0 {
            linear += 1;
            let expected = scale * amplitude(frequency_hz, 0.2);
            assert!((row.solution.maxima.displacement / expected - 1.0).abs() < 1e-9, "at {scale}");
        }
    }
    assert!(linear > 50);
    let grazing: Vec<f64> =
        found.iter().filter(|row| row.events.grazing).map(|row| row.parameter.unwrap()).collect();
    assert_eq!(grazing.len(), 1);
    assert!((grazing[0] / 3.0 - 1.0).abs() < 1e-6, "{grazing:?}");
}

/// The same place is found by closing the gap, and damping lowers the amplitude as the closed form says.
#[test]
fn gap_and_damping_meet_their_closed_forms() {
    let frequency_hz = 0.15;
    let reach = amplitude(frequency_hz, 0.2);
    let found = rows(&oscillator(1.5 * reach), (Parameter::gap(0), frequency_hz), Side::Down, (2.0, 8.0));
    let grazing: Vec<f64> =
        found.iter().filter(|row| row.events.grazing).map(|row| row.parameter.unwrap()).collect();
    assert_eq!(grazing.len(), 1);
    assert!((grazing[0] / reach - 1.0).abs() < 1e-6, "{grazing:?} {reach}");
    let found =
        rows(&oscillator(9.0), (Parameter::ADDED_DAMPING_RATIO, frequency_hz), Side::Up, (-0.05, 0.3));
    for row in found {
        let ratio = row.parameter.unwrap();
        let expected = amplitude(frequency_hz, 0.2 + 2.0 * ratio);
        assert!((row.solution.maxima.displacement / expected - 1.0).abs() < 1e-8, "at {ratio}");
    }
}

/// The orbits of a branch in a parameter agree with the system at that value, found on its own.
#[test]
fn orbits_of_a_varied_branch_are_orbits_of_the_varied_system() {
    for (case, parameter, frequency_hz, range) in [
        (beam(), Parameter::ExcitationScale, 40.0, (0.5, 1.5)),
        (beam(), Parameter::stiffness(0), 40.0, (3e9, 6e9)),
        (duffing(), Parameter::stiffness(0), 0.1, (0.5, 1.5)),
    ] {
        let found = rows(&case, (parameter, frequency_hz), Side::Up, range);
        let last = found.last().unwrap();
        assert_eq!(last.parameter, Some(range.1));
        let system = case.0.clone().with_parameter(parameter, range.1).unwrap();
        let settings = OrbitSettings::default();
        let expected = find_start(&system, &case.1, frequency_hz, 1, &settings).unwrap();
        let error = last.solution.maxima.displacement / expected.maxima.displacement - 1.0;
        assert!(error.abs() < 1e-8, "{parameter:?}: {error:e}");
    }
}

/// A walk that is stored and taken up again goes on with the same bits.
#[test]
fn a_varied_walk_is_taken_up_again_with_the_same_bits() {
    let (system, response) = beam();
    let range = (0.9, 1.1);
    let settings = OrbitSettings::for_range(range);
    let start = find_start(&system, &response, 40.0, 1, &settings).unwrap();
    let parameter = Parameter::ExcitationScale;
    let varied = ContinuationParameter::Other { parameter, frequency_hz: 40.0 };
    let walk =
        || BranchWalk::varying(&system, &response, &start, (varied, Side::Up, range), &settings).unwrap();
    let (mut whole, mut stored) = (walk(), walk());
    let (mut expected, mut found, mut journal) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..20 {
        whole.step(&mut expected).unwrap();
        stored.step(&mut found).unwrap();
        journal.extend(stored.take_journal());
        let checkpoint = stored.checkpoint();
        stored = BranchWalk::resume(&system, &response, (&checkpoint, &journal), range, &settings).unwrap();
    }
    assert_eq!(found, expected);
}
