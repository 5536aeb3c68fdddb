//! The flow of an orbit that touches a contact at its ends and passes it.
//!
//! Beside a touch the flow depends on which side of it the motion lies: where the contact closes for an
//! instant its force acts for as short a time as one likes, its law may need the speed of the impact, and a
//! rigid stop throws the motion back, with a fundamental matrix that is like the root of the depth. A grazing
//! orbit is the end of those that pass without contact. So for a short time after the start and before the
//! end the touched element is left out, its gap opened wide. The equations then describe the motions that
//! pass, smooth on both sides of the touch. On the curve, where the clearance and its rate vanish, they
//! describe the system itself.
//!
//! A closed contact that is touched from inside is kept: its force sets in with the penetration, and one that
//! opens for an instant leaves out little: of the state the power 3/2 of the distance, or more.
//!
//! A symmetric orbit touches the opposite contact half a period later: there that one is left out as well,
//! and so it is as long as the curve goes. Over a parameter that breaks the symmetry, too: there the curve
//! belongs to the first contact and holds only to the side on which the motion leaves the other. Where it
//! would be struck the curve ends (`opposite.rs`).
//!
//! How long: a quarter of the time to the nearest other contact of the element, at most [`WIDEST`]. The
//! solution does not depend on it. Within [`TOUCH`] of the touch a contact is the touch.

use hammerbeam_motion::{
    Parameter, System,
    exact::{ExactIntegrator, MotionError},
};

use super::touched::Touch;
use crate::{OrbitError, OrbitSettings, PeriodicSolution, Response, solve};

/// Longest time for which the element is left out [cycles].
pub(super) const WIDEST: f64 = 1.0 / 32.0;
/// The gap is opened to so many times the largest gap and the orbit.
const WIDE: f64 = 1e3;

/// What is left out, and how long.
#[derive(Debug)]
pub(super) struct Passing {
    /// Of the system with the opened gaps.
    pub integrator: ExactIntegrator,
    /// What is touched at the ends of the orbit, and what opposite.
    pub touches: Vec<Touch>,
    /// How long behind the start of the orbit the opposite contact is touched [cycles].
    pub behind: Option<f64>,
    /// How long elements are left out, at each side of a touch [cycles].
    pub width: f64,
}

impl Passing {
    /// Leaves out elements beside their touches; `None` if one has no gap.
    ///
    /// * `opposite`: the contact that is touched half a period later, and how long after the first.
    /// * `range`: of the parameter that is followed.
    pub fn new(
        (system, parameter): (&System, Parameter),
        (touch, opposite): (Touch, Option<(Touch, f64)>),
        response: &Response,
        (start, range): (&PeriodicSolution, (f64, f64)),
        orbits: &OrbitSettings,
    ) -> Result<Option<Self>, OrbitError> {
        let touches: Vec<Touch> = [touch].into_iter().chain(opposite.map(|(touch, _)| touch)).collect();
        let mut opened = system.clone();
        for Touch { element, .. } in &touches {
            let gap = Parameter::gap(*element);
            let Some(level) = system.elements()[*element].law.gap() else {
                return Ok(None);
            };
            let largest =
                if parameter.is_gap_of(*element) { range.1.abs().max(range.0.abs()) } else { level };
            let wide = WIDE * (largest + start.maxima.displacement);
            opened = opened.with_parameter(gap, wide).map_err(MotionError::from)?;
        }
        let mut integrator = solve::integrator(&opened, response, orbits)?;
        let elements: Vec<usize> = touches.iter().map(|touch| touch.element).collect();
        integrator.differentiate_by(parameter.without_gaps_of(&elements))?;
        let opposite = opposite.map(|(_, behind)| behind);
        Ok(Some(Self { integrator, touches, behind: opposite, width: WIDEST }))
    }

    /// Gives the parameter that is followed another value.
    pub fn set_parameter(&mut self, parameter: Parameter, value: f64) -> Result<(), MotionError> {
        let elements: Vec<usize> = self.touches.iter().map(|touch| touch.element).collect();
        match parameter.without_gaps_of(&elements) {
            Some(left) => self.integrator.set_parameter(left, value),
            None => Ok(()),
        }
    }

    /// The contact that is touched opposite, and how long behind the start of the orbit [cycles].
    pub fn opposite(&self) -> Option<(Touch, f64)> {
        Some((*self.touches.get(1)?, self.behind?))
    }

    /// Where elements are left out, of an orbit from `start` over `cycles`.
    pub fn windows(&self, start: f64, cycles: f64) -> Vec<[f64; 2]> {
        let mut windows = vec![[start, start + self.width], [start + cycles - self.width, start + cycles]];
        windows.extend(self.behind.map(|o| [start + o - self.width, start + o + self.width]));
        windows
    }
}
