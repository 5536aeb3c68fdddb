//! Rows of all solutions as they were when the folder was opened.
//!
//! Whoever opens a folder reads every solution for its checksum, nodes and multipliers among it. What its
//! tables show of it can be kept then, some 100 bytes a solution, for whoever wants all rows at once. The
//! database stays the owner: once another program has written it (as `PRAGMA data_version` shows) rows are
//! read from there. If anything is missing or damaged it is found where it is asked for, as without this.

use std::{collections::HashMap, ops::Range};

use rusqlite::{Connection, Row as SqlRow};

use super::{StoreError, keys::first_key, values::read_row};
use crate::row::Row;

/// All rows of one moment of the database.
#[derive(Debug)]
pub(super) struct KeptRows {
    version: i64,
    /// Where the rows of each walk are, from number 0 on without a gap.
    walks: HashMap<i64, Range<usize>>,
    rows: Vec<Row>,
}

impl KeptRows {
    /// None yet, of the present moment; the connection is in a transaction.
    pub fn none_yet(connection: &Connection) -> Result<Self, StoreError> {
        Ok(Self { version: version(connection)?, walks: HashMap::new(), rows: Vec::new() })
    }

    /// Takes the next solution: its row stands behind its key.
    ///
    /// # Returns
    /// Whether it is the next one of its walk, and has a row.
    pub fn take(&mut self, key: i64, found: &SqlRow<'_>) -> bool {
        let walk = key >> 32;
        let end = self.rows.len();
        let places = self.walks.entry(walk).or_insert(end..end);
        let Ok(row) = read_row(found, 1) else { return false };
        if key != first_key(walk) + places.len() as i64 {
            return false;
        }
        places.end += 1;
        self.rows.push(row);
        true
    }

    /// The rows of a walk, if they are those of the database and as many as it counts at least.
    pub fn of_walk(
        &self,
        connection: &Connection,
        walk: i64,
        counted: i64,
    ) -> Result<Option<&[Row]>, StoreError> {
        let rows = self.walks.get(&walk).map_or(&[][..], |places| &self.rows[places.clone()]);
        let is_whole = rows.len() as i64 >= counted && version(connection)? == self.version;
        Ok(is_whole.then_some(rows))
    }
}

/// A number that changes when another connection has written the database.
fn version(connection: &Connection) -> Result<i64, StoreError> {
    let mut statement = connection.prepare_cached("PRAGMA data_version")?;
    Ok(statement.query_row([], |row| row.get(0))?)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use hammerbeam_orbit::Side;
    use tempfile::tempdir;

    use super::super::{
        DATABASE, Store, StoreError, add_checksums,
        tests::{STUDY, append, study, walked_folder},
    };
    use crate::row::Row;

    fn rows(store: &Store) -> Result<Vec<(Side, u32, Row)>, StoreError> {
        let mut rows = Vec::new();
        for branch in store.branches()? {
            let placed = store.placed_rows(&branch)?;
            rows.extend(placed.into_iter().map(|placed| (placed.side, placed.number, placed.row)));
        }
        Ok(rows)
    }

    fn change(folder: &Path, statement: &str) {
        let connection = rusqlite::Connection::open(folder.join(DATABASE)).unwrap();
        add_checksums(&connection).unwrap();
        connection.execute_batch(statement).unwrap();
        connection.close().unwrap();
    }

    #[test]
    fn rows_that_are_kept_are_those_of_the_database() {
        let folder = tempdir().unwrap();
        walked_folder(folder.path());
        let mut run = Store::open_for_run(folder.path(), &study(STUDY)).unwrap();
        append(&mut run, Side::Down, &[0.19, 0.18]);
        run.finish().unwrap();
        let kept = Store::open_with_rows(folder.path()).unwrap();
        assert!(kept.kept.is_some());
        let expected = rows(&Store::open(folder.path()).unwrap()).unwrap();
        let ends: Vec<f64> = expected[..3].iter().map(|(_, _, row)| row.frequency_hz).collect();
        assert_eq!((expected.len(), &ends[..]), (63, &[0.18, 0.19, 0.2][..]));
        assert_eq!(rows(&kept).unwrap(), expected);
        let start = kept.branches().unwrap()[0].start;
        let walked = kept.walked(start, Side::Down).unwrap();
        assert_eq!([walked[0].frequency_hz, walked[1].frequency_hz], [0.19, 0.18]);
    }

    #[test]
    fn what_was_written_since_is_read_from_the_database() {
        let folder = tempdir().unwrap();
        walked_folder(folder.path());
        let reader = Store::open_with_rows(folder.path()).unwrap();
        let before = rows(&reader).unwrap();
        let mut run = Store::open_for_run(folder.path(), &study(STUDY)).unwrap();
        append(&mut run, Side::Up, &[0.7]);
        assert_eq!(rows(&reader).unwrap().len(), before.len() + 1);
        run.finish().unwrap();
        // As many rows, but one of them is another one.
        let reader = Store::open_with_rows(folder.path()).unwrap();
        assert_eq!(rows(&reader).unwrap().len(), before.len() + 1);
        change(folder.path(), "UPDATE solution SET contacts = 77 WHERE id & 4294967295 = 5");
        assert_eq!(rows(&reader).unwrap()[5].2.maxima.contacts, 77);
    }

    #[test]
    fn a_solution_that_is_missing_is_named_as_without_rows_that_are_kept() {
        for gone in ["= 0", "= 17", "= 60", ">= 0"] {
            let folder = tempdir().unwrap();
            walked_folder(folder.path());
            change(folder.path(), &format!("DELETE FROM solution WHERE id & 4294967295 {gone}"));
            let expected = rows(&Store::open(folder.path()).unwrap()).unwrap_err().to_string();
            let found = rows(&Store::open_with_rows(folder.path()).unwrap()).unwrap_err().to_string();
            assert!(found == expected && found.contains("missing from results.db"), "{found}");
        }
    }

    /// An event that has no name, in a row whose checksum fits.
    #[test]
    fn a_row_that_cannot_be_read_is_named_where_it_is_asked_for() {
        let folder = tempdir().unwrap();
        walked_folder(folder.path());
        change(folder.path(), "UPDATE solution SET event = 1 << 30 WHERE id & 4294967295 = 9");
        let error = rows(&Store::open_with_rows(folder.path()).unwrap()).unwrap_err().to_string();
        assert!(error.starts_with("solution 9 on the up side of branch 1 is damaged"), "{error}");
    }
}
