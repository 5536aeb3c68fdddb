//! Flips of `x'' + 0.1 x' + x^3 = 10 cos(2 pi f t)` (Ueda's oscillator; a spring of 1e-6 N/m only gives the state its scale) on its
//! asymmetric orbits, and of the softening `x'' + 0.2 x' + x - x^3 = F cos`, checked without shooting.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

mod common;

use common::events::{
    Subject, alternation, assert_same, exponent, general_advance, general_multipliers, growth, oscillator,
    settled_period, sorted, step_of, whole, with,
};
use hammerbeam_motion::{Law, law::CubicSpring};
use hammerbeam_orbit::{
    BranchRow, EventStatus, OrbitSettings, PeriodicSolution, Side, StopReason, find_start,
};

/// The well of the softening spring and the branch that leans to lower frequencies.
const SOFTENING: (f64, f64) = (0.07, 0.2);

/// `x'' + 0.3 x' + x - x^3 = 0.3 cos(2 pi f t)`: before it escapes from its well the orbit loses its symmetry and doubles its period.
fn softening() -> Subject {
    oscillator(1.0, 0.2, 0.23, Law::Cubic(CubicSpring::new(-1.0).unwrap()))
}

#[test]
fn explore() {
    let subject = softening();
    for (from, range) in [(0.19, SOFTENING), (0.08, SOFTENING)] {
        let Ok(start) = find_start(&subject.0, &subject.1, from, 1, &step_of(5e-4)) else { println!("none at {from}"); continue };
        let rows = whole(&subject, &start, range, &step_of(5e-4));
        for row in rows.iter().filter(|row| row.located.is_some()) {
            println!("{from} {} {} {:?}", row.events.label(), row.solution.frequency_hz, row.solution.floquet_multipliers);
        }
        println!("{} rows {} {}", rows.len(), rows[0].solution.frequency_hz, rows[rows.len()-1].solution.frequency_hz);
    }
}
