//! The column of the sensitivities that belongs to a number of a family of systems: differences of the motions of its neighbours.
//!
//! The modes are those of the value, and the state is that of modes, so the column has the change of their coordinates in it; no formula of the structure is needed. With the step h it is
//! `(Z(p + h) - Z(p - h))/2h`, of one side where the other has no system or has other contacts, beside grazing. It serves Newton's method and tangents, both of which converge whatever its last digits: solutions
//! are those of the equations, and events those of the fundamental matrices, which are exact.

use super::{ExactIntegrator, MotionError};
use crate::{ParameterError, Stretch};

/// Step of the differences, of the size of the number: truncation and rounding leave some 1e-7 of the column.
const STEP: f64 = 1e-5;

/// What the column by a number is made of.
#[derive(Debug)]
pub(super) struct ByFamily {
    /// Number of the family.
    pub family: usize,
    /// Steps to the neighbours, and these; made with the first flow.
    neighbours: Option<Vec<(f64, ExactIntegrator)>>,
}

impl ByFamily {
    pub fn new(family: usize) -> Self {
        Self { family, neighbours: None }
    }
}

impl ExactIntegrator {
    /// The column of a flow that has come to `end`.
    pub(super) fn family_column(
        &mut self,
        (stretch, state): (&Stretch, &[f64]),
        end: &[f64],
    ) -> Result<Option<Vec<f64>>, MotionError> {
        let Some(mut by_family) = self.by_family.take() else { return Ok(None) };
        let column = self.differences(&mut by_family, (stretch, state), end);
        self.by_family = Some(by_family);
        column.map(Some)
    }

    fn differences(
        &self,
        by_family: &mut ByFamily,
        (stretch, state): (&Stretch, &[f64]),
        end: &[f64],
    ) -> Result<Vec<f64>, MotionError> {
        self.make_neighbours(by_family)?;
        let mut ends: Vec<(f64, Vec<f64>)> = Vec::new();
        let mut others = Vec::new();
        for (step, neighbour) in by_family.neighbours.iter_mut().flatten() {
            let Ok(moved) = neighbour.advance(stretch, state) else { continue };
            let alike = neighbour.touches == self.touches;
            if alike { &mut ends } else { &mut others }.push((*step, moved));
        }
        if ends.is_empty() {
            ends = others;
        }
        let middle = (0.0, end.to_vec());
        let (below, above) = match ends.as_slice() {
            [below, above] => (below, above),
            [one] => (&middle, one),
            _ => return Err(ParameterError::NoMember("no neighbour of the system moves".into()).into()),
        };
        let difference = |(a, b): (&f64, &f64)| (b - a) / (above.0 - below.0);
        Ok(below.1.iter().zip(&above.1).map(difference).collect())
    }

    /// How a number of a family, if that is the parameter, changes the relative displacement of an element beyond the level of one of its contacts, and its rate, of a given state of the modes.
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
        let made = self.make_neighbours(&mut by_family);
        let place = |(step, integrator): &(f64, Self)| {
            let system = integrator.system();
            let [r, rate, _] = system.relative_motion(element, frequency_hz, phase, state);
            (*step, [r - system.elements()[element].law.contacts()[contact].level, rate])
        };
        let mut places: Vec<(f64, [f64; 2])> = by_family.neighbours.iter().flatten().map(place).collect();
        self.by_family = Some(by_family);
        made?;
        if places.len() == 1 {
            let [r, rate, _] = self.system.relative_motion(element, frequency_hz, phase, state);
            places.push((0.0, [r - self.system.elements()[element].law.contacts()[contact].level, rate]));
        }
        let [(from, below), (to, above)] = [places[0], places[1]];
        Ok(Some([0, 1].map(|i| (above[i] - below[i]) / (to - from))))
    }

    fn make_neighbours(&self, by_family: &mut ByFamily) -> Result<(), MotionError> {
        if by_family.neighbours.is_none() {
            by_family.neighbours = Some(self.neighbours(by_family.family)?);
        }
        Ok(())
    }

    /// The systems beside the present one, as far as there are.
    fn neighbours(&self, family: usize) -> Result<Vec<(f64, Self)>, MotionError> {
        let kin = self.system.family(family)?;
        let (value, size) = (kin.value, STEP * kin.size.max(kin.value.abs()));
        let mut neighbours = Vec::new();
        let mut refusal = None;
        for step in [-size, size] {
            match self.system.member(family, value + step) {
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
