//! Pieces of a study: what it asks for beside the branches over the frequency, each a `[[vary]]` (branches
//! over another parameter) or a `[[curve]]` (a curve of bifurcations).
//!
//! A piece is known by its definition; its place in the study may change. Its branches are stored as all
//! others are: starts, walks with their checkpoints, solutions.

use hammerbeam_orbit::{BranchEventKind, EventSet, PeriodicSolution};
use hammerbeam_study::file::CurveOf;
use rusqlite::{Connection, Transaction, params};

use super::{
    StoreError,
    keys::starts_of_piece,
    read::{BranchRecord, branches_of},
    starts::{NewStart, StartRecord, delete_start},
};
use crate::{end_text::BranchOver, row::SolvedRow};

/// What a piece is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PieceKind {
    /// Branches over a parameter, at one frequency.
    Vary,
    /// A curve of bifurcations.
    Curve(CurveOf),
}

/// What was asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// Everything that it depends on besides the study itself.
    pub definition: String,
    /// What it is.
    pub kind: PieceKind,
    /// Name of the parameter.
    pub parameter: String,
}

/// A stored piece, without rows.
#[derive(Debug, Clone, PartialEq)]
pub struct PieceRecord {
    /// Its key.
    pub key: u32,
    /// Its place in the study, from 1.
    pub place: u32,
    /// What it is.
    pub kind: PieceKind,
    /// Name of the parameter.
    pub parameter: String,
    /// Whether its starts are known.
    pub searched: bool,
    /// Whether nothing is left to compute.
    pub finished: bool,
    /// Why there is nothing, or not everything.
    pub message: Option<String>,
    /// Its branches.
    pub branches: Vec<BranchRecord>,
}

impl PieceKind {
    /// What its branches are called: `branch`, or what the curve consists of.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Vary => "branch",
            Self::Curve(of) => of.name(),
        }
    }

    /// Whether it is a curve.
    #[must_use]
    pub fn is_curve(self) -> bool {
        matches!(self, Self::Curve(_))
    }

    fn stored(self) -> &'static str {
        match self {
            Self::Vary => "vary",
            Self::Curve(of) => of.name(),
        }
    }

    fn of_stored(word: &str) -> Option<Self> {
        let curves =
            [CurveOf::Fold, CurveOf::Flip, CurveOf::NeimarkSacker, CurveOf::Grazing].map(Self::Curve);
        [Self::Vary].into_iter().chain(curves).find(|kind| kind.stored() == word)
    }
}

impl PieceRecord {
    /// What its branches run along.
    #[must_use]
    pub fn along(&self) -> BranchOver<'_> {
        match self.kind {
            PieceKind::Vary => BranchOver::Parameter(&self.parameter),
            PieceKind::Curve(of) => BranchOver::Curve(&self.parameter, of),
        }
    }
}

/// Throws away pieces that the study does not ask for any more, notes new ones, and gives all the numbers
/// of their places in it.
pub fn keep_pieces(transaction: Transaction<'_>, wanted: &[Piece]) -> Result<(), StoreError> {
    let stored: Vec<(u32, String)> = transaction
        .prepare("SELECT id, definition FROM piece")?
        .query_map([], |row| Ok((row.get(0)?, row.get(1)?)))?
        .collect::<Result<_, _>>()?;
    let is_wanted = |text: &String| wanted.iter().any(|piece| piece.definition == *text);
    for (key, _) in stored.iter().filter(|(_, text)| !is_wanted(text)) {
        let starts: Vec<u32> = transaction
            .prepare("SELECT id FROM start WHERE piece = ?1")?
            .query_map([key], |row| row.get(0))?
            .collect::<Result<_, _>>()?;
        for start in starts {
            delete_start(&transaction, start)?;
        }
        transaction.execute("DELETE FROM piece WHERE id = ?1", [key])?;
    }
    // From the last one: of pieces that are the same the first one counts.
    for (index, piece) in wanted.iter().enumerate().rev() {
        let insert = "INSERT INTO piece (place, definition, kind, parameter) VALUES (?1, ?2, ?3, ?4)
            ON CONFLICT (definition) DO UPDATE SET place = excluded.place";
        let values = params![index as u32 + 1, piece.definition, piece.kind.stored(), piece.parameter];
        transaction.execute(insert, values)?;
    }
    transaction.commit()?;
    Ok(())
}

/// Notes what came of the search of a piece: its starts, each with the walks that will begin there.
pub fn note_piece_starts(
    transaction: Transaction<'_>,
    piece: u32,
    parameter: f64,
    starts: &[PeriodicSolution],
    message: Option<&str>,
) -> Result<(), StoreError> {
    let update = "UPDATE piece SET searched = 1, message = ?2 WHERE id = ?1";
    transaction.execute(update, params![piece, message])?;
    for (start, key) in starts.iter().zip(starts_of_piece(piece)) {
        let events = EventSet::default().with(BranchEventKind::Start);
        let row = SolvedRow { parameter, solution: start.clone(), events, located: None };
        NewStart { key, job: None, piece: Some(piece), row: &row, down: None }.insert(&transaction)?;
    }
    transaction.commit()?;
    Ok(())
}

/// Notes that nothing of a piece is left to compute.
pub fn finish_piece(
    transaction: Transaction<'_>,
    piece: u32,
    message: Option<&str>,
) -> Result<(), StoreError> {
    let update = "UPDATE piece SET searched = 1, finished = 1, message = coalesce(?2, message) WHERE id = ?1";
    transaction.execute(update, params![piece, message])?;
    transaction.commit()?;
    Ok(())
}

/// Starts of a piece, by its key, in their order.
pub fn starts(connection: &Connection, piece: u32) -> Result<Vec<StartRecord>, StoreError> {
    let select = "SELECT id, period_multiple, branch FROM start WHERE piece = ?1 ORDER BY id";
    let mut statement = connection.prepare(select)?;
    statement.query_and_then([piece], StartRecord::read)?.collect()
}

/// The pieces whose starts are known, in the order of the study.
pub fn pieces(connection: &Connection) -> Result<Vec<PieceRecord>, StoreError> {
    Ok(all_pieces(connection)?.into_iter().filter(|piece| piece.searched).collect())
}

/// All pieces, in the order of the study, those too of which nothing is known yet.
pub fn all_pieces(connection: &Connection) -> Result<Vec<PieceRecord>, StoreError> {
    let select = "SELECT id, place, kind, parameter, searched, finished, message FROM piece ORDER BY place";
    let mut statement = connection.prepare(select)?;
    let mut rows = statement.query([])?;
    let mut pieces = Vec::new();
    while let Some(row) = rows.next()? {
        let (key, word): (u32, String) = (row.get(0)?, row.get(2)?);
        let kind =
            PieceKind::of_stored(&word).ok_or(StoreError::Unknown { what: "kind of piece", found: word })?;
        pieces.push(PieceRecord {
            key,
            place: row.get(1)?,
            kind,
            parameter: row.get(3)?,
            searched: row.get(4)?,
            finished: row.get(5)?,
            message: row.get(6)?,
            branches: branches_of(connection, Some(key))?,
        });
    }
    Ok(pieces)
}
