//! The flow of an orbit that touches a contact at its ends and passes it.
//!
//! Beside a touch the flow depends on which side of it the motion lies: where the contact closes for an instant its force acts for as short a time as one likes, its law may need the speed of the impact, and a rigid stop throws the
//! motion back, with a fundamental matrix that is like the root of the depth. A grazing orbit is the end of those that pass without contact. So for a short time after the begin and before the end the touched element is left out, its gap opened
//! wide: the equations are those of the motions that pass, smooth on both sides of the touch, and on the curve, where the clearance and its rate vanish, those of the system itself.
//!
//! A closed contact that is touched from inside is kept: its force sets in with the penetration, and one that opens for an instant leaves out little: of the state the power 3/2 of the distance, or more.
//!
//! How long: a quarter of the time to the nearest other contact of the element, at most [`WIDEST`]. The solution does not depend on it. Within [`TOUCH`] of the touch a contact is the touch.

use hammerbeam_motion::{
    Parameter, Stretch,
    exact::{ExactIntegrator, Maxima, MotionError},
};

use super::shooting::Shooting;
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
    /// Of the system with the opened gap.
    pub integrator: ExactIntegrator,
    pub element: usize,
    /// How long the element is left out, at each end [cycles].
    pub width: f64,
}

impl Passing {
    /// Leaves out an element beside the ends of an orbit; `None` if it has no gap.
    ///
    /// * `range`: of the parameter that is followed.
    pub fn new(
        (shooting, element): (&Shooting, usize),
        response: &Response,
        (start, range): (&PeriodicSolution, (f64, f64)),
        orbits: &OrbitSettings,
    ) -> Result<Option<Self>, OrbitError> {
        let system = shooting.integrator.system();
        let gap = Parameter::Gap { element };
        let Some(level) = system.elements()[element].law.gap() else { return Ok(None) };
        let largest = if shooting.parameter == gap { range.1.abs().max(range.0.abs()) } else { level };
        let wide = WIDE * (largest + start.maxima.displacement);
        let system = system.clone().with_parameter(gap, wide).map_err(MotionError::from)?;
        let mut integrator = solve::integrator(&system, response, orbits)?;
        if shooting.parameter != gap {
            integrator.differentiate_by(Some(shooting.parameter))?;
        }
        Ok(Some(Self { integrator, element, width: WIDEST }))
    }

    /// Gives the parameter that is followed another value.
    pub fn set_parameter(&mut self, parameter: Parameter, value: f64) -> Result<(), MotionError> {
        if parameter == (Parameter::Gap { element: self.element }) {
            return Ok(());
        }
        self.integrator.set_parameter(parameter, value)
    }
}

impl Shooting {
    /// The parts of a stretch of an orbit from `begin` on, and whether the touched element is left out in them.
    pub fn parts(&self, stretch: Stretch, begin: f64) -> Vec<(Stretch, bool)> {
        let Some(passing) = &self.passing else { return vec![(stretch, false)] };
        let end = begin + f64::from(self.period_multiple);
        let [low, high] = [begin + passing.width, end - passing.width];
        let cuts = [
            stretch.start,
            low.clamp(stretch.start, stretch.end),
            high.clamp(stretch.start, stretch.end),
            stretch.end,
        ];
        let part =
            |(k, passes): (usize, bool)| (Stretch { start: cuts[k], end: cuts[k + 1], ..stretch }, passes);
        [(0, true), (1, false), (2, true)]
            .map(part)
            .into_iter()
            .filter(|(part, _)| part.end > part.start)
            .collect()
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

    /// Leaves the touched element out as long as its other contacts allow, over the orbit that begins with `state` at its touch.
    pub fn fit_passing(&mut self, frequency_hz: f64, begin: f64, state: &[f64]) -> Result<(), MotionError> {
        let Some(element) = self.passing.as_ref().map(|passing| passing.element) else { return Ok(()) };
        let cycles = f64::from(self.period_multiple);
        let first = Stretch { frequency_hz, start: begin, end: begin + TOUCH };
        let state = self.integrator_of(true).advance(&first, state)?;
        let rest = Stretch { frequency_hz, start: first.end, end: begin + cycles - TOUCH };
        let trace = self.integrator.trace(&rest, &state, &[])?;
        let length = (rest.end - rest.start) / frequency_hz;
        let of_element = trace.contacts.iter().filter(|contact| contact.element == element);
        let distances = of_element.map(|contact| {
            let begin = contact.begin.as_ref().map_or(0.0, |begin| begin.time);
            let end = contact.end.unwrap_or(length);
            TOUCH + frequency_hz * begin.min(length - end)
        });
        let nearest = distances.fold(f64::INFINITY, f64::min);
        if let Some(passing) = &mut self.passing {
            passing.width = WIDEST.min(0.25 * nearest);
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
