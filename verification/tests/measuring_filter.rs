//! How much a low-pass filter of 850 Hz lowers the largest acceleration of the paper's beam: van de Vorst,
//! Fey, de Kraker and van Campen put their shift of 600 % down to it.
//!
//! The orbit at 36.2 Hz (their figure 9) goes through the filter twice: line by line of its spectrum
//! (`periodic_low_pass`), and in time, through the differential equations of two sections `x'' + 2 z w_c x' +
//! w_c^2 x = w_c^2 u`, `z = cos(pi/8), cos(3 pi/8)`, by Runge and Kutta's method over two periods, of which
//! the first lets them settle. The ratios are those that a calculation with SciPy's `butter(4, ...,
//! analog=True)` and `freqs` gave from 32 768 samples of the motion that simulation settles to.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use std::f64::consts::{PI, TAU};

use crate::common::paper_beam;
use hammerbeam_motion::{
    Stretch,
    exact::{ExactIntegrator, ExactSettings},
};
use hammerbeam_orbit::{OrbitSettings, find_start};
use hammerbeam_signal::filter::periodic_low_pass;

const FREQUENCY: f64 = 36.2;
const SAMPLES: usize = 1 << 15;

fn largest(series: &[f64]) -> f64 {
    series.iter().fold(0.0, |largest, value| largest.max(value.abs()))
}

/// One period behind two sections that have run for one period before.
fn by_runge_kutta(input: &[f64], step: f64, cut_off_hz: f64) -> Vec<f64> {
    let w = TAU * cut_off_hz;
    let rate = |x: [f64; 4], u: f64| {
        let section = |k: usize, u: f64, z: f64| w * w * (u - x[k]) - 2.0 * z * w * x[k + 1];
        [x[1], section(0, u, (PI / 8.0).cos()), x[3], section(2, x[0], (3.0 * PI / 8.0).cos())]
    };
    let after = |x: [f64; 4], k: [f64; 4], h: f64| -> [f64; 4] { std::array::from_fn(|i| x[i] + h * k[i]) };
    let (mut x, mut output) = ([0.0; 4], Vec::with_capacity(2 * input.len()));
    for i in 0..2 * input.len() {
        output.push(x[2]);
        let (u, next) = (input[i % input.len()], input[(i + 1) % input.len()]);
        let middle = 0.5 * (u + next);
        let k1 = rate(x, u);
        let k2 = rate(after(x, k1, 0.5 * step), middle);
        let k3 = rate(after(x, k2, 0.5 * step), middle);
        let k4 = rate(after(x, k3, step), next);
        x = std::array::from_fn(|i| x[i] + step / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
    }
    output.split_off(input.len())
}

#[test]
fn filter_of_850_hz_lowers_the_largest_acceleration_seven_times_and_leaves_the_displacement() {
    let rig = paper_beam();
    let orbit = find_start(&rig.system, &rig.response, FREQUENCY, 1, &OrbitSettings::default()).unwrap();
    assert!(orbit.stable());
    let mut integrator = ExactIntegrator::new(rig.system.clone(), ExactSettings::default()).unwrap();
    let phases: Vec<f64> = (0..SAMPLES).map(|k| orbit.phase + k as f64 / SAMPLES as f64).collect();
    let stretch = Stretch { frequency_hz: FREQUENCY, start: orbit.phase, end: orbit.phase + 1.0 };
    let states = integrator.trace(&stretch, &orbit.nodes[0], &phases).unwrap().samples;
    let (dof, angular) = (rig.system.dof(), TAU * FREQUENCY);
    let of_shape = |q: &[f64]| rig.response.shape.iter().zip(q).map(|(phi, q)| phi * q).sum::<f64>();
    let motion = states.iter().zip(&phases).map(|(state, phase)| {
        let support = rig.response.support_ratios[0] * 0.5015e-3 * (TAU * phase).cos();
        let rate = rig.system.rate(FREQUENCY, *phase, state);
        (support + of_shape(&state[..dof]), of_shape(&rate[dof..]) - angular * angular * support)
    });
    let (displacement, acceleration): (Vec<f64>, Vec<f64>) = motion.unzip();
    assert!((largest(&acceleration) / orbit.maxima.acceleration - 1.0).abs() < 1e-4);
    let duration = 1.0 / FREQUENCY;
    let behind =
        |series: &[f64], cut_off_hz| largest(&periodic_low_pass(series, duration, (4, cut_off_hz)).unwrap());
    for (cut_off_hz, expected) in [(850.0, 7.053), (1500.0, 4.048), (3000.0, 2.127)] {
        let found = behind(&acceleration, cut_off_hz);
        let in_time = largest(&by_runge_kutta(&acceleration, duration / SAMPLES as f64, cut_off_hz));
        // Straight lines between samples lower a line of 3000 Hz by (w h)^2/12 = 2e-5, and those above it by
        // more.
        assert!((found / in_time - 1.0).abs() < 5e-5, "{cut_off_hz} Hz: {found} and {in_time} m/s^2");
        let ratio = orbit.maxima.acceleration / found;
        assert!((ratio - expected).abs() < 1e-3, "{cut_off_hz} Hz: {ratio}");
    }
    let ratio = orbit.maxima.displacement / behind(&displacement, 850.0);
    assert!((ratio - 1.0).abs() < 4e-4, "displacements: {ratio}");
}
