//! A branch over a range much wider than its frequencies: slow orbits are known as well as fast ones.
//!
//! `x'' + 0.1 x' + x = cos 2 pi f t` with 5 N/m more beyond 0.72 m; its walk begins at fifty times its
//! frequency. What is left of each orbit after its period is measured by the general integrator, and by the
//! orbit itself.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use crate::common::events::{misses_itself_by, oscillator, side, step_of};
use hammerbeam_motion::{Law, law::LinearStop};
use hammerbeam_orbit::{Side, StopReason, find_start};

const RANGE: (f64, f64) = (0.02, 10.0);

#[test]
fn an_orbit_far_below_the_frequency_of_the_start_closes_as_well() {
    let subject = oscillator(1.0, 0.1, 1.0, Law::Linear(LinearStop::with_gap(5.0, 0.72).unwrap()));
    let settings = step_of(0.01);
    let start = find_start(&subject.0, &subject.1, 8.0, 1, &settings).unwrap();
    let (rows, reason) = side(&subject, &start, Side::Down, RANGE, &settings);
    assert_eq!(reason, StopReason::RangeEnd { place: RANGE.0 });
    let slow: Vec<_> =
        rows.iter().map(|row| &row.solution).filter(|orbit| orbit.frequency_hz < 0.12).collect();
    assert!(slow.len() > 50, "{} orbits", slow.len());
    for orbit in slow {
        let miss = misses_itself_by(&subject.0, orbit) * state_norm(&orbit.nodes[0]);
        assert!(miss < 1e-9 * orbit.maxima.displacement, "at {} Hz: {miss:.2e} m", orbit.frequency_hz);
    }
}

/// The eigenfrequency is 1 rad/s: velocities are as large as displacements.
fn state_norm(state: &[f64]) -> f64 {
    state[0].hypot(state[1])
}
