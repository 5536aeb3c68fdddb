//! Branches over a parameter at a fixed frequency: what is computed for a `[[vary]]`.

use hammerbeam_orbit::{
    BranchRow, BranchWalk, ContinuationParameter, LocatedEvent, Matcher, OrbitSettings, PeriodicSolution,
    Side, find_orbits,
};
use hammerbeam_results::{end::BranchEnd, row::SolvedRow, store::StoredMemory};
use hammerbeam_study::{Model, Study, StudyParameter, file::Vary};

use super::solver::{Failed, FoundStarts, PieceSolver};
use crate::{orbit_solver::settings, walk::Walk};

/// The orbits of a study at a frequency, and their branches over a parameter.
#[derive(Debug)]
pub(super) struct VarySolver<'a> {
    model: &'a Model,
    study: &'a Study,
    vary: &'a Vary,
    parameter: StudyParameter,
    /// Value of the parameter as the study has it, in the unit of its name.
    value: f64,
}

impl<'a> VarySolver<'a> {
    pub fn new(model: &'a Model, study: &'a Study, vary: &'a Vary) -> Result<Self, String> {
        let parameter = model.parameter(study, &vary.parameter)?;
        let value = model.system.parameter(parameter.parameter).map_err(|error| error.to_string())?;
        Ok(Self { model, study, vary, parameter, value: parameter.in_study(value) })
    }

    /// Range of the parameter in the unit of the system.
    fn range(&self) -> (f64, f64) {
        let [low, high] = self.vary.parameter.range;
        (self.parameter.in_system(low), self.parameter.in_system(high))
    }

    fn searching(&self) -> OrbitSettings {
        let continuation = &self.study.continuation;
        OrbitSettings { max_solutions: continuation.budget_solutions, ..settings(continuation) }
    }

    fn walking(&self) -> OrbitSettings {
        let (low, high) = self.range();
        OrbitSettings { max_step: (high - low) / f64::from(self.vary.steps), ..self.searching() }
    }

    fn walk(&self, walk: BranchWalk, is_at_start: bool) -> Box<dyn Walk + '_> {
        Box::new(VariedWalk {
            walk,
            is_at_start,
            parameter: self.parameter,
            range: self.vary.parameter.range,
        })
    }
}

impl PieceSolver for VarySolver<'_> {
    fn search(&self, interrupted: &dyn Fn() -> bool) -> Result<FoundStarts, Failed> {
        let [low, high] = self.study.excitation.range_hz();
        let (model, orbit) = (self.model, (self.vary.frequency_hz, self.vary.period_multiple));
        let found =
            find_orbits(&model.system, &model.response, orbit, (low, high), &self.searching(), &mut || {
                interrupted()
            })?;
        let message = match found.incomplete {
            Some(error) => Some(error.to_string()),
            None if found.orbits.is_empty() => {
                Some(format!("no periodic solution was found at {} Hz", orbit.0))
            }
            None => None,
        };
        Ok(FoundStarts { starts: found.orbits, parameter: self.value, message })
    }

    fn begin<'a>(&'a self, start: &PeriodicSolution, side: Side) -> Result<Box<dyn Walk + 'a>, Failed> {
        let (parameter, frequency_hz) = (self.parameter.parameter, self.vary.frequency_hz);
        let varied = ContinuationParameter::Other { parameter, frequency_hz };
        let of_side = (varied, side, self.range());
        let (system, response) = (&self.model.system, &self.model.response);
        let walk = BranchWalk::varying(system, response, start, of_side, &self.walking())?;
        Ok(self.walk(walk, side == Side::Up))
    }

    fn resume<'a>(&'a self, memory: &StoredMemory) -> Result<Box<dyn Walk + 'a>, Failed> {
        let stored = (memory.checkpoint.as_slice(), memory.journal.as_slice());
        let (system, response) = (&self.model.system, &self.model.response);
        let walk = BranchWalk::resume(system, response, stored, self.range(), &self.walking())?;
        Ok(self.walk(walk, false))
    }

    fn way(&self) -> ([f64; 2], f64) {
        (self.vary.parameter.range, self.value)
    }

    fn is_near(&self, start: &PeriodicSolution, states: &[(f64, Vec<f64>)]) -> Result<bool, Failed> {
        let searching = self.searching();
        let matcher = Matcher::new(&self.model.system, &self.model.response, start, &searching)?;
        Ok(states.iter().any(|(phase, guess)| matcher.is_near((*phase, guess))))
    }
}

/// A walk over a parameter, in the unit of its name.
#[derive(Debug)]
struct VariedWalk {
    walk: BranchWalk,
    /// The start is still to be given as a row.
    is_at_start: bool,
    parameter: StudyParameter,
    range: [f64; 2],
}

impl Walk for VariedWalk {
    fn step(&mut self, rows: &mut Vec<SolvedRow>) -> Result<Option<BranchEnd>, String> {
        let mut found = Vec::new();
        let reason = if std::mem::take(&mut self.is_at_start) {
            self.walk.start_row().map(|row| {
                found.push(row);
                None
            })
        } else {
            self.walk.step(&mut found)
        };
        rows.extend(found.into_iter().map(|row| self.in_unit(row)));
        let value = |value: f64| self.parameter.in_range(value, self.range);
        let reason = reason.map_err(|error| error.to_string())?;
        Ok(reason.map(|reason| BranchEnd::Walk(reason.in_unit(value))))
    }

    fn checkpoint(&self) -> Option<Vec<u8>> {
        Some(self.walk.checkpoint())
    }

    fn take_journal(&mut self) -> Vec<u8> {
        self.walk.take_journal()
    }
}

impl VariedWalk {
    fn in_unit(&self, row: BranchRow) -> SolvedRow {
        let row = SolvedRow::from(row);
        let parameter = self.parameter.in_range(row.parameter, self.range);
        SolvedRow { parameter, located: row.located.map(|event| self.event_in_unit(event, parameter)), ..row }
    }

    /// The event with its uncertainty, and the last entry of its direction, in the unit of the parameter's
    /// name.
    fn event_in_unit(&self, mut event: LocatedEvent, value: f64) -> LocatedEvent {
        let change = |change: f64| self.parameter.change_in_study(change);
        event.uncertainty = change(event.uncertainty).abs().max(f64::EPSILON * value.abs());
        if let Some(last) = event.direction.last_mut() {
            *last = change(*last);
        }
        event
    }
}
