//! Writing: each call is one transaction.

use hammerbeam_orbit::{BranchRow, Events, PeriodicSolution, Side};
use rusqlite::{Transaction, params};

use super::{Store, StoreError, StoredReason, blob, event::insert_event, first_key, stability, walk_id};

/// How a walk goes on.
#[derive(Debug, Clone, Copy)]
pub enum Continuation<'a> {
    /// From here.
    GoesOn(Memory<'a>),
    /// Not at all.
    Ended(&'a StoredReason),
    /// From here, if its budget grows.
    Paused(&'a StoredReason, Memory<'a>),
}

/// All that a walk needs to go on.
#[derive(Debug, Clone, Copy)]
pub struct Memory<'a> {
    /// Replaces the last one.
    pub checkpoint: &'a [u8],
    /// Appended to what there is.
    pub journal: &'a [u8],
}

impl Store {
    /// Appends solutions to a walk, together with how it goes on.
    ///
    /// # Errors
    /// The database refuses; nothing is appended then.
    pub fn append(
        &mut self,
        start: u32,
        side: Side,
        rows: &[BranchRow],
        continuation: Continuation<'_>,
    ) -> Result<(), StoreError> {
        let walk = walk_id(start, side);
        let transaction = self.write()?;
        let stored: i64 =
            transaction.query_row("SELECT solutions FROM walk WHERE id = ?1", [walk], |row| row.get(0))?;
        for (row, key) in rows.iter().zip(first_key(walk) + stored..) {
            insert_solution(&transaction, key, &row.solution, row.events)?;
            if let Some(located) = &row.located {
                insert_event(&transaction, ("event", &[key]), located)?;
            }
        }
        let (reason, memory) = match continuation {
            Continuation::GoesOn(memory) => (None, Some(memory)),
            Continuation::Ended(reason) => (Some(reason), None),
            Continuation::Paused(reason, memory) => (Some(reason), Some(memory)),
        };
        keep_journal(&transaction, walk, memory)?;
        let update =
            "UPDATE walk SET solutions = ?2, checkpoint = ?3, stop_kind = ?4, stop_frequency_hz = ?5,
            stop_message = ?6 WHERE id = ?1";
        let values = params![
            walk,
            stored + rows.len() as i64,
            memory.map(|memory| memory.checkpoint),
            reason.map(|reason| &reason.kind),
            reason.and_then(|reason| reason.frequency_hz),
            reason.map(|reason| &reason.message),
        ];
        transaction.execute(update, values)?;
        transaction.commit()?;
        Ok(())
    }
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

pub(super) fn insert_solution(
    transaction: &Transaction<'_>,
    key: i64,
    solution: &PeriodicSolution,
    events: Events,
) -> Result<(), StoreError> {
    let insert = "INSERT INTO solution VALUES
        (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15, ?16, ?17, ?18, ?19, ?20, ?21)";
    let maxima = &solution.maxima;
    let [re, im] = solution.floquet_multipliers.first().copied().unwrap_or([0.0, 0.0]);
    let state_length = solution.nodes.first().map_or(0, Vec::len);
    transaction.prepare_cached(insert)?.execute(params![
        key,
        solution.frequency_hz,
        maxima.displacement,
        maxima.acceleration,
        maxima.contact_force,
        maxima.impact_velocity,
        maxima.impulse,
        maxima.contacts,
        pack_events(events),
        stability::number(solution.stability()),
        re,
        im.abs(),
        solution.residual,
        solution.error_estimate,
        solution.nodes.len() as i64,
        state_length as i64,
        solution.floquet_multipliers.len() as i64,
        blob::pack(solution.floquet_multipliers.iter().flatten()),
        blob::pack(solution.nodes.iter().flatten()),
        solution.phase,
        stability::bytes(&solution.on_circle),
    ])?;
    Ok(())
}

/// Events as bits; start and end follow from the place in the branch and are not stored.
fn pack_events(events: Events) -> u32 {
    [events.fold, events.flip, events.neimark_sacker, events.branch_point, events.grazing]
        .iter()
        .enumerate()
        .map(|(bit, set)| u32::from(*set) << bit)
        .sum()
}

/// The events of those bits.
pub(super) fn unpack_events(bits: u32) -> Events {
    let set = |bit: u32| bits >> bit & 1 == 1;
    Events {
        fold: set(0),
        flip: set(1),
        neimark_sacker: set(2),
        branch_point: set(3),
        grazing: set(4),
        ..Events::default()
    }
}
