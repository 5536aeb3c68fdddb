//! Which of several columns is the time, and whether a sampling rate named in the file agrees with it.

use crate::{
    finding::RecordFinding,
    title::names_time,
    unit::{MeasuredQuantity, unit},
};

/// Relative difference up to which two sampling rates are the same one, rounded.
const SAME_RATE: f64 = 0.01;

/// Name and unit of a column.
type ColumnTitle<'a> = (&'a str, Option<&'a str>);

/// Index of the column that is the time by its name or unit.
///
/// A name takes precedence over a unit: a column named time, in seconds or in no known unit, comes before
/// other columns in a unit of time.
///
/// * `columns`: name and unit of each.
pub(super) fn time_column(columns: &[ColumnTitle]) -> Option<usize> {
    let quantity = |column: &ColumnTitle| column.1.and_then(unit).map(|unit| unit.quantity);
    let named = |column: &ColumnTitle| names_time(column.0);
    let measures_time = |column: &ColumnTitle| quantity(column) == Some(MeasuredQuantity::Time);
    let both = columns.iter().position(|column| named(column) && measures_time(column));
    let without_unit = || columns.iter().position(|column| named(column) && quantity(column).is_none());
    both.or_else(without_unit).or_else(|| columns.iter().position(measures_time))
}

/// Whether values rise by nearly equal steps.
pub(super) fn rises_evenly(values: &[f64]) -> bool {
    let Some(([first, ..], last)) = values.split_last().map(|(last, rest)| (rest, last)) else {
        return false;
    };
    let step = (last - first) / (values.len() - 1) as f64;
    step > 0.0 && values.windows(2).all(|pair| (pair[1] - pair[0] - step).abs() < 0.1 * step)
}

/// Adds a finding if a named rate matches neither the median step, which gaps do not affect, nor the mean
/// step, which rounding does not affect.
pub(super) fn compare_rates(named_hz: Option<f64>, times: &[f64], findings: &mut Vec<RecordFinding>) {
    let Some(named_hz) = named_hz else { return };
    let mut steps: Vec<f64> =
        times.windows(2).map(|pair| pair[1] - pair[0]).filter(|step| step.is_finite()).collect();
    if steps.is_empty() {
        return;
    }
    let mean = steps.iter().sum::<f64>() / steps.len() as f64;
    let middle = steps.len() / 2;
    let median = *steps.select_nth_unstable_by(middle, f64::total_cmp).1;
    if [mean, median].iter().all(|step| (step * named_hz - 1.0).abs() > SAME_RATE) {
        // A few long steps are gaps, which lengthen the mean. Many long steps are rounded times, whose median
        // has no meaning.
        let long = steps.iter().filter(|step| **step > 1.5 * median).count();
        let step = if 10 * long < steps.len() { median } else { mean };
        findings.push(RecordFinding::NamedRateDisagrees { named_hz, found_hz: 1.0 / step });
    }
}
