//! Branches in parameters and curves of bifurcations as CSV.

use std::{
    io::Write,
    path::{Path, PathBuf},
};

use super::{
    ExportError, ends::write_varied_ends, events::write_parameter_events, states::write_varied_states,
    table::quoted, write_whole,
};
use crate::{
    store::{PieceBranchRecord, PieceRecord, Store},
    whole_file::{WholeFile, WriteError},
};

/// Columns of `parameter_branches.csv`.
pub const PARAMETER_COLUMNS: [&str; 18] = [
    "piece",
    "branch",
    "period_multiple",
    "parameter_name",
    "parameter",
    "frequency_hz",
    "max_abs_displacement_m",
    "max_abs_acceleration_m_s2",
    "max_contact_force_n",
    "max_impact_velocity_m_s",
    "impulse_n_s",
    "leading_multiplier_re",
    "leading_multiplier_im",
    "residual",
    "error_estimate",
    "contacts",
    "stable",
    "event",
];

/// Writes `parameter_branches.csv` with `parameter_events.csv` and `parameter_ends.csv`, and `curves.csv`
/// with `curve_ends.csv`, into a folder, each only if there is something in it.
///
/// Tables of curves have a further column `of` in front, which says what the curve is of.
pub(crate) fn export_varied(store: &Store, folder: &Path) -> Result<Vec<PathBuf>, ExportError> {
    let tables: [(&str, Kind, TableWriter); 5] = [
        ("parameter_branches.csv", Kind::Branches, write_rows),
        ("parameter_events.csv", Kind::Branches, write_parameter_events),
        ("parameter_ends.csv", Kind::Branches, write_varied_ends),
        ("curves.csv", Kind::Curves, write_rows),
        ("curve_ends.csv", Kind::Curves, write_varied_ends),
    ];
    write_tables(store, folder, &tables)
}

/// Writes `parameter_states.csv` and `curve_states.csv` into a folder, each only if there is something in it.
pub(crate) fn export_varied_states(store: &Store, folder: &Path) -> Result<Vec<PathBuf>, ExportError> {
    let tables: [(&str, Kind, TableWriter); 2] = [
        ("parameter_states.csv", Kind::Branches, write_varied_states),
        ("curve_states.csv", Kind::Curves, write_varied_states),
    ];
    write_tables(store, folder, &tables)
}

/// What a table of pieces is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Branches,
    Curves,
}

fn write_tables(
    store: &Store,
    folder: &Path,
    tables: &[(&str, Kind, TableWriter)],
) -> Result<Vec<PathBuf>, ExportError> {
    let stored = store.pieces()?;
    let mut files = Vec::new();
    for (name, kind, write) in tables {
        let is_of_kind = |piece: &&PieceRecord| piece.is_curve == (*kind == Kind::Curves);
        let pieces: Vec<&PieceRecord> =
            stored.iter().filter(is_of_kind).filter(|piece| !piece.branches.is_empty()).collect();
        let path = folder.join(name);
        if pieces.is_empty() {
            // A table of an earlier export would be taken for this one's.
            let _ = std::fs::remove_file(&path);
            continue;
        }
        write_whole(&path, |writer| write(store, &pieces, writer, &path))?;
        files.push(path);
    }
    Ok(files)
}

/// Writes the pieces, of one kind, as one table.
type TableWriter = fn(&Store, &[&PieceRecord], &mut WholeFile, &Path) -> Result<(), ExportError>;

fn write_rows(
    store: &Store,
    pieces: &[&PieceRecord],
    writer: &mut impl Write,
    path: &Path,
) -> Result<(), ExportError> {
    let failed = |source| ExportError::from(WriteError { path: path.to_owned(), source });
    writeln!(writer, "{}", header(pieces, &PARAMETER_COLUMNS)).map_err(failed)?;
    for (piece, branch, start) in branches(pieces) {
        store.each_varied_row::<ExportError>((piece.id, branch.branch), |row| {
            let numbers: Vec<String> = row.numbers.iter().map(|number| format!("{number:?}")).collect();
            writeln!(
                writer,
                "{start},{:?},{:?},{},{},{},{}",
                row.parameter,
                row.frequency_hz,
                numbers.join(","),
                row.contacts,
                row.stability.column(),
                row.event
            )
            .map_err(failed)
        })?;
    }
    Ok(())
}

/// Columns of a table of pieces; of curves with `of` in front.
pub(super) fn header(pieces: &[&PieceRecord], columns: &[&str]) -> String {
    let front = if pieces.iter().any(|piece| piece.is_curve) { "of," } else { "" };
    format!("{front}{}", columns.join(","))
}

/// Every branch of the pieces, and what its rows begin with.
pub(super) fn branches<'a>(
    pieces: &'a [&PieceRecord],
) -> impl Iterator<Item = (&'a PieceRecord, &'a PieceBranchRecord, String)> {
    let of_piece = |piece: &'a PieceRecord| {
        piece.branches.iter().map(move |branch| (piece, branch, start_of_row(piece, branch)))
    };
    pieces.iter().copied().flat_map(of_piece)
}

/// Piece, branch, period multiple and name of the parameter; what a curve is of in front.
fn start_of_row(piece: &PieceRecord, branch: &PieceBranchRecord) -> String {
    let front = if piece.is_curve { format!("{},", branch.kind) } else { String::new() };
    let name = quoted(&piece.parameter);
    format!("{front}{},{},{},{name}", piece.id, branch.branch, branch.period_multiple)
}
