//! Basins: the same bits for any number of threads and after a stop, and every cell as the general integrator
//! has it.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use crate::common::{Threads, element, oscillator};
use hammerbeam_attractor::{
    Attractor, AttractorError, Axis, Basins, Class, Effort, Grid, distance, fractions, state_scales,
};
use hammerbeam_motion::{
    Law, Stretch, System,
    exact::ExactSettings,
    general::{GeneralSettings, advance},
    law::{PowerSpring, RigidStop},
};

const FREQUENCY_HZ: f64 = 0.25;
const CELLS: usize = 14;

/// Hardening spring, two periodic motions at 0.25 Hz.
fn duffing() -> System {
    let cubic = element(&[1.0], 0.0, Law::Power(PowerSpring::cubic(1.0).unwrap()));
    oscillator(1.0, 0.1, 0.3, vec![cubic])
}

fn grid(count: usize) -> Grid {
    let axis = |direction: [f64; 2], reach: f64| Axis {
        direction: direction.into(),
        low: -reach,
        high: reach,
        count,
    };
    Grid { base: vec![0.0; 2], x: axis([1.0, 0.0], 2.0), y: axis([0.0, 1.0], 3.0) }
}

fn basins(system: System, frequency_hz: f64, grid: Grid) -> Basins {
    Basins::new(system, frequency_hz, grid, Effort::default(), ExactSettings::default()).unwrap()
}

fn all(mut basins: Basins, threads: usize) -> (Vec<u32>, Vec<Attractor>) {
    let mut cells = Vec::new();
    while let Some(round) = basins.round(&mut Threads::of(threads)) {
        assert_eq!(round.first, cells.len());
        cells.extend(round.cells);
    }
    (cells, basins.attractors().to_vec())
}

#[test]
fn cells_and_attractors_do_not_depend_on_the_number_of_threads() {
    let of = |threads| all(basins(duffing(), FREQUENCY_HZ, grid(CELLS)), threads);
    let (one, three) = (of(1), of(3));
    assert_eq!(one, three);
    assert_eq!(one.0.len(), CELLS * CELLS);
    assert_eq!(one.1.len(), 2);
    assert!(one.1.iter().all(|attractor| attractor.class == Class::Periodic { period: 1 }));
}

#[test]
fn a_stop_loses_no_finished_round_and_the_rest_has_the_same_bits() {
    let (cells, attractors) = all(basins(duffing(), FREQUENCY_HZ, grid(CELLS)), 2);
    let mut first = basins(duffing(), FREQUENCY_HZ, grid(CELLS));
    let mut kept = Vec::new();
    for _ in 0..6 {
        kept.extend(first.round(&mut Threads::of(2)).unwrap().cells);
    }
    assert!(
        first.round(&mut Threads { is_stopped: true, ..Threads::of(2) }).is_none(),
        "a round that is stopped leaves nothing"
    );
    assert_eq!(first.done(), kept.len());
    let mut second = basins(duffing(), FREQUENCY_HZ, grid(CELLS));
    second.resume(kept.len(), first.attractors().to_vec());
    while let Some(round) = second.round(&mut Threads::of(1)) {
        kept.extend(round.cells);
    }
    assert_eq!(kept, cells);
    assert_eq!(second.attractors(), attractors);
}

/// The general integrator, which shares no code with the exact one, brings the motion of every fifth cell to
/// the same attractor.
#[test]
fn motions_by_the_general_integrator_end_on_the_attractor_of_their_cell() {
    let (cells, attractors) = all(basins(duffing(), FREQUENCY_HZ, grid(CELLS)), 2);
    let (system, grid) = (duffing(), grid(CELLS));
    let scales = state_scales(&system, FREQUENCY_HZ);
    let stretch = Stretch { frequency_hz: FREQUENCY_HZ, start: 0.0, end: 1.0 };
    let settings = GeneralSettings::with_tolerance(1e-9).state_only();
    let mut differing = 0;
    for cell in (0..cells.len()).step_by(5) {
        let mut state = grid.state(cell);
        for _ in 0..120 {
            state = advance(&system, &stretch, &state, &settings).unwrap().flow.state;
        }
        let off = |number: u32| distance(&scales, &attractors[number as usize - 1].states[0], &state);
        differing += usize::from(off(cells[cell]) > 1e-4);
    }
    // A cell on the border of two basins may go either way; none does.
    assert_eq!(differing, 0);
}

/// A single attractor of a linear oscillator has all cells, and the fraction 1 with no error.
#[test]
fn linear_oscillator_has_one_basin() {
    let (cells, attractors) = all(basins(oscillator(1.0, 0.2, 1.0, vec![]), 0.3, grid(6)), 1);
    assert_eq!(attractors.len(), 1);
    let fractions = fractions(&cells, attractors.len());
    assert_eq!((fractions[0].value, fractions[1].value, fractions[1].half_width), (0.0, 1.0, 0.0));
}

/// Chaos of Ueda's oscillator is one attractor, recognised from other cells by where its states lie.
#[test]
fn a_chaotic_attractor_is_recognised_from_every_cell() {
    let cubic = element(&[1.0], 0.0, Law::Power(PowerSpring::cubic(1.0).unwrap()));
    let system = oscillator(0.0, 0.05, 7.5, vec![cubic]);
    let effort = Effort {
        patience: hammerbeam_attractor::Patience { skipped: 50, periods: 100, longest: 8 },
        ..Effort::default()
    };
    let basins = Basins::new(system, 1.0 / TAU, grid(4), effort, ExactSettings::default()).unwrap();
    let (cells, attractors) = all(basins, 2);
    assert_eq!(attractors.len(), 1, "{:?}", attractors.iter().map(|a| a.class).collect::<Vec<_>>());
    assert_eq!(attractors[0].class, Class::Chaotic);
    assert!(cells.iter().all(|&number| number == 1));
}

fn impact_oscillator() -> System {
    let stop = element(&[1.0], 0.0, Law::Rigid(RigidStop::with_gap(0.8, 0.0).unwrap()));
    oscillator(1.0, 0.04, 0.4, vec![stop])
}

/// Chaos of an impact oscillator at 0.48 Hz in two bands that are visited in turn, one of them near the
/// origin, beside an orbit of two periods: as many cells as lead to it, it is one.
#[test]
fn chaos_in_bands_is_one_attractor() {
    let axis =
        |direction: [f64; 2], low: f64, high: f64| Axis { direction: direction.into(), low, high, count: 14 };
    let grid = Grid { base: vec![0.0; 2], x: axis([1.0, 0.0], -1.0, 0.0), y: axis([0.0, 1.0], -1.0, 1.0) };
    let (cells, attractors) = all(basins(impact_oscillator(), 0.48, grid), 2);
    let classes: Vec<Class> = attractors.iter().map(|attractor| attractor.class).collect();
    assert_eq!(classes.iter().filter(|class| **class == Class::Chaotic).count(), 1, "{classes:?}");
    assert_eq!(classes.len(), 2, "{classes:?}");
    assert!(cells.iter().all(|&number| number > 0));
}

/// A motion cannot begin behind a rigid stop.
#[test]
fn cells_behind_a_rigid_stop_belong_to_no_attractor() {
    let axis = |direction: [f64; 2]| Axis { direction: direction.into(), low: -1.0, high: 1.0, count: 4 };
    let grid = Grid { base: vec![0.0; 2], x: axis([1.0, 0.0]), y: axis([0.0, 1.0]) };
    let behind: Vec<bool> = (0..16).map(|cell| grid.state(cell)[0] > 0.0).collect();
    let (cells, _) = all(basins(impact_oscillator(), 0.6, grid), 1);
    assert_eq!(cells.iter().map(|&number| number == 0).collect::<Vec<_>>(), behind);
}

/// Of 4 cells with 1 and 3: fractions 1/4 and 3/4, each with the standard error `sqrt(3/16/4)`.
#[test]
fn sampling_error_of_a_fraction_is_that_of_a_binomial_distribution() {
    let found = fractions(&[1, 2, 2, 2], 2);
    assert_eq!([found[0].value, found[1].value, found[2].value], [0.0, 0.25, 0.75]);
    assert!((found[1].half_width - (3.0_f64 / 64.0).sqrt()).abs() < 1e-15);
}

#[test]
fn grids_that_make_no_sense_are_refused() {
    let of = |grid| Basins::new(duffing(), 0.25, grid, Effort::default(), ExactSettings::default());
    assert!(matches!(of(grid(0)), Err(AttractorError::Input { .. })));
    let mut reversed = grid(3);
    reversed.x.high = -5.0;
    assert!(matches!(of(reversed), Err(AttractorError::Input { what: "the high end of a coordinate", .. })));
    let mut short = grid(3);
    short.base.pop();
    assert!(matches!(of(short), Err(AttractorError::StateLength { found: 1, expected: 2 })));
}
