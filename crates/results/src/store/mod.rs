//! The results folder: one database with every solution, which survives being killed at any instant.
//!
//! `results.db` is written in transactions (write-ahead log), each of which holds some solutions of a walk
//! together with the checkpoint from which the walk goes on: after a kill, what was committed is there, what
//! was not is computed again, and both agree to the last bit. `run.lock` is held while a run writes.
//!
//! Solutions are keyed by walk and number, so that a walk only ever appends, and read one after the other, so
//! that no branch has to fit into memory.

mod basins;
mod blob;
mod checksum;
mod class;
mod error;
mod event;
mod exponents;
mod jobs;
mod lock;
mod place;
mod read;
mod requests;
mod schema;
mod settled;
mod simulated;
mod simulation_layout;
mod stability;
mod varied;
mod write;

use std::{
    fs,
    path::{Path, PathBuf},
    thread,
    time::{Duration, Instant},
};

use hammerbeam_orbit::{Side, StopReason};
use hammerbeam_study::file::StudyFile;
use rusqlite::{Connection, OpenFlags, Transaction, TransactionBehavior};

pub use checksum::add_checksums;
pub use error::StoreError;
pub use event::VariedEvent;
pub use exponents::ExponentRecord;
pub use jobs::MOST_STARTS;
pub use jobs::{JobKind, JobRecord, StartRecord};
pub use read::{BranchRecord, Row, StoredMemory, WalkRecord};
pub use requests::{RequestKind, RequestRecord};
pub use schema::SCHEMA_VERSION;
pub use settled::SettledMotion;
pub use simulated::{SimulatedChunk, SimulatedContact, SimulatedTouch};
pub use simulation_layout::SimulationLayout;
pub use varied::{
    Piece, PieceBranchRecord, PieceRecord, StoredVariedOrbit, StoredVariedRow, VariedBranch, VariedRow,
};
pub use write::{Continuation, Memory};

use crate::{reason, whole_file::refuse_link};
use lock::Lock;
use place::Place;

/// Name of the database in a results folder.
pub const DATABASE: &str = "results.db";
/// How long one waits for another that reads or writes.
const READER: Duration = Duration::from_secs(5);

/// A results folder, open for reading, or for writing by one run.
#[derive(Debug)]
pub struct Store {
    connection: Connection,
    folder: PathBuf,
    /// Keys of the solutions that were found damaged, in increasing order.
    damaged: Vec<i64>,
    writing: Option<Writing>,
}

/// What a run that writes holds.
#[derive(Debug)]
struct Writing {
    _lock: Lock,
    /// Its number.
    writer: u64,
    /// Where its database is.
    place: Place,
}

/// How a walk ended, as it is stored.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredReason {
    /// `range-end`, `closed`, `shorter-period`, `crossing`, `budget`, `step-too-short`, `runs-back`,
    /// `contact-splits`, `crawls`, `unbounded`, `too-laborious`, `motion`.
    pub kind: String,
    /// Where [Hz], if there is a place.
    pub frequency_hz: Option<f64>,
    /// In words, with all numbers.
    pub message: String,
}

impl Store {
    /// Opens the results folder of a study for a run, and makes it if it is not there.
    ///
    /// # Errors
    /// [`StoreError`]: the folder belongs to another study or version, another run is writing it, a file of it
    /// is a link, or the disk refuses.
    /// Nothing is written then.
    pub fn open_for_run(folder: &Path, file: &StudyFile) -> Result<Self, StoreError> {
        let database = folder.join(DATABASE);
        refuse_links(&database)?;
        roll_back(&database)?;
        if database.exists() {
            schema::check_study(&open(&database, OpenFlags::SQLITE_OPEN_READ_ONLY)?, folder, file)?;
        }
        fs::create_dir_all(folder).map_err(|source| StoreError::folder(folder, source))?;
        let lock = Lock::take(folder)?;
        let flags = OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_CREATE;
        let mut connection = open(&database, flags)?;
        schema::check_study(&connection, folder, file)?;
        connection.pragma_update(None, "journal_mode", "WAL")?;
        connection.pragma_update(None, "synchronous", "NORMAL")?;
        let writer = schema::create_or_update(&mut connection, file)?;
        let damaged = checksum::check(&connection)?;
        let writing = Writing { _lock: lock, writer, place: Place::of(&database)? };
        let store = Self { connection, folder: folder.to_owned(), damaged, writing: Some(writing) };
        // Nothing is computed behind a solution that may be another one.
        match store.damaged.first() {
            Some(key) => Err(store.damaged(*key, StoreError::OtherThanStored)),
            None => Ok(store),
        }
    }

    /// Opens a results folder for reading.
    ///
    /// # Errors
    /// [`StoreError`]: there are no results, or they are of another version. Nothing is written.
    pub fn open(folder: &Path) -> Result<Self, StoreError> {
        let database = folder.join(DATABASE);
        if !database.is_file() {
            return Err(StoreError::NoResults { folder: folder.to_owned() });
        }
        roll_back(&database)?;
        let connection = open(&database, OpenFlags::SQLITE_OPEN_READ_ONLY)?;
        schema::check_version(&connection, folder)?;
        let damaged = checksum::check(&connection)?;
        Ok(Self { connection, folder: folder.to_owned(), damaged, writing: None })
    }

    /// Begins a transaction that writes, if this is still the run that writes, to the database that is still
    /// there.
    ///
    /// The lock of the folder alone does not say so: someone may have removed it, and then another run takes
    /// it as well. That run has the next number, and the one before it adds nothing more.
    fn write(&mut self) -> Result<Transaction<'_>, StoreError> {
        let transaction = self.connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
        if let Some(writing) = &self.writing {
            writing.place.check()?;
            if schema::writer(&transaction)? != writing.writer {
                return Err(StoreError::TakenOver { folder: self.folder.clone() });
            }
        }
        Ok(transaction)
    }

    /// The results folder.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Leaves one plain file behind and lets the lock go. While someone reads the folder (to draw it, say)
    /// that cannot be: it waits for the reader, and after some seconds leaves the file with its log beside
    /// it, which is as good to read.
    ///
    /// # Errors
    /// The disk refuses; everything is stored all the same.
    pub fn finish(self) -> Result<(), StoreError> {
        if let Some(writing) = &self.writing {
            writing.place.check()?;
            let begun = Instant::now();
            while let Err(error) = self.connection.pragma_update(None, "journal_mode", "DELETE") {
                match error.sqlite_error_code() {
                    Some(rusqlite::ErrorCode::DatabaseBusy) if begun.elapsed() < READER => {
                        thread::sleep(Duration::from_millis(50));
                    }
                    Some(rusqlite::ErrorCode::DatabaseBusy) => break,
                    _ => return Err(error.into()),
                }
            }
        }
        self.connection.close().map_err(|(_, error)| error)?;
        Ok(())
    }
}

impl StoredReason {
    /// The side of a branch that begins where it leaves another one.
    #[must_use]
    pub fn of_crossing(frequency_hz: f64) -> Self {
        Self {
            kind: "crossing".to_owned(),
            frequency_hz: Some(frequency_hz),
            message: format!("leaves a branch of half the period at {frequency_hz:.6} Hz"),
        }
    }

    /// A walk that could not begin at its start.
    #[must_use]
    pub fn not_begun(message: &str) -> Self {
        Self {
            kind: "not-begun".to_owned(),
            frequency_hz: None,
            message: format!("the branch could not be followed from its start: {message}"),
        }
    }

    /// A walk whose next solution could not be computed.
    #[must_use]
    pub fn failed(message: &str) -> Self {
        Self {
            kind: "failed".to_owned(),
            frequency_hz: None,
            message: format!("the next solution cannot be computed: {message}"),
        }
    }

    /// A side that comes upon another branch where that one was lost.
    #[must_use]
    pub fn joins(branch: u32, frequency_hz: f64) -> Self {
        Self {
            kind: JOINS.to_owned(),
            frequency_hz: Some(frequency_hz),
            message: format!("beyond {frequency_hz:.6} Hz it is branch {branch}, which ended there"),
        }
    }

    /// The reason, as it is stored.
    #[must_use]
    pub fn of(reason: &StopReason) -> Self {
        let (kind, frequency_hz) = match reason {
            StopReason::RangeEnd { frequency_hz } => ("range-end", Some(*frequency_hz)),
            StopReason::Closed => ("closed", None),
            StopReason::ShorterPeriod { frequency_hz, .. } => ("shorter-period", Some(*frequency_hz)),
            StopReason::Budget { .. } => ("budget", None),
            StopReason::StepTooShort { frequency_hz, .. } => ("step-too-short", Some(*frequency_hz)),
            StopReason::RunsBack { frequency_hz, .. } => ("runs-back", Some(*frequency_hz)),
            StopReason::ContactSplits { frequency_hz, .. } => ("contact-splits", Some(*frequency_hz)),
            StopReason::Crawls { frequency_hz, .. } => ("crawls", Some(*frequency_hz)),
            StopReason::Unbounded { frequency_hz, .. } => (UNBOUNDED, Some(*frequency_hz)),
            StopReason::TooLaborious { frequency_hz, .. } => ("too-laborious", Some(*frequency_hz)),
            StopReason::Motion { frequency_hz, .. } => ("motion", Some(*frequency_hz)),
        };
        // The end of the range is what the study says, with all its digits.
        let at = |place: f64| match reason {
            StopReason::RangeEnd { .. } => format!("{place} Hz"),
            _ => format!("{place:.6} Hz"),
        };
        let message = reason::in_words(reason, &reason::OVER_FREQUENCY, at);
        Self { kind: kind.to_owned(), frequency_hz, message }
    }
}

/// The reason in words.
impl std::fmt::Display for StoredReason {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.pad(&self.message)
    }
}

/// Kind of the end of a branch that goes to infinity.
const UNBOUNDED: &str = "unbounded";

/// Kind of the end of a branch that comes upon another one.
const JOINS: &str = "joins";

impl StoredReason {
    /// Whether the branch goes to infinity.
    #[must_use]
    pub fn is_unbounded(&self) -> bool {
        self.kind == UNBOUNDED
    }

    /// Whether more budget lets the walk go on.
    #[must_use]
    pub fn is_budget(&self) -> bool {
        self.kind == "budget"
    }

    /// Whether the branch is closed, so that one walk is all of it.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.kind == "closed"
    }

    /// Whether the walk ended where it should, and not early.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.is_closed()
            || ["range-end", "shorter-period", "crossing", JOINS, UNBOUNDED].contains(&self.kind.as_str())
    }
}

/// Key of a solution.
pub fn solution_key(start: u32, side: Side, number: u32) -> i64 {
    first_key(walk_id(start, side)) + i64::from(number)
}

/// The start on whose walks a solution lies.
pub fn start_of_key(key: i64) -> u32 {
    (key >> 33) as u32
}

/// Number of a walk: two for each start.
fn walk_id(start: u32, side: Side) -> i64 {
    i64::from(start) * 2 + i64::from(side == Side::Down)
}

/// Key of the first solution a walk can have; the walk has the 2^32 keys from there.
fn first_key(walk: i64) -> i64 {
    walk << 32
}

/// Refuses to write a database that is a link, or has one beside it for a log of its own.
fn refuse_links(database: &Path) -> Result<(), StoreError> {
    for suffix in ["", "-wal", "-shm", "-journal"] {
        let path = database.with_file_name(format!("{DATABASE}{suffix}"));
        refuse_link(&path).map_err(|source| StoreError::Folder { folder: path, source })?;
    }
    Ok(())
}

/// Undoes what was half written when a run was killed while it left one plain file behind; only a connection
/// that may write can do so.
fn roll_back(database: &Path) -> Result<(), StoreError> {
    let journal = database.with_file_name(format!("{DATABASE}-journal"));
    if database.is_file() && journal.is_file() {
        refuse_links(database)?;
        let connection = open(database, OpenFlags::SQLITE_OPEN_READ_WRITE)?;
        connection.query_row("SELECT count(*) FROM sqlite_master", [], |_| Ok(()))?;
    }
    Ok(())
}

fn open(database: &Path, flags: OpenFlags) -> Result<Connection, StoreError> {
    // As a path from here, or a folder named `file:x` would be read as an address.
    let database = Path::new(".").join(database);
    let connection = Connection::open_with_flags(database, flags | OpenFlags::SQLITE_OPEN_NO_MUTEX)?;
    connection.busy_timeout(READER)?;
    add_checksums(&connection)?;
    Ok(connection)
}

#[cfg(test)]
mod motion_tests;
#[cfg(test)]
mod simulated_tests;
#[cfg(test)]
mod tests;
