//! The column of the sensitivities that belongs to a number of a family of systems: differences of the
//! motions of its neighbours.
//!
//! The modes are those of the value, and the state is that of modes, so the column has the change of their
//! coordinates in it; no formula of the structure is needed. With the step h it is `(Z(p + h) - Z(p -
//! h))/2h`. Beside grazing and within chatter the motion bends within a step of 1e-5: where `Z(p + h) + Z(p -
//! h) - 2 Z(p)` is not small against the difference, or the neighbours have other contacts, the step is
//! shortened, down to where rounding leaves three digits, and the difference taken that bends least: bending
//! falls with the step and rounding grows. It is shortened as well as long as `2 b^2`, what a bend b beside a
//! square root leaves of error, is more than the next step's rounding: beside slow impacts the column is
//! large, and where the columns of an orbit cancel, as they do in a tangent, an error of a millionth is one
//! of hundredths. Where only one side has a system, or the contacts of this motion even at the shortest step,
//! it is the difference to that: beside a grazing the motions beyond it tell nothing of those on this side.
//!
//! How the number changes the matrix `dZ/dz` along a direction is the same difference of matrices, each of
//! which is exact: a difference of columns at two states would divide the rounding of the columns by a second
//! step. The column serves Newton's method and tangents, both of which converge whatever its last digits:
//! solutions are those of the equations, and events those of the fundamental matrices, which are exact.

use super::{ExactIntegrator, MotionError};
use crate::{ParameterError, Stretch};

/// Steps of the differences, of the size of the number.
const STEPS: [f64; 3] = [1e-5, 1e-7, 1e-9];
/// How much the motion may bend over a step, relative to the difference.
const BEND: f64 = 1e-3;
/// Rounding of a motion, relative to its end.
const ROUNDING: f64 = 1e-14;
/// By how much rounding grows from one step to the next.
const GROWTH: f64 = 100.0;

/// What the column by a number is made of.
#[derive(Debug)]
pub(super) struct ByFamily {
    /// Number of the family.
    pub family: usize,
    /// For each step, as far as it was needed, the steps to the neighbours and these.
    neighbours: [Option<Vec<Neighbour>>; STEPS.len()],
}

type Neighbour = (f64, ExactIntegrator);
/// The step to a neighbour, and its end.
type Moved = (f64, Vec<f64>);

impl ByFamily {
    pub fn new(family: usize) -> Self {
        Self { family, neighbours: [const { None }; STEPS.len()] }
    }

    /// The neighbours at one of the steps.
    fn at(&mut self, middle: &ExactIntegrator, place: usize) -> Result<&mut [Neighbour], MotionError> {
        if self.neighbours[place].is_none() {
            self.neighbours[place] = Some(middle.neighbours(self.family, STEPS[place])?);
        }
        Ok(self.neighbours[place].as_deref_mut().unwrap_or_default())
    }
}

/// A difference.
struct Difference {
    column: Vec<f64>,
    /// How much the motion bends, relative to the difference; infinite between motions of different kinds.
    bend: f64,
    /// Whether a shorter step would not better it.
    is_smooth: bool,
}

impl ExactIntegrator {
    /// The column of a flow that has come to `end`.
    pub(super) fn family_column(
        &mut self,
        (stretch, state): (&Stretch, &[f64]),
        end: &[f64],
    ) -> Result<Option<Vec<f64>>, MotionError> {
        let end_of = |neighbour: &mut Self| neighbour.advance(stretch, state).ok();
        self.by_number(end, end_of)
    }

    /// How a number of a family, if that is the parameter, changes the derivative of a flow by the state
    /// along a direction.
    ///
    /// * `direction`: length 2n, as the state.
    ///
    /// # Errors
    /// See [`MotionError`]; [`MotionError::Parameter`] if the family has no neighbours.
    pub fn matrix_by_family(
        &mut self,
        (stretch, state): (&Stretch, &[f64]),
        direction: &[f64],
    ) -> Result<Option<Vec<f64>>, MotionError> {
        let Some(by_family) = self.by_family.take() else { return Ok(None) };
        let along = |integrator: &mut Self| -> Result<Vec<f64>, MotionError> {
            let matrix = integrator.flow(stretch, state)?.by_state;
            let entry = |i: usize| direction.iter().enumerate().map(|(j, d)| matrix[(i, j)] * d).sum();
            Ok((0..direction.len()).map(entry).collect())
        };
        let here = along(self);
        self.by_family = Some(by_family);
        self.by_number(&here?, |neighbour| along(neighbour).ok())
    }

    /// Derivative by the number of what `of` makes of a neighbour and `here` is of this integrator itself,
    /// whose last motion was the one in question; `None` if no number is the parameter.
    fn by_number(
        &mut self,
        here: &[f64],
        mut of: impl FnMut(&mut Self) -> Option<Vec<f64>>,
    ) -> Result<Option<Vec<f64>>, MotionError> {
        let Some(mut by_family) = self.by_family.take() else { return Ok(None) };
        let mut column = Err(ParameterError::NoMember("no neighbour of the system moves".into()).into());
        let mut least = f64::INFINITY;
        for place in 0..STEPS.len() {
            let neighbours = by_family.at(self, place);
            let found = neighbours.map(|neighbours| self.difference(neighbours, here, &mut of));
            match found {
                Ok(Some(Difference { column: found, bend, is_smooth })) => {
                    if bend <= least || column.is_err() {
                        (column, least) = (Ok(found), bend);
                    }
                    if is_smooth {
                        break;
                    }
                }
                Ok(None) => {}
                Err(error) => {
                    column = Err(error);
                    break;
                }
            }
        }
        self.by_family = Some(by_family);
        column.map(Some)
    }

    /// `None` where no neighbour moves.
    fn difference(
        &self,
        neighbours: &mut [Neighbour],
        end: &[f64],
        of: &mut impl FnMut(&mut Self) -> Option<Vec<f64>>,
    ) -> Option<Difference> {
        let (mut same, mut other): (Vec<Moved>, Vec<Moved>) = (Vec::new(), Vec::new());
        for (step, neighbour) in neighbours {
            let Some(moved) = of(neighbour) else { continue };
            let is_same = neighbour.touches == self.touches;
            if is_same { &mut same } else { &mut other }.push((*step, moved));
        }
        let (is_same, crosses) = (!same.is_empty(), !other.is_empty());
        let ends = if is_same { same } else { other };
        let middle = (0.0, end.to_vec());
        let (below, above) = match ends.as_slice() {
            [below, above] => (below, above),
            [one] => (&middle, one),
            _ => return None,
        };
        let norm = |values: &mut dyn Iterator<Item = f64>| values.map(|x| x * x).sum::<f64>().sqrt();
        let pairs = || below.1.iter().zip(&above.1);
        let difference = norm(&mut pairs().map(|(a, b)| b - a));
        let bend = norm(&mut pairs().zip(end).map(|((a, b), middle)| a + b - 2.0 * middle));
        let rounding = GROWTH * ROUNDING * norm(&mut end.iter().copied()) / difference;
        let bend = match ends.len() {
            _ if !is_same => f64::INFINITY,
            // Known of one side alone, and near a grazing it may bend as much as it moves.
            _ if crosses => 1.0,
            2 => bend / difference,
            _ => 0.0,
        };
        // What does not move at all is no difference to better.
        let is_still = is_same && !crosses && difference == 0.0;
        let is_smooth = is_still || (bend <= BEND && 2.0 * bend * bend <= rounding);
        let width = above.0 - below.0;
        Some(Difference { column: pairs().map(|(a, b)| (b - a) / width).collect(), bend, is_smooth })
    }

    /// How a number of a family, if that is the parameter, changes the relative displacement of an element
    /// beyond the level of one of its contacts, and its rate, of a given state of the modes.
    ///
    /// * `phase`: [cycles]; `state`: `[q; q']`, length 2n.
    ///
    /// # Errors
    /// [`MotionError::Parameter`] if the family has no neighbours.
    pub fn clearance_by_family(
        &mut self,
        (element, contact): (usize, usize),
        (frequency_hz, phase): (f64, f64),
        state: &[f64],
    ) -> Result<Option<[f64; 2]>, MotionError> {
        let Some(mut by_family) = self.by_family.take() else { return Ok(None) };
        let place = |step: f64, integrator: &Self| {
            let system = integrator.system();
            let [r, rate, _] = system.relative_motion(element, frequency_hz, phase, state);
            (step, [r - system.elements()[element].law.contacts()[contact].level, rate])
        };
        let places = by_family.at(self, 0).map(|neighbours| {
            let mut places: Vec<_> = neighbours.iter().map(|(step, of)| place(*step, of)).collect();
            places.push(place(0.0, self));
            places
        });
        self.by_family = Some(by_family);
        let places = places?;
        let [(from, below), (to, above)] = [places[0], places[1]];
        Ok(Some([0, 1].map(|i| (above[i] - below[i]) / (to - from))))
    }

    /// The systems beside the present one, as far as there are; one at least.
    fn neighbours(&self, family: usize, part: f64) -> Result<Vec<Neighbour>, MotionError> {
        let kin = self.system.family(family)?;
        let size = part * kin.size.max(kin.value.abs());
        let mut neighbours = Vec::new();
        let mut refusal = None;
        for step in [-size, size] {
            match self.system.member(family, kin.value + step) {
                Ok(member) => neighbours.push((step, Self::watching(member.system, self.settings, None)?)),
                Err(error) => refusal = Some(error),
            }
        }
        match refusal {
            Some(error) if neighbours.is_empty() => Err(error.into()),
            _ => Ok(neighbours),
        }
    }
}
