//! Harmonics of the modes in an orbit, by the general integrator.

use std::f64::consts::TAU;

use hammerbeam_motion::{
    Stretch,
    general::{GeneralSettings, sample},
};
use hammerbeam_orbit::PeriodicSolution;

use super::ObservedSystem;

/// Amplitudes of the harmonics `0..=highest` of a mode over one orbit of one excitation period.
pub fn harmonics(rig: &ObservedSystem, orbit: &PeriodicSolution, mode: usize, highest: u32) -> Vec<f64> {
    const SAMPLES: u32 = 128;
    let phases: Vec<f64> = (0..SAMPLES).map(|k| f64::from(k) / f64::from(SAMPLES)).collect();
    let stretch = Stretch { frequency_hz: orbit.frequency_hz, start: 0.0, end: 1.0 };
    let settings = GeneralSettings::with_tolerance(1e-8);
    let states = sample(&rig.system, &stretch, &orbit.nodes[0], &phases, &settings).unwrap();
    let amplitude = |order: u32| {
        let (mut cosine, mut sine) = (0.0, 0.0);
        for (phase, state) in phases.iter().zip(&states) {
            let angle = TAU * f64::from(order) * phase;
            cosine += state[mode] * angle.cos();
            sine += state[mode] * angle.sin();
        }
        f64::hypot(cosine, sine) * 2.0 / f64::from(SAMPLES)
    };
    (0..=highest).map(amplitude).collect()
}

/// Order of the strongest harmonic of a mode, from `lowest` to 13.
pub fn strongest_harmonic(rig: &ObservedSystem, orbit: &PeriodicSolution, mode: usize, lowest: u32) -> u32 {
    let amplitudes = harmonics(rig, orbit, mode, 13);
    (lowest..=13).max_by(|&a, &b| amplitudes[a as usize].total_cmp(&amplitudes[b as usize])).unwrap()
}
