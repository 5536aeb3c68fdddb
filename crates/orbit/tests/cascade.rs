//! A cascade of period doublings: `x'' + 0.1 x' + k(x) x = cos(2 pi f t)`, `k = 1` for `x < 0` and 20 for
//! `x > 0`, from 0.172 Hz down.
//!
//! The distances of successive doublings tend to the ratio 4.669 (Feigenbaum, J. Stat. Phys. 19 (1978),
//! 25-52); after three of them it is near, not there.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use std::sync::OnceLock;

use crate::common::events::{
    Subject, general_multipliers, leaving, oscillator, settled_period, side, step_of, with,
};
use hammerbeam_motion::{Law, law::LinearStop};
use hammerbeam_orbit::{BranchRow, Side, find_start};

const RANGE: (f64, f64) = (0.15, 0.18);

fn subject() -> Subject {
    oscillator(1.0, 0.1, 1.0, Law::Linear(LinearStop::with_gap(19.0, 0.0).unwrap()))
}

/// The flips of the orbits of 1, 2, 4 and 8 periods, each on the branch that leaves the one before.
fn flips() -> &'static [BranchRow] {
    static FLIPS: OnceLock<Vec<BranchRow>> = OnceLock::new();
    FLIPS.get_or_init(|| {
        let (subject, settings) = (subject(), step_of(1e-4));
        let start = find_start(&subject.0, &subject.1, 0.178, 1, &settings).unwrap();
        let (mut rows, _) = side(&subject, &start, Side::Down, RANGE, &settings);
        let mut flips = Vec::new();
        for _ in 0..4 {
            let flip = with(&rows, |events| events.flip)[0].clone();
            rows = leaving(&subject, &flip, Side::Up, RANGE, &settings).0;
            flips.push(flip);
        }
        flips
    })
}

#[test]
fn each_doubling_is_found_on_the_branch_of_the_one_before() {
    let multiples: Vec<u32> = flips().iter().map(|flip| flip.solution.period_multiple).collect();
    assert_eq!(multiples, [1, 2, 4, 8]);
    for flip in flips() {
        let multipliers = general_multipliers(&subject().0, &flip.solution);
        let nearest = multipliers.iter().map(|[re, im]| (re + 1.0).hypot(*im)).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-6, "{nearest:.1e} at {} Hz", flip.solution.frequency_hz);
    }
}

#[test]
fn distances_shrink_nearly_by_feigenbaums_ratio() {
    let at: Vec<f64> = flips().iter().map(|flip| flip.solution.frequency_hz).collect();
    let ratio = (at[1] - at[2]) / (at[2] - at[3]);
    assert!((ratio - 4.669).abs() < 0.8, "{ratio} of {at:?} Hz");
}

/// Between two doublings motion settles on the orbit of that period, without any shooting.
#[test]
fn simulation_between_the_doublings_settles_to_2_4_and_8_periods() {
    let (system, _) = subject();
    for pair in flips()[1..].windows(2) {
        let (first, second) = (&pair[0].solution, &pair[1].solution);
        let frequency_hz = 0.4 * first.frequency_hz + 0.6 * second.frequency_hz;
        let settled = settled_period(&system, frequency_hz, &second.nodes[0], (600, 16), 1e-6);
        assert_eq!(settled, Some(second.period_multiple as usize), "{frequency_hz} Hz");
    }
}
