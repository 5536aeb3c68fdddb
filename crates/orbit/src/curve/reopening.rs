//! Where a contact reopens a curve ends, as a branch does (`orbit/src/reopening.rs`).
//!
//! On the side on which the contact has opened the map over a period has a part `u h^(1/5)`, with the height
//! h of the flight. Multipliers go like `h^(-4/5)` there, and the gradient of a condition on them like
//! `h^(-9/5)`. So steps shrink in proportion to what is left of h: the curve comes nearer by some factor with
//! each step, to no end but rounding. On the other side the border is not seen until a step has passed it,
//! onto orbits of another motion. So it is the end of a curve
//!
//! - that a step has changed how often a contact is touched, and this contact reopens in the orbit before or
//!   behind the step;
//! - that its last [`SHORT_STEPS`] rows came no further than [`SHORT`] each, on the average, and a contact
//!   reopens in the present orbit;
//! - that no step leads on from an orbit in which a contact reopens, or that derivatives of matrices could
//!   not be had there at several rows in a row, as at a grazing.

use hammerbeam_path::Follower;

use super::{
    problem::CurveProblem,
    row::CurveEnd,
    shooting::{CurveOrbit, Shooting},
};
use crate::reopening::{self, Reopening, SHORT_STEPS};

/// An average step that is short [hundredths of the ranges]: other curves take half of one, some shorter ones
/// where something happens.
const SHORT: f64 = 1e-3;

/// An orbit of the curve.
#[derive(Debug)]
pub(super) struct Passed {
    place: CurveOrbit,
    /// Touches of each contact.
    touches: Vec<u32>,
}

/// Counts how far a curve gets in its rows.
#[derive(Debug, Default)]
pub(super) struct ReopeningWatch {
    /// Arc length at which it was last asked whether the curve comes to a reopening.
    asked_at: f64,
}

impl ReopeningWatch {
    /// The end, if the last step, which led away from `before`, has passed a reopening or is the last of many
    /// short ones towards one.
    pub fn comes_to_reopening(
        &mut self,
        problem: &mut CurveProblem,
        follower: &Follower,
        before: &Passed,
    ) -> Option<CurveEnd> {
        let shooting = &problem.shooting;
        let system = shooting.integrator.system();
        let changed = reopening::elements_with_other_touches(system, &before.touches, &shooting.touches);
        if !changed.is_empty() {
            let current = problem.place(&follower.current().point);
            for place in [&before.place, &current] {
                let found = reopening_of(&mut problem.shooting, place);
                if let Some(found) = found.filter(|found| changed.contains(&found.element)) {
                    return Some(reopens_at(before.place.value, found));
                }
            }
        }
        if self.takes_short_steps(follower) { reopens_here(problem, follower) } else { None }
    }

    /// Whether the last [`SHORT_STEPS`] rows were short of one another, asked once in so many.
    fn takes_short_steps(&mut self, follower: &Follower) -> bool {
        let accepted = follower.counters().accepted;
        if !accepted.is_multiple_of(SHORT_STEPS) {
            return false;
        }
        let arc_length = follower.current().arc_length;
        let way = arc_length - std::mem::replace(&mut self.asked_at, arc_length);
        way < SHORT * SHORT_STEPS as f64
    }
}

/// The present orbit, at which the equations were evaluated last, if a contact of it may reopen.
pub(super) fn may_reopen(problem: &CurveProblem, follower: &Follower) -> Option<Passed> {
    let shooting = &problem.shooting;
    let can_reopen = shooting.integrator.system().remembers_impacts();
    let place = || problem.place(&follower.current().point);
    can_reopen.then(|| Passed { place: place(), touches: shooting.touches.clone() })
}

/// The end, if a contact of the present orbit reopens.
pub(super) fn reopens_here(problem: &mut CurveProblem, follower: &Follower) -> Option<CurveEnd> {
    let Passed { place, .. } = may_reopen(problem, follower)?;
    reopening_of(&mut problem.shooting, &place).map(|found| reopens_at(place.value, found))
}

/// Where a contact of an orbit reopens.
fn reopening_of(shooting: &mut Shooting, place: &CurveOrbit) -> Option<Reopening> {
    shooting.set_parameter(place.value).ok()?;
    let state = place.nodes.iter().zip(shooting.scale.values()).map(|(x, s)| x * s).collect();
    let span = (place.frequency_hz, f64::from(shooting.period_multiple));
    reopening::find(&mut shooting.integrator, (place.phase, state), span).ok()?
}

fn reopens_at(parameter: f64, Reopening { element, phase }: Reopening) -> CurveEnd {
    CurveEnd::ContactReopens { parameter, element, phase }
}
