//! Curves of bifurcations from the events of stored branches: what is computed for a `[[curve]]`.

use hammerbeam_orbit::{
    BranchEventKind, CurveKind, CurveRow, CurveSettings, CurveWalk, EventStatus, LocatedEvent, OrbitError,
    PathError, PeriodicSolution, Side,
};
use hammerbeam_results::{
    end::BranchEnd,
    row::SolvedRow,
    store::{Store, StoreError, StoredMemory, solution_key},
};
use hammerbeam_study::{
    Model, Study, StudyParameter,
    file::{Curve, CurveOf},
};

use super::solver::{Failed, FoundStarts, PieceSolver};
use crate::{orbit_solver::settings, walk::Walk};

/// Longest step of a curve, in hundredths of the ranges.
const MAX_STEP: f64 = 0.5;
/// Relative distance within which events may be the same.
const SIDE_BY_SIDE: f64 = 1e-4;

/// The orbit at the event nearest to the frequency of the curve, or why there is none.
pub(super) fn start(
    store: &Store,
    curve: &Curve,
) -> Result<Result<(PeriodicSolution, LocatedEvent), String>, StoreError> {
    let Some((solution, event)) = nearest_event(store, curve)? else {
        let (multiple, of) = (curve.period_multiple, curve.of.name());
        return Ok(Err(format!("no branch of period multiple {multiple} has an event \"{of}\" to begin at")));
    };
    let is_corner = event.status == EventStatus::Bracketed && !event.contacts.is_empty();
    if is_corner && curve.of != CurveOf::Grazing {
        let (of, hz) = (curve.of.name(), solution.frequency_hz);
        return Ok(Err(format!(
            "the {of} nearest to it, at {hz} Hz, is a corner of the branch at a grazing, where multipliers \
             jump: ask for the curve of the grazing"
        )));
    }
    Ok(Ok((solution, event)))
}

/// The curve through an event.
#[derive(Debug)]
pub(super) struct CurveSolver<'a> {
    model: &'a Model,
    study: &'a Study,
    curve: &'a Curve,
    parameter: StudyParameter,
    /// Value of the parameter as the study has it, in the unit of its name.
    value: f64,
    start: PeriodicSolution,
    kind: CurveKind,
}

impl<'a> CurveSolver<'a> {
    /// * `(start, event)`: of [`start`].
    pub fn new(
        (model, study): (&'a Model, &'a Study),
        curve: &'a Curve,
        (start, event): (PeriodicSolution, LocatedEvent),
    ) -> Result<Self, String> {
        let parameter = model.parameter(study, &curve.parameter)?;
        let value = model.system.parameter(parameter.parameter).map_err(|error| error.to_string())?;
        let kind = kind_of(curve.of, &event);
        Ok(Self { model, study, curve, parameter, value: parameter.in_study(value), start, kind })
    }

    fn settings(&self) -> CurveSettings {
        let [low, high] = self.study.excitation.range_hz();
        let [from, to] = self.curve.parameter.range;
        CurveSettings {
            parameter: self.parameter.parameter,
            range: (self.parameter.in_system(from), self.parameter.in_system(to)),
            range_hz: (low, high),
            max_step: MAX_STEP,
            max_rows: self.study.continuation.budget_solutions,
        }
    }

    /// Why no curve starts, in the unit of its parameter.
    fn failed(&self, error: OrbitError) -> Failed {
        match error {
            OrbitError::Path(PathError::Start { parameter: value, cause }) => {
                let value = self.parameter.in_range(value, self.curve.parameter.range);
                let name = &self.curve.parameter.name;
                Failed::Message(format!("the start at {name} = {value} was not corrected: {cause}"))
            }
            error => error.into(),
        }
    }
}

impl PieceSolver for CurveSolver<'_> {
    fn search(&self, _interrupted: &dyn Fn() -> bool) -> Result<FoundStarts, Failed> {
        Ok(FoundStarts { starts: vec![self.start.clone()], parameter: self.value, message: None })
    }

    fn begin<'a>(&'a self, _start: &PeriodicSolution, side: Side) -> Result<Box<dyn Walk + 'a>, Failed> {
        let (system, response) = (&self.model.system, &self.model.response);
        let of_side = (self.kind, side);
        let orbits = settings(&self.study.continuation);
        let walk = CurveWalk::new(system, response, &self.start, of_side, &self.settings(), &orbits)
            .map_err(|error| self.failed(error))?;
        let (kind, parameter, range) = (self.kind, self.parameter, self.curve.parameter.range);
        Ok(Box::new(SideOfCurve { walk, is_at_start: side == Side::Up, kind, parameter, range, last: None }))
    }

    fn resume<'a>(&'a self, _memory: &StoredMemory) -> Result<Box<dyn Walk + 'a>, Failed> {
        Err(Failed::Message("a side of a curve is walked from its start to its end".to_owned()))
    }

    fn way(&self) -> ([f64; 2], f64) {
        (self.curve.parameter.range, self.value)
    }

    fn is_near(&self, _start: &PeriodicSolution, _states: &[(f64, Vec<f64>)]) -> Result<bool, Failed> {
        Ok(false)
    }
}

/// A walk along one side of a curve, in the unit of its parameter.
#[derive(Debug)]
struct SideOfCurve {
    walk: CurveWalk,
    /// The start is still to be given as a row.
    is_at_start: bool,
    kind: CurveKind,
    parameter: StudyParameter,
    range: [f64; 2],
    /// The newest row: how the curve ends may mark it.
    last: Option<CurveRow>,
}

impl Walk for SideOfCurve {
    fn step(&mut self, rows: &mut Vec<SolvedRow>) -> Result<Option<BranchEnd>, String> {
        let found = if std::mem::take(&mut self.is_at_start) {
            self.walk.start_row().map(Ok)
        } else {
            self.walk.step()
        };
        let (next, end, failure) = match found {
            Ok(Ok(row)) => (Some(row), None, None),
            Ok(Err(end)) => (None, Some(end), None),
            Err(error) => (None, None, Some(error.to_string())),
        };
        let before = std::mem::replace(&mut self.last, next);
        let value = |value: f64| self.parameter.in_range(value, self.range);
        if let Some(mut row) = before {
            if let Some(end) = &end {
                row.events.mark_end(self.kind, end);
            }
            let row = SolvedRow::from(row);
            rows.push(SolvedRow { parameter: value(row.parameter), ..row });
        }
        failure.map_or_else(|| Ok(end.map(|end| BranchEnd::Curve(end.in_unit(value)))), Err)
    }

    fn checkpoint(&self) -> Option<Vec<u8>> {
        None
    }

    fn take_journal(&mut self) -> Vec<u8> {
        Vec::new()
    }
}

fn kind_of(of: CurveOf, event: &LocatedEvent) -> CurveKind {
    match (of, event.contacts.first()) {
        (CurveOf::Fold, _) => CurveKind::Fold,
        (CurveOf::Flip, _) => CurveKind::Flip,
        (CurveOf::NeimarkSacker, _) => CurveKind::NeimarkSacker,
        (CurveOf::Grazing, change) => CurveKind::Grazing { contact: change.map(|change| change.contact) },
    }
}

/// The solution at the event of that kind nearest to the frequency, over all branches of that period.
fn nearest_event(
    store: &Store,
    curve: &Curve,
) -> Result<Option<(PeriodicSolution, LocatedEvent)>, StoreError> {
    let wanted = match curve.of {
        CurveOf::Fold => BranchEventKind::Fold,
        CurveOf::Flip => BranchEventKind::Flip,
        CurveOf::NeimarkSacker => BranchEventKind::NeimarkSacker,
        CurveOf::Grazing => BranchEventKind::Grazing,
    };
    let mut nearest: Option<(f64, i64)> = None;
    let mut found = Vec::new();
    for branch in store.branches()?.iter().filter(|branch| branch.period_multiple == curve.period_multiple) {
        for side in [Side::Up, Side::Down] {
            for (number, row) in store.walked(branch.start, side)?.iter().enumerate() {
                if !row.events.has(wanted) {
                    continue;
                }
                let distance = (row.frequency_hz - curve.near_hz).abs();
                let key = solution_key(branch.start, side, number as u32);
                found.push((row.frequency_hz, key));
                if nearest.is_none_or(|(least, _)| distance < least) {
                    nearest = Some((distance, key));
                }
            }
        }
    }
    let Some((_, key)) = nearest else { return Ok(None) };
    let Some(event) = store.event(key)? else { return Ok(None) };
    let (key, event) = best_known(store, &found, (key, event))?;
    Ok(Some((store.solution_of_key(key)?, event)))
}

/// Of events that cannot be distinguished from the nearest one by their places, as at a corner that several
/// rows mark, the one that is known best.
///
/// * `found`: frequencies [Hz] and keys.
fn best_known(
    store: &Store,
    found: &[(f64, i64)],
    (key, event): (i64, LocatedEvent),
) -> Result<(i64, LocatedEvent), StoreError> {
    let hz = found.iter().find(|(_, other)| *other == key).map_or(f64::NAN, |(hz, _)| *hz);
    let (uncertainty, mut best) = (event.uncertainty, (key, event));
    for &(other_hz, other) in found.iter().filter(|(_, other)| *other != key) {
        if (other_hz - hz).abs() > SIDE_BY_SIDE * hz {
            continue;
        }
        let Some(event) = store.event(other)? else { continue };
        let is_same = (other_hz - hz).abs() <= uncertainty + event.uncertainty;
        if is_same && event.uncertainty < best.1.uncertainty {
            best = (other, event);
        }
    }
    Ok(best)
}
