//! Ends of branches as CSV, each with its last state.

use std::{io::Write, path::Path};

use hammerbeam_orbit::Side;

use super::{ExportError, table::quoted};
use crate::store::Store;

/// Columns of `ends.csv`.
pub const END_COLUMNS: [&str; 8] =
    ["branch", "period_multiple", "side", "end", "frequency_hz", "message", "phase_cycles", "state"];

/// One row per side of a branch: how it ended, and the state `[q; q']` of its last solution at the phase at which that begins.
pub(super) fn write_ends(store: &Store, writer: &mut impl Write, path: &Path) -> Result<(), ExportError> {
    let failed = |source| ExportError::Write { path: path.to_owned(), source };
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
                None => ("", String::new()),
            };
            let state: Vec<String> = last.nodes[0].iter().map(|entry| format!("{entry:?}")).collect();
            writeln!(
                writer,
                "{},{},{name},{kind},{:?},{message},{:?},{}",
                branch.id,
                branch.period_multiple,
                last.frequency_hz,
                last.phase,
                state.join(" ")
            )
            .map_err(failed)?;
        }
    }
    Ok(())
}
