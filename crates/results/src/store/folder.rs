//! The results folder itself: opening it for a run or for reading, transactions, closing it.

use std::{
    fs, io,
    path::{Path, PathBuf},
    thread,
    time::{Duration, Instant},
};

use hammerbeam_study::file::StudyFile;
use rusqlite::{Connection, OpenFlags, Transaction, TransactionBehavior, config::DbConfig};

use super::{
    checksum::{self, add_checksums},
    error::{DATABASE, StoreError},
    kept_rows::KeptRows,
    keys::{side_of_key, side_word, start_of_key},
    lock::Lock,
    place::Place,
    schema,
};
use crate::whole_file::refuse_link;

/// How long one waits for another that reads or writes.
const READER: Duration = Duration::from_secs(5);

/// Instructions of the database between two questions whether to go on: some dozens of rows.
const BETWEEN_QUESTIONS: i32 = 1000;

/// A results folder, open for reading, or for writing by one run.
#[derive(Debug)]
pub struct Store {
    pub(super) connection: Connection,
    folder: PathBuf,
    /// Keys of the solutions that were found damaged, in increasing order.
    damaged: Vec<i64>,
    /// `None` where nobody asked for them, or something is damaged or missing.
    pub(super) kept: Option<KeptRows>,
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

impl Store {
    /// Opens the results folder of a study for a run, and makes it if it is not there.
    ///
    /// # Errors
    /// [`StoreError`]: the folder belongs to another study or version, another run is writing it, a file of
    /// it is a link, or the disk refuses. Nothing is written then.
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
        let connection = open(&database, flags)?;
        schema::check_study(&connection, folder, file)?;
        // Before anything is written: a damaged row that is replaced has a checksum that fits again.
        let damaged = match schema::is_empty(&connection, folder)? {
            true => Vec::new(),
            false => {
                // All of one moment.
                let _moment = connection.unchecked_transaction()?;
                checksum::check(&connection, schema::create_tables, |_, _| {})?
            }
        };
        let mut store = Self { connection, folder: folder.to_owned(), damaged, kept: None, writing: None };
        // Nothing is computed behind a solution that may be another one.
        if let Some(&key) = store.damaged.first() {
            return Err(store.damaged(key, StoreError::OtherThanStored));
        }
        store.connection.pragma_update(None, "journal_mode", "WAL")?;
        store.connection.pragma_update(None, "synchronous", "NORMAL")?;
        let writer = schema::create_or_update(&mut store.connection, file)?;
        store.writing = Some(Writing { _lock: lock, writer, place: Place::of(&database)? });
        Ok(store)
    }

    /// Opens a results folder for reading.
    ///
    /// # Errors
    /// [`StoreError`]: there are no results, or they are of another version. Nothing is written.
    pub fn open(folder: &Path) -> Result<Self, StoreError> {
        Self::open_checked(folder, false)
    }

    /// The same for whoever goes over all rows more than once, or wants them fast: what the tables show of a
    /// solution is kept in memory, some 100 bytes each, as it was when its checksum was looked at.
    ///
    /// # Errors
    /// As [`Self::open`].
    pub fn open_with_rows(folder: &Path) -> Result<Self, StoreError> {
        Self::open_checked(folder, true)
    }

    fn open_checked(folder: &Path, keeps_rows: bool) -> Result<Self, StoreError> {
        let database = folder.join(DATABASE);
        if !database.is_file() {
            return Err(StoreError::NoResults { folder: folder.to_owned() });
        }
        roll_back(&database)?;
        let connection = open(&database, OpenFlags::SQLITE_OPEN_READ_ONLY)?;
        schema::check_version(&connection, folder)?;
        // All of one moment, even while a run writes.
        let moment = connection.unchecked_transaction()?;
        let mut kept = if keeps_rows { Some(KeptRows::none_yet(&connection)?) } else { None };
        let damaged = checksum::check(&connection, schema::create_tables, |key, row| {
            if kept.as_mut().is_some_and(|kept| !kept.take(key, row)) {
                kept = None;
            }
        })?;
        drop(moment);
        let kept = kept.filter(|_| damaged.is_empty());
        Ok(Self { connection, folder: folder.to_owned(), damaged, kept, writing: None })
    }

    /// Opens a transaction that writes, if this is still the run that writes, to the database that is still
    /// there.
    ///
    /// The lock of the folder alone does not say so: someone may have removed it, and then another run takes
    /// it as well. That run has the next number, and the one before it adds nothing more.
    pub(super) fn write(&mut self) -> Result<Transaction<'_>, StoreError> {
        let transaction = self.connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
        if let Some(writing) = &self.writing {
            writing.place.check()?;
            if schema::writer(&transaction)? != writing.writer {
                return Err(StoreError::TakenOver { folder: self.folder.clone() });
            }
        }
        Ok(transaction)
    }

    /// Something noted about the study: `title`, `study` (its text), `program`, `identity`.
    ///
    /// # Errors
    /// The database refuses.
    pub fn about(&self, key: &str) -> Result<String, StoreError> {
        schema::about(&self.connection, key)
    }

    /// As long as this is held, everything read is of one moment, even while a run writes.
    ///
    /// # Errors
    /// The database refuses.
    pub fn snapshot(&self) -> Result<impl Sized + use<'_>, StoreError> {
        Ok(self.connection.unchecked_transaction()?)
    }

    /// From now on reading ends with an error soon after this says true.
    ///
    /// # Errors
    /// The database refuses.
    pub fn read_unless(
        &mut self,
        interrupted: impl FnMut() -> bool + Send + 'static,
    ) -> Result<(), StoreError> {
        Ok(self.connection.progress_handler(BETWEEN_QUESTIONS, Some(interrupted))?)
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
    pub(super) fn missing(&self, first: i64, last: i64) -> StoreError {
        let (branch, side) = self.place_of(first);
        StoreError::MissingSolutions { branch, side, first: first as u32, last: last as u32 }
    }

    /// Branch and side of a solution, in words.
    fn place_of(&self, key: i64) -> (String, &'static str) {
        let select =
            "SELECT branch, (SELECT place FROM piece WHERE id = start.piece) FROM start WHERE id = ?1";
        let found =
            self.connection.query_row(select, [start_of_key(key)], |row| Ok((row.get(0)?, row.get(1)?)));
        let branch = match found {
            Ok((Some::<u32>(branch), None::<u32>)) => branch.to_string(),
            Ok((Some(branch), Some(piece))) => format!("{branch} of piece {piece}"),
            _ => "(none yet)".to_owned(),
        };
        (branch, side_word(side_of_key(key)))
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
            let started = Instant::now();
            while let Err(error) = self.connection.pragma_update(None, "journal_mode", "DELETE") {
                match error.sqlite_error_code() {
                    Some(rusqlite::ErrorCode::DatabaseBusy) if started.elapsed() < READER => {
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

/// Refuses to write a database that is a link, or has one beside it for a log of its own.
fn refuse_links(database: &Path) -> Result<(), StoreError> {
    for suffix in ["", "-wal", "-shm", "-journal"] {
        let path = database.with_file_name(format!("{DATABASE}{suffix}"));
        let refused = refuse_link(&path).and_then(|()| match path.exists() && !path.is_file() {
            true => Err(io::Error::new(io::ErrorKind::InvalidInput, "it is no file")),
            false => Ok(()),
        });
        refused.map_err(|source| StoreError::Folder { folder: path, source })?;
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
    // Nothing in the file may act by itself.
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_ENABLE_TRIGGER, false)?;
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_ENABLE_VIEW, false)?;
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_TRUSTED_SCHEMA, false)?;
    add_checksums(&connection)?;
    Ok(connection)
}
