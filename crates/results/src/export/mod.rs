//! Stored results as CSV for other programs.
//!
//! | file | what it does |
//! |---|---|
//! | `branch_table.rs` | which tables of branches there are, and their columns |
//! | `branches.rs` | writes them |
//! | `motions.rs`, `simulation.rs` | sweeps, exponents, basins; motions in time |
//! | `table.rs` | a table that gets its name when it is finished |

mod branch_table;
mod branches;
mod error;
mod motions;
mod simulation;
mod table;

use std::path::{Path, PathBuf};

pub use branch_table::{BranchTable, TableLines, TableOver};
pub use error::ExportError;
pub use motions::{write_basins, write_exponents, write_sweep};
pub use simulation::SimulationTables;
pub use table::{Table, header, number, word};

pub(crate) use branches::{complex_numbers, numbers as entries};
pub(crate) use motions::grid;
pub(crate) use table::quoted;

use branches::write_branches;
use motions::export_motions;

use crate::{lines::Branches, store::Store};

/// What was exported.
#[derive(Debug, Clone, PartialEq)]
pub struct Exported {
    /// The branches.
    pub path: PathBuf,
    /// Number of their rows, without the header.
    pub rows: u64,
    /// The events.
    pub events_path: PathBuf,
    /// How branches ended.
    pub ends_path: PathBuf,
    /// `parameter_branches.csv`, `parameter_events.csv` and `parameter_ends.csv`, `curves.csv` and
    /// `curve_ends.csv`, where the study asks for them.
    pub varied_paths: Vec<PathBuf>,
    /// `outputs.csv`, `parameter_outputs.csv` and `curve_outputs.csv`, where the study has outputs.
    pub output_paths: Vec<PathBuf>,
    /// Tables of motions, sweeps, exponents and basins, with the numbers of their requests.
    pub motion_paths: Vec<PathBuf>,
}

/// Writes the tables of branches, events, ends and outputs, over the frequency and, where the study asks for
/// them, over other parameters and along curves, and those of motions, into a folder.
///
/// Numbers are the shortest that read back to the same double. The files appear complete or not at all.
///
/// # Errors
/// [`ExportError`].
pub fn export_csv(store: &Store, folder: &Path) -> Result<Exported, ExportError> {
    let snapshot = store.snapshot()?;
    let branches = Branches::of(store)?;
    let mut exported = Exported {
        path: folder.join("branches.csv"),
        rows: 0,
        events_path: folder.join("events.csv"),
        ends_path: folder.join("ends.csv"),
        varied_paths: Vec::new(),
        output_paths: Vec::new(),
        motion_paths: Vec::new(),
    };
    for table in BranchTable::ALL.iter().filter(|table| table.lines != TableLines::States) {
        let Some((path, lines)) = write_branches(&branches, store, folder, table)? else { continue };
        match (table.over, table.lines) {
            (TableOver::Frequency, TableLines::Rows) => exported.rows = lines,
            (_, TableLines::Outputs) => exported.output_paths.push(path),
            (TableOver::Frequency, _) => {}
            _ => exported.varied_paths.push(path),
        }
    }
    exported.motion_paths = export_motions(store, folder)?;
    drop(snapshot);
    Ok(exported)
}

/// Writes `states.csv` into a folder, and `parameter_states.csv` and `curve_states.csv` where there are such
/// branches and curves: the state and all multipliers of every solution, which take several times the room of
/// the rest.
///
/// # Returns
/// The files.
/// # Errors
/// [`ExportError`].
pub fn export_states(store: &Store, folder: &Path) -> Result<Vec<PathBuf>, ExportError> {
    let snapshot = store.snapshot()?;
    let branches = Branches::of(store)?;
    let mut paths = Vec::new();
    for table in BranchTable::ALL.iter().filter(|table| table.lines == TableLines::States) {
        paths.extend(write_branches(&branches, store, folder, table)?.map(|(path, _)| path));
    }
    drop(snapshot);
    Ok(paths)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use hammerbeam_orbit::Side;

    use super::*;
    use crate::store::tests::{STUDY, append, study, walked_folder};

    /// Tables that were finished stay; of the one that was being written nothing is left.
    #[test]
    fn an_export_that_is_interrupted_leaves_no_part_of_a_table() {
        let folder = tempfile::tempdir().unwrap();
        walked_folder(folder.path());
        let mut run = Store::open_for_run(folder.path(), &study(STUDY)).unwrap();
        let frequencies_hz: Vec<f64> = (0..2000).map(|k| 0.4 + 1e-4 * f64::from(k)).collect();
        append(&mut run, Side::Up, &frequencies_hz);
        drop(run);
        let (mut left, mut written) = (0, Vec::new());
        for most in (0..12).map(|power| 2_u32.pow(power)) {
            let out = tempfile::tempdir().unwrap();
            let (mut store, mut asked) = (Store::open(folder.path()).unwrap(), 0);
            let interrupted = move || {
                asked += 1;
                asked > most
            };
            store.read_unless(interrupted).unwrap();
            let exported = export_csv(&store, out.path()).and_then(|_| export_states(&store, out.path()));
            left += u32::from(exported.is_err());
            let names = fs::read_dir(out.path()).unwrap().map(|entry| entry.unwrap().file_name());
            let names: Vec<String> = names.map(|name| name.into_string().unwrap()).collect();
            assert!(names.iter().all(|name| name.ends_with(".csv")), "{names:?}");
            written.push(names.len());
        }
        assert!(left >= 4 && written[0] == 0, "{left}, {written:?}");
        assert_eq!(written.last(), Some(&4), "{written:?}");
    }
}
