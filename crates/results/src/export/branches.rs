//! Branches and curves as CSV: one writer for all tables of [`BranchTable`].

use std::{
    fs,
    io::Write,
    path::{Path, PathBuf},
};

use super::{
    branch_table::{BranchTable, TableLines, TableOver},
    error::ExportError,
    table::{quoted, write_whole},
};
use crate::{
    columns::TableColumn,
    lines::{Branches, Cell},
    store::{Store, StoredOutputs},
    whole_file::WriteError,
};

/// Writes a table into a folder; tables of pieces and of outputs only if there are such.
///
/// # Returns
/// The file, if there is one, and the number of its lines without the header.
pub(super) fn write_branches(
    all: &Branches,
    store: &Store,
    folder: &Path,
    table: &BranchTable,
) -> Result<Option<(PathBuf, u64)>, ExportError> {
    let path = folder.join(format!("{}.csv", table.name));
    let branches = all.over(table.over);
    let is_left_out = match table.lines {
        TableLines::Outputs => StoredOutputs::of(store)?.outputs().is_empty(),
        _ => false,
    };
    if is_left_out || branches.is_empty() && table.over != TableOver::Frequency {
        // A table of an earlier export would be taken for this one's.
        let _ = fs::remove_file(&path);
        return Ok(None);
    }
    let lines = write_whole(&path, |writer| {
        let failed = |source| ExportError::from(WriteError { path: path.clone(), source });
        let names: Vec<&str> = table.columns().map(TableColumn::name).collect();
        writeln!(writer, "{}", names.join(",")).map_err(failed)?;
        let mut lines = 0;
        for branch in &branches {
            branch.each_line(store, table.lines, |line| {
                lines += 1;
                let cells: Vec<String> = table.columns().map(|column| text(&line.cell(column))).collect();
                writeln!(writer, "{}", cells.join(",")).map_err(failed)
            })?;
        }
        Ok(lines)
    })?;
    Ok(Some((path, lines)))
}

fn text(cell: &Cell) -> String {
    match cell {
        Cell::None => String::new(),
        Cell::Number(number) => format!("{number:?}"),
        Cell::Whole(number) => number.to_string(),
        Cell::Flag(flag) => flag.to_string(),
        Cell::Words(words) => quoted(words),
        Cell::Stability(stability) => stability.column().to_owned(),
        Cell::Numbers(entries) => numbers(entries),
        Cell::Complex(entries) => complex_numbers(entries),
    }
}

/// Numbers with blanks between them.
pub(crate) fn numbers(entries: &[f64]) -> String {
    entries.iter().map(|entry| format!("{entry:?}")).collect::<Vec<_>>().join(" ")
}

/// `re+imi`, with blanks between them.
pub(crate) fn complex_numbers(entries: &[[f64; 2]]) -> String {
    entries.iter().map(|[re, im]| format!("{re:?}{im:+?}i")).collect::<Vec<_>>().join(" ")
}
