//! Undamped modes that vibrate freely besides a periodic motion.
//!
//! Where no element acts, the free vibration of an undamped mode may be added to any motion. If its frequency
//! is a multiple of the orbit's, the sum is periodic, too: orbits of every amplitude and phase of the mode
//! belong to one frequency, a family of which none stands out.

use std::f64::consts::TAU;

use hammerbeam_motion::{LocalElement, System};

use crate::{OrbitError, PeriodicSolution, ResonantMode};

/// Relative distance of a harmonic of the orbit from an eigenfrequency up to which that resonates.
const RESONANT: f64 = 1e-6;
/// Load on a mode, relative to the largest on any, that is more than rounding.
const DRIVEN: f64 = 1e-12;
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

/// Why a structure that is driven at this frequency may have no periodic motion: it resonates with an
/// undamped mode ([`OrbitError::Resonance`]). `None` where no load drives such a mode, or where elements act
/// without a contact.
pub(crate) fn resonance(system: &System, frequency_hz: f64) -> Option<OrbitError> {
    let drives = |mode: &usize| {
        let order = harmonic(system, *mode, frequency_hz).round();
        let of_order = |index: &usize| f64::from(system.orders()[*index]) == order;
        (0..system.orders().len()).filter(of_order).any(|index| {
            let load = system.modal_load(index, TAU * frequency_hz).amplitude;
            let largest = load.iter().map(|part| part.norm()).fold(0.0, f64::max);
            load[*mode].norm() > DRIVEN * largest
        })
    };
    let mode = free_modes(system, frequency_hz)?.find(drives)?;
    Some(OrbitError::Resonance { frequency_hz, mode: described(system, mode) })
}

/// The undamped mode whose frequency is a multiple of the frequency of an orbit that touches nothing; `None`
/// where elements act without a contact.
pub(crate) fn resonant_mode(system: &System, base_hz: f64) -> Option<ResonantMode> {
    free_modes(system, base_hz)?.next().map(|mode| described(system, mode))
}

/// The undamped modes whose frequencies are multiples of this one; `None` where elements act without a
/// contact.
fn free_modes(system: &System, base_hz: f64) -> Option<impl Iterator<Item = usize>> {
    let always_acts = |element: &LocalElement| element.law.contacts().is_empty();
    if system.elements().iter().any(always_acts) {
        return None;
    }
    let is_free = move |mode: &usize| {
        let times = harmonic(system, *mode, base_hz);
        let is_whole = (times - times.round()).abs() <= RESONANT * times;
        times > 0.5 && is_whole && !is_damped(system, *mode)
    };
    Some((0..system.dof()).filter(is_free))
}

/// Frequency of a mode over this one.
fn harmonic(system: &System, mode: usize, base_hz: f64) -> f64 {
    system.model().natural_frequencies[mode] / TAU / base_hz
}

fn described(system: &System, mode: usize) -> ResonantMode {
    ResonantMode {
        number: mode + 1,
        frequency_hz: system.model().natural_frequencies[mode] / TAU,
        damping_ratio: damping_ratio(system, mode),
    }
}

/// Whether a mode is damped; of a rigid one any damping counts.
pub(crate) fn is_damped(system: &System, mode: usize) -> bool {
    damping_ratio(system, mode) > UNDAMPED
}

/// Ratio to critical damping of a mode; of a rigid one infinite, or not a number without damping.
fn damping_ratio(system: &System, mode: usize) -> f64 {
    let model = system.model();
    model.damping[(mode, mode)] / (2.0 * model.natural_frequencies[mode])
}
