//! The work of a period, which no clock has to show: a few per cent above what it is.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::paper_beam;
use hammerbeam_attractor::{SectionMap, SystemMap};
use hammerbeam_motion::exact::ExactSettings;

/// One contact in a period: one step to its middle and one to its release, whose length takes two tries each.
#[test]
fn a_period_with_one_contact_takes_two_steps_four_solves_and_ten_looks() {
    let mut map = SystemMap::new(paper_beam(), 36.0, 1, ExactSettings { tolerance: 1e-9 }).unwrap();
    let mut state = vec![0.0; 12];
    for period in 0..300 {
        state = map.advance(period, &state).unwrap();
    }
    let before = map.integrator().counts();
    for period in 0..100 {
        state = map.advance(period, &state).unwrap();
    }
    let after = map.integrator().counts();
    assert_eq!(map.integrator().touches(), [1]);
    let per_period = |before: u64, after: u64| (after - before) as f64 / 100.0;
    assert!(per_period(before.steps, after.steps) < 2.1);
    assert!(per_period(before.solves, after.solves) < 4.2);
    assert!(per_period(before.looks, after.looks) < 10.5);
}
