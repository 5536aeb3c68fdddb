//! Contacts that open for an instant between two presses, against closed forms.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::PI;

use crate::common::{diagonal, element, model};
use hammerbeam_motion::{
    Law, Load, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    general::{GeneralSettings, advance},
    law::{HertzStop, LinearStop},
};

/// Matrix that takes displacement and velocity of a vibration of that circular frequency over a time.
fn turned(frequency: f64, time: f64) -> [[f64; 2]; 2] {
    let (sine, cosine) = (frequency * time).sin_cos();
    [[cosine, sine / frequency], [-frequency * sine, cosine]]
}

fn times(a: [[f64; 2]; 2], b: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j]))
}

/// A mass of 1 kg on a spring of 1 N/m, pressed on by a stop of 9 N/m up to the displacement -1 m: closed it
/// vibrates with `sqrt(10)` rad/s about -0.9 m, with the amplitude `0.1 m + opening`.
struct Pressed {
    opening: f64,
}

impl Pressed {
    const FREQUENCY: f64 = 3.162_277_660_168_379_5;

    /// State at a phase since the deepest penetration.
    fn state(&self, phase: f64) -> [f64; 2] {
        let amplitude = 0.1 + self.opening;
        [-0.9 + amplitude * phase.cos(), -amplitude * Self::FREQUENCY * phase.sin()]
    }

    /// Over several openings from one phase to another: the time, and the derivative of the end by the start.
    /// The force has no jump, so the pieces just follow one another.
    fn over(&self, openings: u32, (from, to): (f64, f64)) -> (f64, [[f64; 2]; 2]) {
        let speed = Self::FREQUENCY * (self.opening * (0.2 + self.opening)).sqrt();
        let release = PI - (speed / Self::FREQUENCY).atan2(0.1);
        // `-cos t + v sin t = -1` again.
        let flight = 2.0 * speed.atan();
        let mut phase = from;
        let (mut time, mut derivative) = (0.0, [[1.0, 0.0], [0.0, 1.0]]);
        for end in (0..openings).map(|_| release).chain([to]) {
            let closed = (end - phase) / Self::FREQUENCY;
            derivative = times(turned(Self::FREQUENCY, closed), derivative);
            time += closed;
            if end == release {
                derivative = times(turned(1.0, flight), derivative);
                time += flight;
            }
            phase = -release;
        }
        (time, derivative)
    }
}

/// A mass of 1 kg on a spring of 1 N/m, pressed on by a stop up to the displacement -1 m.
fn pressed_by(stop: Law) -> System {
    System::new(model(&[1.0], diagonal(&[0.0])), &Load::default(), vec![element(&[1.0], 0.0, stop)]).unwrap()
}

fn integrator() -> ExactIntegrator {
    let system = pressed_by(Law::Linear(LinearStop::with_preload(9.0, 9.0).unwrap()));
    ExactIntegrator::new(system, ExactSettings::default()).unwrap()
}

#[test]
fn a_contact_that_opens_for_an_instant_is_two() {
    let mut integrator = integrator();
    for opening in [1e-10, 1e-9, 1e-8, 1e-7, 1e-6] {
        let pressed = Pressed { opening };
        for from in [-3.0, -2.2, -1.0, -0.3, 0.0, 0.4, 1.1, 1.9, 2.6, 3.0, 3.1] {
            for to in [-3.1, -2.5, -0.7, 0.0, 1.3, 2.8] {
                let (time, expected) = pressed.over(3, (from, to));
                let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: time };
                let flow = integrator.flow(&stretch, &pressed.state(from)).unwrap();
                // What the error of the steps leaves undecided of the opening changes the flight with the
                // root of that.
                let allowed = 2e-8 + 1e-10 / opening.sqrt();
                let case = format!("opening {opening:e}, from {from} to {to}");
                assert_eq!(integrator.touches(), [3], "{case}");
                let end = pressed.state(to);
                for i in 0..2 {
                    assert!((flow.state[i] - end[i]).abs() < 1e-10, "{case}: {:?}, not {end:?}", flow.state);
                    for j in 0..2 {
                        let error = (flow.by_state[(i, j)] - expected[i][j]).abs();
                        assert!(error < allowed, "{case}: {error:e} of {expected:?}");
                    }
                }
            }
        }
    }
}

/// What stays closed by as little is one contact, and costs hardly more steps than one that stays closed by
/// far.
#[test]
fn a_contact_that_nearly_opens_is_one() {
    let mut integrator = integrator();
    let mut steps = |opening: f64, (from, to): (f64, f64)| {
        let pressed = Pressed { opening };
        let before = integrator.counts().solves;
        let end = (6.0 * PI + to - from) / Pressed::FREQUENCY;
        let flow =
            integrator.flow(&Stretch { frequency_hz: 1.0, start: 0.0, end }, &pressed.state(from)).unwrap();
        assert_eq!(integrator.touches(), [0], "{opening:e} from {from}");
        let (found, expected) = (flow.state[0], pressed.state(to)[0]);
        assert!((found - expected).abs() < 1e-10, "{opening:e} from {from}: {found}, not {expected}");
        integrator.counts().solves - before
    };
    for from in [-3.0, -1.0, 0.0, 0.4, 1.9, 3.1] {
        for to in [-3.1, -0.7, 0.0, 2.8] {
            let far = steps(-1e-2, (from, to));
            for opening in [-1e-11, -1e-9, -1e-8, -1e-7, -1e-6] {
                let near = steps(opening, (from, to));
                assert!(near <= far + 18, "{opening:e} from {from} to {to}: {near}, not {far}");
            }
        }
    }
}

/// Where the penetration of a Hertz contact comes down to next to nothing the slope of its force turns within
/// the root of that. Without damping the motion is the same forwards and backwards from there.
#[test]
fn a_hertz_contact_that_nearly_opens_has_the_sensitivities_of_the_general_integrator() {
    let system = pressed_by(Law::Hertz(HertzStop::with_preload(9.0, 9.0).unwrap()));
    let mut integrator = ExactIntegrator::new(system.clone(), ExactSettings::default()).unwrap();
    let settings = GeneralSettings::with_tolerance(1e-13);
    let over = |end: f64| Stretch { frequency_hz: 1.0, start: 0.0, end };
    for penetration in [1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5] {
        for (before, behind) in [(1.0, 1.0), (0.3, 1.7), (1.9, 0.2)] {
            let [x, v] =
                advance(&system, &over(before), &[penetration - 1.0, 0.0], &settings).unwrap().flow.state[..]
            else {
                panic!("two numbers")
            };
            let start = [x, -v];
            let expected = advance(&system, &over(before + behind), &start, &settings).unwrap().flow;
            let found = integrator.flow(&over(before + behind), &start).unwrap();
            let case = format!("{penetration:e}, {before} s before and {behind} s behind");
            assert_eq!(integrator.touches(), [0], "{case}");
            for i in 0..2 {
                for j in 0..2 {
                    let error = (found.by_state[(i, j)] - expected.by_state[(i, j)]).abs();
                    assert!(error < 5e-10, "{case}: {error:e}");
                }
            }
        }
    }
}
