//! Laws that remember with what speed their contact began, from one stretch to the next.
//!
//! A state `[q; q']` within such a contact does not tell how the contact began, so a stretch that starts
//! there is refused. One exception: a motion goes on over the end of the stretch before, if it starts with
//! exactly the state, to the last bit, and at the phase in which that ended, and no parameter was changed in
//! between. So motion is followed period by period.
//!
//! **Sensitivities** of a flow are by the state at its start alone, and an orbit has to be cut where the
//! contact is open: [`ExactIntegrator::flow`] does not go on. Tangent vectors that are carried along a motion
//! can, by [`ExactIntegrator::flow_onwards`]. With the fundamental matrix `P` of the stretch before and the
//! derivative `w` of the speed by the state at the start of that, neighbours have the displacement `y` there,
//! `P y` at its end and `w y = (w P^-1)(P y)` in their speed; so the speed has the derivative `w P^-1` by the
//! state at the start of the next stretch, among the neighbours that come from there.

use faer::{Mat, linalg::solvers::Solve};

use super::{ExactIntegrator, MotionError, run::Run, sensitivity::Sensitivity};
use crate::{Flow, Law, Stretch};

/// Where a stretch ended, and what the laws remembered there.
#[derive(Debug, Clone)]
pub struct ContactMemory {
    phase: f64,
    state: Vec<f64>,
    laws: Vec<Law>,
    /// Derivative of the remembered speed by the state, of each element; empty where it is not known or not
    /// needed.
    speeds: Vec<Vec<f64>>,
}

impl ContactMemory {
    /// The speed of the impact that the law of each element remembers [m/s]; infinite where there was none
    /// yet, and where the law remembers none.
    #[must_use]
    pub fn impact_speeds(&self) -> Vec<f64> {
        self.laws.iter().map(Law::impact_speed).collect()
    }
}

impl ExactIntegrator {
    /// Flow over a stretch that may start in a contact whose law remembers its impact, where it goes on from
    /// the end of the stretch before; else as [`ExactIntegrator::flow`].
    ///
    /// Its `by_state` takes tangent vectors of the flow before on; where that had no sensitivities, the speed
    /// of the impact counts as given. By frequency and parameters the speed counts as given.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn flow_onwards(&mut self, stretch: &Stretch, state: &[f64]) -> Result<Flow, MotionError> {
        self.goes_on = true;
        let flow = self.flow(stretch, state);
        self.goes_on = false;
        flow
    }

    /// What a motion that goes on from the end of the last stretch has to know, if there are laws that
    /// remember.
    #[must_use]
    pub fn memory(&self) -> Option<ContactMemory> {
        self.memory.clone()
    }

    /// Goes back to the end of a stretch, of this integrator or another of the same system.
    pub fn set_memory(&mut self, memory: Option<ContactMemory>) {
        self.memory = memory;
    }

    /// Goes back to where a motion of this system was at a state and a phase, if its laws remembered impacts
    /// of these speeds then, see [`ContactMemory::impact_speeds`].
    ///
    /// * `phase`: [cycles], from 0 to less than 1; `state`: `[q; q']`, length 2n; `impact_speeds`: one of
    ///   each element [m/s].
    pub fn set_impact_speeds(&mut self, phase: f64, state: &[f64], impact_speeds: &[f64]) {
        let elements = self.system.elements().iter().zip(impact_speeds);
        let laws = elements.map(|(element, speed)| element.law.struck_at(*speed)).collect();
        self.memory = Some(ContactMemory { phase, state: state.to_vec(), laws, speeds: Vec::new() });
    }

    /// Puts laws that remember an impact back to what they are before the first.
    pub(super) fn forget_impacts(&mut self) {
        for (law, element) in self.laws.iter_mut().zip(self.system.elements()) {
            if law.remembers_impact() {
                *law = element.law.clone();
            }
        }
    }

    /// Keeps what the laws remember at the end of a stretch.
    pub(super) fn remember_end(&mut self, stretch: &Stretch, state: &[f64]) {
        if self.laws.iter().any(Law::remembers_impact) {
            let phase = stretch.end - stretch.end.floor();
            let (state, laws) = (state.to_vec(), self.laws.clone());
            self.memory = Some(ContactMemory { phase, state, laws, speeds: Vec::new() });
        }
    }

    /// Keeps the sensitivities of the remembered speeds, too, by the state at the end of a flow.
    pub(super) fn remember_speeds(&mut self, by_state: &Mat<f64>) {
        let Some(memory) = &mut self.memory else { return };
        let (run, n) = (&self.run, by_state.nrows());
        let Some(sensitivity) = &run.sensitivity else { return };
        let inside = |e: usize| run.closed[e].is_some() || run.parted[e].is_some();
        if !(0..self.laws.len()).any(|e| self.laws[e].remembers_impact() && inside(e)) {
            return;
        }
        let transposed = by_state.transpose().partial_piv_lu();
        let speed = |e: usize| {
            let row = sensitivity.impact_speed(e).filter(|_| inside(e));
            row.map_or_else(Vec::new, |row| {
                let solved = transposed.solve(Mat::from_fn(n, 1, |i, _| row[i]));
                (0..n).map(|i| solved[(i, 0)]).collect()
            })
        };
        memory.speeds = (0..self.laws.len()).map(speed).collect();
    }

    /// Lets the laws remember what they did at the end of the last stretch, if this one goes on there.
    pub(super) fn recall_impacts(
        &mut self,
        stretch: &Stretch,
        state: &[f64],
        sensitivity: Option<&mut Sensitivity>,
    ) {
        let Some(memory) = &self.memory else { return };
        if memory.phase == stretch.start - stretch.start.floor() && memory.state == state {
            self.laws.clone_from(&memory.laws);
            if let Some(sensitivity) = sensitivity {
                let known = memory.speeds.iter().enumerate().filter(|(_, row)| !row.is_empty());
                known.for_each(|(element, row)| sensitivity.recall_impact(element, row));
            }
        }
    }

    /// A stretch cannot start in a contact whose law does not know how it began.
    pub(super) fn check_start(&self, run: &Run, stretch: &Stretch) -> Result<(), MotionError> {
        let closed = |element: &usize| run.closed[*element].is_some();
        match (0..self.laws.len()).filter(closed).find(|&e| !self.laws[e].is_struck()) {
            None => Ok(()),
            Some(element) => Err(MotionError::StartsInContact {
                element: self.system.elements()[element].name.clone(),
                phase: stretch.start,
            }),
        }
    }
}
