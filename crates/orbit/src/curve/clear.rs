//! An orbit cut where fundamental matrices do not jump, before a curve is followed from it
//! (`start_phase.rs`).

use hammerbeam_motion::{Stretch, exact::ExactIntegrator};

use crate::{OrbitError, PeriodicSolution, cut::offset_to_clear};

/// An orbit whose segments end away from contacts at which fundamental matrices jump, as far as there is
/// room.
pub(super) fn cut_clear(
    integrator: &mut ExactIntegrator,
    orbit: &PeriodicSolution,
) -> Result<PeriodicSolution, OrbitError> {
    let (cycles, frequency_hz) = (f64::from(orbit.period_multiple), orbit.frequency_hz);
    let length = cycles / orbit.nodes.len() as f64;
    let phases = (orbit.phase, cycles, length);
    let mut cut = orbit.clone();
    if let Some(offset) = offset_to_clear(integrator, phases, &orbit.nodes[0], frequency_hz)? {
        cut.phase = (orbit.phase + offset).rem_euclid(cycles);
        for (k, node) in cut.nodes.iter_mut().enumerate() {
            let start = orbit.phase + k as f64 * length;
            *node = integrator.advance(&Stretch { frequency_hz, start, end: start + offset }, node)?;
        }
    }
    Ok(cut)
}
