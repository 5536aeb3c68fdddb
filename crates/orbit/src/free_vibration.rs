//! Undamped modes that vibrate freely besides a periodic motion.
//!
//! Where no element acts, the free vibration of an undamped mode may be added to any motion. If its frequency
//! is a multiple of that of the orbit the sum is periodic, too: orbits of every amplitude and phase of the
//! mode belong to one frequency, a family of which none stands out.

use std::f64::consts::TAU;

use hammerbeam_motion::{LocalElement, System};

use crate::{OrbitError, PeriodicSolution, ResonantMode};

/// Relative distance of a harmonic of the orbit from an eigenfrequency up to which that resonates.
const RESONANT: f64 = 1e-6;
/// Damping ratio up to which a mode counts as undamped here.
const UNDAMPED: f64 = 1e-6;

/// Why the search that led to this orbit cannot give all like it: the orbit touches nothing, and an undamped
/// mode vibrates freely at a multiple of its frequency ([`OrbitError::FreeVibration`]).
#[must_use]
pub fn free_vibration(system: &System, orbit: &PeriodicSolution) -> Option<OrbitError> {
    let base_hz = orbit.frequency_hz / f64::from(orbit.period_multiple);
    let mode = resonant_mode(system, base_hz).filter(|_| orbit.maxima.contacts == 0)?;
    Some(OrbitError::FreeVibration { base_hz, mode })
}

/// The undamped mode whose frequency is a multiple of that of an orbit that touches nothing; `None` where
/// elements act without a contact.
pub(crate) fn resonant_mode(system: &System, base_hz: f64) -> Option<ResonantMode> {
    let always_acts = |element: &LocalElement| element.law.contacts().is_empty();
    if system.elements().iter().any(always_acts) {
        return None;
    }
    let frequencies = &system.model().natural_frequencies;
    let resonates = |w: f64| {
        let harmonic = w / TAU / base_hz;
        w > 0.0 && harmonic > 0.5 && (harmonic - harmonic.round()).abs() <= RESONANT * harmonic
    };
    let is_free = |mode: &usize| resonates(frequencies[*mode]) && !is_damped(system, *mode);
    (0..frequencies.len()).find(is_free).map(|mode| ResonantMode {
        number: mode + 1,
        frequency_hz: frequencies[mode] / TAU,
        damping_ratio: damping_ratio(system, mode),
    })
}

/// Whether a mode vibrates and is damped.
pub(crate) fn is_damped(system: &System, mode: usize) -> bool {
    system.model().natural_frequencies[mode] > 0.0 && damping_ratio(system, mode) > UNDAMPED
}

/// Ratio to critical damping of a mode, which vibrates.
fn damping_ratio(system: &System, mode: usize) -> f64 {
    let model = system.model();
    model.damping[(mode, mode)] / (2.0 * model.natural_frequencies[mode])
}
