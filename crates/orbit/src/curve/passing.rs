//! The flow of an orbit that touches a contact at its ends and passes it.
//!
//! Beside a touch the flow depends on which side of it the motion lies: where the contact closes for an
//! instant its force acts for as short a time as one likes, its law may need the speed of the impact, and a
//! rigid stop throws the motion back, with a fundamental matrix that is like the root of the depth. A grazing
//! orbit is the end of those that pass without contact. So for a short time after the begin and before the
//! end the touched element is left out, its gap opened wide: the equations are those of the motions that
//! pass, smooth on both sides of the touch, and on the curve, where the clearance and its rate vanish, those
//! of the system itself.
//!
//! A closed contact that is touched from inside is kept: its force sets in with the penetration, and one that
//! opens for an instant leaves out little: of the state the power 3/2 of the distance, or more.
//!
//! A symmetric orbit touches the opposite contact half a period later: there that one is left out as well,
//! and so it is as long as the curve goes: over a parameter that breaks the symmetry too, where the curve is
//! that of the first contact and holds only to the side on which the motion leaves the other: where it would
//! be struck the curve ends (`opposite.rs`).
//!
//! How long: a quarter of the time to the nearest other contact of the element, at most [`WIDEST`]. The
//! solution does not depend on it. Within [`TOUCH`] of the touch a contact is the touch.

use hammerbeam_motion::{
    Parameter, Stretch,
    exact::{ExactIntegrator, Maxima, MotionError},
};

use super::{grazing::Touch, shooting::Shooting};
use crate::{OrbitError, OrbitMaxima, OrbitSettings, PeriodicSolution, Response, solve};

/// Longest time for which the element is left out [cycles].
const WIDEST: f64 = 1.0 / 32.0;
/// Times this near the touch are the touch [cycles].
const TOUCH: f64 = 1e-3;
/// The gap is opened to so many times the largest gap and the orbit.
const WIDE: f64 = 1e3;

/// What is left out, and how long.
#[derive(Debug)]
pub(super) struct Passing {
    /// Of the system with the opened gaps.
    pub integrator: ExactIntegrator,
    /// What is touched at the ends of the orbit, and what opposite.
    touches: Vec<Touch>,
    /// How long behind the begin of the orbit the opposite contact is touched [cycles].
    opposite: Option<f64>,
    /// How long elements are left out, at each side of a touch [cycles].
    pub width: f64,
}

impl Passing {
    /// Leaves out elements beside their touches; `None` if one has no gap.
    ///
    /// * `opposite`: the contact that is touched half a period later, and how long after the first.
    /// * `range`: of the parameter that is followed.
    pub fn new(
        shooting: &Shooting,
        (touch, opposite): (Touch, Option<(Touch, f64)>),
        response: &Response,
        (start, range): (&PeriodicSolution, (f64, f64)),
        orbits: &OrbitSettings,
    ) -> Result<Option<Self>, OrbitError> {
        let touches: Vec<Touch> = [touch].into_iter().chain(opposite.map(|(touch, _)| touch)).collect();
        let mut system = shooting.integrator.system().clone();
        let mut is_parameter = false;
        for Touch { element, .. } in &touches {
            let gap = Parameter::gap(*element);
            let Some(level) = shooting.integrator.system().elements()[*element].law.gap() else {
                return Ok(None);
            };
            is_parameter |= shooting.parameter == gap;
            let largest = if shooting.parameter == gap { range.1.abs().max(range.0.abs()) } else { level };
            let wide = WIDE * (largest + start.maxima.displacement);
            system = system.with_parameter(gap, wide).map_err(MotionError::from)?;
        }
        let mut integrator = solve::integrator(&system, response, orbits)?;
        if !is_parameter {
            integrator.differentiate_by(Some(shooting.parameter))?;
        }
        let opposite = opposite.map(|(_, behind)| behind);
        Ok(Some(Self { integrator, touches, opposite, width: WIDEST }))
    }

    /// Gives the parameter that is followed another value.
    pub fn set_parameter(&mut self, parameter: Parameter, value: f64) -> Result<(), MotionError> {
        if self.touches.iter().any(|touch| parameter == Parameter::gap(touch.element)) {
            return Ok(());
        }
        self.integrator.set_parameter(parameter, value)
    }

    /// The contact that is touched opposite, and how long behind the begin of the orbit [cycles].
    pub fn opposite(&self) -> Option<(Touch, f64)> {
        Some((*self.touches.get(1)?, self.opposite?))
    }

    /// Where elements are left out, of an orbit from `begin` over `cycles`.
    fn windows(&self, begin: f64, cycles: f64) -> Vec<[f64; 2]> {
        let mut windows = vec![[begin, begin + self.width], [begin + cycles - self.width, begin + cycles]];
        windows.extend(self.opposite.map(|o| [begin + o - self.width, begin + o + self.width]));
        windows
    }
}

impl Shooting {
    /// The parts of a stretch of an orbit from `begin` on, and whether touched elements are left out in them.
    pub fn parts(&self, stretch: Stretch, begin: f64) -> Vec<(Stretch, bool)> {
        let Some(passing) = &self.passing else { return vec![(stretch, false)] };
        let windows = passing.windows(begin, f64::from(self.period_multiple));
        let mut cuts: Vec<f64> = windows.iter().flatten().copied().collect();
        cuts.retain(|cut| stretch.start < *cut && *cut < stretch.end);
        cuts.extend([stretch.start, stretch.end]);
        cuts.sort_by(f64::total_cmp);
        let part = |cuts: &[f64]| {
            let middle = 0.5 * (cuts[0] + cuts[1]);
            let passes = windows.iter().any(|[from, to]| (*from..=*to).contains(&middle));
            (Stretch { start: cuts[0], end: cuts[1], ..stretch }, passes)
        };
        cuts.windows(2).map(part).collect()
    }

    /// The state at the end of a stretch of the orbit that begins at the phase `begin`, in its own units.
    pub fn advance(&mut self, stretch: Stretch, begin: f64, state: &[f64]) -> Result<Vec<f64>, MotionError> {
        let mut state = state.to_vec();
        for (part, passes) in self.parts(stretch, begin) {
            state = self.integrator_of(passes).advance(&part, &state)?;
        }
        Ok(state)
    }

    /// The integrator of a part of the orbit.
    pub fn integrator_of(&mut self, passes: bool) -> &mut ExactIntegrator {
        match &mut self.passing {
            Some(passing) if passes => &mut passing.integrator,
            _ => &mut self.integrator,
        }
    }

    /// Leaves touched elements out as long as their other contacts allow, over the orbit that begins with
    /// `state` at its touch.
    pub fn fit_passing(&mut self, frequency_hz: f64, begin: f64, state: &[f64]) -> Result<(), MotionError> {
        let Some(passing) = &self.passing else { return Ok(()) };
        let (touches, opposite) = (passing.touches.clone(), passing.opposite);
        let cycles = f64::from(self.period_multiple);
        let first = Stretch { frequency_hz, start: begin, end: begin + TOUCH };
        let state = self.integrator_of(true).advance(&first, state)?;
        let rest = Stretch { frequency_hz, start: first.end, end: begin + cycles - TOUCH };
        let trace = self.integrator.trace(&rest, &state, &[])?;
        let length = (rest.end - rest.start) / frequency_hz;
        let of_elements =
            trace.contacts.iter().filter(|contact| touches.iter().any(|t| t.element == contact.element));
        let distances = of_elements.filter_map(|contact| {
            // Times behind the begin of the orbit [cycles].
            let from = TOUCH + contact.since() * frequency_hz;
            let to = TOUCH + contact.clear.unwrap_or(length) * frequency_hz;
            let to_ends = from.min(cycles - to);
            let Some(opposite) = opposite else { return Some(to_ends) };
            let to_opposite = (from - opposite).max(opposite - to);
            let is_it = from > opposite - TOUCH && to < opposite + TOUCH;
            (!is_it).then_some(to_ends.min(to_opposite))
        });
        let nearest = distances.fold(f64::INFINITY, f64::min);
        if let Some(passing) = &mut self.passing {
            passing.width = WIDEST.min(0.25 * nearest.max(0.0));
        }
        Ok(())
    }

    /// Maxima of the orbit whose segments begin at these phases with these states.
    pub fn observe(&mut self, stretches: &[Stretch], nodes: &[Vec<f64>]) -> Result<OrbitMaxima, OrbitError> {
        if self.passing.is_none() {
            return solve::observe(&mut self.integrator, stretches, nodes);
        }
        let begin = stretches[0].start;
        let mut all: Option<Maxima> = None;
        for (stretch, node) in stretches.iter().zip(nodes) {
            let mut state = node.clone();
            for (part, passes) in self.parts(*stretch, begin) {
                let integrator = self.integrator_of(passes);
                let maxima = integrator.observe(&[(part, &state)])?;
                state = integrator.advance(&part, &state)?;
                all = Some(all.map_or(maxima, |all| all.and(&maxima)));
            }
        }
        Ok(all.unwrap_or_default().into())
    }
}
