//! Branches and curves by columns: each table of [`BranchTable`] as arrays.

use hammerbeam_orbit::Stability;

use super::{ArrayTable, ArrayValues};
use crate::{
    columns::{ColumnKind, TableColumn},
    export::{BranchTable, TableLines, TableOver},
    lines::{Branches, Cell, OwnedBranch},
    store::{Store, StoreError},
};

/// Branches over the frequency: their rows, events, ends or states, with the columns of the CSV file.
/// Behind `stable` comes `stability`, which says it in a word.
///
/// * `branches`: their numbers; all if there are none.
///
/// # Errors
/// [`StoreError`]: solutions are missing or damaged.
pub fn branch_array(
    store: &Store,
    lines: TableLines,
    branches: &[u32],
) -> Result<Vec<ArrayTable>, StoreError> {
    let all = Branches::of(store)?;
    BranchTable::of(TableOver::Frequency, lines).map(|table| array(store, &all, table, branches)).collect()
}

/// Branches over other parameters and curves, each table only if there is something in it.
///
/// * `lines`: which tables are meant.
///
/// # Errors
/// [`StoreError`].
pub fn piece_arrays(store: &Store, lines: &[TableLines]) -> Result<Vec<ArrayTable>, StoreError> {
    let all = Branches::of(store)?;
    let wanted = |table: &&BranchTable| {
        table.over != TableOver::Frequency && lines.contains(&table.lines) && !all.over(table.over).is_empty()
    };
    BranchTable::ALL.iter().filter(wanted).map(|table| array(store, &all, table, &[])).collect()
}

fn array(
    store: &Store,
    all: &Branches,
    table: &BranchTable,
    branches: &[u32],
) -> Result<ArrayTable, StoreError> {
    let mut columns: Vec<ColumnBuilder> = table.columns().map(ColumnBuilder::of).collect();
    let is_wanted = |branch: &OwnedBranch<'_>| branches.is_empty() || branches.contains(&branch.id());
    for branch in all.over(table.over).iter().filter(|branch| is_wanted(branch)) {
        branch.each_line::<StoreError>(store, table.lines, |line| {
            columns.iter_mut().for_each(|column| column.add(line.cell(column.column)));
            Ok(())
        })?;
    }
    Ok(ArrayTable::new(table.name, columns.into_iter().flat_map(ColumnBuilder::finished).collect()))
}

/// A column that grows line by line.
struct ColumnBuilder {
    column: TableColumn,
    entries: Entries,
}

enum Entries {
    Numbers(Vec<f64>),
    Whole(Vec<i64>),
    Flags(Vec<bool>),
    Words(Vec<std::borrow::Cow<'static, str>>),
    Stability(Vec<Stability>),
    Vectors(Vec<Vec<f64>>),
    Complex(Vec<Vec<[f64; 2]>>),
}

impl ColumnBuilder {
    fn of(column: TableColumn) -> Self {
        let entries = match column.kind() {
            ColumnKind::Number => Entries::Numbers(vec![]),
            ColumnKind::Whole => Entries::Whole(vec![]),
            ColumnKind::Words | ColumnKind::Events => Entries::Words(vec![]),
            ColumnKind::Flag => Entries::Flags(vec![]),
            ColumnKind::Stability => Entries::Stability(vec![]),
            ColumnKind::Numbers => Entries::Vectors(vec![]),
            ColumnKind::Complex => Entries::Complex(vec![]),
        };
        Self { column, entries }
    }

    fn add(&mut self, cell: Cell) {
        match (&mut self.entries, cell) {
            (Entries::Numbers(values), Cell::Number(value)) => values.push(value),
            (Entries::Numbers(values), _) => values.push(f64::NAN),
            (Entries::Whole(values), Cell::Whole(value)) => values.push(value as i64),
            (Entries::Whole(values), _) => values.push(-1),
            (Entries::Flags(values), cell) => values.push(cell == Cell::Flag(true)),
            (Entries::Words(values), Cell::Words(words)) => values.push(words),
            (Entries::Words(values), _) => values.push("".into()),
            (Entries::Stability(values), Cell::Stability(stability)) => values.push(stability),
            (Entries::Stability(values), _) => values.push(Stability::Unstable),
            (Entries::Vectors(values), Cell::Numbers(entries)) => values.push(entries),
            (Entries::Vectors(values), _) => values.push(vec![]),
            (Entries::Complex(values), Cell::Complex(entries)) => values.push(entries),
            (Entries::Complex(values), _) => values.push(vec![]),
        }
    }

    fn finished(self) -> Vec<(String, ArrayValues)> {
        let values = match self.entries {
            Entries::Numbers(values) => ArrayValues::Numbers(values),
            Entries::Whole(values) => ArrayValues::Whole(values),
            Entries::Flags(values) => ArrayValues::Flags(values),
            Entries::Words(values) => ArrayValues::Words(values),
            Entries::Vectors(rows) => ArrayValues::vectors(&rows),
            Entries::Complex(rows) => ArrayValues::complex(&rows),
            Entries::Stability(values) => {
                let stable = values.iter().map(|value| *value == Stability::Stable).collect();
                let words = values.iter().map(|value| value.word().into()).collect();
                return vec![
                    (self.column.name().to_owned(), ArrayValues::Flags(stable)),
                    ("stability".to_owned(), ArrayValues::Words(words)),
                ];
            }
        };
        vec![(self.column.name().to_owned(), values)]
    }
}
