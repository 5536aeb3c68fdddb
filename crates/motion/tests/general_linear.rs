//! The general integrator against closed forms of linear systems.
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use std::f64::consts::TAU;

use crate::common::{element, hertz};
use crate::general_common::{assert_columns_close, assert_near, diagonal, harmonic_force, model};
use faer::c64;
use hammerbeam_motion::{
    Flow, Load, LocalElement, Stretch, System,
    general::{GeneralSettings, advance, sample},
};

const FREQUENCY: f64 = 3.0;
const STRETCH: Stretch = Stretch { frequency_hz: FREQUENCY, start: 0.3, end: 2.55 };
const FORCE: f64 = 40.0;

/// One oscillator `q'' + c q' + w^2 q = F cos(2 pi cycles)` with complex roots: everything in closed form.
struct Oscillator {
    roots: [c64; 2],
    stiffness: f64,
    damping: f64,
}

impl Oscillator {
    fn new(stiffness: f64, damping: f64) -> Self {
        let root = c64::new(damping * damping / 4.0 - stiffness, 0.0).sqrt();
        Self { roots: [-damping / 2.0 + root, -damping / 2.0 - root], stiffness, damping }
    }

    /// `[a b; c d]`, and its derivative by the time.
    fn propagator(&self, time: f64) -> [[f64; 4]; 2] {
        let [r, s] = self.roots;
        let (er, es) = ((r * time).exp(), (s * time).exp());
        let of = |er: c64, es: c64| {
            let unit = (er - es) / (r - s);
            let rate = (r * er - s * es) / (r - s);
            [((r * es - s * er) / (r - s)).re, unit.re, -self.stiffness * unit.re, rate.re]
        };
        [of(er, es), of(r * er, s * es)]
    }

    /// Particular motion at a phase and its derivatives by the frequency and the phase, as [q, v].
    fn particular(&self, frequency: f64, cycles: f64) -> [[f64; 2]; 3] {
        let (w, i) = (TAU * frequency, c64::new(0.0, 1.0));
        let h = FORCE / (self.stiffness - w * w + i * w * self.damping);
        let dh = -h * h / FORCE * (i * self.damping - 2.0 * w) * TAU;
        let e = (i * TAU * cycles).exp();
        let (de, speed) = (i * TAU * e, i * w);
        [
            [(h * e).re, (speed * h * e).re],
            [(dh * e).re, (speed * dh * e + i * TAU * h * e).re],
            [(h * de).re, (speed * h * de).re],
        ]
    }

    /// State and sensitivities at the end of [`STRETCH`].
    fn flow(&self, stretch: &Stretch, state: [f64; 2]) -> ([f64; 2], [f64; 4], [f64; 2]) {
        let duration = stretch.duration();
        let [e, de] = self.propagator(duration);
        let [p0, p0_f, _] = self.particular(stretch.frequency_hz, stretch.start);
        let [p1, p1_f, _] = self.particular(stretch.frequency_hz, stretch.end);
        let homogeneous = [state[0] - p0[0], state[1] - p0[1]];
        let apply = |m: [f64; 4], x: [f64; 2]| [m[0] * x[0] + m[1] * x[1], m[2] * x[0] + m[3] * x[1]];
        let (free, rate, load) = (apply(e, homogeneous), apply(de, homogeneous), apply(e, p0_f));
        let stretching = -duration / stretch.frequency_hz;
        let end = [free[0] + p1[0], free[1] + p1[1]];
        let by_frequency = [0, 1].map(|k| p1_f[k] - load[k] + stretching * rate[k]);
        (end, e, by_frequency)
    }
}

fn oscillator_system(stiffness: f64, damping: f64) -> System {
    oscillator_with(stiffness, damping, vec![])
}

fn oscillator_with(stiffness: f64, damping: f64, elements: Vec<LocalElement>) -> System {
    let model = model(&[stiffness.sqrt()], diagonal(&[damping]));
    let load = Load { support: vec![], forces: vec![harmonic_force(&[1.0], 1, FORCE, 0.0)] };
    System::new(model, &load, elements).unwrap()
}

fn assert_flow(flow: &Flow, exact: &([f64; 2], [f64; 4], [f64; 2]), tolerance: f64) {
    let (state, by_state, by_frequency) = exact;
    let part = |value: f64, other: f64, what: &str| {
        assert_near(value, other, tolerance * other.abs().max(1e-3), what);
    };
    for k in 0..2 {
        part(flow.state[k], state[k], "state");
        part(flow.by_frequency[k], by_frequency[k], "by frequency");
        for j in 0..2 {
            part(flow.by_state[(k, j)], by_state[2 * k + j], "by state");
        }
    }
}

#[test]
fn damped_forced_oscillators_agree_with_the_closed_form() {
    for (stiffness, damping) in [(900.0, 3.0), (900.0, 0.0), (25.0, 40.0), (0.0, 2.0), (355.0, 0.4)] {
        let state = [0.02, -0.5];
        let settings = GeneralSettings::with_tolerance(1e-12);
        let flow = advance(&oscillator_system(stiffness, damping), &STRETCH, &state, &settings).unwrap().flow;
        assert_flow(&flow, &Oscillator::new(stiffness, damping).flow(&STRETCH, state), 1e-10);
    }
}

/// An undamped motion turns where its excitation does, and what is left of its velocity there is rounding.
#[test]
fn a_motion_that_turns_at_the_start_is_followed() {
    for speed in [1e-13, -1e-15, 3e-17, -1e-19] {
        let state = [0.02, speed];
        let settings = GeneralSettings::with_tolerance(1e-12);
        let flow = advance(&oscillator_system(900.0, 0.0), &STRETCH, &state, &settings).unwrap().flow;
        assert_flow(&flow, &Oscillator::new(900.0, 0.0).flow(&STRETCH, state), 1e-10);
    }
}

/// A rigid-body mode without damping: `q'' = F cos(2 pi cycles)`.
#[test]
fn an_undamped_rigid_mode_agrees_with_the_closed_form() {
    let state = [0.02, -0.5];
    let flow =
        advance(&oscillator_system(0.0, 0.0), &STRETCH, &state, &GeneralSettings::with_tolerance(1e-12));
    let flow = flow.unwrap().flow;
    let (w, duration) = (TAU * FREQUENCY, STRETCH.duration());
    let (a, b) = (TAU * STRETCH.start, TAU * STRETCH.end);
    let position = |f: f64| {
        let (w, duration) = (TAU * f, (STRETCH.end - STRETCH.start) / f);
        state[0] + state[1] * duration + FORCE / (w * w) * (a.cos() - b.cos() - w * duration * a.sin())
    };
    let speed = state[1] + FORCE / w * (b.sin() - a.sin());
    assert_near(flow.state[0], position(FREQUENCY), 1e-12, "displacement");
    assert_near(flow.state[1], speed, 1e-11, "velocity");
    assert_near(flow.by_state[(0, 1)], duration, 1e-12, "displacement by velocity");
    assert_near(flow.by_state[(1, 0)], 0.0, 1e-12, "velocity by displacement");
    let by_frequency = -state[1] * duration / FREQUENCY
        - 2.0 / FREQUENCY * (position(FREQUENCY) - state[0] - state[1] * duration);
    assert_near(flow.by_frequency[0], by_frequency, 1e-11, "displacement by frequency");
    assert_near(flow.by_frequency[1], -(speed - state[1]) / FREQUENCY, 1e-11, "velocity by frequency");
}

#[test]
fn errors_are_proportional_to_the_tolerance() {
    let exact = Oscillator::new(900.0, 3.0).flow(&STRETCH, [0.02, -0.5]);
    for tolerance in [1e-6, 1e-8, 1e-10, 1e-12] {
        let settings = GeneralSettings::with_tolerance(tolerance);
        let flow = advance(&oscillator_system(900.0, 3.0), &STRETCH, &[0.02, -0.5], &settings).unwrap().flow;
        assert_flow(&flow, &exact, 20.0 * tolerance);
    }
}

#[test]
fn samples_lie_on_the_closed_form() {
    let oscillator = Oscillator::new(900.0, 3.0);
    let phases: Vec<f64> =
        (0..=60).map(|k| STRETCH.start + (STRETCH.end - STRETCH.start) * f64::from(k) / 60.0).collect();
    let settings = GeneralSettings::with_tolerance(1e-11);
    let states = sample(&oscillator_system(900.0, 3.0), &STRETCH, &[0.02, -0.5], &phases, &settings).unwrap();
    for (state, &end) in states.iter().zip(&phases) {
        let (exact, _, _) = oscillator.flow(&Stretch { end, ..STRETCH }, [0.02, -0.5]);
        assert_near(state[0], exact[0], 1e-9 * 0.1, "displacement");
        assert_near(state[1], exact[1], 1e-9 * 2.0, "velocity");
    }
}

/// `q'' + c q' + w^2 q = b_0` from rest settles on `b_0 / w^2`.
#[test]
fn a_constant_load_bends_to_its_static_displacement() {
    let model = model(&[20.0], diagonal(&[15.0]));
    let load = Load { support: vec![], forces: vec![harmonic_force(&[2.0], 0, 5.0, 0.0)] };
    let system = System::new(model, &load, vec![]).unwrap();
    let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: 6.0 };
    let flow = advance(&system, &stretch, &[0.0, 0.0], &GeneralSettings::with_tolerance(1e-11)).unwrap().flow;
    assert_near(flow.state[0], 10.0 / 400.0, 1e-12, "static displacement");
}

/// `det(by_state) = exp(-T tr C)`, with dampers that couple the modes.
#[test]
fn volumes_shrink_with_the_trace_of_the_damping() {
    let damping = [[2.0, 1.5, 0.3], [1.5, 4.0, -0.7], [0.3, -0.7, 1.0]];
    let matrix = faer::Mat::from_fn(3, 3, |i, j| damping[i][j]);
    let system = System::new(model(&[5.0, 30.0, 60.0], matrix), &Load::default(), vec![]).unwrap();
    let stretch = Stretch { frequency_hz: 4.0, start: 0.0, end: 3.0 };
    let flow = advance(&system, &stretch, &[0.1; 6], &GeneralSettings::with_tolerance(1e-12)).unwrap().flow;
    assert_near(flow.by_state.determinant() / (-7.0 * stretch.duration()).exp(), 1.0, 1e-9, "determinant");
}

#[test]
fn stretches_compose() {
    let system = oscillator_system(900.0, 3.0);
    let settings = GeneralSettings::with_tolerance(1e-12);
    let whole = advance(&system, &STRETCH, &[0.02, -0.5], &settings).unwrap().flow;
    let first = advance(&system, &Stretch { end: 1.1, ..STRETCH }, &[0.02, -0.5], &settings).unwrap().flow;
    let second = advance(&system, &Stretch { start: 1.1, ..STRETCH }, &first.state, &settings).unwrap().flow;
    assert_columns_close(&whole.state, &second.state, 1e-11);
    let product = &second.by_state * &first.by_state;
    for j in 0..2 {
        let column = |m: &faer::Mat<f64>| (0..2).map(|i| m[(i, j)]).collect::<Vec<_>>();
        assert_columns_close(&column(&whole.by_state), &column(&product), 1e-10);
    }
    let carried: Vec<f64> = (0..2)
        .map(|i| {
            second.by_frequency[i]
                + (0..2).map(|j| second.by_state[(i, j)] * first.by_frequency[j]).sum::<f64>()
        })
        .collect();
    assert_columns_close(&whole.by_frequency, &carried, 1e-10);
}

/// Far above its frequencies a structure moves by a millionth of a gap, and its steps are as good as that.
#[test]
fn a_motion_far_smaller_than_a_gap_is_as_accurate_as_another() {
    let (stiffness, damping) = (900.0, 3.0);
    for (frequency_hz, gap) in [(1e3, 1.0), (3e4, 1.0), (1e4, 1e3)] {
        let closed_form = Oscillator::new(stiffness, damping);
        let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
        let [state, ..] = closed_form.particular(frequency_hz, 0.0);
        assert!(state[0].abs() < 1e-4 * gap);
        let system = oscillator_with(stiffness, damping, vec![element(&[1.0], 0.0, hertz(1e8, gap))]);
        let settings = GeneralSettings::with_tolerance(1e-11);
        let end = advance(&system, &stretch, &state, &settings).unwrap().flow.state;
        let largest = state[0].hypot(state[1] / (TAU * frequency_hz));
        assert_near(end[0], state[0], 3e-10 * largest, "displacement");
        assert_near(end[1], state[1], 3e-10 * largest * TAU * frequency_hz, "velocity");
    }
}
