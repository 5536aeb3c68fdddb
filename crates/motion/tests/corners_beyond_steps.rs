//! Sensitivities of a Hertz contact that nearly opens between two presses, or just does: its stiffness goes
//! like the root of the penetration, so it has a corner at the turn, beyond the ends of the steps beside it.
#![allow(clippy::unwrap_used, reason = "tests")]

use faer::Mat;
use hammerbeam_motion::{
    Load, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    general::{GeneralSettings, observe},
};

use crate::common::{element, force, hertz, model};

/// Two masses pressed by their weight and a force; the frequency decides how deep the turn is.
fn system() -> System {
    let damping = [[0.118_200_966_6, 0.007_405_353_7], [0.007_405_353_7, 0.122_846_786_5]];
    let free = model(&[1.072_350_589_9, 1.998_082_874_7], Mat::from_fn(2, 2, |i, j| damping[i][j]));
    let shaken = force(&[0.790_435_145_7, -0.580_457_912_4], 1, 1.0, -2.291_193_364_6);
    let weight = force(&[0.368_441_699_7, 0.067_294_889_0], 0, 1.0, 0.0);
    let load = Load { support: vec![], forces: vec![shaken, weight] };
    let stop = element(&[0.585_836_860_5, 0.797_747_667_0], 0.0, hertz(32.523_083_356, 0.146_936_408_6));
    System::new(free, &load, vec![stop]).unwrap()
}

const STATE: [f64; 4] = [-2.097_725_111_6, 0.252_226_719_9, 0.864_204_528_0, 0.261_254_488_2];

/// A touch lies within rounding of its level, on either side of it. With a turn just in front of it, its
/// first step must not depend on which side that is.
#[test]
fn steps_from_a_slow_touch_do_not_depend_on_rounding() {
    let system = system();
    let mut slow = 0;
    for off in [-2e-2, -1e-2, -3e-3, -1e-3, 1e-3, 3e-3, 1e-2, 2e-2] {
        let steps = (0..20).map(|number| {
            let frequency_hz = 0.174_236_8 * (1.0 + off) * (1.0 + 1e-14 * f64::from(number));
            let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
            let mut exact = ExactIntegrator::new(system.clone(), ExactSettings { tolerance: 5e-12 }).unwrap();
            exact.flow(&stretch, &STATE).unwrap();
            slow += i32::from(exact.touches().iter().sum::<u32>() > 1);
            exact.counts().steps
        });
        let steps: Vec<u64> = steps.collect();
        assert!(steps.iter().all(|count| *count == steps[0]), "{off}: {steps:?}");
    }
    assert!(slow > 40, "{slow} motions touch twice");
}

/// Against the general integrator, in turns of 1e-7 to 1e-2 m, of contacts that press 0.3 m deep.
#[test]
fn sensitivities_do_not_depend_on_how_little_a_hertz_contact_is_pressed_between_two_presses() {
    let system = system();
    let state = STATE;
    let (mut shallow, mut deep) = (0, 0);
    for number in 0..120 {
        // Densely about the frequency at which it opens.
        let off = if number < 60 { 1e-3 * f64::from(number - 30) } else { 5e-6 * f64::from(number - 90) };
        let stretch = Stretch { frequency_hz: 0.174_236_8 * (1.0 + off), start: 0.0, end: 1.0 };
        let settings = GeneralSettings::with_tolerance(3e-13);
        let expected = observe(&system, &stretch, &state, (&[1.0, 0.0], &[]), &settings).unwrap();
        let turn = expected.extrema.iter().map(|extremum| extremum.abs()).fold(1.0, f64::min);
        if turn < 5e-7 {
            // What the tolerance of the steps leaves of the state is a part of the turn here.
            continue;
        }
        let mut exact = ExactIntegrator::new(system.clone(), ExactSettings { tolerance: 5e-12 }).unwrap();
        let found = exact.flow(&stretch, &state).unwrap().by_state;
        let difference = (&found - &expected.flow.by_state).norm_max() / found.norm_max();
        assert!(difference < 1e-9, "{difference:e} at a turn of {turn:e} m, {} Hz", stretch.frequency_hz);
        shallow += i32::from(turn < 3e-5);
        deep += i32::from(turn > 1e-3);
    }
    assert!(shallow > 10 && deep > 5, "{shallow} and {deep}");
}
