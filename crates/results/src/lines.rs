//! The lines of all tables of branches: the one place that walks over what is stored and says what a line has
//! in a column. CSV and arrays are made of these.

use std::borrow::Cow;

use hammerbeam_orbit::{
    BranchEventKind, ContactChange, EventSet, EventStatus, LocatedEvent, Side, SignalStatistics, Stability,
};
use hammerbeam_study::file::OutputEntry;

use crate::{
    columns::{RowValue, TableColumn},
    end_text::{BranchOver, NOT_FINISHED, sentence},
    export::{TableLines, TableOver},
    row::Row,
    store::{BranchRecord, PieceRecord, Store, StoreError, StoredOutputs, solution_key},
};

/// What a line has in a column.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Cell {
    /// Nothing.
    None,
    /// A number.
    Number(f64),
    /// A whole number.
    Whole(u64),
    /// Yes or no.
    Flag(bool),
    /// Words.
    Words(Cow<'static, str>),
    /// Stable, marginal or unstable.
    Stability(Stability),
    /// Numbers.
    Numbers(Vec<f64>),
    /// Complex numbers.
    Complex(Vec<[f64; 2]>),
}

impl From<RowValue> for Cell {
    fn from(value: RowValue) -> Self {
        match value {
            RowValue::Number(number) => Self::Number(number),
            RowValue::Count(count) => Self::Whole(count.into()),
            RowValue::Stability(stability) => Self::Stability(stability),
            RowValue::Events(events) => Self::Words(events.label().into()),
        }
    }
}

/// A branch with the piece that it is of, if it is of one.
pub(crate) struct OwnedBranch<'a> {
    piece: Option<&'a PieceRecord>,
    branch: &'a BranchRecord,
}

/// The branches and curves of a store.
#[derive(Debug)]
pub(crate) struct Branches {
    diagram: Vec<BranchRecord>,
    pieces: Vec<PieceRecord>,
}

impl Branches {
    pub fn of(store: &Store) -> Result<Self, StoreError> {
        Ok(Self { diagram: store.branches()?, pieces: store.pieces()? })
    }

    /// The branches of a table, one after the other.
    pub fn over(&self, over: TableOver) -> Vec<OwnedBranch<'_>> {
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
}

impl OwnedBranch<'_> {
    /// Number of the branch; within its piece, where there is one.
    pub fn id(&self) -> u32 {
        self.branch.id
    }

    /// Period of its orbits over that of the excitation.
    pub fn period_multiple(&self) -> u32 {
        self.branch.period_multiple
    }

    /// Each line of a table that the branch has.
    pub fn each_line<E: From<StoreError>>(
        &self,
        store: &Store,
        lines: TableLines,
        take: impl FnMut(&Line<'_>) -> Result<(), E>,
    ) -> Result<(), E> {
        match lines {
            TableLines::Rows => self.each_row(store, take),
            TableLines::Events => self.each_event(store, take),
            TableLines::Ends => self.each_end(store, take),
            TableLines::States => self.each_state(store, take),
            TableLines::Outputs => self.each_output(store, take),
        }
    }

    /// The rows of the lines of [`TableLines::Rows`], so many at a time.
    pub fn each_block<E: From<StoreError>>(
        &self,
        store: &Store,
        size: usize,
        mut take: impl FnMut(&[Row]) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut rows = Vec::with_capacity(size);
        store.each_row::<E>(self.branch, |row| {
            rows.push(row);
            if rows.len() == size {
                take(&rows)?;
                rows.clear();
            }
            Ok(())
        })?;
        take(&rows)
    }

    fn line(&self, row: Row) -> Line<'_> {
        Line { of: self, number: 0, side: Side::Up, row, event: None, point: None, output: None }
    }

    fn each_row<E: From<StoreError>>(
        &self,
        store: &Store,
        mut take: impl FnMut(&Line<'_>) -> Result<(), E>,
    ) -> Result<(), E> {
        store.each_row(self.branch, |row| take(&self.line(row)))
    }

    fn each_event<E: From<StoreError>>(
        &self,
        store: &Store,
        mut take: impl FnMut(&Line<'_>) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut next = 0;
        store.each_placed_row::<E>(self.branch, |placed| {
            let number = next;
            next += 1;
            let key = solution_key(self.branch.start, placed.side, placed.number);
            // These are no events.
            let marks = [BranchEventKind::Start, BranchEventKind::End];
            let events = marks.into_iter().fold(placed.row.events, EventSet::without);
            let Some(event) = store.event(key)?.filter(|_| events != EventSet::default()) else {
                return Ok(());
            };
            // It was walked the other way than rows are counted.
            let event = if placed.side == Side::Down { event.backwards() } else { event };
            let mut row = placed.row;
            if self.piece.is_none() {
                row.events = events;
            }
            let point = Point { multipliers: store.multipliers(key)?, ..Point::default() };
            take(&Line { number, event: Some(event), point: Some(point), ..self.line(row) })
        })
    }

    fn each_end<E: From<StoreError>>(
        &self,
        store: &Store,
        mut take: impl FnMut(&Line<'_>) -> Result<(), E>,
    ) -> Result<(), E> {
        for side in [Side::Down, Side::Up] {
            let Some((last_side, number)) = self.branch.last_of(side) else { continue };
            let (row, point) = point_at(store, solution_key(self.branch.start, last_side, number))?;
            take(&Line { side, point: Some(point), ..self.line(row) })?;
        }
        Ok(())
    }

    fn each_state<E: From<StoreError>>(
        &self,
        store: &Store,
        mut take: impl FnMut(&Line<'_>) -> Result<(), E>,
    ) -> Result<(), E> {
        for (number, (side, of_side)) in (0..).zip(self.branch.places()) {
            let (row, point) = point_at(store, solution_key(self.branch.start, side, of_side))?;
            take(&Line { number, point: Some(point), ..self.line(row) })?;
        }
        Ok(())
    }

    /// A line for each output of each row that has its numbers.
    fn each_output<E: From<StoreError>>(
        &self,
        store: &Store,
        mut take: impl FnMut(&Line<'_>) -> Result<(), E>,
    ) -> Result<(), E> {
        let outputs = StoredOutputs::of(store)?;
        let mut next = 0;
        store.each_placed_row::<E>(self.branch, |placed| {
            let number = next;
            next += 1;
            let key = solution_key(self.branch.start, placed.side, placed.number);
            let values = outputs.values(key, self.branch.period_multiple)?;
            for (output, statistics) in outputs.outputs().iter().zip(values.unwrap_or_default()) {
                take(&Line { number, output: Some((output, statistics)), ..self.line(placed.row) })?;
            }
            Ok(())
        })
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
pub(crate) struct Line<'a> {
    of: &'a OwnedBranch<'a>,
    /// Of the row, from 0 along the branch.
    number: u64,
    /// Of an end.
    side: Side,
    row: Row,
    event: Option<LocatedEvent>,
    point: Option<Point>,
    output: Option<(&'a OutputEntry, SignalStatistics)>,
}

impl Line<'_> {
    /// What the line has in a column.
    pub fn cell(&self, column: TableColumn) -> Cell {
        let of_row = self.row.value(column).map(Cell::from);
        of_row
            .or_else(|| self.of_branch(column))
            .or_else(|| self.of_point(column))
            .or_else(|| self.of_event(column))
            .or_else(|| self.of_output(column))
            .unwrap_or(Cell::None)
    }

    fn of_branch(&self, column: TableColumn) -> Option<Cell> {
        let OwnedBranch { piece, branch } = self.of;
        let end = branch.walk(self.side).end.as_ref();
        Some(match column {
            TableColumn::Branch => Cell::Whole(branch.id.into()),
            TableColumn::PeriodMultiple => Cell::Whole(branch.period_multiple.into()),
            TableColumn::Of => Cell::Words((*piece)?.kind.name().into()),
            TableColumn::Piece => Cell::Whole((*piece)?.place.into()),
            TableColumn::ParameterName => Cell::Words((*piece)?.parameter.clone().into()),
            TableColumn::Side => Cell::Words(if self.side == Side::Down { "down" } else { "up" }.into()),
            TableColumn::End => Cell::Words(end.map_or("not-finished", |end| end.word()).into()),
            TableColumn::Message => {
                let along = piece.map_or(BranchOver::Frequency, PieceRecord::along);
                Cell::Words(end.map_or(NOT_FINISHED.into(), |end| sentence(end, along).into()))
            }
            TableColumn::RowNumber => Cell::Whole(self.number),
            _ => return None,
        })
    }

    fn of_point(&self, column: TableColumn) -> Option<Cell> {
        let point = self.point.as_ref()?;
        match column {
            TableColumn::Phase => Some(Cell::Number(point.phase)),
            TableColumn::State => Some(Cell::Numbers(point.state.clone())),
            TableColumn::Multipliers => Some(Cell::Complex(point.multipliers.clone())),
            _ => None,
        }
    }

    fn of_event(&self, column: TableColumn) -> Option<Cell> {
        let event = self.event.as_ref()?;
        let critical = |part: usize| event.multiplier.map(|pair| Cell::Number(pair[part]));
        match column {
            TableColumn::Status => Some(Cell::Words(
                match event.status {
                    EventStatus::Located => "located",
                    EventStatus::Bracketed => "bracketed",
                }
                .into(),
            )),
            TableColumn::UncertaintyHz | TableColumn::Uncertainty => Some(Cell::Number(event.uncertainty)),
            TableColumn::MultiplierRe => critical(0),
            TableColumn::MultiplierIm => critical(1),
            TableColumn::ContactChange => Some(Cell::Words(changes(&event.contacts).into())),
            TableColumn::Direction => Some(Cell::Numbers(event.direction.clone())),
            TableColumn::SymmetryBreaking => Some(Cell::Flag(event.breaks_symmetry)),
            _ => None,
        }
    }

    fn of_output(&self, column: TableColumn) -> Option<Cell> {
        let (output, statistics) = self.output.as_ref()?;
        let harmonics =
            |of: fn(&[f64; 2]) -> f64| Cell::Numbers(statistics.harmonics.iter().map(of).collect());
        Some(match column {
            TableColumn::OutputName => Cell::Words(output.name.clone().into()),
            TableColumn::OutputQuantity => Cell::Words(output.quantity.word().into()),
            TableColumn::OutputUnit => Cell::Words(output.quantity.unit().into()),
            TableColumn::OutputMaximum => Cell::Number(statistics.maximum),
            TableColumn::OutputMinimum => Cell::Number(statistics.minimum),
            TableColumn::OutputLargest => Cell::Number(statistics.largest()),
            TableColumn::OutputPeakToPeak => Cell::Number(statistics.peak_to_peak()),
            TableColumn::OutputMean => Cell::Number(statistics.mean),
            TableColumn::OutputRootMeanSquare => Cell::Number(statistics.root_mean_square),
            TableColumn::OutputAmplitudes => harmonics(|[re, im]| re.hypot(*im)),
            TableColumn::OutputPhases => harmonics(|[re, im]| im.atan2(*re)),
            _ => return None,
        })
    }
}

fn changes(contacts: &[ContactChange]) -> String {
    let change =
        |change: &ContactChange| format!("{}{}", if change.appears { "+" } else { "-" }, change.contact + 1);
    contacts.iter().map(change).collect::<Vec<_>>().join(" ")
}
