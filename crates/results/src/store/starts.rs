//! Starts: solutions from which branches are followed, found by a job or by a piece of the study.

use hammerbeam_orbit::{BranchEventKind, EventSet, LocatedEvent, PeriodicSolution, Side};
use rusqlite::{Connection, Row as SqlRow, Transaction, params, params_from_iter, types::Value};

use super::{
    StoreError,
    event::event,
    jobs::{JobKind, JobRecord},
    keys::{MOST_STARTS, first_key, side_word, starts_of_job, walk_id},
    values::{END_COLUMNS, period_multiple, values_of_end},
    write::{forget_walked, insert_solution},
};
use crate::{end::BranchEnd, row::SolvedRow};

/// A solution from which a branch may be followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StartRecord {
    /// Its key.
    pub key: u32,
    /// Orbit period over excitation period.
    pub period_multiple: u32,
    /// Number of the branch, once it is known to be a new one.
    pub branch: Option<u32>,
}

impl StartRecord {
    /// The job it came of, if it is a start of the diagram.
    #[must_use]
    pub fn job(&self) -> u32 {
        self.key / MOST_STARTS
    }

    pub(super) fn read(row: &SqlRow<'_>) -> Result<Self, StoreError> {
        let period_multiple = period_multiple(row.get(1)?)?;
        Ok(Self { key: row.get(0)?, period_multiple, branch: row.get(2)? })
    }
}

/// A new start, and what it came of.
pub(super) struct NewStart<'a> {
    pub key: u32,
    pub job: Option<u32>,
    pub piece: Option<u32>,
    pub row: &'a SolvedRow,
    /// How its down side ends before it is walked.
    pub down: Option<&'a BranchEnd>,
}

impl NewStart<'_> {
    /// Stores the start with the two walks that begin there; not if it is there already.
    pub fn insert(&self, transaction: &Transaction<'_>) -> Result<(), StoreError> {
        let Self { key, job, piece, row, down } = *self;
        let insert = "INSERT OR IGNORE INTO start (id, job, piece, period_multiple) VALUES (?1, ?2, ?3, ?4)";
        if transaction.execute(insert, params![key, job, piece, row.solution.period_multiple])? == 0 {
            // It is there since before the job was taken back, with what was walked.
            return Ok(());
        }
        let insert = format!(
            "INSERT INTO walk (id, start, side, solutions, {END_COLUMNS})
            VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)"
        );
        for (side, solutions) in [(Side::Up, 1), (Side::Down, 0)] {
            let of_walk = [
                Value::Integer(walk_id(key, side)),
                Value::Integer(key.into()),
                Value::Text(side_word(side).to_owned()),
                Value::Integer(solutions),
            ];
            let end = values_of_end(down.filter(|_| side == Side::Down));
            transaction.execute(&insert, params_from_iter(of_walk.into_iter().chain(end)))?;
        }
        insert_solution(transaction, first_key(walk_id(key, Side::Up)), row)
    }
}

/// What is known of the event at which a branch leaves another one, as an event of the new branch: it lies as
/// closely as on the old one, the direction is that in which the branch leaves, and the critical multiplier
/// is the one at +1 of the orbit with the periods of the new branch.
fn seen_from_new_branch(source: &LocatedEvent, root: &PeriodicSolution) -> LocatedEvent {
    let from_one = |[re, im]: &[f64; 2]| (1.0 - re).hypot(*im);
    let multipliers = root.floquet_multipliers.iter().copied();
    let multiplier = multipliers.min_by(|a, b| from_one(a).total_cmp(&from_one(b)));
    LocatedEvent { multiplier, contacts: Vec::new(), ..source.clone() }
}

/// Starts of all jobs, in their order.
pub fn starts(connection: &Connection) -> Result<Vec<StartRecord>, StoreError> {
    let select = "SELECT id, period_multiple, branch FROM start WHERE piece IS NULL ORDER BY id";
    let mut statement = connection.prepare(select)?;
    statement.query_and_then([], StartRecord::read)?.collect()
}

/// Notes what came of a job: its starts, each with the walks that will begin there.
pub fn note_starts(
    transaction: Transaction<'_>,
    job: &JobRecord,
    starts: &[PeriodicSolution],
    message: Option<&str>,
) -> Result<(), StoreError> {
    let crossing = BranchEnd::Crossing { frequency_hz: job.frequency_hz };
    let down = (job.kind == JobKind::Doubling).then_some(&crossing);
    let left = job.source.filter(|_| job.kind.leaves_source());
    let source = left.map(|key| event(&transaction, key)).transpose()?.flatten();
    let update = "UPDATE job SET evaluated = 1, message = ?2 WHERE id = ?1";
    transaction.execute(update, params![job.id, message])?;
    for (start, key) in starts.iter().zip(starts_of_job(job.id)) {
        let row = SolvedRow {
            parameter: start.frequency_hz,
            solution: start.clone(),
            events: EventSet::of([(left.is_some(), BranchEventKind::BranchPoint)]),
            located: source.as_ref().map(|source| seen_from_new_branch(source, start)),
        };
        NewStart { key, job: Some(job.id), piece: None, row: &row, down }.insert(&transaction)?;
    }
    transaction.commit()?;
    Ok(())
}

/// A start is that of a new branch.
pub fn accept_start(transaction: Transaction<'_>, key: u32) -> Result<u32, StoreError> {
    let select = "SELECT max(branch) FROM start
        WHERE piece IS (SELECT piece FROM start WHERE id = ?1)";
    let newest: Option<u32> = transaction.query_row(select, [key], |row| row.get(0))?;
    let branch = newest.unwrap_or(0) + 1;
    transaction.execute("UPDATE start SET branch = ?2 WHERE id = ?1", params![key, branch])?;
    transaction.commit()?;
    Ok(branch)
}

/// A start lies on another branch: it goes, with everything that was walked from it.
pub fn drop_start(transaction: Transaction<'_>, key: u32) -> Result<(), StoreError> {
    delete_start(&transaction, key)?;
    transaction.commit()?;
    Ok(())
}
/// Deletes a start with everything that was walked from it.
pub(super) fn delete_start(transaction: &Transaction<'_>, key: u32) -> Result<(), StoreError> {
    for side in [Side::Up, Side::Down] {
        forget_walked(transaction, walk_id(key, side), 0)?;
    }
    transaction.execute("DELETE FROM walk WHERE start = ?1", [key])?;
    transaction.execute("DELETE FROM start WHERE id = ?1", [key])?;
    Ok(())
}
