//! Writing walks: each call is one transaction.

use hammerbeam_orbit::Side;
use rusqlite::{Transaction, params, params_from_iter, types::Value};

use super::{
    StoreError, blob,
    event::insert_event,
    keys::{first_key, walk_id},
    outputs::forget_outputs,
    stability,
    values::{END_COLUMNS, values_of_end, values_of_row},
};
use crate::{
    end::BranchEnd,
    row::{Row, SolvedRow},
};

/// How a walk goes on.
#[derive(Debug, Clone, Copy)]
pub enum Continuation<'a> {
    /// From here.
    GoesOn(Memory<'a>),
    /// Not at all.
    Ended(&'a BranchEnd),
    /// From here, if its budget grows.
    Paused(&'a BranchEnd, Memory<'a>),
}

/// All that a walk needs to go on.
#[derive(Debug, Clone, Copy)]
pub struct Memory<'a> {
    /// Replaces the last one.
    pub checkpoint: &'a [u8],
    /// Appended to what there is.
    pub journal: &'a [u8],
}

/// Adds solutions to a walk, together with how it goes on.
///
/// * `kept`: so many solutions stay; `None` for all.
pub fn write_walk(
    transaction: Transaction<'_>,
    (start, side): (u32, Side),
    kept: Option<u32>,
    rows: &[SolvedRow],
    continuation: Continuation<'_>,
) -> Result<(), StoreError> {
    let walk = walk_id(start, side);
    let count = "SELECT solutions FROM walk WHERE id = ?1";
    let mut stored: u32 = transaction.query_row(count, [walk], |row| row.get(0))?;
    if let Some(kept) = kept {
        forget_walked(&transaction, walk, kept)?;
        stored = stored.min(kept);
    }
    for (row, key) in rows.iter().zip(first_key(walk) + i64::from(stored)..) {
        insert_solution(&transaction, key, row)?;
    }
    let (end, memory) = match continuation {
        Continuation::GoesOn(memory) => (None, Some(memory)),
        Continuation::Ended(end) => (Some(end), None),
        Continuation::Paused(end, memory) => (Some(end), Some(memory)),
    };
    keep_journal(&transaction, walk, memory)?;
    let update = format!(
        "UPDATE walk SET (solutions, checkpoint, {END_COLUMNS}) = (?2, ?3, ?4, ?5, ?6, ?7) WHERE id = ?1"
    );
    let of_walk = [
        Value::Integer(walk),
        Value::Integer(i64::from(stored) + rows.len() as i64),
        memory.map_or(Value::Null, |memory| Value::Blob(memory.checkpoint.to_vec())),
    ];
    transaction.execute(&update, params_from_iter(of_walk.into_iter().chain(values_of_end(end))))?;
    transaction.commit()?;
    Ok(())
}
/// Deletes what was walked beyond so many solutions, and what is needed to go on.
pub(super) fn forget_walked(
    transaction: &Transaction<'_>,
    walk: i64,
    solutions: u32,
) -> Result<(), StoreError> {
    let (first, last) = (first_key(walk) + i64::from(solutions), first_key(walk + 1));
    transaction.execute("DELETE FROM event WHERE solution >= ?1 AND solution < ?2", [first, last])?;
    transaction.execute("DELETE FROM solution WHERE id >= ?1 AND id < ?2", [first, last])?;
    forget_outputs(transaction, [first, last])?;
    transaction.execute("DELETE FROM journal WHERE walk = ?1", [walk])?;
    Ok(())
}

/// Appends to the journal of a walk, or throws it away when the walk has ended.
fn keep_journal(
    transaction: &Transaction<'_>,
    walk: i64,
    memory: Option<Memory<'_>>,
) -> Result<(), StoreError> {
    match memory {
        None => transaction.execute("DELETE FROM journal WHERE walk = ?1", [walk])?,
        Some(memory) if memory.journal.is_empty() => 0,
        Some(memory) => {
            let insert = "INSERT INTO journal (walk, bytes) VALUES (?1, ?2)";
            transaction.execute(insert, params![walk, memory.journal])?
        }
    };
    Ok(())
}

/// Stores a solution under its key, with what is known of its event.
pub(super) fn insert_solution(
    transaction: &Transaction<'_>,
    key: i64,
    row: &SolvedRow,
) -> Result<(), StoreError> {
    let solution = &row.solution;
    let mut values = vec![Value::Integer(key)];
    values.extend(values_of_row(&Row::from(row)));
    values.extend([
        Value::Integer(solution.nodes.len() as i64),
        Value::Integer(solution.nodes.first().map_or(0, Vec::len) as i64),
        Value::Integer(solution.floquet_multipliers.len() as i64),
        Value::Blob(blob::pack(solution.floquet_multipliers.iter().flatten())),
        Value::Blob(blob::pack(solution.nodes.iter().flatten())),
        Value::Real(solution.phase),
        Value::Blob(stability::bytes(&solution.on_circle)),
    ]);
    let insert = format!("INSERT INTO solution VALUES ({})", vec!["?"; values.len()].join(", "));
    transaction.prepare_cached(&insert)?.execute(params_from_iter(values))?;
    match &row.located {
        Some(located) => insert_event(transaction, key, located),
        None => Ok(()),
    }
}
