//! Checksums of stored rows: a bit that a disk, a cable or a copy has changed is found before it becomes a
//! result.
//!
//! Every table has a column `checksum`, which SQLite computes from all other columns of the row, its key
//! included, whenever the row is inserted or updated (a stored generated column). So nothing that writes rows
//! knows of it, and none can be left out. It is the CRC-32 (IEEE 802.3) of the values one after the other,
//! each as
//!
//! ```text
//! 0                       nothing
//! 1, 8 bytes              an integer
//! 2, 8 bytes              a number, -0 as 0
//! 3, 8 bytes, the bytes   a text behind its length
//! 4, 8 bytes, the bytes   a blob behind its length
//! ```
//!
//! in little-endian order: any change of up to 32 bits in a row is found for certain, of all others one in
//! 4e9 is not.
//!
//! Whoever opens the database reads it once from end to end: it has to hold what this version makes and
//! nothing else (a trigger or a view that someone else has put there would act), its
//! pages whole (`PRAGMA integrity_check`: a page that has lost the count of its rows would hide some), each
//! checksum that of its row.

use crc32fast::Hasher;
use rusqlite::{
    Connection, Row as SqlRow,
    functions::{Context, FunctionFlags},
    types::ValueRef,
};

use super::StoreError;

/// Adds the function of rows by which the tables compute their checksums; whatever inserts or updates rows
/// needs it.
///
/// # Errors
/// The database refuses.
pub fn add_checksums(connection: &Connection) -> rusqlite::Result<()> {
    let flags =
        FunctionFlags::SQLITE_UTF8 | FunctionFlags::SQLITE_DETERMINISTIC | FunctionFlags::SQLITE_INNOCUOUS;
    connection.create_scalar_function("row_checksum", -1, flags, |row: &Context<'_>| {
        Ok(of_values((0..row.len()).map(|column| row.get_raw(column))))
    })
}

fn of_values<'a>(values: impl Iterator<Item = ValueRef<'a>>) -> i64 {
    let mut hasher = Hasher::new();
    for value in values {
        match value {
            ValueRef::Null => hasher.update(&[0]),
            ValueRef::Integer(number) => number_of(&mut hasher, 1, number.to_le_bytes()),
            // SQLite does not keep the sign of zero.
            ValueRef::Real(number) => number_of(&mut hasher, 2, (number + 0.0).to_le_bytes()),
            ValueRef::Text(bytes) => bytes_of(&mut hasher, 3, bytes),
            ValueRef::Blob(bytes) => bytes_of(&mut hasher, 4, bytes),
        }
    }
    hasher.finalize().into()
}

fn number_of(hasher: &mut Hasher, tag: u8, number: [u8; 8]) {
    hasher.update(&[tag]);
    hasher.update(&number);
}

fn bytes_of(hasher: &mut Hasher, tag: u8, bytes: &[u8]) {
    number_of(hasher, tag, (bytes.len() as u64).to_le_bytes());
    hasher.update(bytes);
}

/// Makes tables, each with its checksums.
///
/// * `tables`: `CREATE TABLE` statements without them.
pub(super) fn create(connection: &Connection, tables: &str) -> rusqlite::Result<()> {
    // What columns there are SQLite says best.
    let plain = Connection::open_in_memory()?;
    plain.execute_batch(tables)?;
    for (table, statement) in tables_of(&plain)? {
        let columns = columns_of(&plain, &table)?;
        let computed = format!("({CHECKSUM} INTEGER AS (row_checksum({columns})) STORED,");
        connection.execute_batch(&statement.replacen('(', &computed, 1))?;
    }
    Ok(())
}

/// Name of the column.
const CHECKSUM: &str = "checksum";

/// Names and statements of the tables, in the order in which they were made.
fn tables_of(connection: &Connection) -> rusqlite::Result<Vec<(String, String)>> {
    let select = "SELECT name, sql FROM sqlite_master WHERE type = 'table' ORDER BY rowid";
    connection.prepare(select)?.query_map([], |row| Ok((row.get(0)?, row.get(1)?)))?.collect()
}

/// All that a database consists of: kind, name, table and statement.
fn contents_of(connection: &Connection) -> rusqlite::Result<Vec<[Option<String>; 4]>> {
    let select = "SELECT type, name, tbl_name, sql FROM sqlite_master ORDER BY type, name";
    let mut statement = connection.prepare(select)?;
    statement.query_map([], |row| Ok([row.get(0)?, row.get(1)?, row.get(2)?, row.get(3)?]))?.collect()
}

/// Names of the columns of a table without the checksum, separated by commas.
fn columns_of(connection: &Connection, table: &str) -> rusqlite::Result<String> {
    let select = "SELECT group_concat(name, ', ') FROM
        (SELECT name FROM pragma_table_info(?1) WHERE name <> ?2 ORDER BY cid)";
    connection.query_row(select, [table, CHECKSUM], |row| row.get(0))
}

/// Reads the whole database, and refuses it where it is damaged, but for rows of solutions.
///
/// * `create_tables`: makes all tables that there are to be.
/// * `take`: gets each solution that is as it was stored, in the order of their keys: its key, and the row
///   with the columns of the table from its first one on, the key.
///
/// # Returns
/// Keys of the solutions that are not as they were stored, in increasing order.
/// # Errors
/// [`StoreError::DamagedFile`], or the database refuses.
pub(super) fn check(
    connection: &Connection,
    create_tables: impl Fn(&Connection) -> Result<(), StoreError>,
    take: impl FnMut(i64, &SqlRow<'_>),
) -> Result<Vec<i64>, StoreError> {
    let damaged = |what: String| StoreError::DamagedFile { what };
    let made = Connection::open_in_memory()?;
    add_checksums(&made)?;
    create_tables(&made)?;
    if contents_of(connection)? != contents_of(&made)? {
        return Err(damaged(
            "its tables are not those that were made, or there is more than tables".to_owned(),
        ));
    }
    let found: String = connection.query_row("PRAGMA integrity_check(1)", [], |row| row.get(0))?;
    if found != "ok" {
        return Err(damaged(found));
    }
    for (table, _) in tables_of(connection)?.iter().filter(|(table, _)| table != SOLUTIONS) {
        let columns = columns_of(connection, table)?;
        let select = format!("SELECT 1 FROM {table} WHERE {CHECKSUM} IS NOT row_checksum({columns})");
        if connection.prepare(&select)?.exists([])? {
            return Err(damaged(format!("a row of table {table} is not as it was stored")));
        }
    }
    check_solutions(connection, take)
}

/// The table of solutions.
const SOLUTIONS: &str = "solution";

fn check_solutions(
    connection: &Connection,
    mut take: impl FnMut(i64, &SqlRow<'_>),
) -> Result<Vec<i64>, StoreError> {
    let columns = columns_of(connection, SOLUTIONS)?;
    let count = columns.split(',').count();
    let select = format!("SELECT {columns}, {CHECKSUM} FROM {SOLUTIONS} ORDER BY id");
    let mut statement = connection.prepare(&select)?;
    let mut rows = statement.query([])?;
    let mut damaged = Vec::new();
    while let Some(row) = rows.next()? {
        let key = row.get(0)?;
        let values = (0..count).map(|column| row.get_ref(column).unwrap_or(ValueRef::Null));
        if row.get_ref(count)? == ValueRef::Integer(of_values(values)) {
            take(key, row);
        } else {
            damaged.push(key);
        }
    }
    Ok(damaged)
}
