//! What is computed beside the branches in the frequency: branches in other parameters, and curves of
//! bifurcations.
//!
//! Each `[[vary]]` and `[[curve]]` of the study is a *piece*, known by its definition; its number is its
//! place in the study. A piece is stored whole, in one transaction, so a run that is stopped computes again
//! only the pieces that it was at.

use std::collections::BTreeMap;

use hammerbeam_orbit::{LocatedEvent, PeriodicSolution, Stability};
use rusqlite::params;

use super::{
    Store, StoreError, blob,
    event::{insert_event, pairs},
    stability,
};

pub(super) const TABLES_OF_PIECES: &str = "
CREATE TABLE piece (
    id INTEGER PRIMARY KEY,
    definition TEXT NOT NULL UNIQUE,
    kind TEXT NOT NULL CHECK (kind IN ('vary', 'curve')),
    parameter TEXT NOT NULL,
    message TEXT
);
CREATE TABLE piece_branch (
    piece INTEGER NOT NULL REFERENCES piece (id),
    branch INTEGER NOT NULL,
    period_multiple INTEGER NOT NULL,
    kind TEXT NOT NULL,
    up TEXT NOT NULL,
    down TEXT NOT NULL,
    PRIMARY KEY (piece, branch)
) WITHOUT ROWID;
CREATE TABLE piece_row (
    piece INTEGER NOT NULL,
    branch INTEGER NOT NULL,
    place INTEGER NOT NULL,
    parameter REAL NOT NULL,
    frequency_hz REAL NOT NULL,
    max_abs_displacement_m REAL NOT NULL,
    max_abs_acceleration_m_s2 REAL NOT NULL,
    max_contact_force_n REAL NOT NULL,
    max_impact_velocity_m_s REAL NOT NULL,
    impulse_n_s REAL NOT NULL,
    contacts INTEGER NOT NULL,
    stable INTEGER NOT NULL,
    leading_multiplier_re REAL NOT NULL,
    leading_multiplier_im REAL NOT NULL,
    residual REAL NOT NULL,
    error_estimate REAL NOT NULL,
    event TEXT NOT NULL,
    segments INTEGER NOT NULL,
    state_length INTEGER NOT NULL,
    nodes BLOB NOT NULL,
    phase_cycles REAL NOT NULL,
    multipliers BLOB NOT NULL,
    PRIMARY KEY (piece, branch, place)
) WITHOUT ROWID;
";

/// A branch in a parameter, or a curve.
#[derive(Debug, Clone, PartialEq)]
pub struct VariedBranch {
    /// Orbit period over excitation period.
    pub period_multiple: u32,
    /// `branch`, or what the curve is of.
    pub kind: String,
    /// How the side ended on which the parameter increases at first, in words.
    pub up: String,
    /// How the other side ended.
    pub down: String,
    /// The rows end to end: the down side reversed, the start, the up side.
    pub rows: Vec<VariedRow>,
}

/// A row of it.
#[derive(Debug, Clone, PartialEq)]
pub struct VariedRow {
    /// Value of the parameter, in the unit of its name.
    pub parameter: f64,
    /// The solution.
    pub solution: PeriodicSolution,
    /// Events joined by `+`.
    pub event: String,
    /// What is known of them, uncertainty and direction in the unit of the name; `None` on a curve of
    /// bifurcations.
    pub located: Option<LocatedEvent>,
}

/// What was asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// Everything that it depends on besides the study itself.
    pub definition: String,
    /// Whether it is a curve.
    pub is_curve: bool,
    /// Name of the parameter.
    pub parameter: String,
}

/// A stored piece without its rows.
#[derive(Debug, Clone, PartialEq)]
pub struct PieceRecord {
    /// Its place in the study, from 1.
    pub id: u32,
    /// Whether it is a curve.
    pub is_curve: bool,
    /// Name of the parameter.
    pub parameter: String,
    /// Why there is nothing, or not everything.
    pub message: Option<String>,
    /// Its branches.
    pub branches: Vec<PieceBranchRecord>,
}

/// A branch of a stored piece.
#[derive(Debug, Clone, PartialEq)]
pub struct PieceBranchRecord {
    /// Its number within the piece.
    pub branch: u32,
    /// Orbit period over excitation period.
    pub period_multiple: u32,
    /// `branch`, or what the curve is of.
    pub kind: String,
    /// How its up side ended.
    pub up: String,
    /// How its down side ended.
    pub down: String,
    /// Number of its rows.
    pub rows: u32,
    /// Number of those that are stable.
    pub stable: u32,
    /// Number of those of which that is not known, see [`Stability::Marginal`].
    pub marginal: u32,
    /// Smallest and largest value of the parameter.
    pub range: [f64; 2],
    /// How many events there are of each kind, by their words in the table.
    pub events: BTreeMap<String, u32>,
}

/// A stored row, as it is exported.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredVariedRow {
    /// Value of the parameter.
    pub parameter: f64,
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
    /// `max |y|`, `max |y''|`, contact force, impact velocity, impulse, leading multiplier, residual and
    /// error estimate.
    pub numbers: [f64; 9],
    /// Number of contacts.
    pub contacts: u32,
    /// What is known of its stability.
    pub stability: Stability,
    /// Events.
    pub event: String,
}

/// Where the orbit of a stored row begins, and where it leads.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredVariedOrbit {
    /// Value of the parameter.
    pub parameter: f64,
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
    /// Phase at which the orbit is cut [cycles].
    pub phase: f64,
    /// The state there, `[q; q']`.
    pub state: Vec<f64>,
    /// Its Floquet multipliers, the largest first.
    pub floquet_multipliers: Vec<[f64; 2]>,
}

impl Store {
    /// Whether a piece is stored.
    ///
    /// # Errors
    /// The database refuses.
    pub fn has_piece(&self, piece: &Piece) -> Result<bool, StoreError> {
        let select = "SELECT count(*) FROM piece WHERE definition = ?1";
        let count: u32 = self.connection.query_row(select, [&piece.definition], |row| row.get(0))?;
        Ok(count > 0)
    }

    /// Throws away pieces that the study does not ask for any more, and gives the others the numbers of their
    /// places in it.
    ///
    /// # Errors
    /// The database refuses; nothing is changed then.
    pub fn keep_pieces(&mut self, wanted: &[Piece]) -> Result<(), StoreError> {
        let transaction = self.write()?;
        // Branches lose and find their pieces on the way.
        transaction.pragma_update(None, "defer_foreign_keys", true)?;
        let stored: Vec<(u32, String)> = transaction
            .prepare("SELECT id, definition FROM piece")?
            .query_map([], |row| Ok((row.get(0)?, row.get(1)?)))?
            .collect::<Result<_, _>>()?;
        let keys =
            [("piece_event", "piece"), ("piece_row", "piece"), ("piece_branch", "piece"), ("piece", "id")];
        for (id, text) in &stored {
            let place = wanted.iter().position(|piece| piece.definition == *text);
            for (table, key) in keys {
                match place {
                    None => transaction.execute(&format!("DELETE FROM {table} WHERE {key} = ?1"), [id])?,
                    Some(place) if place + 1 == *id as usize => 0,
                    // Negative until all have left their old numbers.
                    Some(place) => {
                        let update = format!("UPDATE {table} SET {key} = -?1 WHERE {key} = ?2");
                        transaction.execute(&update, [place as i64 + 1, i64::from(*id)])?
                    }
                };
            }
        }
        for (table, key) in keys {
            transaction.execute(&format!("UPDATE {table} SET {key} = -{key} WHERE {key} < 0"), [])?;
        }
        transaction.commit()?;
        Ok(())
    }

    /// Stores a piece with all its branches.
    ///
    /// * `number`: its place in the study, from 1.
    ///
    /// # Errors
    /// The database refuses; nothing is stored then.
    pub fn store_piece(
        &mut self,
        number: u32,
        piece: &Piece,
        branches: &[VariedBranch],
        message: Option<&str>,
    ) -> Result<(), StoreError> {
        let transaction = self.write()?;
        let kind = if piece.is_curve { "curve" } else { "vary" };
        transaction.execute(
            "INSERT INTO piece (id, definition, kind, parameter, message) VALUES (?1, ?2, ?3, ?4, ?5)",
            params![number, piece.definition, kind, piece.parameter, message],
        )?;
        let id = i64::from(number);
        for (number, branch) in branches.iter().enumerate() {
            let number = number as i64 + 1;
            transaction.execute(
                "INSERT INTO piece_branch VALUES (?1, ?2, ?3, ?4, ?5, ?6)",
                params![id, number, branch.period_multiple, branch.kind, branch.up, branch.down],
            )?;
            for (place, row) in branch.rows.iter().enumerate() {
                let place = place as i64;
                insert_row(&transaction, (id, number, place), row)?;
                if let Some(located) = &row.located {
                    insert_event(&transaction, ("piece_event", &[id, number, place]), located)?;
                }
            }
        }
        transaction.commit()?;
        Ok(())
    }

    /// The stored pieces, in the order of the study.
    ///
    /// # Errors
    /// The database refuses.
    pub fn pieces(&self) -> Result<Vec<PieceRecord>, StoreError> {
        let mut statement = self
            .connection
            .prepare("SELECT id, kind = 'curve', parameter, message FROM piece ORDER BY id")?;
        let pieces = statement
            .query_map([], |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?, row.get(3)?)))?
            .collect::<Result<Vec<_>, _>>()?;
        let record = |(id, is_curve, parameter, message)| {
            Ok(PieceRecord { id, is_curve, parameter, message, branches: self.piece_branches(id)? })
        };
        pieces.into_iter().map(record).collect()
    }

    fn piece_branches(&self, piece: u32) -> Result<Vec<PieceBranchRecord>, StoreError> {
        let select = "SELECT b.branch, b.period_multiple, b.kind, b.up, b.down, count(*), sum(r.stable = ?2),
            sum(r.stable = ?3), min(r.parameter), max(r.parameter)
            FROM piece_branch b JOIN piece_row r USING (piece, branch)
            WHERE b.piece = ?1 GROUP BY b.branch ORDER BY b.branch";
        let mut statement = self.connection.prepare(select)?;
        let words = [Stability::Stable, Stability::Marginal].map(stability::number);
        let branches = statement.query_map(params![piece, words[0], words[1]], |row| {
            Ok(PieceBranchRecord {
                branch: row.get(0)?,
                period_multiple: row.get(1)?,
                kind: row.get(2)?,
                up: row.get(3)?,
                down: row.get(4)?,
                rows: row.get(5)?,
                stable: row.get(6)?,
                marginal: row.get(7)?,
                range: [row.get(8)?, row.get(9)?],
                events: BTreeMap::new(),
            })
        })?;
        let mut branches = branches.collect::<Result<Vec<_>, _>>()?;
        for branch in &mut branches {
            branch.events = self.piece_events(piece, branch.branch)?;
        }
        Ok(branches)
    }

    fn piece_events(&self, piece: u32, branch: u32) -> Result<BTreeMap<String, u32>, StoreError> {
        let select = "SELECT event, count(*) FROM piece_row
            WHERE piece = ?1 AND branch = ?2 AND event != '' GROUP BY event";
        let mut statement = self.connection.prepare(select)?;
        let mut rows = statement.query([piece, branch])?;
        let mut events = BTreeMap::new();
        while let Some(row) = rows.next()? {
            let (label, count): (String, u32) = (row.get(0)?, row.get(1)?);
            for word in label.split('+') {
                *events.entry(word.to_owned()).or_default() += count;
            }
        }
        Ok(events)
    }

    /// The orbit of a row of a branch of a piece.
    ///
    /// # Errors
    /// The database refuses, or has no such row, or its nodes are damaged.
    pub fn varied_orbit(
        &self,
        (piece, branch): (u32, u32),
        place: u32,
    ) -> Result<StoredVariedOrbit, StoreError> {
        let select =
            "SELECT parameter, frequency_hz, phase_cycles, segments * state_length, state_length, nodes,
            multipliers FROM piece_row WHERE piece = ?1 AND branch = ?2 AND place = ?3";
        let (orbit, entries, length, nodes, multipliers) =
            self.connection.prepare_cached(select)?.query_row([piece, branch, place], |row| {
                let orbit = StoredVariedOrbit {
                    parameter: row.get(0)?,
                    frequency_hz: row.get(1)?,
                    phase: row.get(2)?,
                    state: Vec::new(),
                    floquet_multipliers: Vec::new(),
                };
                let bytes = |column| row.get::<_, Vec<u8>>(column);
                Ok((orbit, row.get::<_, u32>(3)?, row.get::<_, u32>(4)?, bytes(5)?, bytes(6)?))
            })?;
        let mut state = blob::unpack("nodes", &nodes, entries as usize)?;
        state.truncate(length as usize);
        Ok(StoredVariedOrbit { state, floquet_multipliers: pairs(&multipliers)?, ..orbit })
    }

    /// Hands over the rows of a branch of a piece.
    ///
    /// # Errors
    /// The database refuses, or `take` does.
    pub fn each_varied_row<E: From<StoreError>>(
        &self,
        (piece, branch): (u32, u32),
        mut take: impl FnMut(StoredVariedRow) -> Result<(), E>,
    ) -> Result<(), E> {
        let failed = |error: rusqlite::Error| E::from(StoreError::from(error));
        let select = "SELECT parameter, frequency_hz, max_abs_displacement_m, max_abs_acceleration_m_s2,
            max_contact_force_n, max_impact_velocity_m_s, impulse_n_s, leading_multiplier_re,
            leading_multiplier_im, residual, error_estimate, contacts, stable, event
            FROM piece_row WHERE piece = ?1 AND branch = ?2 ORDER BY place";
        let mut statement = self.connection.prepare_cached(select).map_err(failed)?;
        let mut rows = statement.query([piece, branch]).map_err(failed)?;
        while let Some(row) = rows.next().map_err(failed)? {
            take(read_row(row).map_err(failed)?)?;
        }
        Ok(())
    }
}

fn read_row(row: &rusqlite::Row<'_>) -> rusqlite::Result<StoredVariedRow> {
    let mut numbers = [0.0; 9];
    for (k, number) in numbers.iter_mut().enumerate() {
        *number = row.get(2 + k)?;
    }
    Ok(StoredVariedRow {
        parameter: row.get(0)?,
        frequency_hz: row.get(1)?,
        numbers,
        contacts: row.get(11)?,
        stability: row.get::<_, stability::Stored>(12)?.0,
        event: row.get(13)?,
    })
}

fn insert_row(
    transaction: &rusqlite::Transaction<'_>,
    (piece, branch, place): (i64, i64, i64),
    row: &VariedRow,
) -> Result<(), StoreError> {
    let insert = "INSERT INTO piece_row VALUES
        (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15, ?16, ?17, ?18, ?19, ?20, ?21, ?22)";
    let (solution, maxima) = (&row.solution, &row.solution.maxima);
    let [re, im] = solution.floquet_multipliers.first().copied().unwrap_or([0.0, 0.0]);
    transaction.prepare_cached(insert)?.execute(params![
        piece,
        branch,
        place,
        row.parameter,
        solution.frequency_hz,
        maxima.displacement,
        maxima.acceleration,
        maxima.contact_force,
        maxima.impact_velocity,
        maxima.impulse,
        maxima.contacts,
        stability::number(solution.stability()),
        re,
        im.abs(),
        solution.residual,
        solution.error_estimate,
        row.event,
        solution.nodes.len() as i64,
        solution.nodes.first().map_or(0, Vec::len) as i64,
        blob::pack(solution.nodes.iter().flatten()),
        solution.phase,
        blob::pack(solution.floquet_multipliers.iter().flatten()),
    ])?;
    Ok(())
}
