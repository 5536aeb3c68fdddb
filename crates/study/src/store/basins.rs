//! Basins of attraction in a results folder: `basins.db`, beside the branches or alone.
//!
//! A round of cells goes in as one transaction, with the attractors that it found. So after a kill whole rounds are there, which is
//! what the computation goes on from, to the same bits.

use std::{fs, path::Path};

use hammerbeam_attractor::{Attractor, Class, Doubt, Estimate, Round};
use rusqlite::{Connection, OpenFlags, Row as SqlRow, params};

use super::{StoreError, blob, lock::Lock};
use crate::{
    StudyFile,
    identity::{DATA_VERSION, differences},
};

/// Name of the database in a results folder.
pub const BASINS: &str = "basins.db";

/// Marks a database as one of basins: "HmBa".
const APPLICATION_ID: i64 = 0x486d_4261;

const TABLES: &str = "
CREATE TABLE about (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE attractor (
    id INTEGER PRIMARY KEY,
    class TEXT NOT NULL,
    period INTEGER,
    doubt TEXT,
    exponent_per_s REAL,
    exponent_half_width_per_s REAL,
    zero_one REAL,
    state_length INTEGER NOT NULL,
    states BLOB NOT NULL
);
CREATE TABLE cell (id INTEGER PRIMARY KEY, attractor INTEGER NOT NULL);
";

/// Basins of one study over one grid, open for writing.
#[derive(Debug)]
pub struct BasinStore {
    connection: Connection,
    _lock: Lock,
}

impl BasinStore {
    /// Opens the basins of a folder, and makes folder and database if they are not there.
    ///
    /// * `request`: what is asked of the study, as lines `key = value`; everything that the cells depend on.
    ///
    /// # Errors
    /// [`StoreError`]: the folder holds other basins, another program is writing, or the disk refuses.
    pub fn open(folder: &Path, file: &StudyFile, request: &str) -> Result<Self, StoreError> {
        let database = folder.join(BASINS);
        let wanted = format!("{}\n{request}\ndata_version = {DATA_VERSION}", file.study.canonical());
        let writing = OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_NO_MUTEX;
        if database.exists() {
            check(&Connection::open_with_flags(&database, writing)?, folder, &wanted)?;
        }
        fs::create_dir_all(folder).map_err(|source| StoreError::folder(folder, source))?;
        let lock = Lock::take(folder)?;
        let mut connection = Connection::open_with_flags(&database, writing | OpenFlags::SQLITE_OPEN_CREATE)?;
        let is_new = check(&connection, folder, &wanted)?;
        connection.pragma_update(None, "journal_mode", "WAL")?;
        if is_new {
            let transaction = connection.transaction()?;
            transaction.pragma_update(None, "application_id", APPLICATION_ID)?;
            transaction.execute_batch(TABLES)?;
            transaction.execute("INSERT INTO about (key, value) VALUES ('canonical', ?1)", [&wanted])?;
            transaction.commit()?;
        }
        connection.pragma_update(None, "synchronous", "NORMAL")?;
        Ok(Self { connection, _lock: lock })
    }

    /// What is there: the attractor of each cell, from the first one on, and the attractors.
    ///
    /// # Errors
    /// The database refuses, or something in it is damaged.
    pub fn read(&self) -> Result<(Vec<u32>, Vec<Attractor>), StoreError> {
        let mut statement = self.connection.prepare("SELECT attractor FROM cell ORDER BY id")?;
        let cells = statement.query_map([], |row| row.get(0))?.collect::<Result<_, _>>()?;
        let select = "SELECT class, period, doubt, exponent_per_s, exponent_half_width_per_s, zero_one, state_length, states
            FROM attractor ORDER BY id";
        let mut statement = self.connection.prepare(select)?;
        let mut rows = statement.query([])?;
        let mut attractors = Vec::new();
        while let Some(row) = rows.next()? {
            attractors.push(attractor(row)?);
        }
        Ok((cells, attractors))
    }

    /// Adds a round.
    ///
    /// * `known`: number of attractors that were known before it.
    ///
    /// # Errors
    /// The database refuses; nothing of the round is there then.
    pub fn append(&mut self, round: &Round, known: usize) -> Result<(), StoreError> {
        let transaction = self.connection.transaction()?;
        for (index, cell) in round.cells.iter().enumerate() {
            let values = params![(round.first + index) as i64, cell];
            transaction.execute("INSERT INTO cell (id, attractor) VALUES (?1, ?2)", values)?;
        }
        for (index, found) in round.found.iter().enumerate() {
            let length = found.states.first().map_or(0, Vec::len) as i64;
            let insert =
                "INSERT INTO attractor (id, class, period, doubt, exponent_per_s, exponent_half_width_per_s,
                zero_one, state_length, states) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)";
            let values = params![
                (known + index + 1) as i64,
                found.class.name(),
                found.class.period().map(|period| period as i64),
                found.class.doubt(),
                found.largest_exponent.map(|estimate| estimate.value),
                found.largest_exponent.map(|estimate| estimate.half_width),
                found.zero_one,
                length,
                blob::pack(found.states.iter().flatten()),
            ];
            transaction.execute(insert, values)?;
        }
        transaction.commit()?;
        Ok(())
    }

    /// Leaves one plain file behind.
    ///
    /// # Errors
    /// The disk refuses; everything is stored all the same.
    pub fn finish(self) -> Result<(), StoreError> {
        self.connection.pragma_update(None, "journal_mode", "DELETE")?;
        self.connection.close().map_err(|(_, error)| error)?;
        Ok(())
    }
}

/// Refuses the database of something else; true if nobody has written it yet.
fn check(connection: &Connection, folder: &Path, wanted: &str) -> Result<bool, StoreError> {
    let refused = |error: rusqlite::Error| match error.sqlite_error_code() {
        Some(rusqlite::ErrorCode::NotADatabase) => StoreError::NotBasins { folder: folder.to_owned() },
        _ => error.into(),
    };
    let number = |query: &str| connection.query_row(query, [], |row| row.get::<_, i64>(0)).map_err(refused);
    if number("SELECT count(*) FROM sqlite_master")? == 0 {
        return Ok(true);
    }
    if number("PRAGMA application_id")? != APPLICATION_ID {
        return Err(StoreError::NotBasins { folder: folder.to_owned() });
    }
    let select = "SELECT value FROM about WHERE key = 'canonical'";
    let there: String = connection.query_row(select, [], |row| row.get(0))?;
    if there == wanted {
        return Ok(false);
    }
    let differences = differences(&there, wanted, 12);
    Err(StoreError::OtherBasins { folder: folder.to_owned(), differences })
}

fn attractor(row: &SqlRow<'_>) -> Result<Attractor, StoreError> {
    let (name, period, doubt): (String, Option<i64>, Option<String>) =
        (row.get(0)?, row.get(1)?, row.get(2)?);
    let class = match name.as_str() {
        "periodic" => Class::Periodic { period: period.unwrap_or(1) as usize },
        "quasi-periodic" => Class::QuasiPeriodic,
        "chaotic" => Class::Chaotic,
        _ => {
            let all = [Doubt::IndicatorsDisagree, Doubt::ExponentUndecided, Doubt::ZeroOneUndecided];
            let named = |known: &&Doubt| doubt.as_deref() == Some(known.reason());
            Class::Doubtful(all.iter().find(named).copied().unwrap_or(Doubt::NotSettled))
        }
    };
    let exponent: (Option<f64>, Option<f64>) = (row.get(3)?, row.get(4)?);
    let length = (row.get::<_, i64>(6)? as usize).max(1);
    let bytes: Vec<u8> = row.get(7)?;
    let states = blob::unpack("states of an attractor", &bytes, bytes.len() / (8 * length) * length)?;
    Ok(Attractor {
        class,
        states: states.chunks(length).map(<[f64]>::to_vec).collect(),
        largest_exponent: exponent
            .0
            .zip(exponent.1)
            .map(|(value, half_width)| Estimate { value, half_width }),
        zero_one: row.get(5)?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn study() -> StudyFile {
        let text = include_str!("../../../../studies/duffing.toml");
        StudyFile::parse("study.toml", text.to_owned()).unwrap()
    }

    /// One of every class, with numbers that are not whole.
    fn attractors() -> Vec<Attractor> {
        let estimate = Estimate { value: 1.0 / 3.0, half_width: 1e-300 };
        let classes = [
            (Class::Periodic { period: 2 }, None, None),
            (Class::QuasiPeriodic, Some(estimate), Some(-0.01)),
            (Class::Chaotic, Some(estimate), Some(0.99)),
            (Class::Doubtful(Doubt::IndicatorsDisagree), Some(estimate), Some(0.1)),
            (Class::Doubtful(Doubt::ExponentUndecided), Some(estimate), Some(0.9)),
            (Class::Doubtful(Doubt::ZeroOneUndecided), Some(estimate), Some(0.5)),
            (Class::Doubtful(Doubt::NotSettled), Some(estimate), None),
        ];
        let of = |(class, largest_exponent, zero_one)| Attractor {
            class,
            states: vec![vec![0.1, -0.0], vec![f64::MIN_POSITIVE, 1.0 / 7.0]],
            largest_exponent,
            zero_one,
        };
        classes.into_iter().map(of).collect()
    }

    #[test]
    fn rounds_come_back_bit_by_bit() {
        let folder = tempfile::tempdir().unwrap();
        let all = attractors();
        let mut store = BasinStore::open(folder.path(), &study(), "grid = 3").unwrap();
        store.append(&Round { first: 0, cells: vec![1], found: all[..1].to_vec() }, 0).unwrap();
        store.append(&Round { first: 1, cells: vec![0, 7, 2], found: all[1..].to_vec() }, 1).unwrap();
        store.finish().unwrap();
        let store = BasinStore::open(folder.path(), &study(), "grid = 3").unwrap();
        assert_eq!(store.read().unwrap(), (vec![1, 0, 7, 2], all));
    }

    #[test]
    fn a_round_that_does_not_fit_leaves_nothing_of_itself() {
        let folder = tempfile::tempdir().unwrap();
        let mut store = BasinStore::open(folder.path(), &study(), "grid = 3").unwrap();
        store.append(&Round { first: 0, cells: vec![1, 1], found: attractors()[..1].to_vec() }, 0).unwrap();
        // Its second cell is there already.
        assert!(store.append(&Round { first: 1, cells: vec![2], found: vec![] }, 1).is_err());
        assert_eq!(store.read().unwrap().0, [1, 1]);
    }

    #[test]
    fn basins_of_another_request_are_refused_with_the_difference() {
        let folder = tempfile::tempdir().unwrap();
        BasinStore::open(folder.path(), &study(), "grid = 3").unwrap().finish().unwrap();
        let error = BasinStore::open(folder.path(), &study(), "grid = 4").unwrap_err();
        assert!(error.is_bad_input());
        assert!(error.to_string().contains("grid: 3 there, 4 here"), "{error}");
    }
}
