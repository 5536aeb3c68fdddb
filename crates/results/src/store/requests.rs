//! Requests: what was asked of motions that need not repeat (`simulate`, `sweep`, `lyapunov`, `basins`), and
//! how far it is done.
//!
//! A request is known by its kind and by its words, lines `key = value` with everything that its results
//! depend on besides the study. Asked again it is found, and goes on where it was left: results and the
//! number of pieces done are committed together.

use rusqlite::{Connection, OptionalExtension, Transaction, params};

use super::StoreError;

/// What a request is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum RequestKind {
    /// Motions in time; its pieces are periods, those of the transient first.
    Simulation,
    /// Stepped sweeps with the state carried over; its pieces are motions.
    Sweep,
    /// Motions from several states at each frequency; its pieces are frequencies.
    Starts,
    /// Spectra of Lyapunov exponents; its pieces are frequencies.
    Exponents,
    /// Basins of attraction; its pieces are cells.
    Basins,
}

impl RequestKind {
    const ALL: [Self; 5] = [Self::Simulation, Self::Sweep, Self::Starts, Self::Exponents, Self::Basins];

    /// Its name: `simulation`, `sweep`, `starts`, `exponents`, `basins`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Simulation => "simulation",
            Self::Sweep => "sweep",
            Self::Starts => "starts",
            Self::Exponents => "exponents",
            Self::Basins => "basins",
        }
    }
}

/// A request that is in the store.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RequestRecord {
    /// Its number in the folder, counted from 1.
    pub id: i64,
    /// What it is for.
    pub kind: RequestKind,
    /// What was asked, as lines `key = value`.
    pub words: String,
    /// Pieces of work it has.
    pub pieces: u64,
    /// Those that are done.
    pub done: u64,
}

impl RequestRecord {
    /// The value behind a key of its words.
    #[must_use]
    pub fn word(&self, key: &str) -> Option<&str> {
        self.words
            .lines()
            .filter_map(|line| line.split_once(" = "))
            .find(|(name, _)| *name == key)
            .map(|(_, value)| value)
    }
}

/// The request of that kind and of those words; added if it is new.
pub fn request(
    transaction: Transaction<'_>,
    kind: RequestKind,
    words: &str,
    pieces: u64,
) -> Result<RequestRecord, StoreError> {
    let insert = "INSERT OR IGNORE INTO request (kind, words, pieces) VALUES (?1, ?2, ?3)";
    transaction.execute(insert, params![kind.name(), words, pieces as i64])?;
    let select = "SELECT id, done FROM request WHERE kind = ?1 AND words = ?2";
    let (id, done): (i64, i64) =
        transaction.query_row(select, params![kind.name(), words], |row| Ok((row.get(0)?, row.get(1)?)))?;
    transaction.commit()?;
    Ok(RequestRecord { id, kind, words: words.to_owned(), pieces, done: done as u64 })
}

/// All requests in the order in which they came.
pub fn requests(connection: &Connection) -> Result<Vec<RequestRecord>, StoreError> {
    let mut statement =
        connection.prepare("SELECT id, kind, words, pieces, done FROM request ORDER BY id")?;
    let mut rows = statement.query([])?;
    let mut requests = Vec::new();
    while let Some(row) = rows.next()? {
        let name: String = row.get(1)?;
        let kind = RequestKind::ALL
            .into_iter()
            .find(|kind| kind.name() == name)
            .ok_or(StoreError::Unknown { what: "kind of request", found: name })?;
        let (pieces, done): (i64, i64) = (row.get(3)?, row.get(4)?);
        requests.push(RequestRecord {
            id: row.get(0)?,
            kind,
            words: row.get(2)?,
            pieces: pieces as u64,
            done: done as u64,
        });
    }
    Ok(requests)
}
/// Notes how many pieces of a request are done, in the transaction that stores their results.
///
/// A request on which nobody else has gone on in the meantime is at `before`; else nothing is to be stored.
pub(super) fn advance(
    transaction: &Transaction<'_>,
    request: i64,
    (before, after): (u64, u64),
) -> Result<(), StoreError> {
    let select = "SELECT done FROM request WHERE id = ?1";
    let found: Option<i64> = transaction.query_row(select, [request], |row| row.get(0)).optional()?;
    let found = found.unwrap_or_default() as u64;
    if found != before {
        return Err(StoreError::OutOfOrder { request, found, expected: before });
    }
    transaction.execute("UPDATE request SET done = ?2 WHERE id = ?1", params![request, after as i64])?;
    Ok(())
}
