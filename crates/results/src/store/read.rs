//! Reading: branches, their walks, and their solutions one after the other.

use hammerbeam_orbit::{Events, OrbitMaxima, PeriodicSolution, Side, Stability};
use rusqlite::{OptionalExtension, Row as SqlRow, params};

use super::{
    Store, StoreError, StoredReason, blob, first_key, solution_key, stability, walk_id, write::unpack_events,
};

/// A branch of the results.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchRecord {
    /// Number, counted from 1.
    pub id: u32,
    /// Key of its start, by which its walks are found.
    pub start: u32,
    /// Orbit period over excitation period.
    pub period_multiple: u32,
    /// The walk from the start to higher frequencies at first; its first solution is the start.
    pub up: WalkRecord,
    /// The walk from the start to lower frequencies at first.
    pub down: WalkRecord,
}

/// One of the two walks of a branch.
#[derive(Debug, Clone, PartialEq)]
pub struct WalkRecord {
    /// Number of solutions.
    pub solutions: u64,
    /// Why it ended; `None` if it has not.
    pub reason: Option<StoredReason>,
}

/// What a walk needs to go on.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredMemory {
    /// Its newest checkpoint.
    pub checkpoint: Vec<u8>,
    /// The whole of its journal.
    pub journal: Vec<u8>,
}

/// What the tables of a solution show, without its nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
    /// Maxima over the orbit.
    pub maxima: OrbitMaxima,
    /// Events, start and end of the branch included.
    pub events: Events,
    /// What is known of its stability.
    pub stability: Stability,
    /// Multiplier of the largest modulus, the positive one of a pair.
    pub leading_multiplier: [f64; 2],
    /// Residual of the shooting equations.
    pub residual: f64,
    /// Estimated error.
    pub error_estimate: f64,
}

const ROW: &str = "frequency_hz, max_abs_displacement_m, max_abs_acceleration_m_s2, max_contact_force_n,
    max_impact_velocity_m_s, impulse_n_s, contacts, events, stable, leading_multiplier_re, leading_multiplier_im,
    residual, error_estimate";

impl Store {
    /// As long as this is held, everything read is of one moment, even while a run writes.
    ///
    /// # Errors
    /// The database refuses.
    pub fn snapshot(&self) -> Result<impl Sized + use<'_>, StoreError> {
        Ok(self.connection.unchecked_transaction()?)
    }

    /// All branches, in the order in which they were begun.
    ///
    /// # Errors
    /// The database refuses.
    pub fn branches(&self) -> Result<Vec<BranchRecord>, StoreError> {
        let select = "SELECT branch, id, period_multiple FROM start WHERE branch IS NOT NULL ORDER BY branch";
        let mut statement = self.connection.prepare(select)?;
        let ids = statement.query_map([], |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?)))?;
        ids.map(|ids| {
            let (id, start, period_multiple) = ids?;
            let (up, down) = (self.walk(start, Side::Up)?, self.walk(start, Side::Down)?);
            Ok(BranchRecord { id, start, period_multiple, up, down })
        })
        .collect()
    }

    /// A walk of a branch.
    ///
    /// # Errors
    /// The database refuses.
    pub fn walk(&self, start: u32, side: Side) -> Result<WalkRecord, StoreError> {
        let select = "SELECT solutions, stop_kind, stop_frequency_hz, stop_message FROM walk WHERE id = ?1";
        let read = |row: &SqlRow<'_>| {
            let kind: Option<String> = row.get(1)?;
            let reason = match kind {
                Some(kind) => Some(StoredReason { kind, frequency_hz: row.get(2)?, message: row.get(3)? }),
                None => None,
            };
            Ok(WalkRecord { solutions: row.get::<_, u32>(0)?.into(), reason })
        };
        Ok(self.connection.query_row(select, [walk_id(start, side)], read)?)
    }

    /// The checkpoint and the journal from which a walk goes on, if it does.
    ///
    /// # Errors
    /// The database refuses.
    pub fn checkpoint(&self, start: u32, side: Side) -> Result<Option<StoredMemory>, StoreError> {
        let walk = walk_id(start, side);
        let select = "SELECT checkpoint FROM walk WHERE id = ?1";
        let checkpoint: Option<Vec<u8>> = self.connection.query_row(select, [walk], |row| row.get(0))?;
        let Some(checkpoint) = checkpoint else { return Ok(None) };
        let mut journal = Vec::new();
        let mut statement =
            self.connection.prepare("SELECT bytes FROM journal WHERE walk = ?1 ORDER BY id")?;
        let mut pieces = statement.query([walk])?;
        while let Some(piece) = pieces.next()? {
            journal.extend_from_slice(piece.get_ref(0)?.as_blob().map_err(rusqlite::Error::from)?);
        }
        Ok(Some(StoredMemory { checkpoint, journal }))
    }

    /// Hands over the rows of a branch end to end: the down side reversed, the start, the up side.
    ///
    /// # Errors
    /// Solutions are missing or damaged, the database refuses, or `take` does.
    pub fn each_row<E: From<StoreError>>(
        &self,
        branch: &BranchRecord,
        mut take: impl FnMut(Row) -> Result<(), E>,
    ) -> Result<(), E> {
        let total = branch.up.solutions + branch.down.solutions;
        let mut place = 0;
        for (side, order) in [(Side::Down, "DESC"), (Side::Up, "ASC")] {
            self.each_row_of_walk(walk_id(branch.start, side), order, |mut row| {
                row.events.start = place == 0;
                row.events.end = place + 1 == total;
                place += 1;
                take(row)
            })?;
        }
        Ok(())
    }

    /// Hands over the multipliers of the solutions of a branch, end to end as [`Self::each_row`] does;
    /// largest modulus first. Where they are damaged it says so.
    ///
    /// # Errors
    /// The database refuses, or `take` does.
    pub fn each_multipliers<E: From<StoreError>>(
        &self,
        branch: &BranchRecord,
        mut take: impl FnMut(Result<Vec<[f64; 2]>, StoreError>) -> Result<(), E>,
    ) -> Result<(), E> {
        let failed = |error: rusqlite::Error| E::from(StoreError::from(error));
        for (side, order) in [(Side::Down, "DESC"), (Side::Up, "ASC")] {
            let walk = walk_id(branch.start, side);
            let select = format!(
                "SELECT multiplier_count, multipliers, id FROM solution WHERE id >= ?1 AND id < ?2 ORDER BY id {order}"
            );
            let mut statement = self.connection.prepare_cached(&select).map_err(failed)?;
            let mut rows = statement.query(params![first_key(walk), first_key(walk + 1)]).map_err(failed)?;
            while let Some(row) = rows.next().map_err(failed)? {
                let key = row.get(2).map_err(failed)?;
                let read = self.check_solution(key).and_then(|()| read_multipliers(row, 0));
                take(read.map_err(|error| self.damaged(key, error)))?;
            }
        }
        Ok(())
    }

    /// Refuses a walk of which not every solution that it has counted is there, so that no other one takes
    /// its number.
    fn check_complete(&self, walk: i64) -> Result<(), StoreError> {
        // Counted first: a run that writes meanwhile only adds.
        let count = "SELECT solutions FROM walk WHERE id = ?1";
        let counted: i64 =
            self.connection.query_row(count, [walk], |row| row.get(0)).optional()?.unwrap_or(0);
        let (first, end) = (first_key(walk), first_key(walk) + counted);
        let mut keys = self
            .connection
            .prepare_cached("SELECT id FROM solution WHERE id >= ?1 AND id < ?2 ORDER BY id")?;
        let mut expected = first;
        for key in keys.query_map(params![first, end], |row| row.get::<_, i64>(0))? {
            let key = key?;
            if key != expected {
                return Err(self.missing(expected, key - 1));
            }
            expected += 1;
        }
        if expected < end { Err(self.missing(expected, end - 1)) } else { Ok(()) }
    }

    fn each_row_of_walk<E: From<StoreError>>(
        &self,
        walk: i64,
        order: &str,
        mut take: impl FnMut(Row) -> Result<(), E>,
    ) -> Result<(), E> {
        let select = format!("SELECT {ROW}, id FROM solution WHERE id >= ?1 AND id < ?2 ORDER BY id {order}");
        let failed = |error: rusqlite::Error| E::from(StoreError::from(error));
        self.check_complete(walk)?;
        let mut statement = self.connection.prepare_cached(&select).map_err(failed)?;
        let mut rows = statement.query(params![first_key(walk), first_key(walk + 1)]).map_err(failed)?;
        while let Some(row) = rows.next().map_err(failed)? {
            let key = row.get(13).map_err(failed)?;
            let read = self.check_solution(key).and_then(|()| Ok(read_row(row)?));
            take(read.map_err(|error| self.damaged(key, error))?)?;
        }
        Ok(())
    }

    /// A stored solution of a walk with its nodes; number 0 of the up side is the start.
    ///
    /// # Errors
    /// There is no such solution, or it is damaged.
    pub fn solution(&self, start: u32, side: Side, number: u32) -> Result<PeriodicSolution, StoreError> {
        self.solution_of_key(solution_key(start, side, number))
    }

    /// A stored solution by its key.
    ///
    /// # Errors
    /// There is no such solution, or it is damaged.
    pub fn solution_of_key(&self, key: i64) -> Result<PeriodicSolution, StoreError> {
        let select = format!(
            "SELECT {ROW}, segments, state_length, multiplier_count, multipliers, nodes,
            (SELECT period_multiple FROM start WHERE id = ?2), phase_cycles, on_circle FROM solution WHERE id = ?1"
        );
        let mut statement = self.connection.prepare_cached(&select)?;
        let mut rows = statement.query(params![key, key >> 33])?;
        let Some(row) = rows.next()? else { return Err(self.missing(key, key)) };
        let read = self.check_solution(key).and_then(|()| read_solution(row));
        read.map_err(|error| self.damaged(key, error))
    }

    /// Refuses a solution that was found damaged when the folder was opened.
    pub(super) fn check_solution(&self, key: i64) -> Result<(), StoreError> {
        match self.damaged.binary_search(&key) {
            Ok(_) => Err(StoreError::OtherThanStored),
            Err(_) => Ok(()),
        }
    }

    /// Says which solution it is that cannot be read.
    pub(super) fn damaged(&self, key: i64, error: StoreError) -> StoreError {
        let (branch, side) = self.place_of(key);
        StoreError::DamagedSolution { branch, side, number: key as u32, source: Box::new(error) }
    }

    /// Says which solutions of a walk are not there, from one key to another.
    fn missing(&self, first: i64, last: i64) -> StoreError {
        let (branch, side) = self.place_of(first);
        StoreError::MissingSolutions { branch, side, first: first as u32, last: last as u32 }
    }

    /// Branch and side of a solution, in words.
    fn place_of(&self, key: i64) -> (String, &'static str) {
        let select = "SELECT branch FROM start WHERE id = ?1";
        let branch: Option<u32> =
            self.connection.query_row(select, [key >> 33], |row| row.get(0)).unwrap_or_default();
        let branch = branch.map_or_else(|| "(none yet)".to_owned(), |branch| branch.to_string());
        (branch, if key >> 32 & 1 == 1 { "down" } else { "up" })
    }
}

impl Store {
    /// The rows of a walk in the order in which they were walked.
    ///
    /// # Errors
    /// Solutions are missing or damaged, or the database refuses.
    pub fn walked(&self, start: u32, side: Side) -> Result<Vec<Row>, StoreError> {
        let mut rows = Vec::new();
        self.each_row_of_walk::<StoreError>(walk_id(start, side), "ASC", |row| {
            rows.push(row);
            Ok(())
        })?;
        Ok(rows)
    }
}

fn read_row(row: &SqlRow<'_>) -> rusqlite::Result<Row> {
    Ok(Row {
        frequency_hz: row.get(0)?,
        maxima: OrbitMaxima {
            displacement: row.get(1)?,
            acceleration: row.get(2)?,
            contact_force: row.get(3)?,
            impact_velocity: row.get(4)?,
            impulse: row.get(5)?,
            contacts: row.get(6)?,
        },
        events: unpack_events(row.get(7)?),
        stability: row.get::<_, stability::Stored>(8)?.0,
        leading_multiplier: [row.get(9)?, row.get(10)?],
        residual: row.get(11)?,
        error_estimate: row.get(12)?,
    })
}

fn read_solution(row: &SqlRow<'_>) -> Result<PeriodicSolution, StoreError> {
    let shown = read_row(row)?;
    let size = |column| row.get::<_, u32>(column).map(|size| size as usize);
    let (segments, state_length) = (size(13)?, size(14)?);
    let node_bytes: Vec<u8> = row.get(17)?;
    let nodes = blob::unpack("nodes", &node_bytes, segments * state_length)?;
    Ok(PeriodicSolution {
        frequency_hz: shown.frequency_hz,
        period_multiple: row.get(18)?,
        phase: row.get(19)?,
        nodes: nodes.chunks(state_length.max(1)).map(<[f64]>::to_vec).collect(),
        floquet_multipliers: read_multipliers(row, 15)?,
        on_circle: stability::marks(&row.get::<_, Vec<u8>>(20)?),
        residual: shown.residual,
        error_estimate: shown.error_estimate,
        maxima: shown.maxima,
    })
}

/// Multipliers from the column of their number and the one behind it.
fn read_multipliers(row: &SqlRow<'_>, column: usize) -> Result<Vec<[f64; 2]>, StoreError> {
    let count: u32 = row.get(column)?;
    let bytes: Vec<u8> = row.get(column + 1)?;
    let numbers = blob::unpack("multipliers", &bytes, 2 * count as usize)?;
    Ok(numbers.chunks(2).map(|pair| [pair[0], pair[1]]).collect())
}
