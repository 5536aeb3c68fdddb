//! Systems shared by the tests of periodic orbits.
#![allow(dead_code, reason = "each test file uses some of them")]
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

pub mod biased;
pub mod bilinear;
pub mod events;
pub mod independent;

use hammerbeam_motion::System;
use hammerbeam_orbit::{
    BranchRow, BranchWalk, OrbitSettings, PeriodicSolution, Response, Segments, Side, StopReason, find_start,
    reach_orbit,
};
use hammerbeam_structure::GROUND;
use hammerbeam_testkit::{
    laws::{cubic, linear},
    paper_rig,
    structures::masses,
    systems::{element_at, force_at, forced, oscillator, response_of},
};

/// The six-dof beam of the paper with its Hertz stop.
pub fn beam() -> (System, Response) {
    let rig = paper_rig();
    (rig.system, rig.response)
}

/// Three masses in a row with springs, and dampers that couple the modes; a force on the last, and a stop out
/// of its reach or none.
pub fn chain(with_stop: bool) -> (System, Response) {
    let model = masses(
        &[("a", 1.0), ("b", 2.0), ("c", 0.5)],
        &[("a", GROUND, 900.0), ("a", "b", 1600.0), ("b", "c", 400.0)],
        &[("a", GROUND, 0.9), ("b", "c", 0.7)],
        false,
    );
    let load = forced(vec![force_at(&model, "c", 1, 1.0)]);
    let stop = element_at(&model, "c", linear(1000.0, 1.0));
    let response = response_of(&model, "c");
    let elements = if with_stop { vec![stop] } else { vec![] };
    (System::new(model, &load, elements).unwrap(), response)
}

/// `x'' + 0.1 x' + x + x^3 = 0.3 cos(2 pi f t)`.
pub fn duffing() -> (System, Response) {
    oscillator(1.0, 0.1, (0.3, 0.0), cubic(1.0))
}

/// The harmonic orbit at a frequency, along its branch from where motions settle on it.
pub fn orbit_at((system, response): &(System, Response), frequency_hz: f64) -> PeriodicSolution {
    reach_orbit(system, response, (frequency_hz, 1), &OrbitSettings::default(), &mut || false).unwrap()
}

/// Both sides of a harmonic branch joined, the lower end first, and the shooting evaluations they took.
pub fn walk_both(
    (system, response): &(System, Response),
    start_hz: f64,
    range_hz: (f64, f64),
    settings: &OrbitSettings,
) -> (Vec<BranchRow>, u64) {
    let start = find_start(system, response, start_hz, 1, settings).unwrap();
    let (mut rows, down) = walk(system, response, &start, Side::Down, range_hz, settings);
    rows.reverse();
    let (upper, up) = walk(system, response, &start, Side::Up, range_hz, settings);
    rows.extend(upper.into_iter().skip(1));
    (rows, down + up)
}

/// Walks one side to the end of the range: the start row first.
pub fn walk(
    system: &System,
    response: &Response,
    start: &PeriodicSolution,
    side: Side,
    range_hz: (f64, f64),
    settings: &OrbitSettings,
) -> (Vec<BranchRow>, u64) {
    let mut walk = BranchWalk::new(system, response, start, side, range_hz, settings).unwrap();
    let mut rows = vec![walk.start_row().unwrap()];
    loop {
        if let Some(reason) = walk.step(&mut rows).unwrap() {
            assert!(matches!(reason, StopReason::RangeEnd { .. }), "{reason:?}");
            return (rows, walk.evaluations());
        }
    }
}

/// The same orbit computed with other settings: corrected by the start of a walk.
pub fn recomputed(
    system: &System,
    response: &Response,
    orbit: &PeriodicSolution,
    settings: &OrbitSettings,
) -> PeriodicSolution {
    let range = (0.5 * orbit.frequency_hz, 2.0 * orbit.frequency_hz);
    let mut walk = BranchWalk::new(system, response, orbit, Side::Up, range, settings).unwrap();
    walk.start_row().unwrap().solution
}

/// Settings with that many segments.
pub fn with_segments(count: usize) -> OrbitSettings {
    OrbitSettings { segments: Segments::Fixed(count), ..OrbitSettings::default() }
}
