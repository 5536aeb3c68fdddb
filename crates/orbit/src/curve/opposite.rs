//! The contact opposite to the one of a grazing curve, which is touched half a period later as long as orbits
//! are symmetric.
//!
//! # Mathematics
//! Over a parameter that breaks the symmetry a curve of the first contact has the clearance `c` at the
//! second, with `c = 0` where the symmetry holds. It is the clearance of orbits that pass the second contact,
//! which is left out beside its touch (`passing.rs`): where `c > 0` it is not missed, where `c < 0` it would
//! be struck, and these are orbits of another system. So `c` is a test function of the curve, and its zero an
//! end. Beyond, both contacts are grazed at once only at single points, and the curve of the first contact
//! with impacts at the second starts there.
//!
//! Where the symmetry holds all along the curve, `c` is zero up to errors of points. Therefore the zero of `c
//! + e` is taken, with the depth `e` of [`TOUCHED`], to which the second contact is grazed at the end.

use hammerbeam_motion::{Stretch, exact::MotionError};

use super::shooting::{CurveOrbit, Shooting};

/// Depth to which a contact is grazed, in parts of the orbit.
const TOUCHED: f64 = 1e-6;
/// Looks for the least clearance beside the opposite touch.
const LOOKS: usize = 64;

/// Least clearance of the opposite contact beside its touch, in parts of the orbit, beyond the depth to
/// which it is grazed; `None` if the curve has no such contact.
pub(super) fn opposite_clearance(
    shooting: &mut Shooting,
    place: &CurveOrbit,
) -> Result<Option<f64>, MotionError> {
    let Some(passing) = &shooting.passing else { return Ok(None) };
    let Some((touch, behind)) = passing.opposite() else { return Ok(None) };
    let (frequency_hz, width) = (place.frequency_hz, passing.width);
    let [start, end] = [behind - width, behind + width].map(|offset| place.phase + offset);
    let window = Stretch { frequency_hz, start, end };
    shooting.set_parameter(place.value)?;
    let state = state_at(shooting, place, start)?;
    let phases: Vec<f64> = (0..=LOOKS).map(|k| start + (end - start) * k as f64 / LOOKS as f64).collect();
    let clearances = |of: &mut Shooting, phases: &[f64]| -> Result<Vec<[f64; 2]>, MotionError> {
        let samples = of.integrator_of(true).trace(&window, &state, phases)?.samples;
        let at = phases.iter().zip(&samples);
        Ok(at.map(|(phase, state)| touch.clearance(of, frequency_hz, *phase, state)).collect())
    };
    let looked = clearances(shooting, &phases)?;
    let turns: Vec<f64> = phases
        .windows(2)
        .zip(looked.windows(2))
        .filter(|(_, looks)| looks[0][1] <= 0.0 && looks[1][1] > 0.0)
        .map(|(phases, looks)| {
            // A step of the secant method on the rate.
            phases[0] + looks[0][1] / (looks[0][1] - looks[1][1]) * (phases[1] - phases[0])
        })
        .collect();
    let turned = clearances(shooting, &turns)?;
    let least = looked.iter().chain(&turned).map(|[clearance, _]| *clearance).fold(f64::INFINITY, f64::min);
    Ok(Some(least / touch.reach(shooting) + TOUCHED))
}

/// The state of an orbit at a phase, in its own units, from the node before it.
fn state_at(shooting: &mut Shooting, place: &CurveOrbit, phase: f64) -> Result<Vec<f64>, MotionError> {
    let size = shooting.size();
    let length = shooting.cycles() / shooting.count as f64;
    let from = (((phase - place.phase) / length).max(0.0) as usize).min(shooting.count - 1);
    let node = &place.nodes[from * size..(from + 1) * size];
    let state: Vec<f64> = node.iter().zip(shooting.scale.values()).map(|(x, s)| x * s).collect();
    let start = shooting.stretch(from, place.frequency_hz, place.phase).start;
    let stretch = Stretch { frequency_hz: place.frequency_hz, start, end: phase };
    if phase > start { shooting.advance(stretch, place.phase, &state) } else { Ok(state) }
}

/// Name of the element of the opposite contact.
pub(super) fn opposite_name(shooting: &Shooting) -> Option<String> {
    let (touch, _) = shooting.passing.as_ref()?.opposite()?;
    Some(shooting.integrator.system().elements()[touch.element].name.clone())
}
