//! All stored rows of a folder, over whatever they run: each with the system that it is of, and with what it
//! claims to happen there.

use std::borrow::Cow;

use hammerbeam_motion::System;
use hammerbeam_orbit::{BranchEventKind, EventSet, EventStatus, PeriodicSolution, Response};
use hammerbeam_results::{
    Store, StoreError,
    row::Row,
    store::{BranchRecord, PieceKind, PieceRecord, solution_key},
};
use hammerbeam_study::{Model, StudyParameter, file::CurveOf};

use super::{claims::Claims, report::VerifiedPlace};
use crate::{PreparedStudy, piece_parameter::piece_parameter};

/// The branches of a folder.
pub(super) struct StoredRows<'a> {
    model: &'a Model,
    branches: Vec<(Option<VariedPiece>, BranchRecord)>,
}

/// What a branch of a piece runs over.
#[derive(Debug, Clone)]
struct VariedPiece {
    place: u32,
    kind: PieceKind,
    /// The parameter, or why the study does not have it.
    parameter: Result<StudyParameter, String>,
}

/// Where a chosen row is.
#[derive(Debug)]
pub(super) struct ChosenRow {
    branch: usize,
    key: i64,
    row: Row,
}

/// A stored solution, what its row shows and what that claims.
pub(super) struct StoredRow<'a> {
    pub place: VerifiedPlace,
    pub row: Row,
    pub claims: Claims,
    pub solution: PeriodicSolution,
    is_of_curve: bool,
    model: &'a Model,
    parameter: Option<&'a Result<StudyParameter, String>>,
}

impl<'a> StoredRows<'a> {
    /// Those over the frequency first, then those of the pieces, in the order of the study.
    pub fn of(store: &Store, study: &'a PreparedStudy) -> Result<Self, StoreError> {
        let diagram = store.branches()?.into_iter().map(|branch| (None, branch));
        let mut branches: Vec<_> = diagram.collect();
        for record in store.pieces()? {
            let piece = VariedPiece::of(&record, study);
            branches.extend(record.branches.into_iter().map(|branch| (Some(piece.clone()), branch)));
        }
        Ok(Self { model: &study.model, branches })
    }

    /// Number of all rows.
    pub fn count(&self) -> u64 {
        self.branches.iter().map(|(_, branch)| branch.solutions()).sum()
    }

    /// Where the rows of these numbers are, counted end to end along one branch after the other.
    pub fn places(&self, store: &Store, chosen: &[u64]) -> Result<Vec<ChosenRow>, StoreError> {
        let mut wanted = chosen.iter().copied().peekable();
        let mut places = Vec::with_capacity(chosen.len());
        let mut number = 0;
        for (index, (_, branch)) in self.branches.iter().enumerate() {
            store.each_placed_row::<StoreError>(branch, |placed| {
                if wanted.next_if_eq(&number).is_some() {
                    let key = solution_key(branch.start, placed.side, placed.number);
                    places.push(ChosenRow { branch: index, key, row: placed.row });
                }
                number += 1;
                Ok(())
            })?;
        }
        Ok(places)
    }

    /// The solution of a row.
    pub fn read(&self, store: &Store, chosen: &ChosenRow) -> Result<StoredRow<'_>, StoreError> {
        let ChosenRow { branch, key, row } = *chosen;
        let (piece, branch) = &self.branches[branch];
        let solution = store.solution_of_key(key)?;
        let place = VerifiedPlace {
            piece: piece.as_ref().map(|piece| (piece.place, row.parameter)),
            branch: branch.id,
            frequency_hz: solution.frequency_hz,
        };
        let events = piece.as_ref().map_or(row.events, |piece| piece.claims(row.events));
        let event = if events.is_empty() { None } else { store.event(key)? };
        let bracketed = event.filter(|event| event.status == EventStatus::Bracketed);
        let claims = Claims { events, bracketed: bracketed.and_then(|event| event.multiplier) };
        let parameter = piece.as_ref().map(|piece| &piece.parameter);
        let is_of_curve = piece.as_ref().is_some_and(|piece| piece.kind.is_curve());
        Ok(StoredRow { place, row, claims, solution, is_of_curve, model: self.model, parameter })
    }
}

impl VariedPiece {
    fn of(record: &PieceRecord, study: &PreparedStudy) -> Self {
        let parameter = piece_parameter(record, study);
        Self { place: record.place, kind: record.kind, parameter }
    }

    /// What a row claims: on a curve that its orbit is at the bifurcation that the curve consists of, but
    /// where the pair of a Neimark-Sacker point becomes real.
    fn claims(&self, events: EventSet) -> EventSet {
        let PieceKind::Curve(of) = self.kind else { return events };
        let is_real = [BranchEventKind::Resonance11, BranchEventKind::Resonance12]
            .into_iter()
            .any(|resonance| events.has(resonance));
        EventSet::of([
            (of == CurveOf::Fold, BranchEventKind::Fold),
            (of == CurveOf::Flip, BranchEventKind::Flip),
            (of == CurveOf::NeimarkSacker && !is_real, BranchEventKind::NeimarkSacker),
            (of == CurveOf::Grazing, BranchEventKind::Grazing),
        ])
    }
}

/// To this the rows of curves are known: the last correction of a row, relative to the orbit, is no larger.
const CURVE: f64 = 1e-8;

impl StoredRow<'_> {
    /// With which tolerance the row is compared, where rows of branches are with this one.
    pub fn tolerance(&self, of_branches: f64) -> f64 {
        if self.is_of_curve { of_branches.max(CURVE) } else { of_branches }
    }

    /// The system that the solution is of, and what is observed of it; why there is none, in words.
    pub fn system(&self) -> Result<(Cow<'_, System>, Cow<'_, Response>), String> {
        let Some(parameter) = self.parameter else {
            return Ok((Cow::Borrowed(&self.model.system), Cow::Borrowed(&self.model.response)));
        };
        let parameter = parameter.as_ref().map_err(Clone::clone)?;
        let (system, response) = self.model.with_parameter(parameter, self.row.parameter)?;
        Ok((Cow::Owned(system), Cow::Owned(response)))
    }
}
