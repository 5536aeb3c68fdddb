//! The closing question of van de Vorst, Fey, de Kraker and van Campen: what damping in the contact does to
//! the beam, whose measured modal damping, 0.003, is a fifth of the 0.015 that their main case has. Law:
//! Lankarani and Nikravesh, J. Mech. Des. 112 (1990), 369-376.
//!
//! The numbers are our own, read off branches over 34 to 45 Hz (docs/validation/conclusions.md); what
//! is asserted is that orbits found afresh at the peaks have them, and their order.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use crate::common::{ObservedSystem, hertz, paper_beam_with};
use hammerbeam_motion::{
    Law,
    law::{HertzStop, RestitutionModel, RestitutionStop},
};
use hammerbeam_orbit::{OrbitSettings, find_start};

fn with_restitution(e: f64) -> ObservedSystem {
    let elastic = HertzStop::with_gap(4.5e9, 0.0).unwrap();
    let law = RestitutionStop::new(elastic, RestitutionModel::LankaraniNikravesh, e).unwrap();
    paper_beam_with(0.003, &[(-1.0, Law::Restitution(law))])
}

/// Largest displacement [mm] of the stable harmonic orbit at a frequency.
fn peak(rig: &ObservedSystem, frequency_hz: f64) -> f64 {
    subharmonic_peak(rig, frequency_hz, 1)
}

/// The same of an orbit of that many periods.
fn subharmonic_peak(rig: &ObservedSystem, frequency_hz: f64, period_multiple: u32) -> f64 {
    let settings = OrbitSettings::default();
    let orbit = find_start(&rig.system, &rig.response, frequency_hz, period_multiple, &settings).unwrap();
    assert!(orbit.stable());
    1e3 * orbit.maxima.displacement
}

/// A coefficient of 0.6 (of which 0.76 comes out) takes as much from the main peak as five times the modal
/// damping.
#[test]
fn contact_damping_brings_the_main_peak_down_to_that_of_five_times_the_modal_damping() {
    let found = [
        (peak(&paper_beam_with(0.015, &[(-1.0, hertz(4.5e9, 0.0))]), 36.2925), 5.896),
        (peak(&paper_beam_with(0.003, &[(-1.0, hertz(4.5e9, 0.0))]), 36.0328), 13.28),
        (peak(&with_restitution(0.9), 36.0399), 9.151),
        (peak(&with_restitution(0.6), 36.0551), 5.672),
    ];
    for (found, expected) in found {
        // Four digits are printed, and the peaks are flat.
        assert!((found / expected - 1.0).abs() < 2e-4, "{found} mm, not {expected} mm");
    }
}

/// The same coefficient brings the main peaks of the 1/2 and the 1/3 subharmonic branch down to those of five
/// times the modal damping, too, where they would be more than twice as high.
#[test]
fn the_same_coefficient_does_it_for_the_subharmonic_peaks() {
    let elastic = |ratio| paper_beam_with(ratio, &[(-1.0, hertz(4.5e9, 0.0))]);
    let found = [
        (subharmonic_peak(&elastic(0.015), 72.2089, 2), 9.285),
        (subharmonic_peak(&elastic(0.003), 72.0386, 2), 21.10),
        (subharmonic_peak(&with_restitution(0.6), 72.0834, 2), 9.250),
        (subharmonic_peak(&elastic(0.015), 108.0475, 3), 16.26),
        (subharmonic_peak(&elastic(0.003), 108.0180, 3), 36.08),
        (subharmonic_peak(&with_restitution(0.6), 108.0854, 3), 16.27),
    ];
    for (found, expected) in found {
        assert!((found / expected - 1.0).abs() < 5e-4, "{found} mm, not {expected} mm");
    }
}
