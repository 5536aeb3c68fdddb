//! Reading: branches, their walks, and their solutions one after the other.

use hammerbeam_orbit::{BranchEventKind, EventSet, LocatedEvent, PeriodicSolution, Side};
use rusqlite::{Connection, OptionalExtension, Row as SqlRow, params};

use super::{
    Store, StoreError, blob,
    closed::ClosedAt,
    event::event,
    keys::{first_key, is_of_piece, solution_key, start_of_key, walk_id},
    stability,
    values::{END_COLUMNS, finite, period_multiple, read_end, read_row, row_columns},
};
use crate::{
    columns::TableColumn,
    end::BranchEnd,
    row::{Row, SolvedRow},
};

/// Number of the columns of a row.
const OF_ROW: usize = TableColumn::STORED.len();

/// A branch of the results, over the frequency or another parameter, or a curve.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchRecord {
    /// Number, counted from 1; within its piece, where it is of one.
    pub id: u32,
    /// Key of its start, by which its walks are found.
    pub start: u32,
    /// Orbit period over excitation period.
    pub period_multiple: u32,
    /// The walk from the start to higher values at first; its first solution is the start.
    pub up: WalkRecord,
    /// The walk from the start to lower values at first.
    pub down: WalkRecord,
}

/// One of the two walks of a branch.
#[derive(Debug, Clone, PartialEq)]
pub struct WalkRecord {
    /// Number of solutions.
    pub solutions: u64,
    /// How it ended; `None` if it has not.
    pub end: Option<BranchEnd>,
}

/// What a walk needs to go on.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredMemory {
    /// Its newest checkpoint.
    pub checkpoint: Vec<u8>,
    /// The whole of its journal.
    pub journal: Vec<u8>,
}

/// A row of a branch with its place in the store.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlacedRow {
    /// Its side,
    pub side: Side,
    /// and its number there.
    pub number: u32,
    /// What its tables show.
    pub row: Row,
}

impl BranchRecord {
    /// Number of its solutions.
    #[must_use]
    pub fn solutions(&self) -> u64 {
        self.up.solutions + self.down.solutions
    }

    /// Whether it came back to its start, which then is its first solution.
    fn starts_where_it_ends(&self) -> bool {
        self.up.end.as_ref().is_some_and(BranchEnd::is_closed) && self.down.solutions == 0
    }

    /// The walk to one side.
    #[must_use]
    pub fn walk(&self, side: Side) -> &WalkRecord {
        match side {
            Side::Up => &self.up,
            Side::Down => &self.down,
        }
    }

    /// The solution with which a side ends: a side without any ends at the start, which is the first of the
    /// up side, or where a closed branch came back to it; `None` if there is no solution.
    #[must_use]
    pub fn last_of(&self, side: Side) -> Option<(Side, u32)> {
        let last = |side: Side| self.walk(side).solutions.checked_sub(1).map(|last| (side, last as u32));
        last(side).or_else(|| (self.up.solutions > 0).then_some((Side::Up, 0))).or_else(|| last(Side::Down))
    }

    /// Where its solutions lie, end to end: the down side from its end, the start, the up side.
    pub fn places(&self) -> impl Iterator<Item = (Side, u32)> + use<> {
        let (down, up) = (self.down.solutions as u32, self.up.solutions as u32);
        let down = (0..down).rev().map(|number| (Side::Down, number));
        down.chain((0..up).map(|number| (Side::Up, number)))
    }

    fn is_of_piece(&self) -> bool {
        is_of_piece(self.start)
    }
}

impl Store {
    /// All branches over the frequency, in the order in which they were started.
    ///
    /// # Errors
    /// The database refuses.
    pub fn branches(&self) -> Result<Vec<BranchRecord>, StoreError> {
        branches_of(&self.connection, None)
    }

    /// A walk of a branch.
    ///
    /// # Errors
    /// The database refuses.
    pub fn walk(&self, start: u32, side: Side) -> Result<WalkRecord, StoreError> {
        walk(&self.connection, start, side)
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

    /// Hands over the rows of a branch end to end: the down side reversed, the start, the up side. The first
    /// and the last one of a branch over the frequency are marked.
    ///
    /// # Errors
    /// Solutions are missing or damaged, the database refuses, or `take` does.
    pub fn each_row<E: From<StoreError>>(
        &self,
        branch: &BranchRecord,
        mut take: impl FnMut(Row) -> Result<(), E>,
    ) -> Result<(), E> {
        self.each_placed_row(branch, |placed| take(placed.row))
    }

    /// The same, each with its place.
    ///
    /// # Errors
    /// Solutions are missing or damaged, the database refuses, or `take` does.
    pub fn each_placed_row<E: From<StoreError>>(
        &self,
        branch: &BranchRecord,
        mut take: impl FnMut(PlacedRow) -> Result<(), E>,
    ) -> Result<(), E> {
        let (mut place, mut closed) = (0, ClosedAt::of(branch.starts_where_it_ends()));
        for side in [Side::Down, Side::Up] {
            self.each_row_of_walk(walk_id(branch.start, side), side == Side::Down, |number, mut row| {
                place += 1;
                row.events = closed.events(&row, place == 1);
                if !branch.is_of_piece() {
                    row.events = with_ends(row.events, place == 1, place == branch.solutions());
                }
                take(PlacedRow { side, number, row })
            })?;
        }
        Ok(())
    }

    /// All rows of a branch end to end, each with its place.
    ///
    /// # Errors
    /// Solutions are missing or damaged, or the database refuses.
    pub fn placed_rows(&self, branch: &BranchRecord) -> Result<Vec<PlacedRow>, StoreError> {
        let mut rows = Vec::new();
        self.each_placed_row::<StoreError>(branch, |placed| {
            rows.push(placed);
            Ok(())
        })?;
        Ok(rows)
    }

    /// Hands over the multipliers of the solutions of a branch, end to end as [`Self::each_row`] does;
    /// largest modulus first. Where they are damaged it says so.
    ///
    /// # Errors
    /// The database refuses, or `take` does.
    pub fn each_multipliers<E: From<StoreError>>(
        &self,
        branch: &BranchRecord,
        take: impl FnMut(Result<Vec<[f64; 2]>, StoreError>) -> Result<(), E>,
    ) -> Result<(), E> {
        let read = |row: &SqlRow<'_>| read_multipliers(row, 0);
        self.each_solution(branch, "multiplier_count, multipliers", read, take)
    }

    /// Hands over where the orbits of the solutions of a branch begin, in the same order: the phase (cycles)
    /// and the state `[q; q']` there. Where they are damaged it says so.
    ///
    /// # Errors
    /// The database refuses, or `take` does.
    pub fn each_beginning<E: From<StoreError>>(
        &self,
        branch: &BranchRecord,
        take: impl FnMut(Result<(f64, Vec<f64>), StoreError>) -> Result<(), E>,
    ) -> Result<(), E> {
        let read = |row: &SqlRow<'_>| {
            let (length, bytes): (u32, Vec<u8>) = (row.get(1)?, row.get(2)?);
            let first = bytes.get(..8 * length as usize).unwrap_or(&bytes);
            Ok((finite("phase", row.get(0)?)?, blob::unpack("nodes", first, length as usize)?))
        };
        self.each_solution(branch, "phase_cycles, state_length, nodes", read, take)
    }

    /// Hands over what `read` makes of these columns of each solution of a branch, end to end.
    fn each_solution<T, E: From<StoreError>>(
        &self,
        branch: &BranchRecord,
        columns: &str,
        read: impl Fn(&SqlRow<'_>) -> Result<T, StoreError>,
        mut take: impl FnMut(Result<T, StoreError>) -> Result<(), E>,
    ) -> Result<(), E> {
        let failed = |error: rusqlite::Error| E::from(StoreError::from(error));
        for (side, order) in [(Side::Down, "DESC"), (Side::Up, "ASC")] {
            let walk = walk_id(branch.start, side);
            let select =
                format!("SELECT {columns}, id FROM solution WHERE id >= ?1 AND id < ?2 ORDER BY id {order}");
            let mut statement = self.connection.prepare_cached(&select).map_err(failed)?;
            let mut rows = statement.query(params![first_key(walk), first_key(walk + 1)]).map_err(failed)?;
            while let Some(row) = rows.next().map_err(failed)? {
                let key = row.get("id").map_err(failed)?;
                let found = self.check_solution(key).and_then(|()| read(row));
                take(found.map_err(|error| self.damaged(key, error)))?;
            }
        }
        Ok(())
    }

    /// Number of the solutions that a walk has counted.
    fn counted(&self, walk: i64) -> Result<i64, StoreError> {
        let count = "SELECT solutions FROM walk WHERE id = ?1";
        let mut statement = self.connection.prepare_cached(count)?;
        Ok(statement.query_row([walk], |row| row.get(0)).optional()?.unwrap_or(0))
    }

    /// Refuses a walk of which not every solution that it has counted is there, so that no other one takes
    /// its number.
    fn check_complete(&self, walk: i64, counted: i64) -> Result<(), StoreError> {
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

    /// Hands over the rows of a walk with their numbers, backwards or in the order in which it was walked.
    fn each_row_of_walk<E: From<StoreError>>(
        &self,
        walk: i64,
        backwards: bool,
        mut take: impl FnMut(u32, Row) -> Result<(), E>,
    ) -> Result<(), E> {
        // Counted first: a run that writes meanwhile only adds.
        let counted = self.counted(walk)?;
        let kept = self.kept.as_ref().map(|kept| kept.of_walk(&self.connection, walk, counted));
        if let Some(rows) = kept.transpose()?.flatten() {
            let mut rows = (0..rows.len() as u32).zip(rows);
            return match backwards {
                true => rows.rev().try_for_each(|(number, row)| take(number, *row)),
                false => rows.try_for_each(|(number, row)| take(number, *row)),
            };
        }
        let (columns, order) = (row_columns(), if backwards { "DESC" } else { "ASC" });
        let select =
            format!("SELECT id, {columns} FROM solution WHERE id >= ?1 AND id < ?2 ORDER BY id {order}");
        let failed = |error: rusqlite::Error| E::from(StoreError::from(error));
        self.check_complete(walk, counted)?;
        let mut statement = self.connection.prepare_cached(&select).map_err(failed)?;
        let mut rows = statement.query(params![first_key(walk), first_key(walk + 1)]).map_err(failed)?;
        while let Some(row) = rows.next().map_err(failed)? {
            let key = row.get(0).map_err(failed)?;
            let read = self.check_solution(key).and_then(|()| read_row(row, 1));
            take(key as u32, read.map_err(|error| self.damaged(key, error))?)?;
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
        Ok(self.solved_row(key)?.solution)
    }

    /// A stored solution by its key, with its row; what is known of its event is left out.
    ///
    /// # Errors
    /// There is no such solution, or it is damaged.
    pub fn solved_row(&self, key: i64) -> Result<SolvedRow, StoreError> {
        let columns = row_columns();
        let select = format!(
            "SELECT {columns}, segments, state_length, multiplier_count, multipliers, nodes,
            (SELECT period_multiple FROM start WHERE id = ?2), phase_cycles, on_circle
            FROM solution WHERE id = ?1"
        );
        let mut statement = self.connection.prepare_cached(&select)?;
        let mut rows = statement.query(params![key, start_of_key(key)])?;
        let Some(row) = rows.next()? else { return Err(self.missing(key, key)) };
        let read = self.check_solution(key).and_then(|()| read_solution(row));
        read.map_err(|error| self.damaged(key, error))
    }
}

impl Store {
    /// What is known of the event at a solution, if there is one.
    ///
    /// # Errors
    /// The database refuses, or the event is damaged.
    pub fn event(&self, key: i64) -> Result<Option<LocatedEvent>, StoreError> {
        event(&self.connection, key)
    }

    /// All Floquet multipliers of a stored solution.
    ///
    /// # Errors
    /// The database refuses, or they are damaged.
    pub fn multipliers(&self, key: i64) -> Result<Vec<[f64; 2]>, StoreError> {
        self.check_solution(key).map_err(|error| self.damaged(key, error))?;
        let select = "SELECT multipliers FROM solution WHERE id = ?1";
        let bytes: Vec<u8> = self.connection.prepare_cached(select)?.query_row([key], |row| row.get(0))?;
        let numbers = blob::unpack("multipliers", &bytes, bytes.len() / 8)?;
        Ok(numbers.as_chunks::<2>().0.to_vec())
    }

    /// The rows of a walk in the order in which they were walked.
    ///
    /// # Errors
    /// Solutions are missing or damaged, or the database refuses.
    pub fn walked(&self, start: u32, side: Side) -> Result<Vec<Row>, StoreError> {
        let mut rows = Vec::new();
        self.each_row_of_walk::<StoreError>(walk_id(start, side), false, |_, row| {
            rows.push(row);
            Ok(())
        })?;
        Ok(rows)
    }
}

/// The branches of a piece, by its key; over the frequency without one.
pub(super) fn branches_of(
    connection: &Connection,
    piece: Option<u32>,
) -> Result<Vec<BranchRecord>, StoreError> {
    let select = "SELECT branch, id, period_multiple FROM start
        WHERE branch IS NOT NULL AND piece IS ?1 ORDER BY branch";
    let mut statement = connection.prepare(select)?;
    let ids = statement.query_map([piece], |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?)))?;
    ids.map(|ids| {
        let (id, start, multiple) = ids?;
        let period_multiple = period_multiple(multiple)?;
        let (up, down) = (walk(connection, start, Side::Up)?, walk(connection, start, Side::Down)?);
        Ok(BranchRecord { id, start, period_multiple, up, down })
    })
    .collect()
}

/// A walk of a branch.
fn walk(connection: &Connection, start: u32, side: Side) -> Result<WalkRecord, StoreError> {
    let select = format!("SELECT solutions, {END_COLUMNS} FROM walk WHERE id = ?1");
    let mut statement = connection.prepare_cached(&select)?;
    let mut rows = statement.query([walk_id(start, side)])?;
    let Some(row) = rows.next()? else { return Err(rusqlite::Error::QueryReturnedNoRows.into()) };
    Ok(WalkRecord { solutions: row.get::<_, u32>(0)?.into(), end: read_end(row, 1)? })
}

/// Events with the marks of the first and the last row of a branch.
fn with_ends(events: EventSet, is_first: bool, is_last: bool) -> EventSet {
    let marks = [(is_first, BranchEventKind::Start), (is_last, BranchEventKind::End)];
    marks.into_iter().filter(|(is, _)| *is).fold(events, |events, (_, kind)| events.with(kind))
}

fn read_solution(row: &SqlRow<'_>) -> Result<SolvedRow, StoreError> {
    let shown = read_row(row, 0)?;
    let size = |column| row.get::<_, u32>(column).map(|size| size as usize);
    let (segments, state_length) = (size(OF_ROW)?, size(OF_ROW + 1)?);
    let node_bytes: Vec<u8> = row.get(OF_ROW + 4)?;
    let nodes = blob::unpack("nodes", &node_bytes, segments.saturating_mul(state_length))?;
    let solution = PeriodicSolution {
        frequency_hz: shown.frequency_hz,
        period_multiple: period_multiple(row.get(OF_ROW + 5)?)?,
        phase: finite("phase", row.get(OF_ROW + 6)?)?,
        nodes: nodes.chunks(state_length.max(1)).map(<[f64]>::to_vec).collect(),
        floquet_multipliers: read_multipliers(row, OF_ROW + 2)?,
        on_circle: stability::marks(&row.get::<_, Vec<u8>>(OF_ROW + 7)?),
        residual: shown.residual,
        error_estimate: shown.error_estimate,
        maxima: shown.maxima,
    };
    Ok(SolvedRow { parameter: shown.parameter, solution, events: shown.events, located: None })
}

/// Multipliers from the column of their number and the one behind it.
fn read_multipliers(row: &SqlRow<'_>, column: usize) -> Result<Vec<[f64; 2]>, StoreError> {
    let count: u32 = row.get(column)?;
    let bytes: Vec<u8> = row.get(column + 1)?;
    let numbers = blob::unpack("multipliers", &bytes, 2 * count as usize)?;
    Ok(numbers.chunks(2).map(|pair| [pair[0], pair[1]]).collect())
}
