//! Work counts of fixed motions, so that a slow-down that no clock shows still fails. Budgets lie a little
//! above what was measured.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{integrator, paper_beam, settled, uniform_beam};
use hammerbeam_motion::{Stretch, System, exact::ExactCounts};

/// Work of a flow over one cycle from the state after `cycles` cycles from rest, and the contacts on the way.
fn work(system: &System, frequency_hz: f64, cycles: u32, sensitivities: bool) -> (ExactCounts, u32) {
    let state = settled(system, frequency_hz, cycles, 0.0);
    let mut exact = integrator(system);
    let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
    if sensitivities {
        exact.flow(&stretch, &state).unwrap();
    } else {
        exact.advance(&stretch, &state).unwrap();
    }
    (exact.counts(), exact.touches().iter().sum())
}

fn assert_within(found: ExactCounts, [looks, steps, solves]: [u64; 3], what: &str) {
    assert!(found.looks <= looks && found.steps <= steps && found.solves <= solves, "{what}: {found:?}");
}

/// One contact takes three steps and six solves, sensitivities included.
#[test]
fn flows_of_the_beam_keep_their_budgets() {
    let system = paper_beam();
    for (frequency_hz, contacts, budget) in [
        (36.0, 1, [12, 4, 8]),
        (41.0, 1, [12, 4, 8]),
        (66.0, 1, [12, 5, 10]),
        (28.0, 2, [23, 8, 16]),
        (99.0, 0, [3, 0, 0]),
    ] {
        let (found, touches) = work(&system, frequency_hz, 100, true);
        assert_eq!(touches, contacts, "{frequency_hz} Hz");
        assert_within(found, budget, &format!("{frequency_hz} Hz"));
    }
}

#[test]
fn states_alone_need_fewer_steps() {
    let system = paper_beam();
    for (frequency_hz, budget) in [(36.0, [12, 4, 8]), (28.0, [23, 6, 12])] {
        let (found, _) = work(&system, frequency_hz, 100, false);
        assert_within(found, budget, &format!("{frequency_hz} Hz"));
    }
}

/// Sixteen times the modes take under ten times the steps for three contacts, at nearly the same work per
/// step and mode. The looks for touches are nearly the same. Where modes turn by many radians in a step their
/// power series prove nothing any more (`enclosure.rs`), and it takes up to one more look a step to prove
/// that the contact stays closed: 132 looks with 96 modes.
#[test]
fn steps_grow_slower_than_the_modes() {
    for (modes, budget) in [
        (6, [30, 14, 28]),
        (12, [32, 15, 30]),
        (24, [35, 42, 66]),
        (48, [40, 74, 105]),
        (96, [140, 115, 170]),
    ] {
        let (found, contacts) = work(&uniform_beam(modes), 31.0, 40, false);
        assert_eq!(contacts, 3, "{modes} modes");
        assert_within(found, budget, &format!("{modes} modes"));
    }
}

/// Long after the last contact, and with a gap that is never reached, a look takes a good part of the cycle.
#[test]
fn quiet_flights_need_few_looks() {
    let system = crate::common::beam_with(0.015, crate::common::hertz(4.5e9, 5e-3));
    let (found, contacts) = work(&system, 60.0, 30, true);
    assert_eq!(contacts, 0);
    assert_within(found, [3, 0, 0], "60 Hz");
}
