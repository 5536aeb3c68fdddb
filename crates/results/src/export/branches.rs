//! Branches and curves as CSV: one writer for all tables of [`BranchTable`].

use std::{
    io::{self, Write},
    path::{Path, PathBuf},
};

use hammerbeam_orbit::{BranchEventKind, ContactChange, EventStatus, LocatedEvent, Side};

use super::{
    branch_table::{BranchTable, TableLines, TableOver},
    error::ExportError,
    table::{quoted, write_whole},
};
use crate::{
    columns::{RowValue, TableColumn},
    end_text::{BranchOver, NOT_FINISHED, sentence},
    row::Row,
    store::{BranchRecord, PieceRecord, Store, StoreError, solution_key},
    whole_file::WriteError,
};

/// A branch with the piece that it is of, if it is of one.
struct OwnedBranch<'a> {
    piece: Option<&'a PieceRecord>,
    branch: &'a BranchRecord,
}

/// What there is to write.
pub(super) struct Branches {
    diagram: Vec<BranchRecord>,
    pieces: Vec<PieceRecord>,
}

impl Branches {
    pub fn of(store: &Store) -> Result<Self, StoreError> {
        Ok(Self { diagram: store.branches()?, pieces: store.pieces()? })
    }

    /// The branches of a table, one after the other.
    fn over(&self, over: TableOver) -> Vec<OwnedBranch<'_>> {
        if over == TableOver::Frequency {
            return self.diagram.iter().map(|branch| OwnedBranch { piece: None, branch }).collect();
        }
        let pieces = self.pieces.iter().filter(|piece| piece.kind.is_curve() == (over == TableOver::Curves));
        let mut branches = Vec::new();
        for piece in pieces {
            branches.extend(piece.branches.iter().map(|branch| OwnedBranch { piece: Some(piece), branch }));
        }
        branches
    }

    /// Writes a table into a folder; tables of pieces only if there is something in them.
    ///
    /// # Returns
    /// The file, if there is one, and the number of its lines without the header.
    pub fn write(
        &self,
        store: &Store,
        folder: &Path,
        table: &BranchTable,
    ) -> Result<Option<(PathBuf, u64)>, ExportError> {
        let path = folder.join(table.name);
        let branches = self.over(table.over);
        if branches.is_empty() && table.over != TableOver::Frequency {
            // A table of an earlier export would be taken for this one's.
            let _ = std::fs::remove_file(&path);
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
                    line.write(writer, table).map_err(failed)
                })?;
            }
            Ok(lines)
        })?;
        Ok(Some((path, lines)))
    }
}

impl OwnedBranch<'_> {
    fn each_line(
        &self,
        store: &Store,
        lines: TableLines,
        take: impl FnMut(&Line<'_>) -> Result<(), ExportError>,
    ) -> Result<(), ExportError> {
        match lines {
            TableLines::Rows => self.each_row(store, take),
            TableLines::Events => self.each_event(store, take),
            TableLines::Ends => self.each_end(store, take),
            TableLines::States => self.each_state(store, take),
        }
    }

    fn line(&self, row: Row) -> Line<'_> {
        Line { of: self, number: 0, side: Side::Up, row, event: None, point: None }
    }

    fn each_row(
        &self,
        store: &Store,
        mut take: impl FnMut(&Line<'_>) -> Result<(), ExportError>,
    ) -> Result<(), ExportError> {
        store.each_row(self.branch, |row| take(&self.line(row)))
    }

    fn each_event(
        &self,
        store: &Store,
        mut take: impl FnMut(&Line<'_>) -> Result<(), ExportError>,
    ) -> Result<(), ExportError> {
        let mut next = 0;
        store.each_placed_row::<ExportError>(self.branch, |placed| {
            let number = next;
            next += 1;
            let key = solution_key(self.branch.start, placed.side, placed.number);
            let Some(event) = store.event(key)? else { return Ok(()) };
            // It was walked the other way than rows are counted.
            let event = if placed.side == Side::Down { event.backwards() } else { event };
            let mut row = placed.row;
            if self.piece.is_none() {
                // These are no events.
                row.events = row.events.without(BranchEventKind::Start).without(BranchEventKind::End);
            }
            let point = Point { multipliers: store.multipliers(key)?, ..Point::default() };
            take(&Line { number, event: Some(event), point: Some(point), ..self.line(row) })
        })
    }

    fn each_end(
        &self,
        store: &Store,
        mut take: impl FnMut(&Line<'_>) -> Result<(), ExportError>,
    ) -> Result<(), ExportError> {
        for side in [Side::Down, Side::Up] {
            let Some((last_side, number)) = self.branch.last_of(side) else { continue };
            let (row, point) = point_at(store, solution_key(self.branch.start, last_side, number))?;
            take(&Line { side, point: Some(point), ..self.line(row) })?;
        }
        Ok(())
    }

    fn each_state(
        &self,
        store: &Store,
        mut take: impl FnMut(&Line<'_>) -> Result<(), ExportError>,
    ) -> Result<(), ExportError> {
        for (number, (side, of_side)) in (0..).zip(self.branch.places()) {
            let (row, point) = point_at(store, solution_key(self.branch.start, side, of_side))?;
            take(&Line { number, point: Some(point), ..self.line(row) })?;
        }
        Ok(())
    }
}

fn point_at(store: &Store, key: i64) -> Result<(Row, Point), StoreError> {
    let solved = store.solved_row(key)?;
    let row = Row::from(&solved);
    let solution = solved.solution;
    let state = solution.nodes.into_iter().next().unwrap_or_default();
    Ok((row, Point { phase: solution.phase, state, multipliers: solution.floquet_multipliers }))
}

/// Where an orbit begins, and all its multipliers.
#[derive(Default)]
struct Point {
    phase: f64,
    state: Vec<f64>,
    multipliers: Vec<[f64; 2]>,
}

/// All that a line of a table may show.
struct Line<'a> {
    of: &'a OwnedBranch<'a>,
    /// Of the row, from 0 along the branch.
    number: u64,
    /// Of an end.
    side: Side,
    row: Row,
    event: Option<LocatedEvent>,
    point: Option<Point>,
}

impl Line<'_> {
    fn write(&self, writer: &mut impl Write, table: &BranchTable) -> io::Result<()> {
        let cells: Vec<String> = table.columns().map(|column| self.cell(column)).collect();
        writeln!(writer, "{}", cells.join(","))
    }

    fn cell(&self, column: TableColumn) -> String {
        let of_row = self.row.value(column).map(|value| match value {
            RowValue::Number(number) => format!("{number:?}"),
            RowValue::Count(count) => count.to_string(),
            RowValue::Stability(stability) => stability.column().to_owned(),
            RowValue::Events(events) => events.label(),
        });
        of_row
            .or_else(|| self.of_branch(column))
            .or_else(|| self.of_point(column))
            .or_else(|| self.of_event(column))
            .unwrap_or_default()
    }

    fn of_branch(&self, column: TableColumn) -> Option<String> {
        let OwnedBranch { piece, branch } = self.of;
        let end = branch.walk(self.side).end.as_ref();
        Some(match column {
            TableColumn::Branch => branch.id.to_string(),
            TableColumn::PeriodMultiple => branch.period_multiple.to_string(),
            TableColumn::Of => (*piece)?.kind.name().to_owned(),
            TableColumn::Piece => (*piece)?.place.to_string(),
            TableColumn::ParameterName => quoted(&(*piece)?.parameter),
            TableColumn::Side => if self.side == Side::Down { "down" } else { "up" }.to_owned(),
            TableColumn::End => end.map_or("not-finished", |end| end.word()).to_owned(),
            TableColumn::Message => {
                let along = piece.map_or(BranchOver::Frequency, PieceRecord::along);
                quoted(&end.map_or_else(|| NOT_FINISHED.to_owned(), |end| sentence(end, along)))
            }
            TableColumn::RowNumber => self.number.to_string(),
            _ => return None,
        })
    }

    fn of_point(&self, column: TableColumn) -> Option<String> {
        let point = self.point.as_ref()?;
        match column {
            TableColumn::Phase => Some(format!("{:?}", point.phase)),
            TableColumn::State => Some(numbers(&point.state)),
            TableColumn::Multipliers => Some(complex_numbers(&point.multipliers)),
            _ => None,
        }
    }

    fn of_event(&self, column: TableColumn) -> Option<String> {
        let event = self.event.as_ref()?;
        match column {
            TableColumn::Status => Some(
                match event.status {
                    EventStatus::Located => "located",
                    EventStatus::Bracketed => "bracketed",
                }
                .to_owned(),
            ),
            TableColumn::UncertaintyHz | TableColumn::Uncertainty => Some(format!("{:?}", event.uncertainty)),
            TableColumn::MultiplierRe => event.multiplier.map(|[re, _]| format!("{re:?}")),
            TableColumn::MultiplierIm => event.multiplier.map(|[_, im]| format!("{im:?}")),
            TableColumn::ContactChange => Some(changes(&event.contacts)),
            TableColumn::Direction => Some(numbers(&event.direction)),
            TableColumn::SymmetryBreaking => Some(event.breaks_symmetry.to_string()),
            _ => None,
        }
    }
}

fn changes(contacts: &[ContactChange]) -> String {
    let change =
        |change: &ContactChange| format!("{}{}", if change.appears { "+" } else { "-" }, change.contact + 1);
    contacts.iter().map(change).collect::<Vec<_>>().join(" ")
}

/// Numbers with blanks between them.
fn numbers(entries: &[f64]) -> String {
    entries.iter().map(|entry| format!("{entry:?}")).collect::<Vec<_>>().join(" ")
}

/// `re+imi`, with blanks between them.
fn complex_numbers(entries: &[[f64; 2]]) -> String {
    entries.iter().map(|[re, im]| format!("{re:?}{im:+?}i")).collect::<Vec<_>>().join(" ")
}
