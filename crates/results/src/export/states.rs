//! States and all multipliers of every stored solution as CSV.

use std::{io::Write, path::Path};

use hammerbeam_orbit::Side;

use super::{
    ExportError,
    ends::entries,
    events::complex_numbers,
    varied::{branches, header},
};
use crate::{
    store::{BranchRecord, PieceRecord, Store},
    whole_file::WriteError,
};

/// Columns of `states.csv`; `row` counts from 0 along the branch, as in `events.csv`.
pub const STATE_COLUMNS: [&str; 7] =
    ["branch", "period_multiple", "row", "frequency_hz", "phase_cycles", "state", "multipliers"];

/// Columns of `parameter_states.csv`, and of `curve_states.csv` behind `of`; `row` counts from 0 along the
/// branch, as in `parameter_events.csv`.
pub const PARAMETER_STATE_COLUMNS: [&str; 10] = [
    "piece",
    "branch",
    "period_multiple",
    "parameter_name",
    "row",
    "parameter",
    "frequency_hz",
    "phase_cycles",
    "state",
    "multipliers",
];

/// One row per solution: the state `[q; q']` at the phase at which its orbit begins, and its multipliers.
pub(super) fn write_states(store: &Store, writer: &mut impl Write, path: &Path) -> Result<(), ExportError> {
    let failed = |source| ExportError::from(WriteError { path: path.to_owned(), source });
    writeln!(writer, "{}", STATE_COLUMNS.join(",")).map_err(failed)?;
    for branch in store.branches()? {
        for (row, (side, number)) in places(&branch).enumerate() {
            let solution = store.solution(branch.start, side, number)?;
            writeln!(
                writer,
                "{},{},{row},{:?},{:?},{},{}",
                branch.id,
                branch.period_multiple,
                solution.frequency_hz,
                solution.phase,
                entries(&solution.nodes[0]),
                complex_numbers(&solution.floquet_multipliers)
            )
            .map_err(failed)?;
        }
    }
    Ok(())
}

/// The same for the rows of branches in parameters, or of curves.
pub(super) fn write_varied_states(
    store: &Store,
    pieces: &[&PieceRecord],
    writer: &mut impl Write,
    path: &Path,
) -> Result<(), ExportError> {
    let failed = |source| ExportError::from(WriteError { path: path.to_owned(), source });
    writeln!(writer, "{}", header(pieces, &PARAMETER_STATE_COLUMNS)).map_err(failed)?;
    for (piece, branch, start) in branches(pieces) {
        for row in 0..branch.rows {
            let orbit = store.varied_orbit((piece.id, branch.branch), row)?;
            writeln!(
                writer,
                "{start},{row},{:?},{:?},{:?},{},{}",
                orbit.parameter,
                orbit.frequency_hz,
                orbit.phase,
                entries(&orbit.state),
                complex_numbers(&orbit.floquet_multipliers)
            )
            .map_err(failed)?;
        }
    }
    Ok(())
}

/// Where the rows of a branch stand, end to end: the down side from its end, then the up side.
fn places(branch: &BranchRecord) -> impl Iterator<Item = (Side, u32)> + use<> {
    let (down, up) = (branch.down.solutions as u32, branch.up.solutions as u32);
    let down = (0..down).rev().map(|number| (Side::Down, number));
    down.chain((0..up).map(|number| (Side::Up, number)))
}
