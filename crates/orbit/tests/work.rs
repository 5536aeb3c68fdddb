//! Work counts along fixed stretches of the harmonic branch: evaluations of the shooting equations per
//! accepted solution.
//!
//! The counts are deterministic; they hold what it takes to locate flips, Neimark-Sacker points and grazing.
//! The bounds lie a few percent above what was measured, so that a change which costs evaluations is seen.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use crate::common::{beam, orbit_at, walk};
use hammerbeam_orbit::{OrbitSettings, Side};

/// Evaluations per accepted solution on the way from one frequency to the other.
fn evaluations_per_solution(from_hz: f64, to_hz: f64, max_step: f64) -> f64 {
    let subject = beam();
    let (system, response) = &subject;
    let settings = OrbitSettings { max_step, ..OrbitSettings::default() };
    let start = orbit_at(&subject, from_hz);
    let side = if to_hz > from_hz { Side::Up } else { Side::Down };
    let range = (from_hz.min(to_hz), from_hz.max(to_hz));
    let (rows, evaluations) = walk(system, response, &start, side, range, &settings);
    evaluations as f64 / (rows.len() - 1) as f64
}

macro_rules! pinned {
    ($($name:ident: $from:literal to $to:literal Hz at $step:literal Hz <= $bound:literal;)*) => {
        $(#[test]
        fn $name() {
            let found = evaluations_per_solution($from, $to, $step);
            assert!(found <= $bound, "{found}");
        })*
    };
}

pinned! {
    dense_folds_at_the_default_step: 30.0 to 19.0 Hz at 0.02 Hz <= 2.47;
    resonance_and_beyond_at_the_default_step: 30.0 to 60.0 Hz at 0.02 Hz <= 2.20;
    smooth_part_at_the_default_step: 50.0 to 55.0 Hz at 0.02 Hz <= 2.07;
    smooth_part_at_a_step_of_0_001_hz: 50.0 to 50.5 Hz at 0.001 Hz <= 1.02;
    resonance_at_a_step_of_0_001_hz: 36.0 to 36.5 Hz at 0.001 Hz <= 1.02;
}
