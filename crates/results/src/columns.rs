//! The columns of all tables of branches: the one list from which the store, CSV and the reference follow.
//!
//! A number of a [`Row`] is named, described and read here, so the table of solutions in the database
//! ([`TableColumn::STORED`]), the CSV files ([`export`](crate::export)) and
//! `docs/reference/results-tables.md` agree.

use hammerbeam_orbit::{EventSet, Stability};

use crate::row::Row;

/// A column of a table of branches, events, ends or states.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each has its meaning in words")]
pub enum TableColumn {
    Of,
    Piece,
    Branch,
    PeriodMultiple,
    ParameterName,
    RowNumber,
    Side,
    Parameter,
    Frequency,
    Displacement,
    Acceleration,
    ContactForce,
    ImpactVelocity,
    Impulse,
    Contacts,
    LeadingMultiplierRe,
    LeadingMultiplierIm,
    Stable,
    Event,
    Residual,
    ErrorEstimate,
    Status,
    UncertaintyHz,
    Uncertainty,
    MultiplierRe,
    MultiplierIm,
    ContactChange,
    Direction,
    SymmetryBreaking,
    End,
    Message,
    Phase,
    State,
    Multipliers,
    OutputName,
    OutputQuantity,
    OutputUnit,
    OutputMaximum,
    OutputMinimum,
    OutputLargest,
    OutputPeakToPeak,
    OutputMean,
    OutputRootMeanSquare,
    OutputAmplitudes,
    OutputPhases,
}

/// What the entries of a column are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColumnKind {
    /// A number; without one it is not a number.
    Number,
    /// A whole number.
    Whole,
    /// Words.
    Words,
    /// True or false.
    Flag,
    /// Stable, marginal or unstable.
    Stability,
    /// Names of events.
    Events,
    /// A list of numbers.
    Numbers,
    /// A list of complex numbers.
    Complex,
}

/// What a row has in a column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RowValue {
    /// A number.
    Number(f64),
    /// How many.
    Count(u32),
    /// Stable, marginal or unstable.
    Stability(Stability),
    /// What happens.
    Events(EventSet),
}

impl TableColumn {
    /// Those of a row that are stored, in the order of the database.
    pub const STORED: [Self; 14] = [
        Self::Parameter,
        Self::Frequency,
        Self::Displacement,
        Self::Acceleration,
        Self::ContactForce,
        Self::ImpactVelocity,
        Self::Impulse,
        Self::Contacts,
        Self::Event,
        Self::Stable,
        Self::LeadingMultiplierRe,
        Self::LeadingMultiplierIm,
        Self::Residual,
        Self::ErrorEstimate,
    ];

    /// Its name, with the unit of its values.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.described().0
    }

    /// What its entries are.
    #[must_use]
    pub fn kind(self) -> ColumnKind {
        self.described().1
    }

    /// What it holds, as the reference says it.
    #[must_use]
    pub fn meaning(self) -> &'static str {
        self.described().2
    }

    fn described(self) -> (&'static str, ColumnKind, &'static str) {
        use ColumnKind as K;
        match self {
            Self::Of => {
                ("of", K::Words, "what a curve consists of: `fold`, `flip`, `neimark-sacker` or `grazing`")
            }
            Self::Piece => ("piece", K::Whole, "which `[[vary]]` or `[[curve]]` of the study, from 1"),
            Self::Branch => {
                ("branch", K::Whole, "number of the branch; within its piece, where there is one")
            }
            Self::PeriodMultiple => ("period_multiple", K::Whole, "orbit period over excitation period"),
            Self::ParameterName => ("parameter_name", K::Words, "the parameter, as the study file names it"),
            Self::RowNumber => ("row", K::Whole, "number of the row, from 0 along the branch"),
            Self::Side => ("side", K::Words, "which end: `down` or `up`"),
            Self::Parameter => ("parameter", K::Number, "value of the parameter, in the unit of its name"),
            Self::Frequency => ("frequency_hz", K::Number, "excitation frequency"),
            Self::Displacement => {
                ("max_abs_displacement_m", K::Number, "of the response point, in space, over the orbit")
            }
            Self::Acceleration => {
                ("max_abs_acceleration_m_s2", K::Number, "of the response point, in space, over the orbit")
            }
            Self::ContactForce => ("max_contact_force_n", K::Number, "largest over all stops"),
            Self::ImpactVelocity => ("max_impact_velocity_m_s", K::Number, "largest over all stops"),
            Self::Impulse => ("impulse_n_s", K::Number, "sum of the impulses of all contacts"),
            Self::Contacts => ("contacts", K::Whole, "number of contacts in an orbit period"),
            Self::LeadingMultiplierRe => {
                ("leading_multiplier_re", K::Number, "Floquet multiplier of largest modulus, its real part")
            }
            Self::LeadingMultiplierIm => {
                ("leading_multiplier_im", K::Number, "its imaginary part, the positive one of a pair")
            }
            Self::Stable => (
                "stable",
                K::Stability,
                "`true`: all multipliers are known to lie inside the unit circle; `false`: one is known to \
                 lie outside; `marginal`: neither is known, as at a bifurcation, or where errors grow very \
                 much within a period",
            ),
            Self::Event => (
                "event",
                K::Events,
                "empty, or `fold`, `flip`, `neimark-sacker`, `branch-point`, `grazing`, `start`, `end`, \
                 joined by `+`; on curves also points of codimension two",
            ),
            Self::Residual => {
                ("residual", K::Number, "how far the orbit is from closing, relative to its size")
            }
            Self::ErrorEstimate => (
                "error_estimate",
                K::Number,
                "the correction that was still due when the solution was accepted",
            ),
            Self::Status => (
                "status",
                K::Words,
                "`located`: to 1e-8 of the frequency or parameter; `bracketed`: within the uncertainty",
            ),
            Self::UncertaintyHz => ("uncertainty_hz", K::Number, "how far off the frequency may be"),
            Self::Uncertainty => ("uncertainty", K::Number, "how far off the parameter may be, in its unit"),
            Self::MultiplierRe => ("multiplier_re", K::Number, "the critical multiplier, its real part"),
            Self::MultiplierIm => ("multiplier_im", K::Number, "its imaginary part"),
            Self::ContactChange => (
                "contact_change",
                K::Words,
                "at grazing, numbers of the contacts with `+` if they appear and `-` if they vanish, in the \
                 order of the rows",
            ),
            Self::Direction => (
                "direction",
                K::Numbers,
                "critical direction of the state; at the start of a branch on another one, the direction \
                 in which it leaves",
            ),
            Self::SymmetryBreaking => (
                "symmetry_breaking",
                K::Flag,
                "of a branch point: whether the crossing branch has less symmetry",
            ),
            Self::End => ("end", K::Words, "a word for programs; [why a branch ends](ends.md) explains each"),
            Self::Message => ("message", K::Words, "why the branch ends there, in a sentence"),
            Self::Phase => ("phase_cycles", K::Number, "phase of the excitation at which the state is"),
            Self::State => (
                "state",
                K::Numbers,
                "the state `q1 .. qn v1 .. vn` there; `simulate --initial` takes it where its phase is 0",
            ),
            Self::Multipliers => {
                ("multipliers", K::Complex, "all multipliers, as `re+imi` with blanks between them")
            }
            Self::OutputName => ("output", K::Words, "name of the `[[output]]`"),
            Self::OutputQuantity => {
                ("quantity", K::Words, "what is read: `displacement`, `velocity`, `acceleration` or `force`")
            }
            Self::OutputUnit => ("unit", K::Words, "unit of the numbers from `maximum` to `amplitudes`"),
            Self::OutputMaximum => ("maximum", K::Number, "largest value over the orbit"),
            Self::OutputMinimum => ("minimum", K::Number, "smallest value over the orbit"),
            Self::OutputLargest => ("max_abs", K::Number, "largest absolute value"),
            Self::OutputPeakToPeak => ("peak_to_peak", K::Number, "largest value less smallest value"),
            Self::OutputMean => ("mean", K::Number, "mean over the orbit"),
            Self::OutputRootMeanSquare => ("rms", K::Number, "root of the mean square, the mean included"),
            Self::OutputAmplitudes => (
                "amplitudes",
                K::Numbers,
                "amplitudes of the orders `1/n`, `2/n`, ... of the excitation frequency, n being the period \
                 multiple",
            ),
            Self::OutputPhases => (
                "phases_rad",
                K::Numbers,
                "their phases `p`: a harmonic is `amplitude cos(2 pi (j/n) x + p)` at the phase x of the \
                 excitation in cycles",
            ),
        }
    }
}

impl Row {
    /// What the row has in a column; `None` where the column is not one of a row.
    #[must_use]
    pub fn value(&self, column: TableColumn) -> Option<RowValue> {
        match column {
            TableColumn::Contacts => Some(RowValue::Count(self.maxima.contacts)),
            TableColumn::Stable => Some(RowValue::Stability(self.stability)),
            TableColumn::Event => Some(RowValue::Events(self.events)),
            _ => self.number(column).map(RowValue::Number),
        }
    }

    /// The number that the row has in a column; `None` where it has something else or nothing.
    #[must_use]
    pub fn number(&self, column: TableColumn) -> Option<f64> {
        let maxima = &self.maxima;
        Some(match column {
            TableColumn::Parameter => self.parameter,
            TableColumn::Frequency => self.frequency_hz,
            TableColumn::Displacement => maxima.displacement,
            TableColumn::Acceleration => maxima.acceleration,
            TableColumn::ContactForce => maxima.contact_force,
            TableColumn::ImpactVelocity => maxima.impact_velocity,
            TableColumn::Impulse => maxima.impulse,
            TableColumn::LeadingMultiplierRe => self.leading_multiplier[0],
            TableColumn::LeadingMultiplierIm => self.leading_multiplier[1],
            TableColumn::Residual => self.residual,
            TableColumn::ErrorEstimate => self.error_estimate,
            _ => return None,
        })
    }

    /// Takes a value into a column of a row; whether it is one of its kind.
    pub(crate) fn set(&mut self, column: TableColumn, value: RowValue) -> bool {
        let maxima = &mut self.maxima;
        let number = match (column, value) {
            (TableColumn::Contacts, RowValue::Count(count)) => return put(&mut maxima.contacts, count),
            (TableColumn::Stable, RowValue::Stability(stability)) => {
                return put(&mut self.stability, stability);
            }
            (TableColumn::Event, RowValue::Events(events)) => return put(&mut self.events, events),
            (_, RowValue::Number(number)) => number,
            _ => return false,
        };
        let place = match column {
            TableColumn::Parameter => &mut self.parameter,
            TableColumn::Frequency => &mut self.frequency_hz,
            TableColumn::Displacement => &mut maxima.displacement,
            TableColumn::Acceleration => &mut maxima.acceleration,
            TableColumn::ContactForce => &mut maxima.contact_force,
            TableColumn::ImpactVelocity => &mut maxima.impact_velocity,
            TableColumn::Impulse => &mut maxima.impulse,
            TableColumn::LeadingMultiplierRe => &mut self.leading_multiplier[0],
            TableColumn::LeadingMultiplierIm => &mut self.leading_multiplier[1],
            TableColumn::Residual => &mut self.residual,
            TableColumn::ErrorEstimate => &mut self.error_estimate,
            _ => return false,
        };
        put(place, number)
    }
}

fn put<T>(place: &mut T, value: T) -> bool {
    *place = value;
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is written of a row in the stored columns is all of it.
    #[test]
    fn a_row_comes_back_from_its_stored_columns() {
        let mut row = Row { stability: Stability::Marginal, ..Row::default() };
        let values: Vec<RowValue> =
            TableColumn::STORED.into_iter().map(|column| row.value(column).unwrap()).collect();
        for (index, (column, value)) in TableColumn::STORED.into_iter().zip(values).enumerate() {
            let other = match value {
                RowValue::Number(_) => RowValue::Number(index as f64 + 1.0),
                RowValue::Count(_) => RowValue::Count(index as u32 + 1),
                RowValue::Stability(_) => RowValue::Stability(Stability::Stable),
                RowValue::Events(_) => RowValue::Events(EventSet::of_bits(5).unwrap()),
            };
            assert!(row.set(column, other));
            assert_eq!(row.value(column), Some(other), "{column:?}");
        }
        let mut back = Row::default();
        for column in TableColumn::STORED {
            assert!(back.set(column, row.value(column).unwrap()));
        }
        assert_eq!(back, row);
        assert!(
            !back.set(TableColumn::Contacts, RowValue::Number(1.0))
                && row.value(TableColumn::Message).is_none()
        );
    }
}
