//! Modes without damping.
//!
//! With the modal damping matrix C a free vibration of mode i alone decays with the damping ratio `C_ii/(2
//! w_i)`. C is positive semidefinite, so where `C_ii` vanishes the mode is not coupled to others by it
//! either: it never decays, and a pair of multipliers of every orbit on which no stop acts has modulus one.
//! Below a ratio of 1e-10 or so these multipliers cannot be kept apart from the unit circle.
//!
//! A formula that depends on the velocity always acts: the modes that it moves are not free of damping, be it
//! positive or negative.

use std::f64::consts::TAU;

use hammerbeam_motion::System;

/// Damping ratio below which a mode counts as undamped: that which changes a multiplier over a period of the
/// mode by less than it is known to.
pub(super) const NOTHING: f64 = 1e-10;

/// Damping ratio from which on a mode is damped, however fast the excitation is.
const MOST: f64 = 1e-6;

/// A mode that nothing damps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UndampedMode {
    /// Number of the mode, from 1, as `damping.modal_ratio` counts them.
    pub number: usize,
    /// Its eigenfrequency [Hz].
    pub frequency_hz: f64,
    /// Its damping ratio.
    pub ratio: f64,
}

impl std::fmt::Display for UndampedMode {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "mode {} at {} Hz has no damping", self.number, Digits(self.frequency_hz))
    }
}

/// A number with three digits at least.
pub(super) struct Digits(pub f64);

impl std::fmt::Display for Digits {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let decimals = (2.0 - self.0.log10().floor()).clamp(3.0, 12.0) as usize;
        write!(f, "{:.decimals$}", self.0)
    }
}

/// Part of an element's motion below which a mode leaves it at rest.
const AT_A_NODE: f64 = 1e-8;

/// Excitation frequency over the highest eigenfrequency up to which branches are followed with steps of usual
/// length: beyond, a period leaves every mode as it was, up to rounding.
const RESOLVED: f64 = 1e7;

/// The highest excitation frequency at which rounding leaves enough of periodic motion, if the structure
/// vibrates at all [Hz].
pub(super) fn resolved_hz(system: &System) -> Option<f64> {
    let highest = system.model().natural_frequencies.iter().copied().fold(0.0, f64::max);
    (highest > 0.0).then_some(RESOLVED * highest / TAU)
}

/// The modes that vibrate (rigid-body modes are not among them) and that nothing damps, lowest first.
///
/// * `excitation_rate`: 0 for modes that nothing damps at all, else also those that a period of the
///   excitation does not tell from them [1/s].
pub(super) fn undamped_modes(system: &System, excitation_rate: f64) -> Vec<UndampedMode> {
    let model = system.model();
    let modes = model.natural_frequencies.iter().enumerate().filter(|(_, rate)| **rate > 0.0);
    let ratios = modes.map(|(index, rate)| UndampedMode {
        number: index + 1,
        frequency_hz: rate / TAU,
        ratio: model.damping[(index, index)] / (2.0 * rate),
    });
    let is_undamped = |mode: &UndampedMode| {
        let modal: Vec<f64> =
            (0..system.dof()).map(|i| if i + 1 == mode.number { 1.0 } else { 0.0 }).collect();
        let rate = TAU * mode.frequency_hz;
        2.0 * mode.ratio * rate < least_loss(rate, excitation_rate) && !has_damping_force(system, &modal)
    };
    ratios.filter(is_undamped).collect()
}

/// Rate at which a motion has to lose its amplitude [1/s] if a multiplier is to tell it from one that nothing
/// damps: over a period of the motion, or of the excitation if that is shorter. A ratio of a millionth always
/// tells.
pub(super) fn least_loss(rate: f64, excitation_rate: f64) -> f64 {
    2.0 * (NOTHING * excitation_rate).clamp(NOTHING * rate, MOST * rate)
}

/// Whether a force that always acts on a combination of the modes depends on the velocity.
pub(super) fn has_damping_force(system: &System, modal: &[f64]) -> bool {
    let norm = |row: &[f64]| row.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
    system.elements().iter().any(|element| {
        let along: f64 = element.shape.iter().zip(modal).map(|(a, b)| a * b).sum();
        element.law.contacts().is_empty()
            && element.law.depends_on_velocity()
            && along.abs() > AT_A_NODE * norm(&element.shape) * norm(modal)
    })
}
