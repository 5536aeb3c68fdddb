//! From the bytes of a table to its points.

use super::{
    columns::{ColumnRole, TitledColumn, roles},
    measured::{MeasuredKind, MeasuredMaxima, MeasuredPoint, MeasuredTable},
};
use crate::{
    error::PointsError,
    read::csv::{NumberedLine, TextTable, content_lines, decode, excerpt},
};

/// Reads a table of measured points.
///
/// # Errors
/// See [`PointsError`].
pub fn parse(bytes: &[u8]) -> Result<MeasuredTable, PointsError> {
    let mut findings = Vec::new();
    let text = decode(bytes, &mut findings).map_err(|_| PointsError::NotText)?;
    let lines: Vec<NumberedLine> = content_lines(&text).collect();
    let Some((&(_, titles), rows)) = lines.split_first() else { return Err(PointsError::Empty) };
    let table = TextTable::of_titles(titles);
    let titles: Vec<String> = table.fields(titles);
    let columns = roles(&titles, &mut findings)?;
    if rows.is_empty() {
        return Err(PointsError::NoRows);
    }
    let points = rows.iter().map(|&(line, text)| {
        let fields = table.fields(text);
        if fields.len() != columns.len() {
            return Err(PointsError::RaggedRow { line, found: fields.len(), expected: columns.len() });
        }
        point(&table, line, &columns, &fields)
    });
    Ok(MeasuredTable { points: points.collect::<Result<_, _>>()?, findings })
}

fn point(
    table: &TextTable,
    line: usize,
    columns: &[TitledColumn],
    fields: &[String],
) -> Result<MeasuredPoint, PointsError> {
    let (mut frequency_hz, mut maxima, mut excitation) = (None, MeasuredMaxima::default(), None);
    let (mut kind, mut period) = (MeasuredKind::Unknown, None);
    for (column, field) in columns.iter().zip(fields) {
        let value = |factor: f64| positive(table, line, (&column.title, field), factor);
        match column.role {
            ColumnRole::Frequency(factor) => frequency_hz = value(factor)?,
            ColumnRole::Maximum(unit) => {
                if let Some(found) = value(unit.factor)? {
                    maxima.set(unit.quantity, found);
                }
            }
            ColumnRole::Excitation(unit) => {
                excitation = value(unit.factor)?.map(|amplitude| (unit.quantity, amplitude));
            }
            ColumnRole::Kind => kind = kind_of(line, field)?,
            ColumnRole::Period => period = period_of(line, field)?,
            ColumnRole::Other => {}
        }
    }
    let frequency_hz = frequency_hz.ok_or(PointsError::MissingFrequency { line })?;
    if maxima == MeasuredMaxima::default() {
        return Err(PointsError::MissingMaximum { line });
    }
    let kind = match (kind, period) {
        (MeasuredKind::Periodic { .. } | MeasuredKind::Unknown, Some(_)) => {
            MeasuredKind::Periodic { period_multiple: period }
        }
        (other, Some(period)) => {
            return Err(PointsError::PeriodOfAperiodic { line, kind: other.word(), period });
        }
        (kind, None) => kind,
    };
    Ok(MeasuredPoint { origin: format!("line {line}"), frequency_hz, maxima, kind, excitation })
}

/// A positive number times a factor; `None` if the field is empty.
fn positive(
    table: &TextTable,
    line: usize,
    (title, field): (&str, &str),
    factor: f64,
) -> Result<Option<f64>, PointsError> {
    let column = || title.to_owned();
    let value = table.number(field).ok_or_else(|| PointsError::NotANumber {
        line,
        column: column(),
        text: excerpt(field),
    })?;
    match value {
        value if value.is_nan() => Ok(None),
        value if value > 0.0 && value.is_finite() => Ok(Some(factor * value)),
        value => Err(PointsError::NotPositive { line, column: column(), value }),
    }
}

fn kind_of(line: usize, text: &str) -> Result<MeasuredKind, PointsError> {
    match text.trim().to_lowercase().as_str() {
        "" | "-" | "unknown" => Ok(MeasuredKind::Unknown),
        "periodic" => Ok(MeasuredKind::Periodic { period_multiple: None }),
        "aperiodic" | "chaotic" | "chaos" | "quasi-periodic" | "quasiperiodic" => Ok(MeasuredKind::Aperiodic),
        "doubtful" => Ok(MeasuredKind::Doubtful),
        _ => Err(PointsError::UnknownKind { line, text: excerpt(text) }),
    }
}

fn period_of(line: usize, text: &str) -> Result<Option<u32>, PointsError> {
    match text.trim() {
        "" | "-" => Ok(None),
        text => match text.parse::<u32>() {
            Ok(period) if (1..=64).contains(&period) => Ok(Some(period)),
            _ => Err(PointsError::BadPeriod { line, text: excerpt(text) }),
        },
    }
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
