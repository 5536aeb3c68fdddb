//! Ends of branches and curves as CSV, each with its last state.

use std::{io::Write, path::Path};

use hammerbeam_orbit::Side;

use super::{
    ExportError,
    table::quoted,
    varied::{branches, header},
};
use crate::{
    reason::is_closed,
    store::{PieceRecord, Store},
    whole_file::WriteError,
};

/// Columns of `ends.csv`.
pub const END_COLUMNS: [&str; 8] =
    ["branch", "period_multiple", "side", "end", "frequency_hz", "message", "phase_cycles", "state"];

/// Columns of `parameter_ends.csv`, and of `curve_ends.csv` behind `of`.
pub const PARAMETER_END_COLUMNS: [&str; 10] = [
    "piece",
    "branch",
    "period_multiple",
    "parameter_name",
    "side",
    "parameter",
    "frequency_hz",
    "message",
    "phase_cycles",
    "state",
];

/// One row per side of a branch: how it ended, and the state `[q; q']` of its last solution at the phase at
/// which that begins.
pub(super) fn write_ends(store: &Store, writer: &mut impl Write, path: &Path) -> Result<(), ExportError> {
    let failed = |source| ExportError::from(WriteError { path: path.to_owned(), source });
    writeln!(writer, "{}", END_COLUMNS.join(",")).map_err(failed)?;
    for branch in store.branches()? {
        for (side, name, walk) in [(Side::Down, "down", &branch.down), (Side::Up, "up", &branch.up)] {
            // A side without solutions ends at the start, which is the first of the up side.
            let last = match (walk.solutions, branch.up.solutions) {
                (0, 0) => continue,
                (0, _) => store.solution(branch.start, Side::Up, 0)?,
                (count, _) => store.solution(branch.start, side, count as u32 - 1)?,
            };
            let (kind, message) = match &walk.reason {
                Some(reason) => (reason.kind.as_str(), quoted(&reason.message)),
                None => ("not-finished", quoted("not finished: the same run goes on from here")),
            };
            writeln!(
                writer,
                "{},{},{name},{kind},{:?},{message},{:?},{}",
                branch.id,
                branch.period_multiple,
                last.frequency_hz,
                last.phase,
                entries(&last.nodes[0])
            )
            .map_err(failed)?;
        }
    }
    Ok(())
}

/// One row per side of a branch in a parameter or of a curve: how it ended, in words, and the state of its
/// last orbit.
pub(super) fn write_varied_ends(
    store: &Store,
    pieces: &[&PieceRecord],
    writer: &mut impl Write,
    path: &Path,
) -> Result<(), ExportError> {
    let failed = |source| ExportError::from(WriteError { path: path.to_owned(), source });
    writeln!(writer, "{}", header(pieces, &PARAMETER_END_COLUMNS)).map_err(failed)?;
    for (piece, branch, start) in branches(pieces) {
        // A closed curve was walked down, and ends with its first row, at its start.
        let up = if is_closed(&branch.down) { 0 } else { branch.rows - 1 };
        for (name, end, place) in [("down", &branch.down, 0), ("up", &branch.up, up)] {
            let last = store.varied_orbit((piece.id, branch.branch), place)?;
            let message = quoted(end);
            let (value, frequency_hz, phase) = (last.parameter, last.frequency_hz, last.phase);
            let state = entries(&last.state);
            writeln!(writer, "{start},{name},{value:?},{frequency_hz:?},{message},{phase:?},{state}")
                .map_err(failed)?;
        }
    }
    Ok(())
}

/// Numbers with blanks between them.
pub(crate) fn entries(state: &[f64]) -> String {
    let entries: Vec<String> = state.iter().map(|entry| format!("{entry:?}")).collect();
    entries.join(" ")
}
