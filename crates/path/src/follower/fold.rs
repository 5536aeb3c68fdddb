//! Locating a fold: the zero of `t_λ` on the way to the trial.

use super::{
    arrival::Arrival,
    assessment::parameter_slope,
    attempt::Attempt,
    bracket::Bracket,
    locator::{Locator, Probing},
};
use crate::error::StepDoubt;

/// Enough for bisection to reach rounding, were it needed.
const MOST_PROBES: u32 = 60;

/// Ends the step at the fold before the trial: `|t_λ| ≤ fold_tolerance`, or a bracket of rounding.
pub(super) fn arrive_at_fold(attempt: &mut Attempt<'_>, locator: &mut Locator) -> Result<Arrival, StepDoubt> {
    let frame = attempt.frame;
    let (reached, floor) = (frame.settings.fold_tolerance, frame.settings.correction_floor);
    let before = attempt.state.parameter_sign;
    let slope = parameter_slope(attempt);
    let start = before * (before * slope.start).max(f64::MIN_POSITIVE);
    let mut bracket = Bracket::new((0.0, start), (attempt.progress(), slope.end));
    let mut place = bracket.width() * slope.root();
    for probes in 0..MOST_PROBES {
        let probing = Probing { bracket: &bracket, reached, place, goes_on: probes > 0, sharply: false };
        let value =
            locator.probe_toward_zero(attempt, &probing, |probe, _| Some(probe.tangent_parameter()))?;
        check_probe(attempt, locator)?;
        bracket.narrow(place, value);
        if value.abs() <= reached || bracket.uncertainty(value) <= floor {
            break;
        }
        place = bracket.next();
    }
    let uncertainty = bracket.uncertainty(locator.probe.tangent_parameter());
    locator.arrive(attempt);
    if !attempt.is_in_range() {
        return Err(StepDoubt::NotLocated);
    }
    let mut arrival = Arrival { parameter_sign: Some(-before), uncertainty, ..Arrival::default() };
    arrival.events.fold = true;
    Ok(arrival)
}

fn check_probe(attempt: &Attempt<'_>, locator: &Locator) -> Result<(), StepDoubt> {
    if locator.probe.sign * attempt.state.orientation < 0.0 {
        return Err(StepDoubt::Reversed);
    }
    let changed = locator.probe.signature != attempt.state.current.signature;
    if changed && attempt.step > attempt.settings().signature_step {
        Err(StepDoubt::Signature)
    } else {
        Ok(())
    }
}
