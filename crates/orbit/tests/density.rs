//! Rows are dense enough: linear interpolation of the maximum displacement over the frequency is good to 1e-3
//! between neighbouring rows.
//!
//! The orbit between two rows is solved on its own, at the frequency in the middle, by Newton's method from
//! the mean of both.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use crate::common::{beam, duffing};
use hammerbeam_motion::System;
use hammerbeam_orbit::{BranchRow, BranchWalk, OrbitSettings, PeriodicSolution, Response, Side, find_start};

const PROMISED: f64 = 1e-3;

/// The orbit midway in frequency between two rows, `None` if Newton's method does not come to one that is
/// between.
fn midway((system, response): &(System, Response), [a, b]: [&BranchRow; 2]) -> Option<PeriodicSolution> {
    let [a, b] = [&a.solution, &b.solution];
    let frequency_hz = 0.5 * (a.frequency_hz + b.frequency_hz);
    let mean = |(x, y): (&f64, &f64)| 0.5 * (x + y);
    let guess: Vec<f64> = a.nodes[0].iter().zip(&b.nodes[0]).map(mean).collect();
    let guess = PeriodicSolution { frequency_hz, nodes: vec![guess], ..a.clone() };
    let range = (0.5 * frequency_hz, 2.0 * frequency_hz);
    let mut walk =
        BranchWalk::new(system, response, &guess, Side::Up, range, &OrbitSettings::default()).ok()?;
    let found = walk.start_row().ok()?.solution;
    // The corrector may land on another sheet: between two rows the largest force is between theirs, with
    // some room.
    let (low, high) = (a.maxima.impulse.min(b.maxima.impulse), a.maxima.impulse.max(b.maxima.impulse));
    let room = (high - low) + 1e-4 * high;
    (low - room..=high + room).contains(&found.maxima.impulse).then_some(found)
}

/// Compares every `every`-th interval longer than 1e-5 Hz; returns how many were compared, and the worst
/// error with its place.
fn worst(rig: &(System, Response), rows: &[BranchRow], every: usize) -> (usize, f64, f64) {
    let mut compared = 0;
    let mut worst = (0.0, 0.0);
    for pair in rows.windows(2).step_by(every) {
        let [a, b] = [&pair[0].solution, &pair[1].solution];
        if (a.frequency_hz - b.frequency_hz).abs() < 1e-5 {
            continue;
        }
        let Some(found) = midway(rig, [&pair[0], &pair[1]]) else { continue };
        let line = 0.5 * (a.maxima.displacement + b.maxima.displacement);
        let error = (line / found.maxima.displacement - 1.0).abs();
        compared += 1;
        if error > worst.0 {
            worst = (error, found.frequency_hz);
        }
    }
    (compared, worst.0, worst.1)
}

fn assert_dense(rig: &(System, Response), rows: &[BranchRow], every: usize) {
    let (compared, error, frequency_hz) = worst(rig, rows, every);
    assert!(compared * every * 10 > 8 * rows.len(), "{compared} of {} rows", rows.len());
    assert!(error <= PROMISED, "{error:.1e} at {frequency_hz} Hz");
}

/// Rows from an orbit on until the frequency passes `until_hz` on the way to `side`, within the range of the
/// study.
fn stretch(
    (system, response): &(System, Response),
    (from_hz, period_multiple): (f64, u32),
    (side, until_hz): (Side, f64),
    range_hz: (f64, f64),
) -> Vec<BranchRow> {
    let settings = OrbitSettings::for_range(range_hz);
    let start = find_start(system, response, from_hz, period_multiple, &settings).unwrap();
    let mut walk = BranchWalk::new(system, response, &start, side, range_hz, &settings).unwrap();
    let mut rows = vec![walk.start_row().unwrap()];
    let on_the_way = |frequency_hz: f64| match side {
        Side::Up => frequency_hz < until_hz,
        Side::Down => frequency_hz > until_hz,
    };
    while on_the_way(rows.last().unwrap().solution.frequency_hz) && walk.step(&mut rows).unwrap().is_none() {}
    rows
}

const PAPER: (f64, f64) = (19.0, 110.0);

/// Beside the fold at 27.895 Hz rows a whole step apart would miss by 1.2e-3.
#[test]
fn harmonic_rows_from_29_down_to_27_hz() {
    let rig = beam();
    let rows = stretch(&rig, (29.0, 1), (Side::Down, 27.0), PAPER);
    assert!(rows.iter().filter(|row| row.events.fold).count() >= 3);
    assert_dense(&rig, &rows, 1);
}

#[test]
fn rows_of_the_half_branch_from_53_down_to_50_hz() {
    let rig = beam();
    let rows = stretch(&rig, (53.0, 2), (Side::Down, 49.9), PAPER);
    assert_dense(&rig, &rows, 16);
}

#[test]
fn rows_of_a_duffing_oscillator() {
    let rig = duffing();
    let rows = stretch(&rig, (0.09, 1), (Side::Up, 0.49), (0.08, 0.5));
    assert!(rows.iter().filter(|row| row.events.fold).count() >= 2);
    assert_dense(&rig, &rows, 7);
}
