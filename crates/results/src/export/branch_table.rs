//! The tables of branches and curves: which there are, and which of the columns each has.

use crate::columns::TableColumn;
use TableColumn as C;

/// What the branches of a table run along.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TableOver {
    /// The frequency.
    Frequency,
    /// Another parameter.
    Parameters,
    /// A curve of bifurcations.
    Curves,
}

/// What has a line in a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TableLines {
    /// Each row.
    Rows,
    /// Each row of which more is known of what happens there.
    Events,
    /// Each end.
    Ends,
    /// Each row, with its state and all multipliers.
    States,
    /// Each output of each row.
    Outputs,
}

/// A table of branches or curves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BranchTable {
    /// Name; that of its file has `.csv` behind it.
    pub name: &'static str,
    /// What its branches run along.
    pub over: TableOver,
    /// What has a line in it.
    pub lines: TableLines,
    /// Its columns; of curves with [`TableColumn::Of`] in front.
    columns: &'static [TableColumn],
}

/// Columns of `branches.csv`; the first twelve are fixed, further ones follow after them.
const BRANCHES: [TableColumn; 15] = [
    C::Branch,
    C::PeriodMultiple,
    C::Frequency,
    C::Displacement,
    C::Acceleration,
    C::ContactForce,
    C::ImpactVelocity,
    C::Contacts,
    C::LeadingMultiplierRe,
    C::LeadingMultiplierIm,
    C::Stable,
    C::Event,
    C::Impulse,
    C::Residual,
    C::ErrorEstimate,
];

const PARAMETER_BRANCHES: [TableColumn; 18] = [
    C::Piece,
    C::Branch,
    C::PeriodMultiple,
    C::ParameterName,
    C::Parameter,
    C::Frequency,
    C::Displacement,
    C::Acceleration,
    C::ContactForce,
    C::ImpactVelocity,
    C::Impulse,
    C::LeadingMultiplierRe,
    C::LeadingMultiplierIm,
    C::Residual,
    C::ErrorEstimate,
    C::Contacts,
    C::Stable,
    C::Event,
];

const EVENTS: [TableColumn; 13] = [
    C::Branch,
    C::PeriodMultiple,
    C::RowNumber,
    C::Event,
    C::Frequency,
    C::Status,
    C::UncertaintyHz,
    C::MultiplierRe,
    C::MultiplierIm,
    C::ContactChange,
    C::Direction,
    C::SymmetryBreaking,
    C::Multipliers,
];

const PARAMETER_EVENTS: [TableColumn; 16] = [
    C::Piece,
    C::Branch,
    C::PeriodMultiple,
    C::ParameterName,
    C::RowNumber,
    C::Event,
    C::Parameter,
    C::Frequency,
    C::Status,
    C::Uncertainty,
    C::MultiplierRe,
    C::MultiplierIm,
    C::ContactChange,
    C::Direction,
    C::SymmetryBreaking,
    C::Multipliers,
];

const ENDS: [TableColumn; 8] =
    [C::Branch, C::PeriodMultiple, C::Side, C::End, C::Frequency, C::Message, C::Phase, C::State];

const PARAMETER_ENDS: [TableColumn; 11] = [
    C::Piece,
    C::Branch,
    C::PeriodMultiple,
    C::ParameterName,
    C::Side,
    C::Parameter,
    C::Frequency,
    C::Message,
    C::Phase,
    C::State,
    C::End,
];

const STATES: [TableColumn; 7] =
    [C::Branch, C::PeriodMultiple, C::RowNumber, C::Frequency, C::Phase, C::State, C::Multipliers];

const PARAMETER_STATES: [TableColumn; 10] = [
    C::Piece,
    C::Branch,
    C::PeriodMultiple,
    C::ParameterName,
    C::RowNumber,
    C::Parameter,
    C::Frequency,
    C::Phase,
    C::State,
    C::Multipliers,
];

const OUTPUTS: [TableColumn; 15] = [
    C::Branch,
    C::PeriodMultiple,
    C::RowNumber,
    C::Frequency,
    C::OutputName,
    C::OutputQuantity,
    C::OutputUnit,
    C::OutputMaximum,
    C::OutputMinimum,
    C::OutputLargest,
    C::OutputPeakToPeak,
    C::OutputMean,
    C::OutputRootMeanSquare,
    C::OutputAmplitudes,
    C::OutputPhases,
];

const PARAMETER_OUTPUTS: [TableColumn; 18] = [
    C::Piece,
    C::Branch,
    C::PeriodMultiple,
    C::ParameterName,
    C::RowNumber,
    C::Parameter,
    C::Frequency,
    C::OutputName,
    C::OutputQuantity,
    C::OutputUnit,
    C::OutputMaximum,
    C::OutputMinimum,
    C::OutputLargest,
    C::OutputPeakToPeak,
    C::OutputMean,
    C::OutputRootMeanSquare,
    C::OutputAmplitudes,
    C::OutputPhases,
];

impl BranchTable {
    /// The rows of branches over the frequency.
    pub const ROWS: Self = Self::new("branches", TableOver::Frequency, TableLines::Rows, &BRANCHES);

    /// All of them, in the order in which they are written.
    pub const ALL: &'static [Self] = &[
        Self::ROWS,
        Self::new("events", TableOver::Frequency, TableLines::Events, &EVENTS),
        Self::new("ends", TableOver::Frequency, TableLines::Ends, &ENDS),
        Self::new("parameter_branches", TableOver::Parameters, TableLines::Rows, &PARAMETER_BRANCHES),
        Self::new("parameter_events", TableOver::Parameters, TableLines::Events, &PARAMETER_EVENTS),
        Self::new("parameter_ends", TableOver::Parameters, TableLines::Ends, &PARAMETER_ENDS),
        Self::new("curves", TableOver::Curves, TableLines::Rows, &PARAMETER_BRANCHES),
        Self::new("curve_ends", TableOver::Curves, TableLines::Ends, &PARAMETER_ENDS),
        Self::new("states", TableOver::Frequency, TableLines::States, &STATES),
        Self::new("parameter_states", TableOver::Parameters, TableLines::States, &PARAMETER_STATES),
        Self::new("curve_states", TableOver::Curves, TableLines::States, &PARAMETER_STATES),
        Self::new("outputs", TableOver::Frequency, TableLines::Outputs, &OUTPUTS),
        Self::new("parameter_outputs", TableOver::Parameters, TableLines::Outputs, &PARAMETER_OUTPUTS),
        Self::new("curve_outputs", TableOver::Curves, TableLines::Outputs, &PARAMETER_OUTPUTS),
    ];

    const fn new(
        name: &'static str,
        over: TableOver,
        lines: TableLines,
        columns: &'static [TableColumn],
    ) -> Self {
        Self { name, over, lines, columns }
    }

    /// All of them that hold such lines over that.
    pub fn of(over: TableOver, lines: TableLines) -> impl Iterator<Item = &'static Self> {
        Self::ALL.iter().filter(move |table| table.over == over && table.lines == lines)
    }

    /// Its columns, in their order.
    pub fn columns(&self) -> impl Iterator<Item = TableColumn> + use<> {
        let front = (self.over == TableOver::Curves).then_some(TableColumn::Of);
        front.into_iter().chain(self.columns.iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `docs/reference/results-tables.md` describes every column, in the words of the list.
    #[test]
    fn the_reference_has_every_column_with_its_meaning() {
        let page = include_str!("../../../../docs/reference/results-tables.md");
        for table in BranchTable::ALL {
            assert!(page.contains(&format!("`{}.csv`", table.name)), "{} is missing", table.name);
            for column in table.columns() {
                let line = format!("| `{}` | {} |", column.name(), column.meaning());
                assert!(page.lines().any(|other| other == line), "{} needs the line\n{line}", table.name);
            }
        }
    }
}
