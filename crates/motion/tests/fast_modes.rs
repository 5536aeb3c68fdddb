//! Modes that turn many times within a contact, struck by it: motions without sensitivities, whose steps are
//! as long as the state alone allows, are those of the general integrator.
//!
//! A spring sets in with a jump of the rate of its force, which leaves a vibration of `phi^2 k v/w^3` in a
//! mode of the frequency w: 2e-10 m in the fastest of the beam, which turns up to sixty times in the longest
//! steps. At half the touches the level lies behind the place, by rounding.
#![allow(clippy::unwrap_used, reason = "tests")]

use hammerbeam_motion::{
    Law, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    general::{GeneralSettings, advance},
    law::LinearStop,
};
use hammerbeam_testkit::{SeededNumbers, paper_rig_with, stride};

/// The beam of the paper between two springs that turn it around in a tenth of a period.
fn between_springs() -> System {
    let spring = || Law::Linear(LinearStop::with_gap(2e4, 1e-3).unwrap());
    paper_rig_with(0.015, &[(1.0, spring()), (-1.0, spring())]).system
}

/// Largest difference from the general integrator of a state after half a period, relative to its norm, and
/// steps per touch: of 60 states, by default of a third of them.
fn largest_error(tolerance: f64) -> (f64, f64) {
    let system = between_springs();
    let frequencies = system.model().natural_frequencies.clone();
    let n = frequencies.len();
    let mut exact = ExactIntegrator::new(system.clone(), ExactSettings { tolerance }).unwrap();
    let (mut largest, mut touches, mut random) = (0.0_f64, 0, SeededNumbers(11));
    for _ in (0..60).step_by(stride(3)) {
        let frequency_hz = 16.0 + 10.0 * random.number();
        let stretch = Stretch { frequency_hz, start: random.number(), end: 2.0 };
        let stretch = Stretch { end: stretch.start + 0.5, ..stretch };
        let mut state = vec![0.0; 2 * n];
        for i in 0..n {
            let size = 0.1 / (1.0 + 5.0 * i as f64).powi(2);
            state[i] = size * (2.0 * random.number() - 1.0) / frequencies[i];
            state[n + i] = size * (2.0 * random.number() - 1.0);
        }
        let found = exact.advance(&stretch, &state).unwrap();
        touches += exact.touches().iter().sum::<u32>();
        let settings = GeneralSettings::with_tolerance(1e-12);
        let expected = advance(&system, &stretch, &state, &settings).unwrap().flow.state;
        let scale = |i: usize| if i < n { frequencies[i] } else { 1.0 };
        let norm =
            |value: &dyn Fn(usize) -> f64| (0..2 * n).map(|i| (value(i) * scale(i)).powi(2)).sum::<f64>();
        let error = norm(&|i| found[i] - expected[i]) / norm(&|i| expected[i]);
        largest = largest.max(error.sqrt());
    }
    (largest, exact.counts().steps as f64 / f64::from(touches))
}

/// Each of the few steps of a contact may have an error of four tolerances.
#[test]
fn states_of_long_steps_are_those_of_the_general_integrator() {
    for tolerance in [1e-9, 1e-10, 1e-11] {
        let (error, steps) = largest_error(tolerance);
        assert!(error < 16.0 * tolerance, "{error:.1e} at {tolerance:e}");
        assert!(steps < 16.0, "{steps} a touch at {tolerance:e}");
    }
}
