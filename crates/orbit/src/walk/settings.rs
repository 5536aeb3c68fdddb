//! How a walk goes: units, settings of the path, segments.

use hammerbeam_motion::System;
use hammerbeam_path::Settings;

use crate::{OrbitSettings, PeriodicSolution, Segments, cut::must_start_off_contacts};

/// Shortest step with rigid stops, over that without. An impact of the speed v depends on the orbit like
/// `1/v`, and v on the distance from grazing like its root: a point of the path, good to its
/// `correction_floor`, has a speed of its own only down to about 1e-5 of the orbit's. Below, the path would
/// take ever shorter steps through noise; so its turn there is taken as the corner that it is.
const SHORTEST_AT_IMPACTS: f64 = 100.0;

/// Residual to which orbits with rigid stops are corrected: an impact of the speed v makes `1/v` times as
/// much of what is left of the state, so a small correction says nothing there.
const RESIDUAL_AT_IMPACTS: f64 = 1e-11;

/// Residual to which other orbits are corrected. Where hard contacts make the monodromy matrix large, though
/// its multipliers are not, a correction within the tolerance leaves a residual of 1e-7 and multipliers that
/// are known to nothing: such solutions were called marginal, one by one between unstable ones.
const RESIDUAL: f64 = 1e-8;

/// Change of the frequency, relative to it, and residual, over the tolerance, from which on an orbit is
/// corrected further. Over a range up to 20 kHz a correction within the tolerance moves a motion of 20 Hz by
/// 1e-9 of a period.
const PARAMETER: f64 = 0.1;

/// Steps without progress, over the number elsewhere, with stops beside whose contacts an orbit cannot be cut
/// as one likes. Towards the border at which a contact of an impact-speed-dependent law reopens, multipliers
/// grow beyond 1e7 and steps are a ten-millionth of the range: 50 000 of them led over 1e-3 Hz, and not to
/// the border.
const SHORT_BESIDE_IMPACTS: f64 = 10.0;

/// Hertz of arc length that a change of the orbit by the size of the start counts: a hundredth of the range.
pub(crate) fn length_per_norm((low, high): (f64, f64)) -> f64 {
    (high - low) / 100.0
}

/// Settings of the path from the settings of the orbits; `length` is [`length_per_norm`].
pub(crate) fn path_settings(settings: &OrbitSettings, system: &System, length: f64) -> Settings {
    let default = Settings::default();
    let short = if must_start_off_contacts(system) { SHORT_BESIDE_IMPACTS } else { 1.0 };
    let (shortest, wanted) =
        if system.has_rigid_stops() { (SHORTEST_AT_IMPACTS, RESIDUAL_AT_IMPACTS) } else { (1.0, RESIDUAL) };
    Settings {
        initial_step: 0.1 * settings.max_step,
        max_parameter_step: settings.max_step,
        max_step_length: 2.0 * settings.max_step,
        min_step: shortest * default.min_step * length,
        short_step: short * default.short_step * length,
        correction_tolerance: settings.tolerance * length,
        correction_floor: default.correction_floor * length,
        // Rounding of the residual grows with the multipliers.
        residual_floor: 100.0 * default.residual_floor,
        residual_wanted: wanted,
        parameter_tolerance: PARAMETER * settings.tolerance,
        sheet_distance: default.sheet_distance * length,
        signature_step: default.signature_step * length,
        max_points: settings.max_solutions as u64,
        ..default
    }
}

/// Segments of an orbit: more where the largest multiplier would carry a guess away within the period, and a
/// whole number of them per excitation period, so that an orbit of shorter period is known when it is met.
/// Nodes must not lie in contacts of impact-speed-dependent laws, nor on impacts: then there is one.
pub(super) fn segment_count(system: &System, start: &PeriodicSolution, settings: &OrbitSettings) -> usize {
    match settings.segments {
        Segments::Fixed(count) => count.max(1),
        Segments::Automatic if must_start_off_contacts(system) => 1,
        Segments::Automatic => {
            let largest = start.largest_multiplier();
            let by_growth = (largest.max(1.0).ln() / 1e3_f64.ln()).ceil().max(1.0) as usize;
            let by_contacts = start.maxima.contacts as usize / 12 + 1;
            by_growth.max(by_contacts).min(16).next_multiple_of(start.period_multiple as usize)
        }
    }
}
