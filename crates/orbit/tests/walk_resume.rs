//! A walk that is stored and taken up again goes on with the same bits.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use hammerbeam_motion::{Harmonic, HarmonicForce, Law, Load, LocalElement, System, law::HertzStop};
use hammerbeam_orbit::{
    BranchRow, BranchWalk, OrbitError, OrbitSettings, Response, Segments, Side, find_start,
};
use hammerbeam_testkit::structures::unit_mass;

/// Unit mass on a spring, `w = 1`, damping ratio 0.02, with a Hertz stop at a gap, driven by a force.
fn oscillator() -> (System, Response) {
    let model = unit_mass(1.0, 0.04);
    let force =
        HarmonicForce { shape: vec![1.0], harmonic: Harmonic { order: 1, amplitude: 0.2, phase: 0.0 } };
    let load = Load { support: Vec::new(), forces: vec![force] };
    let law = Law::Hertz(HertzStop::with_gap(20.0, 0.5).unwrap());
    let stop = LocalElement { name: "stop".into(), shape: vec![1.0], support_ratios: vec![0.0], law };
    let system = System::new(model, &load, vec![stop]).unwrap();
    (system, Response { shape: vec![1.0], support_ratios: vec![0.0] })
}

const RANGE: (f64, f64) = (0.1, 0.4);

/// Walks up to the end of [`RANGE`], storing and resuming after every `pieces` steps.
fn walk(settings: &OrbitSettings, pieces: usize) -> Vec<BranchRow> {
    walk_from((0.12, Side::Up, RANGE), settings, pieces)
}

/// Walks from a frequency to the end of a range, storing and resuming after every `pieces` steps.
fn walk_from(
    (from_hz, side, range): (f64, Side, (f64, f64)),
    settings: &OrbitSettings,
    pieces: usize,
) -> Vec<BranchRow> {
    let (system, response) = oscillator();
    let start = find_start(&system, &response, from_hz, 1, settings).unwrap();
    let mut walk = BranchWalk::new(&system, &response, &start, side, range, settings).unwrap();
    let (mut rows, mut journal) = (Vec::new(), Vec::new());
    for step in 1.. {
        if walk.step(&mut rows).unwrap().is_some() {
            break;
        }
        if step % pieces == 0 {
            journal.extend(walk.take_journal());
            let checkpoint = walk.checkpoint();
            walk = BranchWalk::resume(&system, &response, (&checkpoint, &journal), range, settings).unwrap();
        }
    }
    rows
}

#[test]
fn a_resumed_walk_has_the_bits_of_an_undisturbed_one() {
    for segments in [Segments::Automatic, Segments::Fixed(4)] {
        let settings = OrbitSettings { segments, ..OrbitSettings::for_range((0.0, 1.5)) };
        let undisturbed = walk(&settings, usize::MAX);
        assert!(undisturbed.iter().any(|row| row.events.fold), "the resonance overhangs");
        assert!(undisturbed.len() > 200);
        assert!(undisturbed == walk(&settings, 7));
    }
}

/// From fifty times the eigenfrequency down to a part of it: the units of displacements and velocities
/// change, each by its own factors.
#[test]
fn a_walk_that_is_resumed_in_other_units_has_the_same_bits() {
    let settings = OrbitSettings { max_step: 0.01, ..OrbitSettings::default() };
    let walk = |pieces| walk_from((8.0, Side::Down, (0.02, 10.0)), &settings, pieces);
    let undisturbed = walk(usize::MAX);
    assert!(undisturbed.last().unwrap().solution.frequency_hz < 0.021);
    assert!(undisturbed == walk(7));
}

/// With long steps rows are put between the points of the path, from what is known of the rows before.
#[test]
fn a_resumed_walk_puts_the_same_rows_between() {
    let settings = OrbitSettings { max_step: 0.01, ..OrbitSettings::default() };
    let undisturbed = walk(&settings, usize::MAX);
    for pieces in 1..4 {
        assert!(undisturbed == walk(&settings, pieces), "{pieces} steps a piece");
    }
    let (system, response) = oscillator();
    let start = find_start(&system, &response, 0.12, 1, &settings).unwrap();
    let mut walk = BranchWalk::new(&system, &response, &start, Side::Up, RANGE, &settings).unwrap();
    let (mut rows, mut steps) = (Vec::new(), 0);
    while walk.step(&mut rows).unwrap().is_none() {
        steps += 1;
    }
    assert!(rows.len() > steps + 20, "{} rows in {steps} steps", rows.len());
}

#[test]
fn bytes_of_another_system_are_refused() {
    let (system, response) = oscillator();
    let settings = OrbitSettings::for_range(RANGE);
    let found = BranchWalk::resume(&system, &response, (&[1, 2, 3], &[]), RANGE, &settings);
    assert_eq!(found.err(), Some(OrbitError::Checkpoint));
}
