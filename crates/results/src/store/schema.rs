//! Tables of the database, and whose they are.

use std::path::Path;

use hammerbeam_study::{
    file::StudyFile,
    identity::{DATA_VERSION, differences},
};
use rusqlite::{Connection, OptionalExtension, TransactionBehavior, params};

use super::{StoreError, checksum};
use crate::columns::{ColumnKind, TableColumn};

/// Version of the tables.
pub const SCHEMA_VERSION: u32 = 14;

/// Marks a database as ours: "HmBm".
const APPLICATION_ID: i64 = 0x486d_426d;

/// What is noted of the newest writer: its number.
const WRITER: &str = "writer";

const TABLES: &str = "
CREATE TABLE about (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE job (
    id INTEGER PRIMARY KEY,
    kind TEXT NOT NULL CHECK (kind IN
        ('harmonic', 'survey', 'resonance', 'none-stable', 'contact-change', 'met', 'doubling',
         'crossing')),
    frequency_hz REAL NOT NULL,
    source INTEGER UNIQUE,
    depth INTEGER NOT NULL,
    evaluated INTEGER NOT NULL DEFAULT 0,
    message TEXT,
    outcome TEXT CHECK (outcome IN ('covered', 'new-branches', 'on-branch', 'nothing')),
    outcome_branch INTEGER,
    CHECK ((outcome IS 'on-branch') = (outcome_branch IS NOT NULL))
);
CREATE TABLE piece (
    id INTEGER PRIMARY KEY,
    place INTEGER NOT NULL,
    definition TEXT NOT NULL UNIQUE,
    kind TEXT NOT NULL CHECK (kind IN ('vary', 'fold', 'flip', 'neimark-sacker', 'grazing')),
    parameter TEXT NOT NULL,
    searched INTEGER NOT NULL DEFAULT 0,
    finished INTEGER NOT NULL DEFAULT 0,
    message TEXT
);
CREATE TABLE start (
    id INTEGER PRIMARY KEY,
    job INTEGER REFERENCES job (id),
    piece INTEGER REFERENCES piece (id),
    period_multiple INTEGER NOT NULL,
    branch INTEGER,
    CHECK ((job IS NULL) <> (piece IS NULL))
);
CREATE TABLE walk (
    id INTEGER PRIMARY KEY,
    start INTEGER NOT NULL REFERENCES start (id),
    side TEXT NOT NULL CHECK (side IN ('up', 'down')),
    solutions INTEGER NOT NULL,
    end_kind TEXT,
    end_place REAL,
    end_numbers BLOB,
    end_text TEXT,
    checkpoint BLOB
);
CREATE TABLE journal (
    id INTEGER PRIMARY KEY,
    walk INTEGER NOT NULL REFERENCES walk (id),
    bytes BLOB NOT NULL
);
CREATE TABLE event (
    solution INTEGER PRIMARY KEY,
    located INTEGER NOT NULL,
    uncertainty REAL NOT NULL,
    multiplier_re REAL,
    multiplier_im REAL,
    direction BLOB NOT NULL,
    contact_changes BLOB NOT NULL,
    breaks_symmetry INTEGER NOT NULL
);
CREATE TABLE output_value (
    solution INTEGER PRIMARY KEY,
    numbers BLOB NOT NULL
);
";

/// What a solution has besides the columns of its row, behind them.
const BEHIND_ROWS: &str = "
    segments INTEGER NOT NULL,
    state_length INTEGER NOT NULL,
    multiplier_count INTEGER NOT NULL,
    multipliers BLOB NOT NULL,
    nodes BLOB NOT NULL,
    phase_cycles REAL NOT NULL,
    on_circle BLOB NOT NULL";

/// What came of requests for motions that need not repeat.
const TABLES_OF_MOTIONS: &str = "
CREATE TABLE request (
    id INTEGER PRIMARY KEY,
    kind TEXT NOT NULL CHECK (kind IN ('simulation', 'sweep', 'starts', 'exponents', 'basins')),
    words TEXT NOT NULL,
    pieces INTEGER NOT NULL,
    done INTEGER NOT NULL DEFAULT 0,
    UNIQUE (kind, words)
);
CREATE TABLE simulated (
    id INTEGER PRIMARY KEY,
    request INTEGER NOT NULL REFERENCES request (id),
    first INTEGER NOT NULL,
    periods INTEGER NOT NULL,
    samples BLOB NOT NULL,
    section BLOB NOT NULL,
    contacts BLOB NOT NULL,
    unfinished BLOB NOT NULL,
    observed INTEGER NOT NULL,
    state BLOB NOT NULL,
    open BLOB NOT NULL,
    impact_speeds BLOB NOT NULL,
    UNIQUE (request, first)
);
CREATE TABLE settled (
    request INTEGER NOT NULL REFERENCES request (id),
    number INTEGER NOT NULL,
    origin TEXT NOT NULL CHECK (origin IN ('up', 'down', 'start')),
    start INTEGER,
    frequency_hz REAL NOT NULL,
    class TEXT NOT NULL,
    period INTEGER,
    doubt TEXT,
    exponent_per_s REAL,
    exponent_half_width_per_s REAL,
    zero_one REAL,
    max_abs_displacement_m REAL NOT NULL,
    contacts_per_period REAL NOT NULL,
    samples BLOB NOT NULL,
    state BLOB NOT NULL,
    PRIMARY KEY (request, number)
) WITHOUT ROWID;
CREATE TABLE exponents (
    request INTEGER NOT NULL REFERENCES request (id),
    number INTEGER NOT NULL,
    frequency_hz REAL NOT NULL,
    sections_per_period INTEGER NOT NULL,
    time_s REAL NOT NULL,
    sum_per_s REAL NOT NULL,
    divergence_per_s REAL NOT NULL,
    expected_sum_per_s REAL,
    kaplan_yorke_dimension REAL NOT NULL,
    block_correlation REAL,
    zero_one REAL,
    exponents BLOB NOT NULL,
    convergence BLOB NOT NULL,
    section BLOB NOT NULL,
    PRIMARY KEY (request, number)
) WITHOUT ROWID;
CREATE TABLE attractor (
    request INTEGER NOT NULL REFERENCES request (id),
    number INTEGER NOT NULL,
    class TEXT NOT NULL,
    period INTEGER,
    doubt TEXT,
    exponent_per_s REAL,
    exponent_half_width_per_s REAL,
    zero_one REAL,
    state_length INTEGER NOT NULL,
    states BLOB NOT NULL,
    PRIMARY KEY (request, number)
) WITHOUT ROWID;
CREATE TABLE cell (
    request INTEGER NOT NULL REFERENCES request (id),
    number INTEGER NOT NULL,
    attractor INTEGER NOT NULL,
    PRIMARY KEY (request, number)
) WITHOUT ROWID;
";

/// Refuses the database of another study or version; an empty one belongs to no study yet.
pub(super) fn check_study(
    connection: &Connection,
    folder: &Path,
    file: &StudyFile,
) -> Result<(), StoreError> {
    if is_empty(connection, folder)? {
        return Ok(());
    }
    check_version(connection, folder)?;
    if about(connection, "identity")? == file.study.identity() {
        return Ok(());
    }
    let there = about(connection, "canonical")?;
    Err(StoreError::OtherStudy {
        folder: folder.to_owned(),
        differences: differences(&there, &file.study.canonical(), 12),
    })
}

/// Refuses a database that this program does not understand.
pub(super) fn check_version(connection: &Connection, folder: &Path) -> Result<(), StoreError> {
    // A run makes the file and fills it in its first moment: both are read at one instant.
    let select = "SELECT application_id, (SELECT count(*) FROM sqlite_master) FROM pragma_application_id";
    let (id, tables): (i64, i64) = connection
        .query_row(select, [], |row| Ok((row.get(0)?, row.get(1)?)))
        .map_err(|error| not_ours(error, folder))?;
    if tables == 0 {
        return Err(StoreError::NoResults { folder: folder.to_owned() });
    }
    if id != APPLICATION_ID {
        return Err(StoreError::NotResults { folder: folder.to_owned() });
    }
    for (key, what, expected) in
        [("schema_version", "storage", SCHEMA_VERSION), ("data_version", "data", DATA_VERSION)]
    {
        let found = about(connection, key)?;
        if found != expected.to_string() {
            let program = about(connection, "program")?;
            return Err(StoreError::OtherVersion {
                folder: folder.to_owned(),
                program,
                what,
                found,
                expected,
            });
        }
    }
    Ok(())
}

/// Whether no run has made its tables yet.
pub(super) fn is_empty(connection: &Connection, folder: &Path) -> Result<bool, StoreError> {
    let tables: i64 = connection
        .query_row("SELECT count(*) FROM sqlite_master", [], |row| row.get(0))
        .map_err(|error| not_ours(error, folder))?;
    Ok(tables == 0)
}

/// A file that is no database at all was not written by us.
fn not_ours(error: rusqlite::Error, folder: &Path) -> StoreError {
    match error.sqlite_error_code() {
        Some(rusqlite::ErrorCode::NotADatabase) => StoreError::NotResults { folder: folder.to_owned() },
        _ => error.into(),
    }
}

/// Something noted about the study.
pub(super) fn about(connection: &Connection, key: &str) -> Result<String, StoreError> {
    let value = connection.query_row("SELECT value FROM about WHERE key = ?1", [key], |row| row.get(0));
    Ok(value.optional()?.unwrap_or_default())
}

/// Makes the tables if they are not there, all at once, and notes the text of the study.
///
/// # Returns
/// The number of this writer, one more than that of the last one.
pub(super) fn create_or_update(connection: &mut Connection, file: &StudyFile) -> Result<u64, StoreError> {
    let transaction = connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
    let tables: i64 = transaction.query_row("SELECT count(*) FROM sqlite_master", [], |row| row.get(0))?;
    if tables == 0 {
        transaction.pragma_update(None, "application_id", APPLICATION_ID)?;
        create_tables(&transaction)?;
        let fixed = [
            ("schema_version", SCHEMA_VERSION.to_string()),
            ("data_version", DATA_VERSION.to_string()),
            ("program", env!("CARGO_PKG_VERSION").to_owned()),
            ("identity", file.study.identity()),
            ("canonical", file.study.canonical()),
        ];
        for (key, value) in fixed {
            note(&transaction, key, &value)?;
        }
    }
    note(&transaction, "title", &file.study.title)?;
    note(&transaction, "study", &file.text_with_whole_paths())?;
    let writer = 1 + writer(&transaction)?;
    note(&transaction, WRITER, &writer.to_string())?;
    transaction.commit()?;
    Ok(writer)
}

/// Number of the newest writer.
pub(super) fn writer(connection: &Connection) -> Result<u64, StoreError> {
    Ok(about(connection, WRITER)?.parse().unwrap_or_default())
}

/// Makes all tables; that of solutions has the stored columns of rows.
pub(super) fn create_tables(connection: &Connection) -> Result<(), StoreError> {
    let column = |column: TableColumn| {
        let kind = if column.kind() == ColumnKind::Number { "REAL" } else { "INTEGER" };
        format!("{} {kind} NOT NULL", column.name())
    };
    let columns: Vec<String> = TableColumn::STORED.into_iter().map(column).collect();
    let columns = columns.join(", ");
    let solutions = format!("CREATE TABLE solution (id INTEGER PRIMARY KEY, {columns}, {BEHIND_ROWS});");
    Ok(checksum::create(connection, &[TABLES, &solutions, TABLES_OF_MOTIONS].concat())?)
}

/// Notes something about the study.
pub(super) fn note(connection: &Connection, key: &str, value: &str) -> Result<(), StoreError> {
    let changed = "INSERT INTO about (key, value) VALUES (?1, ?2)
        ON CONFLICT (key) DO UPDATE SET value = excluded.value WHERE value <> excluded.value";
    connection.execute(changed, params![key, value])?;
    Ok(())
}
